#version 450
// Sums of a workgroup's numbers up to each, with barriers in the loop of a function; and their sum by halves.
layout(local_size_x_id = 0) in;
layout(local_size_x = 1024) in;
layout(std430, set = 0, binding = 0) readonly buffer In { uint values[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Out { uint sums[]; };
layout(std430, set = 0, binding = 2) writeonly buffer Totals { uint totals[]; };
const uint kSize = gl_WorkGroupSize.x;
shared uint data[kSize];

uint scan(uint value) {
  uint n = gl_LocalInvocationID.x;
  data[n] = value;
  for (uint step = 1; step < kSize; step *= 2) {
    barrier();
    uint before = n >= step ? data[n - step] : 0;
    barrier();
    data[n] += before;
  }
  barrier();
  return data[n];
}

void main() {
  uint n = gl_LocalInvocationID.x;
  sums[gl_GlobalInvocationID.x] = scan(values[gl_GlobalInvocationID.x]);
  barrier();
  data[n] = values[gl_GlobalInvocationID.x];
  for (uint half_size = (kSize + 1) / 2, size = kSize; size > 1; size = half_size, half_size = (size + 1) / 2) {
    barrier();
    if (n < half_size && n + half_size < size) data[n] += data[n + half_size];
  }
  barrier();
  if (n == kSize - 1) totals[gl_WorkGroupID.x] = data[0];
}
