// Tile copies: two rows of an image at a time, whose pairs of pixels take turns in the plane.
#include "image/tile.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace lapilli {
namespace {

// Two pairs of texels of 4 bytes, the size that nearly all attachments have.
typedef uint64_t TwoPairs __attribute__((vector_size(16)));

TwoPairs load_pairs(const std::byte* from) {
  TwoPairs pairs;
  std::memcpy(&pairs, from, sizeof pairs);
  return pairs;
}
void store_pairs(const TwoPairs& pairs, std::byte* to) { std::memcpy(to, &pairs, sizeof pairs); }
// Two rows of two pairs to two quads, and back.
void exchange(const std::byte* from0, const std::byte* from1, std::byte* to0, std::byte* to1) {
  const TwoPairs a = load_pairs(from0);
  const TwoPairs b = load_pairs(from1);
  store_pairs(__builtin_shufflevector(a, b, 0, 2), to0);
  store_pairs(__builtin_shufflevector(a, b, 1, 3), to1);
}

// What moves texels: `bytes` of them that lie together on both sides, and two quads of 4-byte texels.
struct ToPlane {
  using ImageByte = const std::byte;
  using PlaneByte = std::byte;
  template <uint32_t kBytes>
  static void move(const std::byte* image, std::byte* plane) {
    std::memcpy(plane, image, kBytes);
  }
  static void two_quads(const std::byte* upper, const std::byte* lower, std::byte* plane) {
    exchange(upper, lower, plane, plane + 16);
  }
};
struct ToImage {
  using ImageByte = std::byte;
  using PlaneByte = const std::byte;
  template <uint32_t kBytes>
  static void move(std::byte* image, const std::byte* plane) {
    std::memcpy(image, plane, kBytes);
  }
  static void two_quads(std::byte* upper, std::byte* lower, const std::byte* plane) {
    exchange(plane, plane + 16, upper, lower);
  }
};

// The rows y and y + 1 of whole blocks, from pixel x on.
template <uint32_t kTexelSize, class Move>
void move_quad_row(typename Move::ImageByte* image, uint64_t row_pitch, typename Move::PlaneByte* plane) {
  if constexpr (kTexelSize == 4) {
    Move::two_quads(image, image + row_pitch, plane);
    Move::two_quads(image + 16, image + row_pitch + 16, plane + 32);
  } else {
    constexpr uint32_t kPair = 2 * kTexelSize;
    for (uint32_t quad = 0; quad < kBlockSize / 2; ++quad) {
      Move::template move<kPair>(image + quad * kPair, plane + quad * 2 * kPair);
      Move::template move<kPair>(image + row_pitch + quad * kPair, plane + quad * 2 * kPair + kPair);
    }
  }
}

template <uint32_t kTexelSize, class Move>
void move_pixels(typename Move::ImageByte* image, uint64_t row_pitch, const TileArea& area,
                 typename Move::PlaneByte* plane) {
  for (uint32_t y = area.y0; y < area.y1; ++y) {
    for (uint32_t x = area.x0; x < area.x1; ++x) {
      Move::template move<kTexelSize>(image + row_pitch * y + uint64_t{x} * kTexelSize,
                                      plane + texel_in_plane(x, y) * kTexelSize);
    }
  }
}

constexpr uint32_t kBelowBlock = kBlockSize - 1;

template <uint32_t kTexelSize, class Move>
void move_area(typename Move::ImageByte* image, uint64_t row_pitch, const TileArea& area,
               typename Move::PlaneByte* plane) {
  const uint32_t whole_x0 = std::min((area.x0 + kBelowBlock) & ~kBelowBlock, area.x1);
  const uint32_t whole_x1 = std::max(area.x1 & ~kBelowBlock, whole_x0);
  for (uint32_t y = area.y0; y < area.y1; y = (y | kBelowBlock) + 1) {
    const uint32_t y1 = std::min((y | kBelowBlock) + 1, area.y1);
    if (y1 - y < kBlockSize) {
      move_pixels<kTexelSize, Move>(image, row_pitch, {area.x0, y, area.x1, y1}, plane);
      continue;
    }
    move_pixels<kTexelSize, Move>(image, row_pitch, {area.x0, y, whole_x0, y1}, plane);
    for (uint32_t x = whole_x0; x < whole_x1; x += kBlockSize) {
      for (uint32_t row = y; row < y1; row += 2) {
        move_quad_row<kTexelSize, Move>(image + row_pitch * row + uint64_t{x} * kTexelSize, row_pitch,
                                        plane + texel_in_plane(x, row) * kTexelSize);
      }
    }
    move_pixels<kTexelSize, Move>(image, row_pitch, {whole_x1, y, area.x1, y1}, plane);
  }
}

template <class Move>
void move_tile(typename Move::ImageByte* image, uint64_t row_pitch, uint32_t texel_size, const TileArea& area,
               typename Move::PlaneByte* plane) {
  switch (texel_size) {
    case 1:
      return move_area<1, Move>(image, row_pitch, area, plane);
    case 2:
      return move_area<2, Move>(image, row_pitch, area, plane);
    case 4:
      return move_area<4, Move>(image, row_pitch, area, plane);
    case 8:
      return move_area<8, Move>(image, row_pitch, area, plane);
    case 16:
      return move_area<16, Move>(image, row_pitch, area, plane);
    default:
      assert(false && "attachments have texels of 1, 2, 4, 8 or 16 bytes");
  }
}

}  // namespace

void load_tile(const std::byte* image, uint64_t row_pitch, uint32_t texel_size, const TileArea& area,
               std::byte* plane) {
  move_tile<ToPlane>(image, row_pitch, texel_size, area, plane);
}

void store_tile(const std::byte* plane, uint32_t texel_size, const TileArea& area, std::byte* image,
                uint64_t row_pitch) {
  move_tile<ToImage>(image, row_pitch, texel_size, area, plane);
}

void fill_tile(std::byte* plane, uint32_t texel_size, const PackedTexel& texel) {
  fill_texels(plane, kTileTexels, texel_size, texel);
}

void fill_image_area(std::byte* image, uint64_t row_pitch, uint32_t texel_size, const TileArea& area,
                     const PackedTexel& texel) {
  if (area.x1 <= area.x0 || area.y1 <= area.y0) return;
  const uint32_t width = area.x1 - area.x0;
  std::byte* const first = image + row_pitch * area.y0 + uint64_t{area.x0} * texel_size;
  fill_texels(first, width, texel_size, texel);
  for (uint64_t row = 1; row < area.y1 - area.y0; ++row) {
    std::memcpy(first + row_pitch * row, first, uint64_t{width} * texel_size);
  }
}

}  // namespace lapilli
