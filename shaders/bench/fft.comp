// Fourier transforms of 1,024 complex numbers, one for each workgroup: ten steps of Stockham's radix 2 in shared memory.
#version 450
layout(local_size_x = 256) in;
layout(push_constant) uniform Push {
  float scale;
  uint count;
} push;
layout(std430, set = 0, binding = 0) readonly buffer In { vec2 signal[]; };
layout(std430, set = 0, binding = 1) writeonly buffer Out { vec2 spectrum[]; };
shared vec2 values[2][1024];

void main() {
  uint first = gl_WorkGroupID.x * 1024;
  for (uint i = gl_LocalInvocationID.x; i < 1024; i += 256) values[0][i] = signal[first + i];
  uint from = 0;
  for (uint width = 1; width < 1024; width *= 2) {
    barrier();
    for (uint i = gl_LocalInvocationID.x; i < 512; i += 256) {
      uint k = i & (width - 1);
      float angle = -3.14159265 * float(k) / float(width);
      vec2 turn = vec2(cos(angle), sin(angle)), a = values[from][i], b = values[from][i + 512];
      b = vec2(b.x * turn.x - b.y * turn.y, b.x * turn.y + b.y * turn.x);
      uint to = (i - k) * 2 + k;
      values[1 - from][to] = a + b;
      values[1 - from][to + width] = a - b;
    }
    from = 1 - from;
  }
  barrier();
  for (uint i = gl_LocalInvocationID.x; i < 1024; i += 256) spectrum[first + i] = push.scale * values[from][i];
}
