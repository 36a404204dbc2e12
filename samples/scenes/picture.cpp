// Draws the volcano, back to front. Coordinates: x to the right and y down, both 0 to 1; every edge is a few texels
// soft, so that neighbouring texels stay close and filters with coarse weights can be compared.
#include "scenes/picture.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace lapilli::samples {
namespace {

using glm::vec2;
using glm::vec3;

constexpr float kSoftEdge = 0.006f;
constexpr vec2 kCrater = {0.38f, 0.30f};

float hash(vec2 p) { return glm::fract(std::sin(glm::dot(p, vec2(127.1f, 311.7f))) * 43758.547f); }

float value_noise(vec2 p) {
  const vec2 cell = glm::floor(p);
  const vec2 f = glm::smoothstep(vec2(0.0f), vec2(1.0f), p - cell);
  const float top = glm::mix(hash(cell), hash(cell + vec2(1, 0)), f.x);
  const float bottom = glm::mix(hash(cell + vec2(0, 1)), hash(cell + vec2(1, 1)), f.x);
  return glm::mix(top, bottom, f.y);
}

float layered_noise(vec2 p) {
  return 0.55f * value_noise(p) + 0.3f * value_noise(2.1f * p + vec2(7.0f)) +
         0.15f * value_noise(4.3f * p + vec2(3.0f));
}

// 1 below a silhouette whose upper edge is at height `edge`.
float below(float y, float edge) { return glm::smoothstep(edge - kSoftEdge, edge + kSoftEdge, y); }

float glow(vec2 p, vec2 center, float radius) {
  const vec2 d = (p - center) / radius;
  return std::exp(-glm::dot(d, d));
}

vec3 sky(vec2 p) {
  const vec3 zenith = {0.07f, 0.09f, 0.25f};
  const vec3 dusk = {0.55f, 0.25f, 0.36f};
  const vec3 horizon = {0.99f, 0.66f, 0.34f};
  vec3 color = glm::mix(zenith, dusk, glm::smoothstep(0.0f, 0.45f, p.y));
  color = glm::mix(color, horizon, glm::smoothstep(0.35f, 0.72f, p.y));
  const vec2 sun = {0.80f, 0.63f};
  color += vec3(0.30f, 0.22f, 0.10f) * glow(p, sun, 0.22f);
  return glm::mix(color, vec3(1.0f, 0.93f, 0.72f),
                  glm::smoothstep(0.055f, 0.045f, glm::length((p - sun) * vec2(1.0f, 0.75f))));
}

vec3 plume(vec2 p, vec3 color) {
  const float rise = kCrater.y - p.y;
  if (rise <= 0.0f) return color;
  const float drift = kCrater.x + 0.35f * rise + 0.7f * rise * rise;
  const float spread = 0.035f + 0.42f * rise;
  const float body = std::exp(-std::pow((p.x - drift) / spread, 2.0f));
  const float billows = layered_noise(vec2(p.x * 9.0f - rise * 6.0f, p.y * 11.0f));
  const float smoke = glm::smoothstep(0.25f, 0.75f, body * (0.45f + billows));
  const vec3 lit =
      glm::mix(vec3(0.24f, 0.20f, 0.26f), vec3(0.80f, 0.42f, 0.26f), glm::smoothstep(0.35f, 0.8f, billows));
  return glm::mix(color, lit, 0.85f * smoke);
}

// Small glowing stones on their ballistic ways out of the crater.
vec3 lapilli_stones(vec2 p, vec3 color) {
  for (int i = 0; i < 26; ++i) {
    const auto n = static_cast<float>(i);
    const float sideways = 0.75f * (hash(vec2(n, 1.0f)) - 0.5f);
    const float upwards = 0.55f + 0.45f * hash(vec2(n, 2.0f));
    const float time = 0.08f + 0.62f * hash(vec2(n, 3.0f));
    const vec2 stone = kCrater + vec2(sideways * time, -upwards * time + 0.9f * time * time);
    const float heat = glow(p, stone, 0.007f + 0.006f * hash(vec2(n, 4.0f)));
    color = glm::mix(color, vec3(1.0f, 0.80f - 0.45f * time, 0.25f), heat);
  }
  return color;
}

vec3 volcano(vec2 p, vec3 color) {
  const float away = std::abs(p.x - kCrater.x);
  const float slope = kCrater.y + 0.52f * (1.0f - std::exp(-4.0f * std::max(away - 0.035f, 0.0f)));
  const float edge = slope + 0.012f * (layered_noise(vec2(p.x * 26.0f, 2.0f)) - 0.5f);
  const float depth = p.y - edge;  // below the surface line
  const float rock = layered_noise(vec2(p.x * 18.0f, p.y * 30.0f));
  const float sunny = glm::smoothstep(-0.15f, 0.25f, p.x - kCrater.x);
  vec3 ground = glm::mix(vec3(0.12f, 0.09f, 0.15f), vec3(0.44f, 0.25f, 0.24f), sunny) * (0.65f + 0.7f * rock);
  // Lava runs from the crater in three wavering streams that cool.
  for (int i = 0; i < 3; ++i) {
    const auto n = static_cast<float>(i);
    const float run = p.y - kCrater.y;
    const float middle = kCrater.x + (n - 1.0f) * 0.30f * run * (1.0f + 0.5f * run) +
                         0.030f * std::sin(run * (15.0f + 4.0f * n) + 2.0f * n) * glm::smoothstep(0.0f, 0.2f, run);
    const float width = 0.011f + 0.016f * run;
    const float stream =
        std::exp(-std::pow((p.x - middle) / width, 2.0f)) * glm::smoothstep(0.50f - 0.08f * n, 0.05f, run);
    ground = glm::mix(ground,
                      glm::mix(vec3(1.0f, 0.83f, 0.35f), vec3(0.85f, 0.16f, 0.06f), glm::smoothstep(0.0f, 0.4f, run)),
                      stream);
  }
  ground += vec3(0.9f, 0.40f, 0.08f) * glow(p, kCrater, 0.07f);
  return glm::mix(color, ground, glm::smoothstep(-kSoftEdge, kSoftEdge, depth));
}

vec3 landscape(vec2 p) {
  vec3 color = sky(p);
  const float far_ridge = 0.69f - 0.05f * layered_noise(vec2(p.x * 7.0f, 9.0f));
  color = glm::mix(color, vec3(0.48f, 0.30f, 0.36f), below(p.y, far_ridge));
  color = plume(p, color);
  color += vec3(0.85f, 0.36f, 0.08f) * glow(p, kCrater, 0.10f);
  color = volcano(p, color);
  color = lapilli_stones(p, color);
  const float shore = 0.80f + 0.045f * layered_noise(vec2(p.x * 5.0f, 1.0f));
  const float grass = layered_noise(vec2(p.x * 40.0f, p.y * 24.0f));
  return glm::mix(color, vec3(0.07f, 0.10f, 0.09f) + vec3(0.06f, 0.10f, 0.05f) * grass, below(p.y, shore));
}

uint8_t unorm8(float value) { return static_cast<uint8_t>(std::lround(glm::clamp(value, 0.0f, 1.0f) * 255.0f)); }

// Twice the signed area of (a, b, p), positive on the side of the third corner if the triangle is.
double side_of(Point a, Point b, Point p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); }

}  // namespace

Texture volcano_picture(uint32_t width, uint32_t height) {
  Texture picture = {width, height, std::vector<uint8_t>(size_t{width} * height * 4, 255)};
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const vec3 color = landscape((vec2(x, y) + 0.5f) / vec2(width, height));
      uint8_t* texel = &picture.rgba[(size_t{y} * width + x) * 4];
      for (int c = 0; c < 3; ++c) texel[c] = unorm8(color[c]);
    }
  }
  return picture;
}

Texture triangle_mask(uint32_t width, uint32_t height, const Triangle& triangle, double softness) {
  Texture mask = {width, height, std::vector<uint8_t>(size_t{width} * height * 4, 255)};
  const double orientation = side_of(triangle[0], triangle[1], triangle[2]) < 0 ? -1.0 : 1.0;
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const Point center = {x + 0.5, y + 0.5};
      double inside = width + height;  // texels to the nearest edge, negative outside
      for (size_t i = 0; i < 3; ++i) {
        const Point a = triangle[i];
        const Point b = triangle[(i + 1) % 3];
        inside = std::min(inside, orientation * side_of(a, b, center) / std::hypot(b.x - a.x, b.y - a.y));
      }
      const uint8_t value = unorm8(static_cast<float>(0.5 + inside / softness));
      std::fill_n(&mask.rgba[(size_t{y} * width + x) * 4], 3, value);
    }
  }
  return mask;
}

}  // namespace lapilli::samples
