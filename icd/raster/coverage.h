// Which pixels of a tile a triangle covers: tile -> 8x8 blocks -> pixels, with exact integer edge functions
// (geometry/bins.h).
#pragma once

#include <cstdint>

#include "geometry/bins.h"

namespace lapilli {

constexpr uint32_t kBlockSize = 8;                           // pixels a side; 16 quads, one batch
constexpr uint32_t kBlocksPerTile = kTileSize / kBlockSize;  // a side

// Coverage of one 8x8 block. Bit 4*q + s: quad q = (y/2)*4 + x/2 of the block, s = (y&1)*2 + (x&1).
struct BlockCoverage {
  uint8_t block_x, block_y;  // in blocks, from the tile's origin
  uint64_t pixels;           // never 0
};

// Writes the blocks that the triangle touches, row by row, and returns how many. (tile_x, tile_y): the tile's first
// pixel.
uint32_t cover_tile(const BinTriangle& triangle, int32_t tile_x, int32_t tile_y,
                    BlockCoverage (&blocks)[kBlocksPerTile * kBlocksPerTile]);

}  // namespace lapilli
