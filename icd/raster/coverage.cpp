// Edge functions over a tile. An edge that the whole tile (or block) lies inside of is not evaluated per pixel.
#include "raster/coverage.h"

#include <algorithm>
#include <array>

#include "base/block_signs.h"

namespace lapilli {
namespace {

constexpr int32_t kTileSpan = kTileSize - 1;
constexpr int32_t kBlockSpan = kBlockSize - 1;

struct LanePosition {
  std::array<int32_t, 64> x{}, y{};
};

// Position in its block of the pixel of each bit of BlockCoverage::pixels.
constexpr LanePosition kLanePosition = [] {
  LanePosition position;
  for (uint32_t lane = 0; lane < 64; ++lane) {
    const uint32_t quad = lane / 4;
    position.x[lane] = static_cast<int32_t>(quad % 4 * 2 + (lane & 1));
    position.y[lane] = static_cast<int32_t>(quad / 4 * 2 + (lane >> 1 & 1));
  }
  return position;
}();

// [i]: the pixels of a block with x (or y) below i.
using PrefixMasks = std::array<uint64_t, kBlockSize + 1>;
constexpr PrefixMasks prefix_masks(const std::array<int32_t, 64>& coordinate) {
  PrefixMasks masks{};
  for (int32_t i = 0; i <= static_cast<int32_t>(kBlockSize); ++i) {
    for (uint32_t lane = 0; lane < 64; ++lane) {
      if (coordinate[lane] < i) masks[static_cast<size_t>(i)] |= uint64_t{1} << lane;
    }
  }
  return masks;
}
constexpr PrefixMasks kColumnsBelow = prefix_masks(kLanePosition.x);
constexpr PrefixMasks kRowsBelow = prefix_masks(kLanePosition.y);

// Pixels of the block at (x, y) that lie in `rect`; both in pixels from the tile's origin.
uint64_t inside_rect(const PixelRect& rect, int32_t x, int32_t y) {
  const auto clamp = [](int32_t v) { return static_cast<size_t>(std::clamp(v, 0, static_cast<int32_t>(kBlockSize))); };
  return kColumnsBelow[clamp(rect.x1 - x)] & ~kColumnsBelow[clamp(rect.x0 - x)] & kRowsBelow[clamp(rect.y1 - y)] &
         ~kRowsBelow[clamp(rect.y0 - y)];
}

// An edge that crosses the tile, relative to the tile's origin. Since it crosses, all its values in the tile are at
// most kTileSpan * (|a| + |b|) < 2^31 in magnitude.
struct TileEdge {
  int32_t a, b, c;
  int32_t highest, lowest;  // in a block, relative to the value at its origin
};

// False: the tile is outside. Edges that the tile is inside of are left out.
bool edges_in_tile(const CoverageEdges& edges, int32_t tile_x, int32_t tile_y, TileEdge (&crossing)[3],
                   uint32_t& count) {
  count = 0;
  for (int i = 0; i < 3; ++i) {
    const int64_t a = edges.a[i];
    const int64_t b = edges.b[i];
    const int64_t c = edges.c[i] + a * tile_x + b * tile_y;
    if (c + kTileSpan * (std::max<int64_t>(a, 0) + std::max<int64_t>(b, 0)) < 0) return false;
    if (c + kTileSpan * (std::min<int64_t>(a, 0) + std::min<int64_t>(b, 0)) >= 0) continue;
    TileEdge& edge = crossing[count++];
    edge.a = edges.a[i];
    edge.b = edges.b[i];
    edge.c = static_cast<int32_t>(c);
    edge.highest = kBlockSpan * (std::max(edge.a, 0) + std::max(edge.b, 0));
    edge.lowest = kBlockSpan * (std::min(edge.a, 0) + std::min(edge.b, 0));
  }
  return true;
}

}  // namespace

uint32_t cover_tile(const CoverageEdges& triangle, const PixelRect& triangle_bounds, int32_t tile_x, int32_t tile_y,
                    BlockCoverage (&blocks)[kBlocksPerTile * kBlocksPerTile]) {
  TileEdge edges[3];
  uint32_t edge_count = 0;
  if (!edges_in_tile(triangle, tile_x, tile_y, edges, edge_count)) return 0;

  constexpr int32_t kSize = static_cast<int32_t>(kTileSize);
  const PixelRect bounds = intersect({triangle_bounds.x0 - tile_x, triangle_bounds.y0 - tile_y,
                                      triangle_bounds.x1 - tile_x, triangle_bounds.y1 - tile_y},
                                     {0, 0, kSize, kSize});
  if (bounds.empty()) return 0;

  constexpr int32_t kBlock = static_cast<int32_t>(kBlockSize);
  uint32_t count = 0;
  for (int32_t y = bounds.y0 & -kBlock; y < bounds.y1; y += kBlock) {
    for (int32_t x = bounds.x0 & -kBlock; x < bounds.x1; x += kBlock) {
      uint64_t pixels = inside_rect(bounds, x, y);
      for (uint32_t i = 0; i < edge_count; ++i) {
        const int32_t at_origin = edges[i].c + edges[i].a * x + edges[i].b * y;
        if (at_origin + edges[i].highest < 0) {
          pixels = 0;
          break;
        }
        if (at_origin + edges[i].lowest < 0) pixels &= ~negative_in_block(at_origin, edges[i].a, edges[i].b);
      }
      if (pixels != 0) blocks[count++] = {static_cast<uint8_t>(x / kBlock), static_cast<uint8_t>(y / kBlock), pixels};
    }
  }
  return count;
}

}  // namespace lapilli
