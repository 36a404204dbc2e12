#version 450
// An atomic operation at an index from outside, on a buffer and on shared memory.
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) buffer Data { uint values[]; };
layout(std430, set = 0, binding = 1) buffer Results { uint results[128]; };
layout(push_constant) uniform Push { uint index; };
shared uint before[16];
shared uint local_values[64];
shared uint after[16];
void main() {
  uint n = gl_LocalInvocationIndex;
  before[n & 15] = after[n & 15] = 1;
  local_values[n] = 77;
  barrier();
  results[n] = atomicAdd(values[index + n], 5);
  results[64 + n] = atomicOr(local_values[index + n], 0x100);
  barrier();
  results[64 + n] += 0x10000 * (before[n & 15] + after[n & 15]) + 0x1000000 * local_values[n];
}
