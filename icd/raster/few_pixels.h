// Triangles of a few pixels in one block (few_pixels.cpp).
#pragma once

#include <cstdint>

#include "raster/coverage.h"

namespace lapilli {

struct FewPixels {
  static constexpr int32_t kMost = 6;
  struct Pixel {
    uint8_t bit;    // of the block
    double e1, e2;  // edge functions 1 and 2
  };
  Pixel pixel[kMost];
  uint32_t count = 0;

  void cover(const EdgeFunctions& edges, const PixelRect& rect);
};

// Bounds from the tile's origin: not empty, in one block, and small.
inline bool is_few(const PixelRect& rect) {
  const int32_t width = rect.x1 - rect.x0;
  const int32_t height = rect.y1 - rect.y0;
  constexpr int32_t kBlock = static_cast<int32_t>(kBlockSize);
  return width > 0 && height > 0 && width <= FewPixels::kMost && height <= FewPixels::kMost &&
         width * height <= FewPixels::kMost && rect.x0 / kBlock == (rect.x1 - 1) / kBlock &&
         rect.y0 / kBlock == (rect.y1 - 1) / kBlock;
}

}  // namespace lapilli
