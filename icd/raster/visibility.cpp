// Numbers of triangles, 64 pixels at once.
#include "raster/visibility.h"

#include "base/simd_dispatch.h"
#include "base/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/visibility.cpp"
#include <hwy/foreach_target.h>

#include "base/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {
namespace {

void fill(uint32_t* numbers, uint32_t value) {
  for (int i = 0; i < kLanes; i += kVectorLanes) store(broadcast(value), numbers + i);
}

void fill_lanes(uint32_t* numbers, uint64_t lanes, uint32_t value) {
  for (int i = 0; i < kVectorsPerBatch; ++i) {
    uint32_t* const at = numbers + i * kVectorLanes;
    store(select(mask_of(lanes, i), broadcast(value), load<U>(at)), at);
  }
}

uint64_t equal(const uint32_t* numbers, uint32_t value) {
  uint64_t lanes = 0;
  for (int i = 0; i < kLanes; i += kVectorLanes) lanes |= bits_of(eq(load<U>(numbers + i), broadcast(value))) << i;
  return lanes;
}

uint64_t between(const uint32_t* numbers, uint32_t first, uint32_t end) {
  uint64_t lanes = 0;
  for (int i = 0; i < kLanes; i += kVectorLanes) {
    lanes |= bits_of(lt(load<U>(numbers + i) - broadcast(first), broadcast(end - first))) << i;
  }
  return lanes;
}

}  // namespace

extern const LaneNumberFunctions kLaneNumbers;
const LaneNumberFunctions kLaneNumbers = {fill, fill_lanes, equal, between};

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lapilli {
namespace {

constexpr PerTarget<const LaneNumberFunctions> kTables = LAPILLI_PER_TARGET(kLaneNumbers);

}  // namespace

const LaneNumberFunctions& lane_number_functions() { return for_target(kTables); }

void Visibility::cover(uint64_t blocks, uint32_t number) {
  whole_ |= blocks;
  mixed_ &= ~blocks;
  functions_->fill_lanes(owner_, blocks, number);
}

// From one number for the block to one for each pixel.
void Visibility::mix(uint32_t block) {
  const uint64_t bit = uint64_t{1} << block;
  functions_->fill(seen_ + block * kBlockTexels, (whole_ & bit) != 0 ? owner_[block] : kNobody);
  whole_ &= ~bit;
  mixed_ |= bit;
}

void Visibility::cover_pixels(uint32_t block, uint64_t pixels, uint32_t number) {
  functions_->fill_lanes(mixed_pixels(block), pixels, number);
}

}  // namespace lapilli
#endif
