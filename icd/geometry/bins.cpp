// Sorting the triangles of a chunk into tiles: count, prefix sum, scatter, so that the order of primitives is kept.
#include "geometry/bins.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "geometry/setup.h"

namespace lapilli {
namespace {

// Edge functions of a triangle at the corner of a tile where each is largest: below 0 the tile is outside.
struct TileEdges {
  int64_t at[3];                 // tile (0, 0)
  int64_t step_x[3], step_y[3];  // to the next tile

  TileEdges(const CoverageEdges& edges, uint32_t x, uint32_t y) {
    constexpr int64_t kSpan = kTileSize - 1, kStep = kTileSize;
    for (int i = 0; i < 3; ++i) {
      const int64_t a = edges.a[i], b = edges.b[i];
      step_x[i] = a * kStep;
      step_y[i] = b * kStep;
      at[i] = edges.c[i] + std::max<int64_t>(a, 0) * kSpan + std::max<int64_t>(b, 0) * kSpan + x * step_x[i] +
              y * step_y[i];
    }
  }
};

// Visits every tile that the triangle may touch. Not inlined: most lie in one tile.
template <class Visit>
[[gnu::noinline]] void visit_tiles(const TileGrid& grid, const BinChunk& chunk, uint32_t index, Visit& visit) {
  const BinTriangle& triangle = chunk.triangles[index];
  const uint32_t x0 = triangle.x0 / kTileSize, x1 = (triangle.x1 - 1u) / kTileSize;
  const uint32_t y0 = triangle.y0 / kTileSize, y1 = (triangle.y1 - 1u) / kTileSize;
  if (x0 == x1 || y0 == y1) {
    for (uint32_t y = y0; y <= y1; ++y) {
      for (uint32_t x = x0; x <= x1; ++x) {
        visit.change(y * grid.columns + x);
        visit.add(index);
      }
    }
    return;
  }
  TileEdges edges(make_edges(chunk, triangle), x0, y0);
  for (uint32_t y = y0; y <= y1; ++y) {
    int64_t e0 = edges.at[0], e1 = edges.at[1], e2 = edges.at[2];
    for (uint32_t x = x0; x <= x1; ++x) {
      if ((e0 | e1 | e2) >= 0) {
        visit.change(y * grid.columns + x);
        visit.add(index);
      }
      e0 += edges.step_x[0];
      e1 += edges.step_x[1];
      e2 += edges.step_x[2];
    }
    for (int i = 0; i < 3; ++i) edges.at[i] += edges.step_y[i];
  }
}
// The tiles of the first and the last pixel of its bounds, 16 bits each: x y x y. Little endian.
uint64_t corner_tiles(const BinTriangle& triangle) {
  static_assert(offsetof(BinTriangle, x0) + sizeof(uint64_t) == sizeof(BinTriangle) && kTileSize == 64);
  uint64_t bounds;
  std::memcpy(&bounds, &triangle.x0, sizeof bounds);
  return ((bounds - (uint64_t{0x00010001} << 32)) >> 6) & 0x03FF'03FF'03FF'03FF;
}

// Neighbours in the list mostly lie in the same tile: that takes one comparison, and what is known of the tile stays in
// registers.
template <class Visit>
void for_each_tile(const TileGrid& grid, const BinChunk& chunk, Visit visit) {
  constexpr uint64_t kNone = ~uint64_t{0};
  const uint32_t count = static_cast<uint32_t>(chunk.triangles.size());
  const BinTriangle* const triangles = chunk.triangles.data();
  uint64_t last = kNone;
  for (uint32_t t = 0; t < count; ++t) {
    const uint64_t tiles = corner_tiles(triangles[t]);
    if (tiles != last) {
      if (static_cast<uint32_t>(tiles) != tiles >> 32) {
        visit_tiles(grid, chunk, t, visit);
        last = kNone;
        continue;
      }
      visit.change(static_cast<uint32_t>(tiles >> 48) * grid.columns + static_cast<uint16_t>(tiles));
      last = tiles;
    }
    visit.add(t);
  }
  visit.change(0);
}

// What is done for each triangle of a tile, and when another tile follows.
struct Count {
  uint32_t* first;  // BinChunk::tile_first
  uint32_t tile = 0, count = 0;

  void add(uint32_t) { ++count; }
  void change(uint32_t next) {
    first[tile + 1] += count;
    tile = next;
    count = 0;
  }
};
struct Scatter {
  uint32_t* first;
  uint32_t* references;
  uint32_t tile = 0, at = first[0];

  void add(uint32_t triangle) { references[at++] = triangle; }
  void change(uint32_t next) {
    first[tile] = at;
    tile = next;
    at = first[tile];
  }
};

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
  for_each_tile(grid, chunk, Count{first});
  for (uint32_t tile = 0; tile < grid.count(); ++tile) first[tile + 1] += first[tile];

  // The scatter moves each tile's start to its end; shifting by one entry restores it.
  chunk.references.resize(first[grid.count()]);
  for_each_tile(grid, chunk, Scatter{first, chunk.references.data()});
  for (uint32_t tile = grid.count(); tile > 0; --tile) first[tile] = first[tile - 1];
  first[0] = 0;
}

uint64_t memory_of(const BinChunk& chunk) {
  return chunk.runs.capacity() * sizeof(BinRun) + chunk.vertices.capacity_bytes() + chunk.varyings.capacity_bytes() +
         chunk.triangles.capacity_bytes() + chunk.tile_first.capacity() * sizeof(uint32_t) +
         chunk.references.capacity_bytes();
}

}  // namespace lapilli
