// A loop whose length differs from lane to lane, with two ways out of it.
#version 450
layout(location = 0) in vec2 place;
layout(location = 0) out vec4 color;

const int kLimit = 96;

// Steps until escape, smoothed; negative if it never does.
float escape_time(vec2 c) {
  vec2 z = vec2(0.0);
  for (int i = 0; i < kLimit; ++i) {
    z = vec2(z.x * z.x - z.y * z.y, 2.0 * z.x * z.y) + c;
    float distance_squared = dot(z, z);
    if (distance_squared > 256.0) return float(i) + 1.0 - log2(0.5 * log2(distance_squared));
    if (distance_squared < 1e-12 && i > 4) break;
  }
  return -1.0;
}

void main() {
  float time = escape_time(place * 1.2 - vec2(0.6, 0.0));
  if (time < 0.0) {
    color = vec4(0.03, 0.02, 0.05, 1.0);
  } else {
    vec3 phase = vec3(0.0, 0.12, 0.25) + 0.035 * time;
    color = vec4(0.5 - 0.5 * cos(6.2831853 * phase), 1.0);
  }
}
