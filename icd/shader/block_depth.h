// Depth test of one triangle over an aligned 8x8 block of a tile, 64 depths at once: what raster/ does before it shades
// (early depth), with the bits of the ops frag_depth and depth_test. Specification: "Depth Test".
#pragma once

#include <cstdint>

#include "base/simd_dispatch.h"
#include "shader/batch.h"

namespace lapilli {

// The part of a TriangleSetup that depth needs; [0], [1] are its edges 1 and 2.
struct TriangleDepth {
  double a[2], b[2], c[2];
  DepthPlane plane;
};
inline TriangleDepth triangle_depth(const TriangleSetup& t) {
  return {{t.edge_a[1], t.edge_a[2]}, {t.edge_b[1], t.edge_b[2]}, {t.edge_c[1], t.edge_c[2]}, t.depth};
}

// Of all 64 depths of a block. A NaN among them makes it -Inf … +Inf.
struct DepthRange {
  float min, max;
};

// Depths are 64 floats, in the order of a block's lanes (image/tile.h), 64-byte aligned. (x, y): the block's first
// pixel in the framebuffer, both multiples of 8.
struct BlockDepthFunctions {
  void (*depth)(const TriangleDepth& triangle, uint32_t x, uint32_t y, float* z);
  // By VkCompareOp: the lanes of `lanes` whose depth passes against `stored`. With `write` their depth is stored (a NaN
  // as 0x7FC00000), and `range` becomes that of the block if any has passed.
  using Test = uint64_t (*)(const TriangleDepth& triangle, uint32_t x, uint32_t y, uint64_t lanes, bool write,
                            float* stored, DepthRange& range);
  Test test[8];
  // The range of 64 depths as they are, such as after a tile was loaded.
  DepthRange (*range)(const float* stored);
};

// For the SIMD target in force, or a given one.
const BlockDepthFunctions& block_depth_functions();
const BlockDepthFunctions& block_depth_functions(SimdTarget target);

}  // namespace lapilli
