// Which pixels of a tile a triangle covers: tile -> 8x8 blocks -> pixels, with exact integer edge functions
// (geometry/bins.h).
#pragma once

#include <cstdint>

#include "geometry/bins.h"

namespace lapilli {

// Coverage of one 8x8 block. Bit 4*q + s: quad q = (y/2)*4 + x/2 of the block, s = (y&1)*2 + (x&1).
struct BlockCoverage {
  uint8_t block_x, block_y;  // in blocks, from the tile's origin
  uint64_t pixels;           // never 0
};

// Writes the blocks that a triangle touches within `bounds`, row by row, and returns how many. (tile_x, tile_y): the
// tile's first pixel.
uint32_t cover_tile(const CoverageEdges& edges, const PixelRect& bounds, int32_t tile_x, int32_t tile_y,
                    BlockCoverage (&blocks)[kBlocksPerTile * kBlocksPerTile]);

}  // namespace lapilli
