#version 450
// Layouts of blocks, dynamic indices everywhere, arrays in registers.
layout(local_size_x = 64) in;
struct Item {
  vec3 a;
  float b;
  mat3x2 c;
};
layout(set = 0, binding = 0) buffer Out { float results[]; };
layout(set = 0, binding = 1, std140) uniform Uniforms {
  vec4 first;
  layout(row_major) mat3 rows;
  mat2x3 columns;
  Item items[3];
  float spaced[4];
} u;
layout(set = 0, binding = 2, std430) buffer Table { float value; float values[]; } tables[3];
layout(push_constant) uniform Push { vec2 offset; float list[6]; } push;
layout(set = 0, binding = 3, std430) buffer Both { mat4 m; layout(row_major) mat2x4 r; Item item; } both;

float pick(float list[5], int i) { return list[i]; }

void main() {
  uint n = gl_GlobalInvocationID.x;
  int i = int(n % 3u);
  uint at = n * 24u;
  results[at] = u.rows[i][(i + 1) % 3];
  results[at + 1u] = u.columns[n & 1u][i];
  results[at + 2u] = u.items[i].a[i] + u.items[2 - i].b;
  results[at + 3u] = u.items[i].c[i][n & 1u];
  results[at + 4u] = u.spaced[n & 3u];
  vec3 product = u.rows * vec3(1, 2, 3);
  results[at + 5u] = product[i];
  results[at + 6u] = tables[i].values[n & 7u] + tables[1].value;
  results[at + 7u] = float(tables[i].values.length());
  results[at + 8u] = push.list[n % 6u] + push.offset.y;
  float local[5];
  for (int k = 0; k < 5; ++k) local[k] = float(k * k) + u.first.x;
  local[(i + 2) % 5] += 100.0;
  results[at + 9u] = local[i] + local[i + 2];
  results[at + 10u] = pick(local, 4 - i);
  const float constants[4] = float[](2.0, 3.0, 5.0, 7.0);
  results[at + 11u] = constants[n & 3u];
  Item item = u.items[i];
  item.c[1] = vec2(item.b);
  item.a.zy = item.a.yx;
  results[at + 12u] = item.a.z + item.c[1].y + item.c[2].x;
  mat3 matrix = transpose(u.rows);
  matrix[i][1] = -1.0;
  results[at + 13u] = matrix[0][1] + matrix[1][1] * 10.0 + matrix[2][1] * 100.0;
  if (n == 5u) {
    both.item = u.items[1];
    both.r = mat2x4(1, 2, 3, 4, 5, 6, 7, 8);
    both.m[2] = vec4(9, 10, 11, 12);
    both.m[3][i] = 13.0;
  }
  vec4 v = u.first;
  v[n & 3u] = 50.0;
  results[at + 14u] = dot(v, vec4(1, 10, 100, 1000));
  results[at + 15u] = u.first.wzyx[n & 3u];
}
