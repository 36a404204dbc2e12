// The bilinear sampler of the oracle.
#include "scenes/texture.h"

#include <algorithm>
#include <cmath>

namespace lapilli::samples {
namespace {

uint32_t wrapped(double coordinate, uint32_t size, Wrap wrap) {
  const double limit = static_cast<double>(size);
  if (wrap == Wrap::kRepeat) coordinate -= limit * std::floor(coordinate / limit);
  return static_cast<uint32_t>(std::clamp(coordinate, 0.0, limit - 1.0));
}

}  // namespace

Color sample_bilinear(const Texture& texture, Wrap wrap, double u, double v) {
  const double x = u * texture.width - 0.5;
  const double y = v * texture.height - 0.5;
  const double left = std::floor(x);
  const double top = std::floor(y);
  const double across = x - left;
  const double down = y - top;
  Color result = {0, 0, 0, 0};
  for (int corner = 0; corner < 4; ++corner) {
    const int right = corner & 1;
    const int below = corner >> 1;
    const uint32_t i = wrapped(left + right, texture.width, wrap);
    const uint32_t j = wrapped(top + below, texture.height, wrap);
    const double weight = (right != 0 ? across : 1.0 - across) * (below != 0 ? down : 1.0 - down);
    const uint8_t* texel = &texture.rgba[(size_t{j} * texture.width + i) * 4];
    for (size_t c = 0; c < 4; ++c) result[c] += weight * texel[c] / 255.0;
  }
  return result;
}

}  // namespace lapilli::samples
