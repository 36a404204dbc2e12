#version 450
// A full-screen triangle made from gl_VertexIndex; everything else comes from buffers.
layout(location = 0) flat out uint instance;
layout(location = 1) flat out int vertex;
void main() {
  vec2 p = vec2((gl_VertexIndex & 1) * 4 - 1, (gl_VertexIndex & 2) * 2 - 1);
  gl_Position = vec4(p, 0, 1);
  instance = gl_InstanceIndex;
  vertex = gl_VertexIndex;
}
