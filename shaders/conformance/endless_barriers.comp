#version 450
// Batches that wait for each other for ever, unless the number is 1.
layout(local_size_x = 128) in;
layout(std430, set = 0, binding = 0) buffer Data { uint number; uint done; };
shared uint round[128];
void main() {
  do {
    barrier();
    ++round[gl_LocalInvocationID.x];
  } while (number != 1);
  done = 1;
}
