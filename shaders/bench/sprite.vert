// A small triangle placed and coloured by push constants: a draw of its own.
#version 450
layout(push_constant) uniform Push {
  vec4 tint;
  vec2 center;
  vec2 size;
} push;
layout(location = 0) in vec2 position;
layout(location = 0) out vec3 color;

void main() {
  gl_Position = vec4(push.center + push.size * position, 0.5, 1.0);
  color = push.tint.rgb;
}
