// For tests: the primitives of lanes-inl.h over arrays of 32-bit patterns, for each SIMD target.
#include "base/lanes_runs.h"

#include "base/simd_targets.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "base/lanes_runs.cpp"
#include <hwy/foreach_target.h>
//
#include "base/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {
namespace {

struct Runs {
#define LAPILLI_UNARY(name, expression)                                                       \
  static void run_##name(const std::uint32_t* xs, std::uint32_t* result, std::size_t count) { \
    for (std::size_t i = 0; i < count; i += kVectorLanes) {                                   \
      const U x = load_unaligned<U>(xs + i);                                                  \
      store_unaligned(expression, result + i);                                                \
    }                                                                                         \
  }
#define LAPILLI_BINARY(name, expression)                                                                               \
  static void run_##name(const std::uint32_t* xs, const std::uint32_t* ys, std::uint32_t* result, std::size_t count) { \
    for (std::size_t i = 0; i < count; i += kVectorLanes) {                                                            \
      const U x = load_unaligned<U>(xs + i);                                                                           \
      const U y = load_unaligned<U>(ys + i);                                                                           \
      store_unaligned(expression, result + i);                                                                         \
    }                                                                                                                  \
  }
  LAPILLI_UNARY_BITS(LAPILLI_UNARY)
  LAPILLI_BINARY_BITS(LAPILLI_BINARY)
#undef LAPILLI_UNARY
#undef LAPILLI_BINARY

  static void extract_unsigned(const std::uint32_t* x, std::uint32_t offset, std::uint32_t width,
                               std::uint32_t* result) {
    for (int i = 0; i < 16; i += kVectorLanes) {
      const U value = load_unaligned<U>(x + i);
      store_unaligned(bitfield_extract(value, broadcast(offset), broadcast(width)), result + i);
    }
  }
  static void extract_signed(const std::uint32_t* x, std::uint32_t offset, std::uint32_t width, std::uint32_t* result) {
    for (int i = 0; i < 16; i += kVectorLanes) {
      const I value = load_unaligned<I>(x + i);
      store_unaligned(bitfield_extract(value, broadcast(offset), broadcast(width)), result + i);
    }
  }
  static void insert(const std::uint32_t* x, std::uint32_t offset, std::uint32_t width, std::uint32_t* result) {
    for (int i = 0; i < 16; i += kVectorLanes) {
      const U value = load_unaligned<U>(x + i);
      store_unaligned(bitfield_insert(~value, value, broadcast(offset), broadcast(width)), result + i);
    }
  }
  static std::uint64_t mask_round_trip(std::uint64_t word) {
    std::uint64_t result = 0;
    for (int i = 0; i < kVectorsPerBatch; ++i) result |= bits_of(mask_of(word, i)) << (i * kVectorLanes);
    return result;
  }
  static void gather(const void* base, const std::uint32_t* offsets, std::uint64_t mask, std::uint32_t* result) {
    for (int i = 0; i < kVectorsPerBatch; ++i) {
      const U offset = load_unaligned<U>(offsets + i * kVectorLanes);
      store_unaligned(gather32(base, offset, mask_of(mask, i)), result + i * kVectorLanes);
    }
  }
};

}  // namespace

extern const LaneRuns kLaneRuns;
#define LAPILLI_ENTRY(name, expression) &Runs::run_##name,
const LaneRuns kLaneRuns = {LAPILLI_UNARY_BITS(LAPILLI_ENTRY) LAPILLI_BINARY_BITS(LAPILLI_ENTRY)  //
                                & Runs::extract_unsigned,
                            &Runs::extract_signed, &Runs::insert, &Runs::mask_round_trip, &Runs::gather};
#undef LAPILLI_ENTRY

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lapilli {
const LaneRuns& lane_runs(SimdTarget target) {
  static constexpr PerTarget<const LaneRuns> kTables = LAPILLI_PER_TARGET(kLaneRuns);
  return for_target(kTables, target);
}
}  // namespace lapilli
#endif
