// 64 depths of a block tested in registers, for every SIMD target.
#include "shader/block_depth.h"

#include "base/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shader/block_depth.cpp"
#include <hwy/foreach_target.h>

#include "image/compare-inl.h"
#include "shader/interpreter/planes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {
namespace {

// The depths of a block, vector by vector.
struct BlockDepth {
  BlockEdge edge1, edge2;
  const DepthPlane& plane;

  HWY_INLINE BlockDepth(const TriangleDepth& triangle, uint32_t x, uint32_t y)
      : edge1(triangle.a[0], triangle.b[0], triangle.c[0], x, y),
        edge2(triangle.a[1], triangle.b[1], triangle.c[1], x, y),
        plane(triangle.plane) {}
  HWY_INLINE F next() { return depth_at(edge1.next(), edge2.next(), plane); }
};

void depth(const TriangleDepth& triangle, uint32_t x, uint32_t y, float* z) {
  BlockDepth block(triangle, x, y);
  for (int i = 0; i < kVectorsPerBatch; ++i) store(block.next(), z + i * kVectorLanes);
}

struct RangeOfLanes {
  F low, high;
  M numbers;

  HWY_INLINE RangeOfLanes() : low(infinity()), high(negate(infinity())), numbers(all_lanes()) {}
  HWY_INLINE void add(F z) {
    low = min(low, z);
    high = max(high, z);
    numbers = numbers & eq(z, z);
  }
  HWY_INLINE DepthRange result() const {
    if (!all(numbers)) return {-__builtin_inff(), __builtin_inff()};
    return {reduce_min(low), reduce_max(high)};
  }
};

DepthRange range(const float* stored) {
  RangeOfLanes lanes;
  for (int i = 0; i < kVectorsPerBatch; ++i) lanes.add(load<F>(stored + i * kVectorLanes));
  return lanes.result();
}

template <int kCompare>
uint64_t test(const TriangleDepth& triangle, uint32_t x, uint32_t y, uint64_t lanes, bool write, float* stored,
              DepthRange& range_after) {
  BlockDepth block(triangle, x, y);
  F z[kVectorsPerBatch];
  uint64_t passed = 0;
  for (int i = 0; i < kVectorsPerBatch; ++i) {
    z[i] = block.next();
    passed |= bits_of(compare_depth<kCompare>(z[i], load<F>(stored + i * kVectorLanes))) << (i * kVectorLanes);
  }
  passed &= lanes;
  if (!write || passed == 0) return passed;
  RangeOfLanes after;
  for (int i = 0; i < kVectorsPerBatch; ++i) {
    float* const at = stored + i * kVectorLanes;
    const F value = select(mask_of(passed, i), canonical(z[i]), load<F>(at));
    store(value, at);
    after.add(value);
  }
  range_after = after.result();
  return passed;
}

}  // namespace

extern const BlockDepthFunctions kBlockDepth;
const BlockDepthFunctions kBlockDepth = {
    depth, {test<0>, test<1>, test<2>, test<3>, test<4>, test<5>, test<6>, test<7>}, range};

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lapilli {
namespace {

constexpr PerTarget<const BlockDepthFunctions> kTables = LAPILLI_PER_TARGET(kBlockDepth);

}  // namespace

const BlockDepthFunctions& block_depth_functions() { return for_target(kTables); }
const BlockDepthFunctions& block_depth_functions(SimdTarget target) { return for_target(kTables, target); }

}  // namespace lapilli
#endif
