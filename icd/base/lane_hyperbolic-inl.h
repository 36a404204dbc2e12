// Hyperbolic functions and their inverses on lanes: worked out in double and rounded at the end. Part of
// lane_math-inl.h.

#if defined(LAPILLI_BASE_LANE_HYPERBOLIC_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LAPILLI_BASE_LANE_HYPERBOLIC_INL_H
#undef LAPILLI_BASE_LANE_HYPERBOLIC_INL_H
#else
#define LAPILLI_BASE_LANE_HYPERBOLIC_INL_H
#endif

#include "base/lane_exp-inl.h"
#include "base/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {

inline constexpr double kLog2E = 0x1.71547652b82fep+0;
inline constexpr double kLn2 = 0x1.62e42fefa39efp-1;
// Below this a few terms of the series at 0 are precise, where the formulas cancel.
inline constexpr float kSeries = 0.03125f;

HWY_API D clamped_double(F x, float limit) { return to_double(max(min(x, broadcast(limit)), broadcast(-limit))); }
// x + x³ · (c1 + c2 x² + c3 x⁴), by its sign also right for -0
HWY_API F odd_series(F x, double c1, double c2, double c3) {
  const D wide = to_double(x);
  const D u = wide * wide;
  const D p = (broadcast(c3) * u + broadcast(c2)) * u + broadcast(c1);
  return copy_sign(to_float(wide + wide * u * p), x);
}
// ln t for double t, 2^-120 ≤ t ≤ 2^129
HWY_API D ln_double(D t) {
  // A sixteenth is well inside float's range; its exponent is that of t less 4, give or take a rounding.
  const D part = t * broadcast(0.0625);
  const I bits = as_i(to_float(part)) - broadcast(0x3F3504F3);
  const I k = shift_right<23>(bits);
  const D m = part * to_double(power_of_two(negate(k)));
  return (to_double(k + broadcast(4)) + log2_double(m)) * broadcast(kLn2);
}

// sinh and cosh are infinite where e^|x| is, for |x| in (88.72, 89.42] before their own value: the specification
// derives their precision from (e^x - e^-x) / 2, and the conformance tests take that at its word.
HWY_API M exp_overflows(F x) { return lt(broadcast(0x1.62e42ep+6f), abs(x)); }
HWY_API F sinh(F x) {
  const D e = exp2_double(clamped_double(x, 100.0f) * broadcast(kLog2E));
  const F finite = to_float((e - broadcast(1.0) / e) * broadcast(0.5));
  const F value = select(exp_overflows(x), copy_sign(infinity(), x), finite);
  const F series = odd_series(x, 1.0 / 6.0, 1.0 / 120.0, 1.0 / 5040.0);
  return select(lt(abs(x), broadcast(kSeries)), series, select(is_nan(x), x, value));
}
HWY_API F cosh(F x) {
  const D e = exp2_double(clamped_double(x, 100.0f) * broadcast(kLog2E));
  const F value = to_float((e + broadcast(1.0) / e) * broadcast(0.5));
  return select(is_nan(x), x, select(exp_overflows(x), infinity(), value));
}
HWY_API F tanh(F x) {
  const D e = exp2_double(clamped_double(x, 20.0f) * broadcast(2.0 * kLog2E));
  const F value = to_float((e - broadcast(1.0)) / (e + broadcast(1.0)));
  const F series = odd_series(x, -1.0 / 3.0, 2.0 / 15.0, -17.0 / 315.0);
  return select(lt(abs(x), broadcast(kSeries)), series, select(is_nan(x), x, value));
}
HWY_API F asinh(F x) {
  const D a = to_double(min(abs(x), broadcast(0x1.fffffep127f)));
  const D wide = ln_double(a + sqrt(a * a + broadcast(1.0)));
  const F value = copy_sign(to_float(wide), x);
  const F series = odd_series(x, -1.0 / 6.0, 3.0 / 40.0, -15.0 / 336.0);
  return select(lt(abs(x), broadcast(kSeries)), series, select(is_finite(x), value, x));
}
// NaN below 1
HWY_API F acosh(F x) {
  const D a = to_double(max(min(x, broadcast(0x1.fffffep127f)), broadcast(1.0f)));
  const D wide = ln_double(a + sqrt((a - broadcast(1.0)) * (a + broadcast(1.0))));
  const F value = select(lt(x, infinity()), to_float(wide), x);
  return select(lt(x, broadcast(1.0f)), quiet_nan(), value);
}
// NaN beyond ±1
HWY_API F atanh(F x) {
  const F one = broadcast(1.0f);
  const M inside = lt(abs(x), one);
  const D a = to_double(select(inside, x, zero_f()));
  const D wide = ln_double((broadcast(1.0) + a) / (broadcast(1.0) - a)) * broadcast(0.5);
  const F series = odd_series(x, 1.0 / 3.0, 1.0 / 5.0, 1.0 / 7.0);
  const F value = select(lt(abs(x), broadcast(kSeries)), series, to_float(wide));
  const F edge = select(eq(abs(x), one), copy_sign(infinity(), x), quiet_nan());
  return select(inside, value, edge);
}

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#endif  // per target
