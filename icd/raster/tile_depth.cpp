// How a tile's depths begin.
#include "raster/tile_depth.h"

#include <algorithm>
#include <bit>

#include "raster/visibility.h"

namespace lapilli {

void TileDepth::begin_cleared(float* plane, float depth) {
  plane_ = plane;
  clear_ = depth;
  changed_ = touched_ = 0;
  std::fill_n(owner_, 64, kCleared);
  std::fill_n(ranges_.min, 64, depth);
  std::fill_n(ranges_.max, 64, depth);
  range_ = {depth, depth};
  range_is_old_ = false;
}

void TileDepth::begin_loaded(float* plane, const uint64_t (&valid)[64]) {
  plane_ = plane;
  std::fill_n(owner_, 64, kPlane);
  changed_ = touched_ = 0;
  const BlockDepthFunctions& functions = block_depth_functions();
  for (uint32_t block = 0; block < 64; ++block) {
    float* const first = plane_ + first_texel_of_block(block);
    const uint64_t pixels = valid[block];
    if (pixels != kAllBits) {
      const float instead = pixels == 0 ? 0 : first[std::countr_zero(pixels)];
      for (uint32_t i = 0; i < kBlockTexels; ++i) {
        if ((pixels >> i & 1) == 0) first[i] = instead;
      }
    }
    const DepthRange range = functions.range(first);
    ranges_.min[block] = range.min;
    ranges_.max[block] = range.max;
  }
  range_is_old_ = true;
}

float* TileDepth::fill(uint32_t block) {
  std::fill_n(plane(block), kBlockTexels, clear_);
  set_in_plane(block);
  return plane(block);
}

void TileDepth::cover(uint64_t blocks, uint32_t triangle, const BlockRanges& ranges) {
  const LaneNumberFunctions& functions = lane_number_functions();
  functions.fill_lanes(owner_, blocks, triangle);
  hierarchical_depth_functions().copy(ranges_, ranges, blocks);
  range_is_old_ = true;
  changed_ |= blocks;
  touched_ &= ~blocks;
}

void TileDepth::make_ranges() {
  const BlockDepthFunctions& functions = block_depth_functions();
  for_each_bit(touched_, [&](uint32_t block) { set_range(block, functions.range(plane(block))); });
}

DepthRange TileDepth::range() {
  make_ranges();
  if (range_is_old_) range_ = hierarchical_depth_functions().range(ranges_);
  range_is_old_ = false;
  return range_;
}

}  // namespace lapilli
