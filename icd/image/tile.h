// The rasterizer's tile storage, and moving tiles between it and an image.
// A tile is 64x64 pixels. A plane holds one attachment (and sample) of it, block by block: the 8x8 blocks row by row,
// in a block its 4x4 quads row by row, in a quad (0,0) (1,0) (0,1) (1,1). A block is 64 texels in a row, which are the
// lanes of a batch.
#pragma once

#include <cstddef>
#include <cstdint>

#include "image/copy.h"

namespace lapilli {

inline constexpr uint32_t kTileSize = 64;  // pixels
inline constexpr uint32_t kTileTexels = kTileSize * kTileSize;
inline constexpr uint32_t kTileQuads = kTileTexels / 4;
inline constexpr uint32_t kBlockSize = 8;  // pixels a side
inline constexpr uint32_t kBlockTexels = kBlockSize * kBlockSize;
inline constexpr uint32_t kBlockQuads = kBlockTexels / 4;
inline constexpr uint32_t kBlocksPerTile = kTileSize / kBlockSize;  // a side

// Pixels x0 ≤ x < x1, y0 ≤ y < y1 of the image; all in one tile, whose origin is (x0, y0) rounded down to multiples
// of 64.
struct TileArea {
  uint32_t x0 = 0;
  uint32_t y0 = 0;
  uint32_t x1 = 0;
  uint32_t y1 = 0;
};

// Texel number of a pixel in its plane; pixel coordinates of the image or of the tile.
constexpr uint32_t texel_in_plane(uint32_t x, uint32_t y) {
  const uint32_t block = y % kTileSize / kBlockSize * kBlocksPerTile + x % kTileSize / kBlockSize;
  const uint32_t quad = y % kBlockSize / 2 * (kBlockSize / 2) + x % kBlockSize / 2;
  return block * kBlockTexels + quad * 4 + (y & 1) * 2 + (x & 1);
}

// Bit 4q of a block's or a batch's lanes, if any lane of quad q is in `lanes`.
constexpr uint64_t live_quads(uint64_t lanes) {
  const uint64_t pairs = lanes | lanes >> 1;
  return (pairs | pairs >> 2) & 0x1111111111111111;
}

// `image` is pixel (0, 0) of a row-major level, `plane` has kTileTexels * texel_size bytes. Only the pixels of the area
// are read and written, on both sides. texel_size: 1, 2, 4, 8 or 16 bytes.
void load_tile(const std::byte* image, uint64_t row_pitch, uint32_t texel_size, const TileArea& area, std::byte* plane);
void store_tile(const std::byte* plane, uint32_t texel_size, const TileArea& area, std::byte* image,
                uint64_t row_pitch);

// Every texel of the plane, also those outside of the image.
void fill_tile(std::byte* plane, uint32_t texel_size, const PackedTexel& texel);

// The area of the image itself, for a tile that nothing but a clear has touched.
void fill_image_area(std::byte* image, uint64_t row_pitch, uint32_t texel_size, const TileArea& area,
                     const PackedTexel& texel);

}  // namespace lapilli
