#version 450
// A small module to damage: a loop, a branch, a function, buffers and a library function.
layout(local_size_x = 8) in;
layout(std430, set = 0, binding = 0) buffer Data { float values[]; };
layout(push_constant) uniform Push { int rounds; };
float step_once(float v, int i) { return i % 2 == 0 ? sin(v) : v * 0.5 + float(i); }
void main() {
  uint at = gl_GlobalInvocationID.x;
  if (at >= values.length()) return;
  float v = values[at];
  for (int i = 0; i < rounds; ++i) v = step_once(v, i);
  values[at] = v;
}
