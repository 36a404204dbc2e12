// A translucent layer: a soft disc of one colour.
#version 450
layout(push_constant) uniform Push {
  vec4 tint;
  float depth;
} push;
layout(location = 0) in vec2 place;
layout(location = 0) out vec4 color;

void main() {
  vec2 away = place - vec2(push.depth * 2.0 - 1.0, 0.3);
  color = vec4(push.tint.rgb, push.tint.a * clamp(1.2 - 0.5 * dot(away, away), 0.1, 1.0));
}
