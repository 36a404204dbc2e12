#version 450
// Counts numbers: each workgroup in shared memory, then all of them in the buffer.
layout(local_size_x = 256) in;
layout(std430, set = 0, binding = 0) readonly buffer In { uint values[]; };
layout(std430, set = 0, binding = 1) buffer Out { uint counts[64]; };
shared uint local_counts[64];
void main() {
  uint n = gl_LocalInvocationID.x;
  if (n < 64) local_counts[n] = 0;
  barrier();
  for (uint i = 0; i < 16; ++i) atomicAdd(local_counts[values[(gl_WorkGroupID.x * 16 + i) * 256 + n] & 63], 1);
  barrier();
  if (n < 64 && local_counts[n] != 0) atomicAdd(counts[n], local_counts[n]);
}
