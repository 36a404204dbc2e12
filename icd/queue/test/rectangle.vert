#version 450
layout(location = 0) in vec2 corner;  // of the unit square
layout(location = 0) out vec4 color;
layout(location = 1) out vec4 unread;
layout(push_constant) uniform Place { vec4 rectangle; float depth; };  // left, top, width, height in clip space
layout(set = 0, binding = 0) uniform Color { vec4 value; };

void main() {
  gl_Position = vec4(rectangle.xy + corner * rectangle.zw, depth, 1.0);
  color = value;
  unread = vec4(corner, corner * 2.0);
}
