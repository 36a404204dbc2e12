#version 450
// Odd-even sort that ends when a round changes nothing: how often the barriers are met is read from shared memory.
layout(local_size_x = 100) in;
layout(std430, set = 0, binding = 0) buffer Data { uint values[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Rounds { uint rounds[]; };
shared uint data[200];
shared bool changed;

void order(uint low) {
  if (low + 1 >= 200) return;
  uint x = data[low], y = data[low + 1];
  if (x <= y) return;
  data[low] = y;
  data[low + 1] = x;
  changed = true;
}

void main() {
  uint n = gl_LocalInvocationID.x, first = gl_WorkGroupID.x * 200;
  data[2 * n] = values[first + 2 * n];
  data[2 * n + 1] = values[first + 2 * n + 1];
  uint round = 0;
  while (true) {
    if (n == 0) changed = false;
    barrier();
    order(2 * n);
    barrier();
    order(2 * n + 1);
    barrier();
    if (!changed) break;
    ++round;
    barrier();
    if (round % 2 == 1) {
      if (gl_WorkGroupID.x % 2 == 0) {
        barrier();
        continue;
      }
      barrier();
    }
  }
  values[first + 2 * n] = data[2 * n];
  values[first + 2 * n + 1] = data[2 * n + 1];
  if (n == 99) rounds[gl_WorkGroupID.x] = round;
}
