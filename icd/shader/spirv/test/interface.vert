#version 450
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 color;
layout(location = 3, component = 1) in vec2 late;
layout(location = 5) in ivec2 numbers;
layout(location = 0) out vec4 smooth_color;
layout(location = 1) noperspective out vec2 screen;
layout(location = 2) flat out ivec2 ids;
layout(location = 3) out mat2 matrix;
layout(location = 5) out float unread;
void main() {
  gl_Position = vec4(position, 1.0);
  smooth_color = color * 2.0;
  screen = late;
  ids = numbers + gl_InstanceIndex;
  matrix = mat2(1, 2, 3, 4);
  unread = sin(position.x);
}
