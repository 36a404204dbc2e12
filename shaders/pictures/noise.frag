// Integer hashing and layers of value noise; a switch that lanes take differently.
#version 450
layout(location = 0) in vec2 place;
layout(location = 0) out vec4 color;

uint hash(uvec2 cell) {
  uint h = cell.x * 0x9E3779B1u ^ cell.y * 0x85EBCA77u;
  h ^= h >> 15;
  h *= 0x2C1B3C6Du;
  h ^= h >> 12;
  h *= 0x297A2D39u;
  return h ^ h >> 15;
}

float value(ivec2 cell) { return float(hash(uvec2(cell)) >> 8) / 16777215.0; }

float value_noise(vec2 p) {
  vec2 base = floor(p);
  vec2 f = p - base;
  f = f * f * (3.0 - 2.0 * f);
  ivec2 cell = ivec2(base);
  return mix(mix(value(cell), value(cell + ivec2(1, 0)), f.x), mix(value(cell + ivec2(0, 1)), value(cell + ivec2(1, 1)), f.x), f.y);
}

float layered(vec2 p) {
  float sum = 0.0;
  float weight = 0.5;
  for (int octave = 0; octave < 5; ++octave) {
    sum += weight * value_noise(p);
    p = mat2(1.6, 1.2, -1.2, 1.6) * p;
    weight *= 0.5;
  }
  return sum;
}

void main() {
  vec2 p = place * 3.0 + 10.0;
  float height = layered(p + 1.5 * layered(p * 0.7 + 3.0));
  vec3 c;
  switch (int(floor(height * 8.0))) {
    case 0:
    case 1:
    case 2:
      c = vec3(0.07, 0.16, 0.35);
      break;
    case 3:
      c = vec3(0.12, 0.35, 0.52);
      break;
    case 4:
      c = vec3(0.30, 0.46, 0.24);
      // falls through: meadows are a little brighter than the bare formula
    case 5:
      c = mix(vec3(0.30, 0.46, 0.24), vec3(0.52, 0.42, 0.28), height);
      break;
    default:
      c = vec3(0.92);
  }
  float slope = layered(p + vec2(0.02, 0.0) + 1.5 * layered((p + vec2(0.02, 0.0)) * 0.7 + 3.0)) - height;
  color = vec4(c * (0.8 + clamp(slope * 9.0, -0.4, 0.4)), 1.0);
}
