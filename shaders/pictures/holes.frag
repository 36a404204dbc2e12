// Discard inside a function inside a loop; the lanes that are left go on, and derivatives were taken before.
#version 450
layout(location = 0) in vec2 place;
layout(location = 0) out vec4 color;

float ring(vec2 center, float radius) { return abs(length(place - center) - radius); }

float nearest_ring() {
  float nearest = 1e9;
  for (int i = 0; i < 6; ++i) {
    float turn = float(i) * 1.0471976;
    vec2 center = 0.55 * vec2(cos(turn), sin(turn));
    if (length(place - center) < 0.10) discard;
    nearest = min(nearest, ring(center, 0.28));
  }
  return nearest;
}

void main() {
  float width = fwidth(place.x) + fwidth(place.y);
  vec2 tile = fract(place * 4.0);
  float distance = nearest_ring();
  if (distance > 0.06) {
    if (tile.x > 0.5 ^^ tile.y > 0.5) discard;
    color = vec4(0.20, 0.24, 0.34, 1.0);
    return;
  }
  float edge = smoothstep(0.05, 0.05 - 2.0 * width, distance);
  color = vec4(mix(vec3(0.30, 0.10, 0.06), vec3(0.98, 0.62, 0.22), edge), 1.0);
}
