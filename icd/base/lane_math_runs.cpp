// For tests: the functions of lane_math-inl.h over arrays, for each SIMD target.
#include "base/lane_math_runs.h"

#include "base/simd_targets.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "base/lane_math_runs.cpp"
#include <hwy/foreach_target.h>
//
#include "base/lane_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {
namespace {

struct Runs {
#define LAPILLI_UNARY(name)                                                       \
  static void run_##name(const float* x, float* result, std::size_t count) {      \
    for (std::size_t i = 0; i < count; i += kVectorLanes) {                       \
      store_unaligned(HWY_NAMESPACE::name(load_unaligned<F>(x + i)), result + i); \
    }                                                                             \
  }
#define LAPILLI_BINARY(name)                                                                                \
  static void run_##name(const float* x, const float* y, float* result, std::size_t count) {                \
    for (std::size_t i = 0; i < count; i += kVectorLanes) {                                                 \
      store_unaligned(HWY_NAMESPACE::name(load_unaligned<F>(x + i), load_unaligned<F>(y + i)), result + i); \
    }                                                                                                       \
  }
  LAPILLI_UNARY_MATH(LAPILLI_UNARY)
  LAPILLI_BINARY_MATH(LAPILLI_BINARY)

  static void run_fma(const float* a, const float* b, const float* c, float* result, std::size_t count) {
    for (std::size_t i = 0; i < count; i += kVectorLanes) {
      const F product = fma(load_unaligned<F>(a + i), load_unaligned<F>(b + i), load_unaligned<F>(c + i));
      store_unaligned(product, result + i);
    }
  }
  static void run_ldexp(const float* x, const std::int32_t* exponent, float* result, std::size_t count) {
    for (std::size_t i = 0; i < count; i += kVectorLanes) {
      store_unaligned(ldexp(load_unaligned<F>(x + i), load_unaligned<I>(exponent + i)), result + i);
    }
  }
  static void run_frexp(const float* x, float* significand, std::int32_t* exponent, std::size_t count) {
    for (std::size_t i = 0; i < count; i += kVectorLanes) {
      const SignificandAndExponent parts = frexp(load_unaligned<F>(x + i));
      store_unaligned(parts.significand, significand + i);
      store_unaligned(parts.exponent, exponent + i);
    }
  }
  static void run_modf(const float* x, float* whole, float* fraction, std::size_t count) {
    for (std::size_t i = 0; i < count; i += kVectorLanes) {
      const WholeAndFraction parts = modf(load_unaligned<F>(x + i));
      store_unaligned(parts.whole, whole + i);
      store_unaligned(parts.fraction, fraction + i);
    }
  }
};

}  // namespace

extern const MathRuns kMathRuns;
#define LAPILLI_ENTRY(name) &Runs::run_##name,
const MathRuns kMathRuns = {LAPILLI_UNARY_MATH(LAPILLI_ENTRY) LAPILLI_BINARY_MATH(LAPILLI_ENTRY)  //
                                & Runs::run_fma,
                            &Runs::run_ldexp, &Runs::run_frexp, &Runs::run_modf};
#undef LAPILLI_ENTRY
#undef LAPILLI_UNARY
#undef LAPILLI_BINARY

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lapilli {
const MathRuns& math_runs(SimdTarget target) {
  static constexpr PerTarget<const MathRuns> kTables = LAPILLI_PER_TARGET(kMathRuns);
  return for_target(kTables, target);
}
}  // namespace lapilli
#endif
