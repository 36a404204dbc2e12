#version 450
layout(location = 0) in vec4 smooth_value;
layout(location = 1) noperspective in vec4 linear_value;
layout(location = 2) flat in vec4 flat_value;
layout(location = 3) flat in int flat_int;
layout(location = 0) out vec4 out_color;
layout(push_constant) uniform Push { int mode; };
void main() {
  switch (mode) {
    case 0: out_color = smooth_value; break;
    case 1: out_color = linear_value; break;
    case 2: out_color = flat_value; break;
    case 3: out_color = vec4(flat_int, flat_int >> 31, 0, 1); break;
    case 4: out_color = gl_FragCoord; break;
    case 5: out_color = vec4(gl_FrontFacing ? 1.0 : -1.0, 0, 0, 1); break;
    case 6: out_color = vec4(dFdx(gl_FragCoord.xy), dFdy(gl_FragCoord.xy)); break;
    case 7: out_color = vec4(dFdx(linear_value.x), dFdy(linear_value.x), fwidth(linear_value.y), 1); break;
    default: out_color = vec4(-1); break;
  }
}
