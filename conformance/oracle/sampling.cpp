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

}  // namespace

Sample sample_nearest(const Texture& t, Address mode_u, Address mode_v, double u, double v) {
  const double x = u * t.width, y = v * t.height;
  const auto close = [](double a) { return std::abs(a - std::nearbyint(a)) < 1e-6 * (1 + std::abs(a)); };
  return {fetch(t, mode_u, mode_v, int64_t(std::floor(x)), int64_t(std::floor(y))), close(x) || close(y)};
}

Sample sample_linear(const Texture& t, Address mode_u, Address mode_v, double u, double v) {
  const double x = u * t.width - 0.5, y = v * t.height - 0.5;
  const double fx = std::floor(x), fy = std::floor(y), a = x - fx, b = y - fy;
  const int64_t i = int64_t(fx), j = int64_t(fy);
  Sample out{};
  const auto t00 = fetch(t, mode_u, mode_v, i, j), t10 = fetch(t, mode_u, mode_v, i + 1, j);
  const auto t01 = fetch(t, mode_u, mode_v, i, j + 1), t11 = fetch(t, mode_u, mode_v, i + 1, j + 1);
  for (size_t c = 0; c < 4; ++c) {
    out.value[c] = (1 - b) * ((1 - a) * t00[c] + a * t10[c]) + b * ((1 - a) * t01[c] + a * t11[c]);
  }
  return out;
}

}  // namespace lapilli::oracle
