// The depths of a tile while it is worked on: values in the plane, or the plane of a triangle that covers a whole block
// and was found to pass everywhere, which nobody has asked for in detail yet.
#pragma once

#include <cstdint>

#include "raster/coverage.h"
#include "raster/hierarchical_depth.h"

namespace lapilli {

class TileDepth {
 public:
  // Owners of a block: a triangle by its number (Visibility), or one of these.
  static constexpr uint32_t kCleared = 0;
  static constexpr uint32_t kPlane = ~0u;

  // All blocks have this depth; the plane is filled where it is needed.
  void begin_cleared(float* plane, float depth);
  // The plane has the depths of the pixels in `valid` (by block); those of the others are made up.
  void begin_loaded(float* plane, const uint64_t (&valid)[64]);

  const BlockRanges& ranges() {
    make_ranges();
    return ranges_;
  }
  DepthRange range();  // of the whole tile

  uint32_t owner(uint32_t block) const { return owner_[block]; }
  float* plane(uint32_t block) { return plane_ + first_texel_of_block(block); }
  // Puts the cleared depths into the plane.
  float* fill(uint32_t block);
  // The caller has put the owner's depths there.
  void set_in_plane(uint32_t block) { owner_[block] = kPlane; }

  // The depths of these blocks become the triangle's, which are within `ranges`.
  void cover(uint64_t blocks, uint32_t triangle, const BlockRanges& ranges);
  // The block's depths have changed in the plane.
  void set_range(uint32_t block, DepthRange range) {
    ranges_.min[block] = range.min;
    ranges_.max[block] = range.max;
    range_is_old_ = true;
    changed_ |= uint64_t{1} << block;
    touched_ &= ~(uint64_t{1} << block);
  }
  // Depths of the block have changed in the plane; its range is made when somebody asks.
  void touch(uint32_t block) { touched_ |= uint64_t{1} << block; }
  // Blocks whose depths are no longer those that the tile began with.
  uint64_t changed() const { return changed_ | touched_; }

 private:
  void make_ranges();

  float* plane_ = nullptr;
  float clear_ = 0;
  bool range_is_old_ = false;
  DepthRange range_{};
  uint64_t changed_ = 0, touched_ = 0;  // touched: without a range
  BlockRanges ranges_;
  alignas(64) uint32_t owner_[64];
};

}  // namespace lapilli
