#version 450
// Sorts 512 numbers in a workgroup: barriers in nested loops.
layout(local_size_x = 256) in;
layout(std430, set = 0, binding = 0) buffer Data { int values[]; };
shared int data[512];

void main() {
  uint n = gl_LocalInvocationID.x, first = gl_WorkGroupID.x * 512;
  data[n] = values[first + n];
  data[n + 256] = values[first + n + 256];
  for (uint size = 2; size <= 512; size *= 2) {
    for (uint step = size / 2; step > 0; step /= 2) {
      barrier();
      uint low = 2 * n - (n & (step - 1)), high = low + step;
      int x = data[low], y = data[high];
      if ((x > y) == ((low & size) == 0)) {
        data[low] = y;
        data[high] = x;
      }
    }
  }
  barrier();
  values[first + n] = data[n];
  values[first + n + 256] = data[n + 256];
}
