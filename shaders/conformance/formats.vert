#version 450
layout(location = 0) in vec4 a;
layout(location = 1) in vec4 b;
layout(location = 2) in vec4 c;
layout(location = 5) in vec4 d;
layout(location = 0) flat out vec4 sum;
void main() {
  // One pixel for each vertex index / 3: triangles are placed by the vertex's number.
  int pixel = gl_VertexIndex / 3, corner = gl_VertexIndex % 3;
  vec2 p = vec2(pixel % 8, pixel / 8) + vec2((corner & 1) * 2, (corner & 2));
  gl_Position = vec4(p / 4.0 - 1.0, 0.0, 1.0);
  sum = a + 10.0 * b + 100.0 * c + 1000.0 * d;
}
