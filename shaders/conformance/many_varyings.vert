#version 450
layout(location = 0) in vec4 in_position;
layout(location = 1) in vec4 in_value;
layout(location = 0) out mat3 matrix;
layout(location = 3) out float list[5];
layout(location = 8) out Block { vec2 a; vec3 b; } block;
void main() {
  gl_Position = in_position;
  matrix = mat3(in_value.x, in_value.y, in_value.z, in_value.w, 2.0, 3.0, 4.0, 5.0, 6.0);
  for (int i = 0; i < 5; ++i) list[i] = float(i + 1) * in_value.x;
  block.a = in_value.zw;
  block.b = in_value.xyz * 2.0;
}
