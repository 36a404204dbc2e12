// Which triangle is seen at each pixel of a tile: what deferred draws leave behind instead of colours.
// DESIGN.md, "Deferred shading of opaque draws".
#pragma once

#include <cstdint>
#include <vector>

#include "raster/coverage.h"

namespace lapilli {

// Lanes of 64 numbers; compiled for each SIMD target.
struct LaneNumberFunctions {
  void (*fill)(uint32_t* numbers, uint32_t value);
  void (*fill_lanes)(uint32_t* numbers, uint64_t lanes, uint32_t value);
  uint64_t (*equal)(const uint32_t* numbers, uint32_t value);
  // Those in [first, end).
  uint64_t (*between)(const uint32_t* numbers, uint32_t first, uint32_t end);
};
const LaneNumberFunctions& lane_number_functions();

// A triangle that somebody may have to come back to in this tile, to shade it or to know its depths.
// What shading needs of its vertices is copied while they are at hand: the bins are far apart in memory.
struct TileTriangle {
  const BinChunk* chunk;
  uint32_t index;         // in chunk->triangles
  uint32_t draw;          // counted within the tile
  uint32_t setup;         // where its TriangleSetup is (SetupRing)
  uint32_t front_facing;  // ~0 or 0
  int32_t x[3], y[3];     // as in BinVertex
  float inverse_w[3];
  uint32_t varyings[3];  // in chunk->varyings
};

class Visibility {
 public:
  static constexpr uint32_t kNobody = 0;

  void begin_tile() {
    functions_ = &lane_number_functions();
    whole_ = mixed_ = 0;
    triangles_.assign(1, {});
  }
  // Numbers are given in the order of the API, from 1; the new one is for the caller to fill.
  TileTriangle& add() { return triangles_.emplace_back(); }
  uint32_t next_number() const { return static_cast<uint32_t>(triangles_.size()); }
  TileTriangle& triangle(uint32_t number) { return triangles_[number]; }
  const TileTriangle& triangle(uint32_t number) const { return triangles_[number]; }

  // From here on the triangle is what is seen: in whole blocks, or in the pixels of one.
  void cover(uint64_t blocks, uint32_t number);
  void cover_pixels(uint32_t block, uint64_t pixels, uint32_t number);
  // The numbers of the block's pixels, for the caller to change.
  uint32_t* mixed_pixels(uint32_t block) {
    if ((mixed_ >> block & 1) == 0) mix(block);
    return seen_ + block * kBlockTexels;
  }

  // Blocks with a pixel that waits to be shaded, by one triangle or by any.
  bool pending() const { return (whole_ | mixed_) != 0; }
  uint64_t whole() const { return whole_; }
  uint64_t mixed() const { return mixed_; }
  uint32_t whole_block(uint32_t block) const { return owner_[block]; }
  const uint32_t* pixels(uint32_t block) const { return seen_ + block * kBlockTexels; }
  void forget_pixels() { whole_ = mixed_ = 0; }

 private:
  void mix(uint32_t block);

  const LaneNumberFunctions* functions_ = nullptr;
  uint64_t whole_ = 0, mixed_ = 0;
  alignas(64) uint32_t owner_[64];          // of whole blocks
  alignas(64) uint32_t seen_[kTileTexels];  // [block's bit][lane], of mixed blocks
  std::vector<TileTriangle> triangles_;
};

}  // namespace lapilli
