#version 450
// The same vec4 in all three interpolation modes, and a flat integer.
layout(location = 0) in vec4 in_position;
layout(location = 1) in vec4 in_value;
layout(location = 0) out vec4 smooth_value;
layout(location = 1) noperspective out vec4 linear_value;
layout(location = 2) flat out vec4 flat_value;
layout(location = 3) flat out int flat_int;
void main() {
  gl_Position = in_position;
  smooth_value = in_value;
  linear_value = in_value;
  flat_value = in_value;
  flat_int = int(in_value.x * 1000.0);
}
