// See sampling.h.
#include "oracle/sampling.h"

#include <algorithm>
#include <cmath>

namespace lapilli::oracle {
namespace {

// The texel index, or -1 for the border.
int64_t wrap(Address mode, int64_t i, int64_t size) {
  const auto modulo = [](int64_t a, int64_t b) { return ((a % b) + b) % b; };
  switch (mode) {
    case Address::kRepeat:
      return modulo(i, size);
    case Address::kMirroredRepeat: {
      const int64_t j = modulo(i, 2 * size);
      return j < size ? j : 2 * size - 1 - j;
    }
    case Address::kClampToEdge:
      return std::clamp<int64_t>(i, 0, size - 1);
    default:
      return i < 0 || i >= size ? -1 : i;
  }
}

std::array<double, 4> fetch(const Texture& t, Address mode_u, Address mode_v, int64_t i, int64_t j) {
  const int64_t x = wrap(mode_u, i, t.width), y = wrap(mode_v, j, t.height);
  return x < 0 || y < 0 ? t.border : t.texels[size_t(y * t.width + x)];
}

bool close_to_integer(double a) { return std::abs(a - std::nearbyint(a)) < 1e-6 * (1 + std::abs(a)); }

}  // namespace

Sample sample_nearest(const Texture& t, Address mode_u, Address mode_v, double u, double v, Offset offset) {
  const double x = u * t.width, y = v * t.height;
  return {fetch(t, mode_u, mode_v, int64_t(std::floor(x)) + offset.x, int64_t(std::floor(y)) + offset.y),
          close_to_integer(x) || close_to_integer(y)};
}

Gathered gather(const Texture& t, Address mode_u, Address mode_v, double u, double v, Offset offset) {
  const double x = u * t.width - 0.5, y = v * t.height - 0.5;
  const int64_t i = int64_t(std::floor(x)) + offset.x, j = int64_t(std::floor(y)) + offset.y;
  return {{fetch(t, mode_u, mode_v, i, j + 1), fetch(t, mode_u, mode_v, i + 1, j + 1),
           fetch(t, mode_u, mode_v, i + 1, j), fetch(t, mode_u, mode_v, i, j)},
          close_to_integer(x) || close_to_integer(y)};
}

Sample sample_linear(const Texture& t, Address mode_u, Address mode_v, double u, double v, Offset offset) {
  const double x = u * t.width - 0.5, y = v * t.height - 0.5;
  const double a = x - std::floor(x), b = y - std::floor(y);
  const auto [lower_left, lower_right, upper_right, upper_left] = gather(t, mode_u, mode_v, u, v, offset).texels;
  Sample out{};
  for (size_t c = 0; c < 4; ++c) {
    out.value[c] =
        (1 - b) * ((1 - a) * upper_left[c] + a * upper_right[c]) + b * ((1 - a) * lower_left[c] + a * lower_right[c]);
  }
  return out;
}

Sample sample_trilinear(const std::vector<Texture>& levels, Address mode_u, Address mode_v, double u, double v,
                        double lod, Offset offset) {
  const double d = std::clamp(lod, 0.0, double(levels.size()) - 1);
  const size_t fine = size_t(d), coarse = std::min(fine + 1, levels.size() - 1);
  Sample out = sample_linear(levels[fine], mode_u, mode_v, u, v, offset);
  const Sample next = sample_linear(levels[coarse], mode_u, mode_v, u, v, offset);
  for (size_t c = 0; c < 4; ++c) out.value[c] += (d - double(fine)) * (next.value[c] - out.value[c]);
  return out;
}

Texture compare(const Texture& depth, Compare op, double reference) {
  Texture out = depth;
  const auto outcome = [&](double d) {
    switch (op) {
      case Compare::kLess:
        return reference < d;
      case Compare::kLessOrEqual:
        return reference <= d;
      case Compare::kGreater:
        return reference > d;
      default:
        return reference >= d;
    }
  };
  for (auto& texel : out.texels) texel = {outcome(texel[0]) ? 1.0 : 0.0, 0, 0, 1};
  out.border = {outcome(out.border[0]) ? 1.0 : 0.0, 0, 0, 1};
  return out;
}

}  // namespace lapilli::oracle
