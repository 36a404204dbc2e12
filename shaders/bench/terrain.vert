// A height field: position and colour for each vertex, one matrix from a uniform buffer.
#version 450
layout(set = 0, binding = 0) uniform Camera {
  mat4 view_projection;
} camera;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 vertex_color;
layout(location = 0) out vec3 color;

void main() {
  gl_Position = camera.view_projection * vec4(position, 1.0);
  color = vertex_color;
}
