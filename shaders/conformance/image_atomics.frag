#version 450
// Counts the fragments of each column.
layout(set = 0, binding = 0, r32ui) uniform uimage2D counts;
layout(location = 0) in vec4 in_color;
layout(location = 0) out vec4 out_color;
void main() {
  imageAtomicAdd(counts, ivec2(gl_FragCoord.x, 0), 1u);
  out_color = in_color;
}
