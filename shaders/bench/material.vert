// A quad placed by a uniform buffer with a dynamic offset.
#version 450
layout(set = 0, binding = 0) uniform Object {
  mat4 transform;
  vec4 tint;
} object;
layout(location = 0) in vec2 position;
layout(location = 0) out vec2 uv;

void main() {
  gl_Position = object.transform * vec4(position, 0.0, 1.0);
  uv = position * 0.5 + 0.5;
}
