// Product of two square matrices (in one buffer, the second behind the first) by tiles of 16 x 16 in shared memory.
#version 450
layout(local_size_x = 256) in;
layout(push_constant) uniform Push {
  float scale;
  uint count;  // elements of a matrix
} push;
layout(std430, set = 0, binding = 0) readonly buffer In { float operands[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Out { float product[]; };
shared float left[16][16], right[16][16];

void main() {
  uint side = uint(sqrt(float(push.count)) + 0.5), tiles = side / 16;
  uint row = gl_LocalInvocationID.x / 16, column = gl_LocalInvocationID.x % 16;
  uint y = gl_WorkGroupID.x / tiles * 16 + row, x = gl_WorkGroupID.x % tiles * 16 + column;
  float sum = 0.0;
  for (uint tile = 0; tile < tiles; ++tile) {
    left[row][column] = operands[y * side + tile * 16 + column];
    right[row][column] = operands[push.count + (tile * 16 + row) * side + x];
    barrier();
    for (uint k = 0; k < 16; ++k) sum += left[row][k] * right[k][column];
    barrier();
  }
  product[y * side + x] = push.scale * sum;
}
