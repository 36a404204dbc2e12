// Triangles of at most 32 pixels a side in a few blocks: set up many at a time, then covered and depth tested a block
// in one go, with edge functions that fit 32 bits.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>

#include "geometry/bins.h"

namespace lapilli {

// Of a tile's list. Arrays by the triangle's place in the group, [vertex] or [edge] first.
struct TriangleGroup {
  static constexpr uint32_t kMost = 16;
  static constexpr int32_t kMostExtent = 1 << 13;  // of a small triangle, 24.8 units
  static constexpr int32_t kMostBlocks = 9;        // that the bounds of a small triangle touch

  // As binned: 24.8 fixed point, z without bias, and BinTriangle's bounds.
  alignas(64) int32_t x[3][kMost], y[3][kMost];
  alignas(64) double z[3][kMost];
  alignas(64) uint16_t bounds[kMost][4];

  // Those that are small; the rest says something of them alone.
  uint32_t small;
  // In the tile, in pixels from its first one; x0 < x1, y0 < y1.
  alignas(64) int32_t x0[kMost], y0[kMost], x1[kMost], y1[kMost];
  // Edge functions as in TriangleSetup for a pixel of the tile: E(x, y) = 256 * (steps · (x, y)) + c, with the steps as
  // signed halves, the first one in the low half; c is 1 less (`less` is -1, else 0) where a centre on the edge is
  // outside (top-left rule).
  alignas(64) int32_t c[3][kMost], less[3][kMost];
  alignas(64) uint32_t steps[3][kMost];
  alignas(64) double k1[kMost], k2[kMost];  // DepthPlane

  // Those of the small ones with bounds of at most 2x2 pixels: pixel p is (x0 + p % 2, y0 + p / 2).
  uint32_t tiny;
  // What cover_tiny says of them: bit p of the pixels that are covered, and their depths.
  alignas(64) uint32_t tiny_covered[kMost];
  alignas(64) float tiny_depth[4][kMost];

  // Puts a triangle in place i.
  void put(uint32_t i, const BinChunk& chunk, const BinTriangle& triangle) {
    __builtin_memcpy(bounds[i], &triangle.x0, sizeof bounds[i]);
    for (size_t v = 0; v < 3; ++v) {
      const BinVertex& vertex = chunk.vertices[triangle.v[v]];
      x[v][i] = vertex.x;
      y[v][i] = vertex.y;
      z[v][i] = vertex.z;
    }
  }
};

// What is done to a block, in the order of its lanes.
struct SmallTarget {
  float* depths = nullptr;   // 64; null: no test
  bool write_depth = false;  // of what passes
  double z0 = 0;             // DepthPlane, with bias
  float min_depth = 0, max_depth = 1;
  uint32_t* numbers = nullptr;  // 64; null: nobody asks who is seen
  uint32_t number = 0;          // of the triangle
};
struct SmallDrawn {
  uint64_t covered = 0, passed = 0;  // pixels
};
// The `pixels` (not 0) of the block whose first pixel is (x, y), from the tile's, under triangle i.
using DrawSmallTriangle = SmallDrawn(const TriangleGroup& group, uint32_t i, uint32_t x, uint32_t y, uint64_t pixels,
                                     const SmallTarget& target);
struct SmallTriangleFunctions {
  // From what was put into the first `count` places. `tile`: what of it may be drawn to, from its first pixel.
  void (*set_up)(TriangleGroup& group, uint32_t count, uint32_t tile_x, uint32_t tile_y, const PixelRect& tile);
  // Tiny ones of runs with this range of depths and without bias.
  void (*cover_tiny)(TriangleGroup& group, uint32_t count, float min_depth, float max_depth);
  DrawSmallTriangle* draw[8];  // by VkCompareOp; without depths: coverage alone
};
const SmallTriangleFunctions& small_triangle_functions();

// compare_depth of one pixel; the bits of a VkCompareOp are less, equal and greater.
inline bool passes(VkCompareOp compare, float depth, float stored) {
  static_assert(VK_COMPARE_OP_LESS == 1 && VK_COMPARE_OP_EQUAL == 2 && VK_COMPARE_OP_GREATER == 4);
  const int relation = int{depth < stored} | int{depth == stored} << 1 | int{depth > stored} << 2;
  const bool unordered_passes = (compare & VK_COMPARE_OP_NOT_EQUAL) == VK_COMPARE_OP_NOT_EQUAL;
  return (compare & relation) != 0 || (relation == 0 && unordered_passes);
}

}  // namespace lapilli
