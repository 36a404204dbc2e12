// Asks a driver whether it knows shared memory and barriers.
#version 450
layout(local_size_x = 2) in;
layout(std430, set = 0, binding = 0) readonly buffer In { float values[]; };
layout(std430, set = 0, binding = 1) buffer Out { float result[]; };
shared float piece[2];

void main() {
  uint i = gl_LocalInvocationID.x;
  piece[i] = values[i];
  barrier();
  result[i] = piece[1 - i];
}
