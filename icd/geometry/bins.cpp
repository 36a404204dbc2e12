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

// Calls visit(tile, triangle) for every tile that each triangle may touch, in primitive order.
template <class Visit>
void for_each_tile(const TileGrid& grid, const BinChunk& chunk, const Visit& visit) {
  const uint32_t count = static_cast<uint32_t>(chunk.triangles.size());
  for (uint32_t t = 0; t < count; ++t) {
    const BinTriangle& triangle = chunk.triangles[t];
    const uint32_t x0 = triangle.x0 / kTileSize, x1 = (triangle.x1 - 1u) / kTileSize;
    const uint32_t y0 = triangle.y0 / kTileSize, y1 = (triangle.y1 - 1u) / kTileSize;
    if (x0 == x1 && y0 == y1) {
      visit(y0 * grid.columns + x0, t);
      continue;
    }
    const bool test_edges = x0 != x1 && y0 != y1;
    const CoverageEdges edges = test_edges ? make_edges(chunk, triangle) : CoverageEdges{};
    for (uint32_t y = y0; y <= y1; ++y) {
      for (uint32_t x = x0; x <= x1; ++x) {
        if (!test_edges || may_touch(edges, static_cast<int32_t>(x * kTileSize), static_cast<int32_t>(y * kTileSize)))
          visit(y * grid.columns + x, t);
      }
    }
  }
}

}  // namespace

void clear_chunk(BinChunk& chunk) {
  chunk.runs.clear();
  chunk.vertices.clear();
  chunk.varyings.clear();
  chunk.triangles.clear();
  chunk.references.clear();
}

void release_chunk(BinChunk& chunk) { chunk = BinChunk(); }

// The edges of a triangle in many tiles are tested twice, which costs less than to remember what came of it.
void finish_chunk(const TileGrid& grid, BinChunk& chunk) {
  chunk.tile_first.assign(grid.count() + 1, 0);
  uint32_t* const first = chunk.tile_first.data();
  for_each_tile(grid, chunk, [first](uint32_t tile, uint32_t) { ++first[tile + 1]; });
  for (uint32_t tile = 0; tile < grid.count(); ++tile) first[tile + 1] += first[tile];

  // The scatter moves each tile's start to its end; shifting by one entry restores it.
  chunk.references.resize(first[grid.count()]);
  uint32_t* const references = chunk.references.data();
  for_each_tile(grid, chunk, [=](uint32_t tile, uint32_t triangle) { references[first[tile]++] = triangle; });
  for (uint32_t tile = grid.count(); tile > 0; --tile) first[tile] = first[tile - 1];
  first[0] = 0;
}

uint64_t memory_of(const BinChunk& chunk) {
  return chunk.runs.capacity() * sizeof(BinRun) + chunk.vertices.capacity_bytes() + chunk.varyings.capacity_bytes() +
         chunk.triangles.capacity_bytes() + chunk.tile_first.capacity() * sizeof(uint32_t) +
         chunk.references.capacity_bytes();
}

}  // namespace lapilli
