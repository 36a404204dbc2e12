#version 450
// An element of an array that is chosen at run time, at another place than the pixel's centre.
layout(location = 0) in mat3 matrix;
layout(location = 3) in float list[5];
layout(location = 0) out vec4 out_color;
layout(push_constant) uniform Push { int mode; };
void main() {
  const int i = (int(gl_FragCoord.x) + mode) % 5;
  const vec2 offset = vec2(0.25, -0.375);
  out_color = vec4(interpolateAtOffset(list[i], offset), interpolateAtCentroid(list[i]), interpolateAtOffset(matrix[i % 3], offset).xy);
}
