#version 450
// Barriers that not all invocations reach, which no shader may do: nothing may hang.
layout(local_size_x = 200) in;
layout(std430, set = 0, binding = 0) buffer Results { uint results[]; };
layout(push_constant) uniform Push { uint kind; };
shared uint data[200];
void main() {
  uint n = gl_LocalInvocationIndex;
  data[n] = n;
  if (kind == 0 && n >= 70) return;
  if (kind == 1 && (n & 1) == 0) barrier();
  if (kind == 2 && n < 64) {
    for (uint i = 0; i < n; ++i) barrier();
  }
  barrier();
  results[n] = data[n] + 1;
}
