// An RGBA8 picture on the host, and what a sampler makes of it in double.
#pragma once

#include <cstdint>
#include <vector>

#include "scenes/geometry.h"

namespace lapilli::samples {

struct Texture {
  uint32_t width = 0;
  uint32_t height = 0;
  std::vector<uint8_t> rgba;  // rows top down, UNORM
};

enum class Wrap { kRepeat, kClampToEdge };

// VK_FILTER_LINEAR at level 0 with full weights; (u, v) in [0, 1] spans the picture. Specification: Texel Filtering.
Color sample_bilinear(const Texture& texture, Wrap wrap, double u, double v);

}  // namespace lapilli::samples
