#version 450
// Counts its invocations, by vertex.
layout(location = 0) in vec4 in_position;
layout(location = 1) in vec4 in_color;
layout(std430, set = 0, binding = 0) buffer Counts { uint vertices, fragments, helpers, vertex[]; };
layout(location = 0) flat out vec4 out_color;
void main() {
  atomicAdd(vertices, 1);
  atomicAdd(vertex[gl_VertexIndex], 1);
  gl_Position = in_position;
  out_color = in_color;
}
