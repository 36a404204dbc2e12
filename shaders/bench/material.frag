// The object's own texture times its own tint.
#version 450
layout(set = 0, binding = 0) uniform Object {
  mat4 transform;
  vec4 tint;
} object;
layout(set = 0, binding = 1) uniform sampler2D picture;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 color;

void main() { color = texture(picture, uv) * object.tint; }
