#version 450
// Reads and writes shared memory at an index from outside, between two arrays that must stay as they are.
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) buffer Results { uint results[64]; };
layout(push_constant) uniform Push { uint index; uint store; };
shared uint before[16];
shared uint values[64];
shared uint after[16];
void main() {
  uint n = gl_LocalInvocationIndex;
  before[n & 15] = 1;
  values[n] = 77;
  after[n & 15] = 1;
  barrier();
  if (store != 0) values[index + n] = 0xBAD;
  barrier();
  results[n] = values[index + n] + 0x10000 * (before[n & 15] + after[n & 15]);
}
