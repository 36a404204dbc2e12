// Tile copies, block by block: in a row of a block, every second pair of texels in the plane belongs to the row.
#include "image/tile.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace lapilli {
namespace {

// Move<bytes>(texels of the image, texels of the plane), for pairs of texels. `image` is the block's first texel.
template <uint32_t kTexelSize, class Move, class ImageByte, class PlaneByte>
void move_block(ImageByte* image, uint64_t row_pitch, PlaneByte* plane, Move move) {
  constexpr uint32_t kPair = 2 * kTexelSize;
  for (uint32_t quad_row = 0; quad_row < kBlockSize / 2; ++quad_row) {
    ImageByte* const upper = image + 2 * quad_row * row_pitch;
    ImageByte* const lower = upper + row_pitch;
    for (uint32_t quad = 0; quad < kBlockSize / 2; ++quad, plane += 2 * kPair) {
      move.template operator()<kPair>(upper + quad * kPair, plane);
      move.template operator()<kPair>(lower + quad * kPair, plane + kPair);
    }
  }
}

template <uint32_t kTexelSize, class Move, class ImageByte, class PlaneByte>
void move_blocks(ImageByte* image, uint64_t row_pitch, const TileArea& area, PlaneByte* plane, Move move) {
  for (uint32_t y = area.y0; y < area.y1; y = (y | (kBlockSize - 1)) + 1) {
    const uint32_t y1 = std::min((y | (kBlockSize - 1)) + 1, area.y1);
    for (uint32_t x = area.x0; x < area.x1; x = (x | (kBlockSize - 1)) + 1) {
      const uint32_t x1 = std::min((x | (kBlockSize - 1)) + 1, area.x1);
      if (x1 - x == kBlockSize && y1 - y == kBlockSize) {
        move_block<kTexelSize>(image + row_pitch * y + uint64_t{x} * kTexelSize, row_pitch,
                               plane + texel_in_plane(x, y) * kTexelSize, move);
        continue;
      }
      for (uint32_t py = y; py < y1; ++py) {
        for (uint32_t px = x; px < x1; ++px) {
          move.template operator()<kTexelSize>(image + row_pitch * py + uint64_t{px} * kTexelSize,
                                               plane + texel_in_plane(px, py) * kTexelSize);
        }
      }
    }
  }
}

struct MoveToPlane {
  template <uint32_t kBytes>
  void operator()(const std::byte* image, std::byte* plane) const {
    std::memcpy(plane, image, kBytes);
  }
};
struct MoveToImage {
  template <uint32_t kBytes>
  void operator()(std::byte* image, const std::byte* plane) const {
    std::memcpy(image, plane, kBytes);
  }
};

template <class Move, class ImageByte, class PlaneByte>
void move_tile(ImageByte* image, uint64_t row_pitch, uint32_t texel_size, const TileArea& area, PlaneByte* plane,
               Move move) {
  switch (texel_size) {
    case 1:
      return move_blocks<1>(image, row_pitch, area, plane, move);
    case 2:
      return move_blocks<2>(image, row_pitch, area, plane, move);
    case 4:
      return move_blocks<4>(image, row_pitch, area, plane, move);
    case 8:
      return move_blocks<8>(image, row_pitch, area, plane, move);
    case 16:
      return move_blocks<16>(image, row_pitch, area, plane, move);
    default:
      assert(false && "attachments have texels of 1, 2, 4, 8 or 16 bytes");
  }
}

}  // namespace

void load_tile(const std::byte* image, uint64_t row_pitch, uint32_t texel_size, const TileArea& area,
               std::byte* plane) {
  move_tile(image, row_pitch, texel_size, area, plane, MoveToPlane());
}

void store_tile(const std::byte* plane, uint32_t texel_size, const TileArea& area, std::byte* image,
                uint64_t row_pitch) {
  move_tile(image, row_pitch, texel_size, area, plane, MoveToImage());
}

void fill_tile(std::byte* plane, uint32_t texel_size, const PackedTexel& texel) {
  fill_texels(plane, kTileTexels, texel_size, texel);
}

void fill_image_area(std::byte* image, uint64_t row_pitch, uint32_t texel_size, const TileArea& area,
                     const PackedTexel& texel) {
  for (uint32_t y = area.y0; y < area.y1; ++y) {
    fill_texels(image + row_pitch * y + uint64_t{area.x0} * texel_size, area.x1 - area.x0, texel_size, texel);
  }
}

}  // namespace lapilli
