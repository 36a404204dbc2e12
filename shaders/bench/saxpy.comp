// y = a x + y.
#version 450
layout(local_size_x = 64) in;
layout(push_constant) uniform Push {
  float a;
  uint count;
} push;
layout(std430, set = 0, binding = 0) readonly buffer X { float x[]; };
layout(std430, set = 0, binding = 1) buffer Y { float y[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i < push.count) y[i] = push.a * x[i] + y[i];
}
