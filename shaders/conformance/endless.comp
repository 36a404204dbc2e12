#version 450
// Never ends for the values that the test puts in.
layout(local_size_x = 1) in;
layout(set = 0, binding = 0, std430) buffer Values { uint value[]; };
void main() {
  uint i = value[0];
  while (i != 1u) i += 2u;
  value[1] = i;
}
