#version 450
// Reads and writes at an index from outside, perhaps far beyond the buffers and arrays.
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) buffer Data { uint values[]; };
layout(std430, set = 0, binding = 1) buffer Results { uint results[64]; };
layout(push_constant) uniform Push { uint index; uint store; };
void main() {
  uint local[4] = uint[4](11u, 12u, 13u, 14u);
  uint at = index + gl_LocalInvocationIndex;
  if (store != 0u) values[at] = 0xBADu;
  results[gl_LocalInvocationIndex] = values[at] + 0u * local[at & 3u];
}
