// Leaving code of a wide target by hand, where the compiler cannot see that it is left. Per-target header.
#if defined(LAPILLI_BASE_LANES_LEAVE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LAPILLI_BASE_LANES_LEAVE_INL_H
#undef LAPILLI_BASE_LANES_LEAVE_INL_H
#else
#define LAPILLI_BASE_LANES_LEAVE_INL_H
#endif

#include "base/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {

// Clears the upper parts of the vector registers: while they hold something, each change between code of the baseline
// and wide code costs some hundred cycles.
HWY_API void clear_upper_lanes() {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
  _mm256_zeroupper();
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#endif  // per target
