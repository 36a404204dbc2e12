// A textured floor to the horizon: one trilinear lookup for each pixel, at a level of detail that changes down the screen.
#version 450
layout(set = 0, binding = 0) uniform sampler2D picture;
layout(location = 0) in vec2 place;
layout(location = 0) out vec4 color;

void main() {
  float distance = 1.0 / (1.15 - place.y);
  color = texture(picture, vec2(place.x * distance, distance) * 0.5);
}
