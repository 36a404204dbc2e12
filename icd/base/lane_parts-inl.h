// Remainders, and taking floats apart and putting them together, on lanes. Part of lane_math-inl.h.

#if defined(LAPILLI_BASE_LANE_PARTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LAPILLI_BASE_LANE_PARTS_INL_H
#undef LAPILLI_BASE_LANE_PARTS_INL_H
#else
#define LAPILLI_BASE_LANE_PARTS_INL_H
#endif

#include "base/lane_exp-inl.h"
#include "base/lane_math_scalar.h"
#include "base/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {

static HWY_NOINLINE HWY_MAYBE_UNUSED F far_remainders(F x, F y, M far_lanes, F rest) {
  alignas(64) float xs[kVectorLanes];
  alignas(64) float ys[kVectorLanes];
  alignas(64) float rests[kVectorLanes];
  store(x, xs);
  store(y, ys);
  store(rest, rests);
  const uint64_t bits = bits_of(far_lanes);
  for (int lane = 0; lane < kVectorLanes; ++lane) {
    if ((bits >> lane & 1) != 0) rests[lane] = exact_remainder(xs[lane], ys[lane]);
  }
  return load<F>(rests);
}

// SPIR-V FRem: x - y · trunc(x / y) without any rounding, for quotients of any size (C's fmodf). The sign is that of x,
// also for 0. NaN where x is infinite or y is 0; x where y is infinite.
HWY_API F frem(F x, F y) {
  const F a = abs(x);
  const F b = abs(y);
  const F quotient = trunc(a / b);
  // Exact while the quotient is exact or one too large: the rest is a multiple of the smaller last place, below |y|.
  F rest = fma(negate(quotient), b, a);
  rest = select(lt(rest, zero_f()), rest + b, rest);
  // Beyond 2^23 the quotient may be wrong by more.
  const M both_finite = is_finite(x) & is_finite(y) & ne(y, zero_f());
  const M far_lanes = ~lt(quotient, broadcast(8388608.0f)) & both_finite;
  if (HWY_UNLIKELY(any(far_lanes))) rest = far_remainders(a, b, far_lanes, rest);
  rest = select(eq(b, infinity()) & is_finite(x), a, rest);
  return select(is_nan(rest), quiet_nan(), copy_sign(rest, x));
}
// SPIR-V FMod: x - y · floor(x / y); the exact remainder, moved to the sign of y by adding y once (which rounds). A
// zero has the sign of y.
HWY_API F fmod(F x, F y) {
  const F rest = frem(x, y);
  const M nonzero = ne(rest, zero_f());
  const M other_side = lt(as_i(rest) ^ as_i(y), zero_i());
  const F moved = select(other_side & nonzero, rest + y, rest);
  return select(nonzero, moved, copy_sign(rest, y));
}

// x - floor(x), below 1: what rounds to 1 (tiny negative x) gives the float below it, so that 0 ≤ fract < 1 (GLSL).
HWY_API F fract(F x) { return min(x - floor(x), broadcast(0x1.fffffep-1f)); }

// The whole part toward 0 and what is left; both have the sign of x.
struct WholeAndFraction {
  F whole;
  F fraction;
};
HWY_API WholeAndFraction modf(F x) {
  const F whole = trunc(x);
  const F fraction = select(is_inf(x), zero_f(), x - whole);
  return {whole, copy_sign(fraction, x)};
}

// x = significand · 2^exponent with 1/2 ≤ |significand| < 1. 0, ∞ and NaN are their own significand, with exponent 0.
struct SignificandAndExponent {
  F significand;
  I exponent;
};
HWY_API SignificandAndExponent frexp(F x) {
  const M denormal = lt(abs(x), broadcast(0x1p-126f));
  const F normal = select(denormal, x * broadcast(0x1p24f), x);
  const U bits = as_u(normal);
  const I biased = as_i(shift_right<23>(bits) & broadcast(255u));
  const I exponent = biased - select(denormal, broadcast(126 + 24), broadcast(126));
  const F significand = as_f((bits & broadcast(0x807FFFFFu)) | broadcast(126u << 23));
  const M regular = is_finite(x) & ne(x, zero_f());
  return {select(regular, significand, x), select(regular, exponent, zero_i())};
}

// x · 2^exponent, rounded once; any exponent.
HWY_API F ldexp(F x, I exponent) {
  // Beyond ±300 every finite x is 0 or ∞.
  const I bounded = max(min(exponent, broadcast(300)), broadcast(-300));
  const I quarter = shift_right<2>(bounded);
  const I rest = bounded - quarter - quarter - quarter;
  const D power = to_double(power_of_two(quarter));
  return to_float(to_double(x) * power * power * power * to_double(power_of_two(rest)));
}

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#endif  // per target
