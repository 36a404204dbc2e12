// Perspective-correct barycentric coordinates: λ_i / w_i over their sum. Per-target header.
#if defined(LAPILLI_SHADER_PERSPECTIVE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LAPILLI_SHADER_PERSPECTIVE_INL_H
#undef LAPILLI_SHADER_PERSPECTIVE_INL_H
#else
#define LAPILLI_SHADER_PERSPECTIVE_INL_H
#endif

#include "base/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {

struct Corrected {
  F l1, l2;
  F inverse_w;
};

// Inverse w of a triangle's vertices, in lanes.
struct InverseW {
  F w0, w1, w2;
};
HWY_INLINE Corrected correct_perspective(F l1, F l2, const InverseW& w) {
  const F t0 = (broadcast(1.0f) - l1 - l2) * w.w0;
  const F t1 = l1 * w.w1;
  const F t2 = l2 * w.w2;
  const F sum = t0 + t1 + t2;
  return {t1 / sum, t2 / sum, sum};
}

// a / b, correctly rounded, where |1 - b| ≤ 2^-14 and nothing is near the ends of the range. In ulps of a/b, and with B
// for b's 24 bits as an integer:
// - y = 1/b * (1 + d) with -1 / (B + 1) < d < 1 / (B - 1): 2 - b, where that lies between two floats the upper one;
// - q = a - a(b - 1) before it is rounded = a/b * (1 - (b - 1)^2), less than 2^-4 off;
// - the remainder is exact, and q + remainder * y misses a/b by less than 2^-24. Points half-way between floats are
//   N/(2B) away, N = 1, 2 …: only a near one matters, and then q is one of its neighbours, at 1/2 ± N/(2B); within the
//   bounds of d the sum stays on the right side.
HWY_INLINE F divide_near_one(F a, F minus_b, F one_minus_b, F y) {
  const F q = fma(a, one_minus_b, a);
  return fma(fma(minus_b, q, a), y, q);
}

// The same bits as correct_perspective where all w are 1, as they are for whatever is drawn without perspective. Only
// for places inside the triangle: all three coordinates are in [0, 1], and their sum is 1 but for some 2^-24.
HWY_INLINE Corrected correct_affine(F l1, F l2) {
#if HWY_TARGET == HWY_SCALAR
  const F one = broadcast(1.0f);
  return correct_perspective(l1, l2, {one, one, one});
#else
  const F minus_sum = l1 - broadcast(1.0f) + l2 - l1 - l2;  // negated all through: rounding does not mind
  const F one_minus_sum = broadcast(1.0f) + minus_sum;
  const F y = fma(minus_sum, broadcast(0x1.FFFFFEp-1f), broadcast(2.0f));
  return {divide_near_one(l1, minus_sum, one_minus_sum, y), divide_near_one(l2, minus_sum, one_minus_sum, y),
          negate(minus_sum)};
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#endif  // per target
