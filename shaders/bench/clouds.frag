// Three octaves of gradient noise with an arithmetic hash: about 200 flops, no loop that lanes leave differently.
#version 450
layout(location = 0) in vec2 place;
layout(location = 0) out vec4 color;

// A permutation of 0 to 255, exact in float32: every driver gets the same.
vec4 permute(vec4 x) {
  vec4 y = x * (x * 6.0 + 5.0);
  return y - floor(y * 0.00390625) * 256.0;
}

float gradient_noise(vec2 p) {
  vec2 cell = floor(p);
  vec2 f = p - cell;
  vec4 corner_x = vec4(0.0, 1.0, 0.0, 1.0) + cell.x;
  vec4 corner_y = vec4(0.0, 0.0, 1.0, 1.0) + cell.y;
  vec4 h = permute(permute(corner_x) + corner_y);
  vec4 gradient_x = fract(h * 0.0859375) * 2.0 - 1.0;
  vec4 gradient_y = abs(gradient_x) - 0.5;
  vec4 d = gradient_x * (f.x - vec4(0.0, 1.0, 0.0, 1.0)) + gradient_y * (f.y - vec4(0.0, 0.0, 1.0, 1.0));
  vec2 fade = f * f * (3.0 - 2.0 * f);
  vec2 row = mix(d.xz, d.yw, fade.x);
  return mix(row.x, row.y, fade.y);
}

void main() {
  vec2 p = place * 3.0 + 20.0;
  float sum = gradient_noise(p) + 0.5 * gradient_noise(p * 2.03) + 0.25 * gradient_noise(p * 4.01);
  float cover = clamp(0.5 + 1.1 * sum, 0.0, 1.0);
  color = vec4(mix(vec3(0.16, 0.33, 0.65), vec3(0.96, 0.95, 0.93), cover), 1.0);
}
