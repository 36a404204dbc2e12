// Differences of pictures.
#include "run/compare.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

namespace lapilli::run {

Difference difference(const samples::Frame& a, const samples::Frame& b, float clear_depth) {
  Difference result;
  for (size_t pixel = 0; pixel < a.depth.size(); ++pixel) {
    int largest = 0;
    for (size_t c = 0; c < 4; ++c)
      largest = std::max(largest, std::abs(a.color[pixel * 4 + c] - b.color[pixel * 4 + c]));
    if (largest != 0) ++result.pixels;
    result.largest = std::max(result.largest, largest);
    if ((a.depth[pixel] != clear_depth) != (b.depth[pixel] != clear_depth)) ++result.coverage;
    result.depth = std::max(result.depth, std::abs(static_cast<double>(a.depth[pixel]) - b.depth[pixel]));
  }
  return result;
}

OracleError oracle_error(const oracle::Expected& expected, const samples::Frame& frame, bool writes_depth,
                         float clear_depth) {
  const oracle::ImageError color = oracle::compare_color(expected, frame.color);
  OracleError result = {color.max_abs * 255, color.mean_abs * 255, color.beyond, -1,
                        oracle::compare_depth(expected, frame.depth).max_abs};
  if (!writes_depth) return result;
  result.coverage = 0;
  for (size_t pixel = 0; pixel < frame.depth.size(); ++pixel) {
    const bool covered = expected.owner[pixel] >= 0;
    if (expected.either[pixel] == 0 && covered != (frame.depth[pixel] != clear_depth)) ++result.coverage;
  }
  return result;
}

std::vector<uint8_t> difference_picture(const samples::Frame& a, const samples::Frame& b, int amplification) {
  std::vector<uint8_t> picture(a.color.size(), 255);
  for (size_t i = 0; i < picture.size(); ++i) {
    if (i % 4 == 3) continue;
    picture[i] = static_cast<uint8_t>(std::min(255, amplification * std::abs(a.color[i] - b.color[i])));
  }
  return picture;
}

bool is_empty(const samples::Frame& frame) {
  for (size_t i = 4; i < frame.color.size(); i += 4) {
    if (std::memcmp(&frame.color[i], frame.color.data(), 4) != 0) return false;
  }
  return true;
}

}  // namespace lapilli::run
