// Sorting the triangles of a chunk into tiles: count, prefix sum, scatter, so that the order of primitives is kept.
#include "geometry/bins.h"

#include "geometry/setup.h"

namespace lapilli {
namespace {

// False if an edge leaves the whole tile outside. The value at the corner where it is largest decides.
bool may_touch(const CoverageEdges& edges, int32_t tile_x, int32_t tile_y) {
  constexpr int64_t kSpan = kTileSize - 1;
  for (int i = 0; i < 3; ++i) {
    const int64_t at_origin = edges.c[i] + int64_t{edges.a[i]} * tile_x + int64_t{edges.b[i]} * tile_y;
    const int64_t largest =
        at_origin + (edges.a[i] > 0 ? edges.a[i] * kSpan : 0) + (edges.b[i] > 0 ? edges.b[i] * kSpan : 0);
    if (largest < 0) return false;
  }
  return true;
}

struct TileRange {
  uint32_t x0, y0, x1, y1;  // inclusive
};

TileRange tiles_of(const BinTriangle& triangle) {
  return {triangle.x0 / kTileSize, triangle.y0 / kTileSize, (triangle.x1 - 1u) / kTileSize,
          (triangle.y1 - 1u) / kTileSize};
}

}  // namespace

void finish_chunk(const TileGrid& grid, BinChunk& chunk) {
  struct Entry {
    uint32_t tile, triangle;
  };
  std::vector<Entry> entries;
  entries.reserve(chunk.triangles.size());
  chunk.tile_first.assign(grid.count() + 1, 0);
  for (uint32_t t = 0; t < chunk.triangles.size(); ++t) {
    const BinTriangle& triangle = chunk.triangles[t];
    const TileRange range = tiles_of(triangle);
    const bool test_edges = range.x0 != range.x1 && range.y0 != range.y1;
    const CoverageEdges edges = test_edges ? make_edges(chunk, triangle) : CoverageEdges{};
    for (uint32_t y = range.y0; y <= range.y1; ++y) {
      for (uint32_t x = range.x0; x <= range.x1; ++x) {
        if (test_edges && !may_touch(edges, static_cast<int32_t>(x * kTileSize), static_cast<int32_t>(y * kTileSize))) {
          continue;
        }
        const uint32_t tile = y * grid.columns + x;
        entries.push_back({tile, t});
        ++chunk.tile_first[tile + 1];
      }
    }
  }
  for (uint32_t tile = 0; tile < grid.count(); ++tile) chunk.tile_first[tile + 1] += chunk.tile_first[tile];

  // The scatter moves each tile's start to its end; shifting by one entry restores it.
  chunk.references.resize(entries.size());
  for (const Entry& entry : entries) chunk.references[chunk.tile_first[entry.tile]++] = entry.triangle;
  for (uint32_t tile = grid.count(); tile > 0; --tile) chunk.tile_first[tile] = chunk.tile_first[tile - 1];
  chunk.tile_first[0] = 0;
}

}  // namespace lapilli
