// Which pixels of a tile a triangle covers: tile -> 8x8 blocks -> pixels, with exact integer edge functions
// (geometry/bins.h).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "geometry/bins.h"

namespace lapilli {

// Sets of a block's pixels and of a tile's blocks are 64-bit words with the same order: bit 4*q + s is
// x = 2*(q%4) + (s&1), y = 2*(q/4) + (s>>1). For pixels it is the order of the lanes.
constexpr uint32_t column_of_bit(uint32_t bit) { return (bit >> 2 & 3) * 2 + (bit & 1); }
constexpr uint32_t row_of_bit(uint32_t bit) { return (bit >> 4) * 2 + (bit >> 1 & 1); }
constexpr uint32_t bit_of(uint32_t column, uint32_t row) {
  return ((row / 2) * 4 + column / 2) * 4 + (row & 1) * 2 + (column & 1);
}
// The first texel of a block in a plane (image/tile.h), by its bit.
constexpr uint32_t first_texel_of_block(uint32_t bit) {
  return (row_of_bit(bit) * kBlocksPerTile + column_of_bit(bit)) * kBlockTexels;
}
constexpr uint64_t kAllBits = ~uint64_t{0};
// Calls body(bit) for each bit that is set, from the lowest on.
template <class Body>
void for_each_bit(uint64_t word, Body&& body) {
  for (; word != 0; word &= word - 1) body(static_cast<uint32_t>(std::countr_zero(word)));
}

// How many of live_quads()' bits are set.
constexpr uint32_t count_quads(uint64_t quads) {
  // Sums of four quads each, at most 4, in bytes and then all of them in the highest.
  const uint64_t sums = (quads & 0x0101010101010101) + (quads >> 4 & 0x0101010101010101);
  return static_cast<uint32_t>((sums * 0x0101010101010101) >> 56);
}

// [i]: the bits with a coordinate below i.
using PrefixMasks = std::array<uint64_t, kBlockSize + 1>;
constexpr PrefixMasks prefix_masks(uint32_t (*coordinate)(uint32_t)) {
  PrefixMasks masks{};
  for (uint32_t i = 0; i <= kBlockSize; ++i) {
    for (uint32_t bit = 0; bit < 64; ++bit) {
      if (coordinate(bit) < i) masks[i] |= uint64_t{1} << bit;
    }
  }
  return masks;
}
inline constexpr PrefixMasks kColumnsBelow = prefix_masks(column_of_bit);
inline constexpr PrefixMasks kRowsBelow = prefix_masks(row_of_bit);

// Bits in [x0, x1) x [y0, y1).
inline uint64_t bits_in(int32_t x0, int32_t y0, int32_t x1, int32_t y1) {
  const auto clamp = [](int32_t v) { return static_cast<size_t>(std::clamp(v, 0, static_cast<int32_t>(kBlockSize))); };
  return kColumnsBelow[clamp(x1)] & ~kColumnsBelow[clamp(x0)] & kRowsBelow[clamp(y1)] & ~kRowsBelow[clamp(y0)];
}

// Pixels of the block with this bit that lie in `rect`, which is in pixels from the tile's origin.
inline uint64_t pixels_in_rect(const PixelRect& rect, uint32_t block) {
  const int32_t x = static_cast<int32_t>(column_of_bit(block) * kBlockSize);
  const int32_t y = static_cast<int32_t>(row_of_bit(block) * kBlockSize);
  return bits_in(rect.x0 - x, rect.y0 - y, rect.x1 - x, rect.y1 - y);
}

// What is left of a triangle's edges in one tile. Values of an edge that crosses the tile are at most
// 63 * (|a| + |b|) < 2^31 in magnitude there.
class TileCoverage {
 public:
  // (tile_x, tile_y): the tile's first pixel; `bounds`: of the triangle, in pixels from there, inside the tile.
  // False: nothing is covered.
  bool begin(const CoverageEdges& edges, int32_t tile_x, int32_t tile_y, const PixelRect& bounds);

  struct Blocks {
    uint64_t touched;  // may have a covered pixel
    uint64_t inside;   // all pixels covered; a part of `touched`
  };
  Blocks blocks() const;
  // The covered pixels of a block.
  uint64_t pixels(uint32_t block) const;

 private:
  struct Edge {
    int32_t a, b, c;          // relative to the tile's origin
    int32_t highest, lowest;  // in a block, relative to the value at its first pixel
  };
  Edge edges_[3];  // those that cross the tile
  uint32_t count_ = 0;
  PixelRect bounds_;
};

}  // namespace lapilli
