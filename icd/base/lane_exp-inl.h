// Exponential and logarithm, powers and roots on lanes. Part of lane_math-inl.h.

#if defined(LAPILLI_BASE_LANE_EXP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LAPILLI_BASE_LANE_EXP_INL_H
#undef LAPILLI_BASE_LANE_EXP_INL_H
#else
#define LAPILLI_BASE_LANE_EXP_INL_H
#endif

#include "base/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {

// 2^k, -126 ≤ k ≤ 127
HWY_API F power_of_two(I k) { return as_f(shift_left<23>(as_u(k + broadcast(127)))); }

// y · 2^k for |k| ≤ 252 and |y| near 1: the first product is exact, the second rounds where the result is denormal.
HWY_API F scale(F y, I k) {
  const I half = shift_right<1>(k);
  return y * power_of_two(half) * power_of_two(k - half);
}

// 2^(x + tail) = 2^k · 2^r with |r| ≤ 1/2, for |tail| below 2^-16. Beyond the limits everything is 0 or ∞.
HWY_API F exp2_with_tail(F x, F tail) {
  const F clamped = max(min(x, broadcast(129.0f)), broadcast(-151.0f));
  const F magic = broadcast(12582912.0f);  // rounds to an integer, which stands in the low bits
  const F shifted = clamped + magic;
  const F r = (clamped - (shifted - magic)) + tail;
  F p = fma(broadcast(0x1.3f906cp-13f), r, broadcast(0x1.5f0a66p-10f));
  p = fma(p, r, broadcast(0x1.3b30b0p-7f));
  p = fma(p, r, broadcast(0x1.c6af78p-5f));
  p = fma(p, r, broadcast(0x1.ebfbd8p-3f));
  p = fma(p, r, broadcast(0x1.62e430p-1f));
  return scale(fma(p, r, broadcast(1.0f)), as_i(shifted) - as_i(magic));
}
HWY_API F exp2(F x) { return exp2_with_tail(x, zero_f()); }

// e^x = 2^k · e^r with |r| ≤ ln 2 / 2
HWY_API F exp(F x) {
  const F clamped = max(min(x, broadcast(89.0f)), broadcast(-104.0f));
  const F magic = broadcast(12582912.0f);
  const F shifted = fma(clamped, broadcast(0x1.715476p+0f), magic);
  const F k = shifted - magic;
  const F r = fma(k, broadcast(0x1.05c610p-29f), fma(k, broadcast(-0x1.62e430p-1f), clamped));
  F p = fma(broadcast(0x1.6851b6p-10f), r, broadcast(0x1.123be4p-7f));
  p = fma(p, r, broadcast(0x1.555b98p-5f));
  p = fma(p, r, broadcast(0x1.55548ep-3f));
  p = fma(p, r, broadcast(0x1.fffff8p-2f));
  const F y = fma(p, r * r, r) + broadcast(1.0f);
  return scale(y, as_i(shifted) - as_i(magic));
}

// x = 2^k · (1 + f) with √½ ≤ 1 + f < √2; x positive and finite, denormals included.
struct LogParts {
  F f;
  F k;
};
HWY_API LogParts split_for_log(F x) {
  const M denormal = lt(x, broadcast(0x1p-126f));
  const U bits = as_u(select(denormal, x * broadcast(0x1p23f), x));
  const I above_root = as_i(bits - broadcast(0x3F3504F3u));  // of √½
  const I k = shift_right<23>(above_root);
  const F m = as_f(bits - shift_left<23>(as_u(k)));
  return {m - broadcast(1.0f), to_float(k - select(denormal, broadcast(23), zero_i()))};
}
// log(1 + f) - f
HWY_API F log_tail(F f) {
  F p = fma(broadcast(0x1.11c874p-4f), f, broadcast(-0x1.dd6510p-4f));
  p = fma(p, f, broadcast(0x1.e7a54ep-4f));
  p = fma(p, f, broadcast(-0x1.fc4da0p-4f));
  p = fma(p, f, broadcast(0x1.232cfap-3f));
  p = fma(p, f, broadcast(-0x1.555ae4p-3f));
  p = fma(p, f, broadcast(0x1.99a546p-3f));
  p = fma(p, f, broadcast(-0x1.00000ap-2f));
  p = fma(p, f, broadcast(0x1.555546p-2f));
  p = fma(p, f, broadcast(-0.5f));
  return p * (f * f);
}
// What a logarithm is where x is not positive and finite.
HWY_API F log_special(F x, F value) {
  F result = select(lt(x, infinity()), value, x);  // +∞ and NaN
  result = select(lt(x, zero_f()), quiet_nan(), result);
  return select(eq(x, zero_f()), negate(infinity()), result);
}

HWY_API F log(F x) {
  const LogParts parts = split_for_log(x);
  // k · ln 2 in two parts; the product with the upper one, of 15 bits, is exact.
  const F high = parts.k * broadcast(0x1.62e4p-1f);
  const F sum = high + parts.f;
  const F error = parts.f - (sum - high);
  const F low = fma(parts.k, broadcast(0x1.7f7d1cp-20f), log_tail(parts.f) + error);
  return log_special(x, sum + low);
}
HWY_API F log2(F x) {
  const LogParts parts = split_for_log(x);
  const F log2_e = broadcast(0x1.715476p+0f);
  // (f + tail) · log2(e) with the rounding errors of its larger part.
  const F product = parts.f * log2_e;
  F low = fma(parts.f, log2_e, negate(product));
  low = fma(parts.f, broadcast(0x1.4ae0c0p-26f), low);
  low = fma(log_tail(parts.f), log2_e, low);
  const F sum = parts.k + product;
  const F error = product - (sum - parts.k);
  return log_special(x, sum + (error + low));
}

// 2^t in double, relative error 2^-40, for -252 ≤ t ≤ 252.
HWY_API D exp2_double(D t) {
  const D magic = broadcast(6755399441055744.0);  // 1.5 · 2^52
  const D k = (t + magic) - magic;
  const D r = t - k;
  D p = broadcast(0x1.61919a23ccd22p-20) * r + broadcast(0x1.00daa899035e8p-16);
  p = p * r + broadcast(0x1.430aea9da241bp-13);
  p = p * r + broadcast(0x1.5d87488121abdp-10);
  p = p * r + broadcast(0x1.3b2ab5b29fa96p-7);
  p = p * r + broadcast(0x1.c6b08dd424bbep-5);
  p = p * r + broadcast(0x1.ebfbdff940351p-3);
  p = p * r + broadcast(0x1.62e42fef8639ep-1);
  p = p * r + broadcast(0x1.ffffffffff732p-1);
  const I whole = truncate_in_range(k);
  const I half = shift_right<1>(whole);
  return p * to_double(power_of_two(half)) * to_double(power_of_two(whole - half));
}
// log2(m) for √½ ≤ m ≤ √2 in double, relative error 2^-45.
HWY_API D log2_double(D m) {
  const D s = (m - broadcast(1.0)) / (m + broadcast(1.0));
  const D u = s * s;
  D p = broadcast(0x1.21ad80ef98981p-2) * u + broadcast(0x1.47959547db8d4p-2);
  p = p * u + broadcast(0x1.a61a2d32d522bp-2);
  p = p * u + broadcast(0x1.2776c2955365bp-1);
  p = p * u + broadcast(0x1.ec709dc53a86ap-1);
  p = p * u + broadcast(0x1.71547652b8252p+1);
  return p * s;
}

// What pow is where x is not positive and finite, or y infinite or NaN. `value` is |x|^y where both are finite, not 0.
static HWY_NOINLINE HWY_MAYBE_UNUSED F pow_special(F x, F y, F value) {
  const F one = broadcast(1.0f);
  const F a = abs(x);
  const M y_finite = is_finite(y);
  const M y_integer = eq(trunc(y), y);
  const M y_small = lt(abs(y), broadcast(16777216.0f));  // beyond, every float is even
  const I y_whole = truncate_in_range(select(y_small, y, zero_f()));
  const M y_odd = y_integer & y_small & ne(y_whole & broadcast(1), zero_i());
  const M y_negative = lt(y, zero_f());

  F r = value;
  r = select(eq(a, zero_f()), select(y_negative, infinity(), zero_f()), r);
  r = select(eq(a, infinity()), select(y_negative, zero_f(), infinity()), r);
  const M grows = lt(one, a) ^ y_negative;
  r = select(is_inf(y), select(grows, infinity(), zero_f()), r);
  r = select(is_inf(y) & eq(a, one), one, r);
  const M no_root = lt(x, zero_f()) & is_finite(x) & y_finite & ~y_integer;
  r = select(no_root, quiet_nan(), r);
  r = flip_sign(r, select(y_odd, sign_bit(x), zero_u()));
  r = select(unordered(x, y), quiet_nan(), r);
  return select(eq(y, zero_f()) | eq(x, one), one, r);
}

// log2(x) = high + low, right to about 2^-31 of its value; x positive and finite.
struct DoubleFloat {
  F high;
  F low;
};
HWY_API DoubleFloat log2_in_two(F x) {
  const LogParts parts = split_for_log(x);
  // s + s_low = f / (2 + f): log(1 + f) = log((1 + s) / (1 - s)) = 2 s + 2/3 s³ + …
  const F sum = parts.f + broadcast(2.0f);
  const F sum_low = parts.f - (sum - broadcast(2.0f));
  const F inverse = broadcast(1.0f) / sum;
  const F s = parts.f * inverse;
  const F minus_s = negate(s);
  const F s_low = fma(minus_s, sum_low, fma(minus_s, sum, parts.f)) * inverse;
  const F u = s * s;
  const F u_low = fma(s, s, negate(u));
  F q = fma(broadcast(0x1.5906e6p-2f), u, broadcast(0x1.a5cabcp-2f));
  q = fma(q, u, broadcast(0x1.2776e8p-1f));
  q = fma(q, u, broadcast(0x1.ec709ep-1f));
  const F w = q * u;
  const F w_low = fma(q, u, negate(w)) + q * u_low;
  // The sum of the linear term, s · 2 / ln 2, and the cubic one, s w, with all their rounding errors.
  const F two_log2_e = broadcast(0x1.715476p+1f);
  const F linear = s * two_log2_e;
  const F cubic = s * w;
  F low = fma(s, two_log2_e, negate(linear)) + fma(s, w, negate(cubic));
  low = fma(s, broadcast(0x1.4ae0c0p-25f), low);
  low = fma(s_low, fma(w, broadcast(3.0f), two_log2_e), low);
  low = fma(s, w_low, low);
  const F head = linear + cubic;
  low = low + (cubic - (head - linear));
  const F high = parts.k + head;
  return {high, low + (head - (high - parts.k))};
}

// As C's powf, all special cases included: pow(x, 0) and pow(1, y) are 1, a negative x has integer powers only.
HWY_API F pow(F x, F y) {
  const F a = abs(x);
  const M usual = lt(zero_f(), a) & lt(a, infinity()) & is_finite(y);
  const DoubleFloat log2_x = log2_in_two(select(usual, a, broadcast(1.0f)));
  const F t = y * log2_x.high;
  const F tail = fma(y, log2_x.low, fma(y, log2_x.high, negate(t)));
  // Where t is far beyond float's exponents the tail may be anything, and must not count.
  const F value = exp2_with_tail(t, select(lt(abs(t), broadcast(160.0f)), tail, zero_f()));
  if (HWY_LIKELY(all(usual & lt(zero_f(), x)))) return value;
  return pow_special(x, y, value);
}

#if HWY_TARGET != HWY_AVX3
// 1 / √x in two rounded steps
HWY_API F inverse_sqrt(F x) { return broadcast(1.0f) / sqrt(x); }
#endif

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#endif  // per target
