// Texture sampling oracle in float64: one level, nearest or linear. Specification: "Image Operations", Texel Addressing
// and Texel Filtering.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace lapilli::oracle {

enum class Address { kRepeat, kMirroredRepeat, kClampToEdge, kClampToBorder };

struct Texture {
  int width = 0, height = 0;
  std::vector<std::array<double, 4>> texels;
  std::array<double, 4> border = {};
};

struct Sample {
  std::array<double, 4> value;
  bool tie = false;  // nearest: so close to the middle between two texels that rounding may choose the other
};

// (u, v): normalized.
Sample sample_nearest(const Texture& texture, Address address_u, Address address_v, double u, double v);
Sample sample_linear(const Texture& texture, Address address_u, Address address_v, double u, double v);

}  // namespace lapilli::oracle
