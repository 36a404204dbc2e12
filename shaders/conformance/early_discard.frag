#version 450
// Fragments that are discarded have written their depth before.
layout(early_fragment_tests) in;
layout(location = 0) flat in vec4 in_color;
layout(location = 0) out vec4 out_color;
void main() {
  ivec2 p = ivec2(gl_FragCoord.xy);
  if (((p.x + p.y) & 1) == 1) discard;
  out_color = in_color;
}
