#version 450
// Takes pixels out like discard_checker.frag does, by the mask of their one sample.
layout(location = 0) flat in vec4 in_color;
layout(location = 0) out vec4 out_color;
void main() {
  const ivec2 p = ivec2(gl_FragCoord.xy);
  gl_SampleMask[0] = gl_SampleMaskIn[0] << ((p.x + p.y) & 1);
  const bool right = gl_SampleID == 0 && gl_SamplePosition == vec2(0.5);
  out_color = right ? in_color : vec4(0.5);
}
