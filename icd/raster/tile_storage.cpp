// Moving the blocks of a tile, row by row of blocks.
#include "raster/tile_storage.h"

#include <algorithm>
#include <bit>
#include <new>

namespace lapilli {
namespace {

constexpr std::align_val_t kAlignment{64};

// Bit x: the block in column x of the row is one of them.
uint32_t columns_of(uint64_t blocks, uint32_t row) {
  const uint32_t pairs = static_cast<uint32_t>(blocks >> bit_of(0, row)) & 0x3333;
  return (pairs & 3) | (pairs >> 2 & 0xC) | (pairs >> 4 & 0x30) | (pairs >> 6 & 0xC0);
}

}  // namespace

void TileStorage::Free::operator()(std::byte* memory) const { ::operator delete(memory, kAlignment); }

void TileStorage::reserve(std::span<const PassAttachment> attachments, uint32_t samples) {
  attachments_ = attachments;
  samples_ = samples;
  const size_t bytes = attachments.size() * samples * kPlaneBytes;
  if (bytes <= capacity_) return;
  memory_.reset();
  capacity_ = 0;
  memory_.reset(static_cast<std::byte*>(::operator new(bytes, kAlignment)));
  capacity_ = bytes;
}

void TileStorage::begin_tile(const TileArea& area, bool first_set, bool last_set) {
  area_ = area;
  first_set_ = first_set;
  last_set_ = last_set;
  colors_present_ = 0;
}

void TileStorage::move(size_t attachment, uint32_t sample, const TileArea& area, Move move) {
  const AttachmentTarget& target = *attachments_[attachment].target;
  const PackedTexel& clear = attachments_[attachment].clear;
  const uint32_t size = target.format->texel_size;
  std::byte* const image = target.data + sample * target.sample_pitch;
  std::byte* const texels = plane(attachment, sample);
  switch (move) {
    case Move::load:
      return load_tile(image, target.row_pitch, size, area, texels);
    case Move::store:
      return store_tile(texels, size, area, image, target.row_pitch);
    case Move::fill_image:
      return fill_image_area(image, target.row_pitch, size, area, clear);
    case Move::fill_plane:
      break;
  }
  // Blocks side by side lie side by side in the plane, and what is outside of the area is nobody's.
  const uint32_t first = texel_in_plane(area.x0 & ~(kBlockSize - 1), area.y0);
  const uint32_t columns = (area.x1 + kBlockSize - 1) / kBlockSize - area.x0 / kBlockSize;
  const uint32_t rows = (area.y1 + kBlockSize - 1) / kBlockSize - area.y0 / kBlockSize;
  for (uint32_t row = 0; row < rows; ++row) {
    const uint32_t texel = first / kBlockTexels * kBlockTexels + row * kBlocksPerTile * kBlockTexels;
    fill_texels(texels + size_t{texel} * size, columns * kBlockTexels, size, clear);
  }
}

void TileStorage::move_blocks(size_t attachment, uint64_t blocks, Move how) {
  const auto move_area = [&](const TileArea& area) {
    if (area.x0 >= area.x1 || area.y0 >= area.y1) return;
    for (uint32_t sample = 0; sample < samples_; ++sample) move(attachment, sample, area, how);
  };
  if (blocks == 0) return;
  if (blocks == kAllBits) return move_area(area_);
  const uint32_t tile_x = area_.x0 / kTileSize * kTileSize;
  const uint32_t tile_y = area_.y0 / kTileSize * kTileSize;
  for (uint32_t row = 0; row < kBlocksPerTile; ++row) {
    uint32_t columns = columns_of(blocks, row);
    if (columns == 0) continue;
    const uint32_t y0 = std::max(tile_y + row * kBlockSize, area_.y0);
    const uint32_t y1 = std::min(tile_y + (row + 1) * kBlockSize, area_.y1);
    while (columns != 0) {
      const uint32_t first = static_cast<uint32_t>(std::countr_zero(columns));
      const uint32_t end = first + static_cast<uint32_t>(std::countr_one(columns >> first));
      columns &= ~((1u << end) - 1);
      move_area(
          {std::max(tile_x + first * kBlockSize, area_.x0), y0, std::min(tile_x + end * kBlockSize, area_.x1), y1});
    }
  }
}

void TileStorage::fetch_missing_colors(uint64_t blocks) {
  for (size_t i = 0; i < attachments_.size(); ++i) {
    // "Don't care" loads too: what the tile held before would depend on which thread worked on what.
    if (!attachments_[i].is_depth) move_blocks(i, blocks, begins_cleared(i) ? Move::fill_plane : Move::load);
  }
  colors_present_ |= blocks;
}

void TileStorage::fetch_all(size_t attachment) {
  move_blocks(attachment, kAllBits, begins_cleared(attachment) ? Move::fill_plane : Move::load);
}

void TileStorage::store_colors() {
  for (size_t i = 0; i < attachments_.size(); ++i) {
    if (!attachments_[i].is_depth) store(i, colors_present_);
  }
}

void TileStorage::store(size_t attachment, uint64_t blocks) {
  if (!stores(attachment)) return;
  move_blocks(attachment, blocks, Move::store);
  if (begins_cleared(attachment)) move_blocks(attachment, ~blocks, Move::fill_image);
}

}  // namespace lapilli
