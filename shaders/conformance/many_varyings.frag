#version 450
layout(location = 0) in mat3 matrix;
layout(location = 3) in float list[5];
layout(location = 8) in Block { vec2 a; vec3 b; } block;
layout(location = 0) out vec4 out_color;
void main() {
  float sum = 0.0;
  for (int i = 0; i < 5; ++i) sum += list[i];
  out_color = vec4(sum, dot(matrix * vec3(1.0, 2.0, 3.0), vec3(1.0, -1.0, 0.5)), block.a.x - block.a.y, dot(block.b, vec3(1.0)));
}
