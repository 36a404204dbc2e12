// Triangles of at most 32 pixels a side: the pixels of a block are covered and depth tested in one go, with edge
// functions that fit 32 bits.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>

#include "geometry/bins.h"

namespace lapilli {

// Edge functions as in TriangleSetup, but from the tile's first pixel: E_i(x, y) = 256 * (dx_i * y - dy_i * x) + c_i.
struct SmallTriangle {
  static constexpr int32_t kMostExtent = 1 << 13;  // 24.8 units
  int32_t dx[3], dy[3], c[3];
  int32_t bias[3];  // -1: a centre on the edge is outside (top-left rule), else 0
  DepthPlane depth;
};
// False: too large.
bool make_small_triangle(const BinChunk& chunk, const BinTriangle& triangle, uint32_t tile_x, uint32_t tile_y,
                         SmallTriangle& out);

// What is done to a block: 64 values each, in the order of its lanes.
struct SmallTarget {
  float* depths = nullptr;      // null: no test
  bool write_depth = false;     // of what passes
  uint32_t* numbers = nullptr;  // null: nobody asks who is seen
  uint32_t number = 0;          // of the triangle
};
struct SmallDrawn {
  uint64_t covered = 0, passed = 0;  // pixels
};
// The `pixels` of the block whose first pixel is (x, y), from the tile's.
using DrawSmallTriangle = SmallDrawn(const SmallTriangle& triangle, int32_t x, int32_t y, uint64_t pixels,
                                     const SmallTarget& target);
struct SmallTriangleFunctions {
  DrawSmallTriangle* draw[8];  // by VkCompareOp; with ALWAYS and no depths: coverage alone
};
const SmallTriangleFunctions& small_triangle_functions();

}  // namespace lapilli
