// Comparisons of depths, by tests of a fragment and by samplers. Per-target header.
#if defined(LAPILLI_IMAGE_COMPARE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LAPILLI_IMAGE_COMPARE_INL_H
#undef LAPILLI_IMAGE_COMPARE_INL_H
#else
#define LAPILLI_IMAGE_COMPARE_INL_H
#endif

#include <cstdint>

#include "base/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {

// VkCompareOp of a fragment's depth, or a sampler's reference, and the stored one.
template <int kCompare>
HWY_API M compare_depth(F z, F stored) {
  if constexpr (kCompare == 0) return no_lanes();  // NEVER
  if constexpr (kCompare == 1) return lt(z, stored);
  if constexpr (kCompare == 2) return eq(z, stored);
  if constexpr (kCompare == 3) return le(z, stored);
  if constexpr (kCompare == 4) return gt(z, stored);
  if constexpr (kCompare == 5) return ne(z, stored);
  if constexpr (kCompare == 6) return ge(z, stored);
  return all_lanes();  // ALWAYS
}

HWY_API M compare_depth(uint32_t how, F z, F stored) {
  switch (how) {
    case 0:
      return compare_depth<0>(z, stored);
    case 1:
      return compare_depth<1>(z, stored);
    case 2:
      return compare_depth<2>(z, stored);
    case 3:
      return compare_depth<3>(z, stored);
    case 4:
      return compare_depth<4>(z, stored);
    case 5:
      return compare_depth<5>(z, stored);
    case 6:
      return compare_depth<6>(z, stored);
    default:
      return compare_depth<7>(z, stored);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#endif  // per target
