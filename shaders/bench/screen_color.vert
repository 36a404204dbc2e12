// Vertices that are already where they belong on the screen.
#version 450
layout(location = 0) in vec2 position;
layout(location = 1) in vec3 vertex_color;
layout(location = 0) out vec3 color;

void main() {
  gl_Position = vec4(position, 0.5, 1.0);
  color = vertex_color;
}
