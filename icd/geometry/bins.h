// The seam between geometry and rasterization. geometry/ fills a BinSet: set-up triangles in the order of the API, and
// for each tile the list of those that may touch it. raster/ consumes it tile by tile and asks for the next one
// (FrontEnd::next).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/draw_call.h"
#include "image/tile.h"
#include "shader/batch.h"

namespace lapilli {

// Pixels [x0, x1) x [y0, y1) in framebuffer space; empty where x1 <= x0 or y1 <= y0.
struct PixelRect {
  int32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool empty() const { return x1 <= x0 || y1 <= y0; }
};
PixelRect intersect(const PixelRect& a, const PixelRect& b);

// The three edge functions for coverage, as integers in units of 1/256 of TriangleSetup's: with the top-left rule
// folded into c, pixel (x, y) is covered where a*x + b*y + c >= 0 for all three. |a|, |b| <= 2^24, so that inside a
// tile which an edge crosses the value fits 32 bits.
struct CoverageEdges {
  int32_t a[3], b[3];
  int64_t c[3];
};

struct BinTriangle {
  TriangleSetup setup;
  CoverageEdges edges;
  PixelRect bounds;   // clipped to scissor, viewport and render area; never empty
  uint32_t draw = 0;  // index into the pass's draws
};

// The triangles of some consecutive primitives.
struct BinChunk {
  std::vector<BinTriangle> triangles;
  std::vector<float> varyings;       // TriangleSetup::varyings points into it
  std::vector<uint32_t> tile_first;  // [tile] first entry of the tile in `references`; one more at the end
  std::vector<uint32_t> references;  // indices into triangles, grouped by tile, in primitive order

  std::span<const uint32_t> tile(uint32_t index) const {
    return std::span(references).subspan(tile_first[index], tile_first[index + 1] - tile_first[index]);
  }
};

struct TileGrid {
  uint32_t columns = 0, rows = 0;
  uint32_t count() const { return columns * rows; }
};

struct BinSet {
  std::span<const BinChunk> chunks;  // in primitive order
  bool last = false;                 // no further set follows
};

}  // namespace lapilli
