// What the depth test of a whole 8x8 block can be known to give from the range of the stored depths and from bounds of
// the triangle's depths there.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>

#include "base/simd_dispatch.h"
#include "geometry/bins.h"
#include "shader/block_depth.h"

namespace lapilli {

// Bounds of a triangle's depths in a tile. Depth is a linear function of the pixel but for rounding. With k_i, E_i as
// in DepthPlane no value on the way, here or in the exact formula, is larger in magnitude than
//   M = |z0| + sum |k_i| * (|E_i| + 64 * (|a_i| + |b_i|)),   E_i at the tile's first pixel,
// and each of the fewer than 16 roundings on the way to a bound and to the depth itself errs by at most 2^-53 * M. So
// 2^-47 * M is on the safe side. Rounding to float and clamping are monotonic and change nothing.
struct DepthBounds {
  double z, dx, dy;  // at the tile's first pixel; for one pixel in x and y
  double error;
  float min, max;  // clamp range
  bool known;      // false: no bound is given
};
DepthBounds depth_bounds(const TriangleDepth& triangle, uint32_t tile_x, uint32_t tile_y);
// In the pixels of a rectangle, which is relative to the tile's origin.
DepthRange range_in_rect(const DepthBounds& bounds, const PixelRect& rect);

// One bit for each block (raster/coverage.h): `never`: all its depths fail, `always`: all pass.
struct BlockVerdicts {
  uint64_t never = 0, always = 0;
};
// Of anything that has ranges, as bit 0.
BlockVerdicts judge(VkCompareOp compare, DepthRange triangle, DepthRange stored);

// Of the stored depths, by the block's bit.
struct alignas(64) BlockRanges {
  float min[64], max[64];
};
// All blocks of the tile; `triangle` becomes the bounds of the triangle's depths. The bounds have to be known.
BlockVerdicts judge(VkCompareOp compare, const DepthBounds& bounds, const BlockRanges& stored, BlockRanges& triangle);

// How the triangle's range lies to the stored one; a bit for each block.
struct DepthRelations {
  uint64_t below = 0;     // triangle's max < stored min
  uint64_t at_most = 0;   // <=
  uint64_t above = 0;     // triangle's min > stored max
  uint64_t at_least = 0;  // >=
  uint64_t same = 0;      // all four are one value
};
// Linear in the pixel, before clamping, at the tile's first block.
struct BlockSlopes {
  double low, high, dx, dy;
  float min, max;
};
struct HierarchicalDepthFunctions {
  void (*relate)(const BlockSlopes& slopes, const BlockRanges& stored, BlockRanges& triangle, DepthRelations& is);
  DepthRange (*range)(const BlockRanges& blocks);
  void (*copy)(BlockRanges& to, const BlockRanges& from, uint64_t blocks);
};
const HierarchicalDepthFunctions& hierarchical_depth_functions();

}  // namespace lapilli
