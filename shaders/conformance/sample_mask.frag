#version 450
// Like discard_checker.frag, by the mask of samples.
layout(location = 0) flat in vec4 in_color;
layout(location = 0) out vec4 out_color;
void main() {
  ivec2 p = ivec2(gl_FragCoord.xy);
  out_color = in_color;
  gl_SampleMask[0] = ((p.x + p.y) & 1) == 1 ? ~1 : gl_SampleMaskIn[0];
}
