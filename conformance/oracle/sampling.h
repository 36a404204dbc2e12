// Texture sampling oracle in float64: nearest, linear and trilinear filters, gathers, depth comparison. Specification:
// "Image Operations", Texel Addressing, Texel Filtering, Depth Compare Operation.
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

struct Offset {
  int x = 0, y = 0;  // texels
};

// (u, v): normalized.
Sample sample_nearest(const Texture& texture, Address address_u, Address address_v, double u, double v,
                      Offset offset = {});
Sample sample_linear(const Texture& texture, Address address_u, Address address_v, double u, double v,
                     Offset offset = {});

// The texels of the linear filter in the order of textureGather. `tie`: another footprint is as good.
struct Gathered {
  std::array<std::array<double, 4>, 4> texels;
  bool tie = false;
};
Gathered gather(const Texture& texture, Address address_u, Address address_v, double u, double v, Offset offset = {});

// The linear filter in the nearest two levels of a chain; `lod` is clamped to the chain.
Sample sample_trilinear(const std::vector<Texture>& levels, Address address_u, Address address_v, double u, double v,
                        double lod, Offset offset = {});

// The outcome of a depth comparison (reference op depth) for each texel and the border: 0 or 1, in the first component.
enum class Compare { kLess, kLessOrEqual, kGreater, kGreaterOrEqual };
Texture compare(const Texture& depth, Compare op, double reference);

}  // namespace lapilli::oracle
