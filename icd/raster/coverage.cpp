// Edge functions over a tile. An edge that the whole tile (or block) lies inside of is not evaluated per pixel.
#include "raster/coverage.h"

#include <algorithm>
#include <array>

#include "base/block_signs.h"

namespace lapilli {
namespace {

constexpr int32_t kTileSpan = kTileSize - 1;
constexpr int32_t kBlockSpan = kBlockSize - 1;
constexpr int32_t kBlock = static_cast<int32_t>(kBlockSize);

}  // namespace

bool TileCoverage::begin(const CoverageEdges& edges, int32_t tile_x, int32_t tile_y, const PixelRect& bounds) {
  if (bounds.empty()) return false;
  bounds_ = bounds;
  count_ = 0;
  for (int i = 0; i < 3; ++i) {
    const int64_t a = edges.a[i];
    const int64_t b = edges.b[i];
    const int64_t c = edges.c[i] + a * tile_x + b * tile_y;
    if (c + kTileSpan * (std::max<int64_t>(a, 0) + std::max<int64_t>(b, 0)) < 0) return false;
    if (c + kTileSpan * (std::min<int64_t>(a, 0) + std::min<int64_t>(b, 0)) >= 0) continue;
    Edge& edge = edges_[count_++];
    edge.a = edges.a[i];
    edge.b = edges.b[i];
    edge.c = static_cast<int32_t>(c);
    edge.highest = kBlockSpan * (std::max(edge.a, 0) + std::max(edge.b, 0));
    edge.lowest = kBlockSpan * (std::min(edge.a, 0) + std::min(edge.b, 0));
  }
  return true;
}

TileCoverage::Blocks TileCoverage::blocks() const {
  Blocks blocks;
  blocks.touched = bits_in(bounds_.x0 / kBlock, bounds_.y0 / kBlock, (bounds_.x1 + kBlockSpan) / kBlock,
                           (bounds_.y1 + kBlockSpan) / kBlock);
  blocks.inside = bits_in((bounds_.x0 + kBlockSpan) / kBlock, (bounds_.y0 + kBlockSpan) / kBlock, bounds_.x1 / kBlock,
                          bounds_.y1 / kBlock);
  for (uint32_t i = 0; i < count_; ++i) {
    const Edge& edge = edges_[i];
    blocks.touched &= ~negative_in_block(edge.c + edge.highest, edge.a * kBlock, edge.b * kBlock);
    blocks.inside &= ~negative_in_block(edge.c + edge.lowest, edge.a * kBlock, edge.b * kBlock);
  }
  blocks.inside &= blocks.touched;
  return blocks;
}

uint64_t TileCoverage::pixels(uint32_t block) const {
  const int32_t x = static_cast<int32_t>(column_of_bit(block)) * kBlock;
  const int32_t y = static_cast<int32_t>(row_of_bit(block)) * kBlock;
  uint64_t pixels = bits_in(bounds_.x0 - x, bounds_.y0 - y, bounds_.x1 - x, bounds_.y1 - y);
  for (uint32_t i = 0; i < count_; ++i) {
    const Edge& edge = edges_[i];
    const int32_t at_first = edge.c + edge.a * x + edge.b * y;
    if (at_first + edge.lowest < 0) pixels &= ~negative_in_block(at_first, edge.a, edge.b);
  }
  return pixels;
}

}  // namespace lapilli
