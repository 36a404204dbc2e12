// Tile copies: in a row of a tile, every second pair of texels in the plane belongs to the row.
#include "image/tile.h"

#include <cassert>
#include <cstring>

namespace lapilli {
namespace {

// Calls Move for the texels of each row: pairs where the row starts and ends at even pixels, single ones at odd ends.
// Move<bytes>(texel of the image, texel of the plane).
template <uint32_t kTexelSize, class Move, class ImageByte, class PlaneByte>
void for_each_run(ImageByte* image, uint64_t row_pitch, const TileArea& area, PlaneByte* plane, Move move) {
  for (uint32_t y = area.y0; y < area.y1; ++y) {
    ImageByte* row = image + row_pitch * y;
    uint32_t x = area.x0;
    if ((x & 1) != 0 && x < area.x1) {
      move.template operator()<kTexelSize>(row + x * kTexelSize, plane + texel_in_plane(x, y) * kTexelSize);
      ++x;
    }
    ImageByte* pair = row + x * kTexelSize;
    PlaneByte* quad_half = plane + texel_in_plane(x, y) * kTexelSize;
    for (; x + 1 < area.x1; x += 2) {
      move.template operator()<2 * kTexelSize>(pair, quad_half);
      pair += 2 * kTexelSize;
      quad_half += 4 * kTexelSize;
    }
    if (x < area.x1) move.template operator()<kTexelSize>(pair, quad_half);
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
      return for_each_run<1>(image, row_pitch, area, plane, move);
    case 2:
      return for_each_run<2>(image, row_pitch, area, plane, move);
    case 4:
      return for_each_run<4>(image, row_pitch, area, plane, move);
    case 8:
      return for_each_run<8>(image, row_pitch, area, plane, move);
    case 16:
      return for_each_run<16>(image, row_pitch, area, plane, move);
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
