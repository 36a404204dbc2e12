#version 450
// Inputs of many_varyings.vert and interpolation.vert at other places than the pixel's centre.
layout(location = 0) in vec4 smooth_value;
layout(location = 1) noperspective in vec4 linear_value;
layout(location = 2) flat in vec4 flat_value;
layout(location = 0) out vec4 out_color;
layout(push_constant) uniform Push { int mode; };
void main() {
  const vec2 offset = vec2(int(gl_FragCoord.x) * 7 % 16, int(gl_FragCoord.y) * 5 % 16) / 16.0 - 0.5;
  switch (mode) {
    case 0: out_color = interpolateAtOffset(smooth_value, offset); break;
    case 1: out_color = interpolateAtOffset(linear_value, offset); break;
    case 2: out_color = interpolateAtOffset(flat_value, offset); break;
    case 3: out_color = interpolateAtCentroid(smooth_value); break;
    case 4: out_color = interpolateAtSample(linear_value, 0); break;
    case 5: out_color = vec4(interpolateAtOffset(smooth_value.zw, vec2(0.25, -0.5)), dFdx(interpolateAtOffset(linear_value.x, vec2(0.5, 0))), interpolateAtCentroid(smooth_value.y)); break;
    default: out_color = vec4(-1); break;
  }
}
