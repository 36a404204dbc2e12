#version 450
// Counts its invocations, by pixel; helper invocations must not count. Discards those of every third column afterwards.
layout(location = 0) flat in vec4 in_color;
layout(std430, set = 0, binding = 0) buffer Counts { uint vertices, fragments, helpers, vertex[]; };
layout(std430, set = 0, binding = 1) buffer Pixels { uint pixel[]; };
layout(location = 0) out vec4 out_color;
void main() {
  uint old = atomicAdd(fragments, 1);
  if (gl_HelperInvocation) atomicAdd(helpers, 1);
  ivec2 at = ivec2(gl_FragCoord.xy);
  atomicAdd(pixel[at.y * 64 + at.x], 1);
  if (at.x % 3 == 0) discard;
  atomicAdd(pixel[4096 + at.y * 64 + at.x], 1);
  out_color = in_color;
  if (dFdx(float(old)) == 0.125) out_color = vec4(0);
}
