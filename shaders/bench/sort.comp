// Sorts pieces of 1,024 numbers, one for each workgroup: Batcher's bitonic network, 55 steps in shared memory.
#version 450
layout(local_size_x = 512) in;
layout(push_constant) uniform Push {
  float scale;
  uint count;
} push;
layout(std430, set = 0, binding = 0) readonly buffer In { float unsorted[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Out { float sorted[]; };
shared float keys[1024];

void main() {
  uint i = gl_LocalInvocationID.x, first = gl_WorkGroupID.x * 1024;
  keys[i] = unsorted[first + i];
  keys[i + 512] = unsorted[first + i + 512];
  for (uint run = 2; run <= 1024; run *= 2) {
    for (uint apart = run / 2; apart > 0; apart /= 2) {
      barrier();
      uint low = 2 * apart * (i / apart) + i % apart, high = low + apart;
      float a = keys[low], b = keys[high];
      if ((a > b) == ((low & run) == 0)) {
        keys[low] = b;
        keys[high] = a;
      }
    }
  }
  barrier();
  sorted[first + i] = push.scale * keys[i];
  sorted[first + i + 512] = push.scale * keys[i + 512];
}
