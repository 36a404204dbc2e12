// Trigonometric functions and their inverses on lanes. Part of lane_math-inl.h.

#if defined(LAPILLI_BASE_LANE_TRIG_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LAPILLI_BASE_LANE_TRIG_INL_H
#undef LAPILLI_BASE_LANE_TRIG_INL_H
#else
#define LAPILLI_BASE_LANE_TRIG_INL_H
#endif

#include "base/lane_math_scalar.h"
#include "base/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {

// π and π/2 in floats whose sum is right to two or three times 24 bits.
inline constexpr float kPi1 = 0x1.921fb6p+1f;
inline constexpr float kPi2 = -0x1.777a5cp-24f;
inline constexpr float kPi3 = -0x1.ee59dap-49f;
inline constexpr float kHalfPi1 = 0x1.921fb6p+0f;
inline constexpr float kHalfPi2 = -0x1.777a5cp-25f;
inline constexpr float kHalfPi3 = -0x1.ee59dap-50f;
// Adding it leaves no bits below 1: rounds to an integer, which stands in the low bits of the sum.
inline constexpr float kRoundToInteger = 12582912.0f;  // 1.5 · 2^23
// Up to here the reductions in three parts (Cody and Waite, with fma) are precise.
inline constexpr float kLargeAngle = 65536.0f;

// (-1)^odd · sin(r) for |r| ≤ π/2 and some; `odd` in the lowest bit, upper bits are ignored.
HWY_API F signed_sin(F r, U odd) {
  const F u = r * r;
  F p = fma(broadcast(-0x1.add9aap-26f), u, broadcast(0x1.727032p-19f));
  p = fma(p, u, broadcast(-0x1.a02128p-13f));
  p = fma(p, u, broadcast(0x1.111130p-7f));
  p = fma(p, u, broadcast(-0x1.555556p-3f));
  // At ±1 the rounding errors may add up to one place too much.
  const F value = max(min(fma(r, u * p, r), broadcast(1.0f)), broadcast(-1.0f));
  return flip_sign(value, shift_left<31>(odd));
}
// sin(angle + quarter_turns · π/2) for the lanes `large`, the rest from `value`.
static HWY_NOINLINE HWY_MAYBE_UNUSED F sin_of_large(F angle, uint32_t quarter_turns, M large, F value) {
  alignas(64) float angles[kVectorLanes];
  alignas(64) float r[kVectorLanes] = {};
  alignas(64) uint32_t odd[kVectorLanes] = {};
  store(angle, angles);
  const uint64_t bits = bits_of(large);
  for (int lane = 0; lane < kVectorLanes; ++lane) {
    if ((bits >> lane & 1) != 0) odd[lane] = reduce_to_half_turn(angles[lane], quarter_turns, &r[lane]);
  }
  return select(large, signed_sin(load<F>(r), load<U>(odd)), value);
}

// sin(angle) = (-1)^k sin(r) with r = angle - k π. angle ≥ 0 keeps the sign of zero out of the polynomial.
HWY_API F sin(F x) {
  const F angle = abs(x);
  const F shifted = fma(angle, broadcast(0x1.45f306p-2f), broadcast(kRoundToInteger));
  const F k = shifted - broadcast(kRoundToInteger);
  // Exact: the difference is a multiple of angle's last place or of 2^-23, and less than 2.
  F r = fma(k, broadcast(-kPi1), angle);
  // If this cancels, its rounding error shrinks with it.
  r = fma(k, broadcast(-kPi2), r);
  r = fma(k, broadcast(-kPi3), r);
  F value = signed_sin(r, as_u(shifted));
  const M large = ~lt(angle, broadcast(kLargeAngle));
  if (HWY_UNLIKELY(any(large))) value = sin_of_large(angle, 0, large, value);
  return flip_sign(value, sign_bit(x));
}
// cos(angle) = sin(angle + π/2) = (-1)^k sin(r) with r = angle - (k - 1/2) π.
HWY_API F cos(F x) {
  const F angle = abs(x);
  const F shifted = fma(angle, broadcast(0x1.45f306p-2f), broadcast(0.5f)) + broadcast(kRoundToInteger);
  const F k = (shifted - broadcast(kRoundToInteger)) - broadcast(0.5f);
  F r = fma(k, broadcast(-kPi1), angle);
  r = fma(k, broadcast(-kPi2), r);
  r = fma(k, broadcast(-kPi3), r);
  F value = signed_sin(r, as_u(shifted));
  const M large = ~lt(angle, broadcast(kLargeAngle));
  if (HWY_UNLIKELY(any(large))) value = sin_of_large(angle, 1, large, value);
  return value;
}

// An angle is quadrant · π/2 + r + tail with |r| ≤ π/4 and |tail| at most half the last place of r.
struct QuadrantAngle {
  F r;
  F tail;
  U quadrant;  // modulo 4; upper bits are undefined
};
static HWY_NOINLINE HWY_MAYBE_UNUSED QuadrantAngle reduce_large(F angle, M large, QuadrantAngle reduced) {
  alignas(64) float angles[kVectorLanes];
  alignas(64) float r[kVectorLanes];
  alignas(64) float tail[kVectorLanes];
  alignas(64) uint32_t quadrant[kVectorLanes];
  store(angle, angles);
  store(reduced.r, r);
  store(reduced.tail, tail);
  store(reduced.quadrant, quadrant);
  const uint64_t bits = bits_of(large);
  for (int lane = 0; lane < kVectorLanes; ++lane) {
    if ((bits >> lane & 1) != 0) quadrant[lane] = reduce_to_quadrant(angles[lane], &r[lane], &tail[lane]);
  }
  return {load<F>(r), load<F>(tail), load<U>(quadrant)};
}
// angle ≥ 0
HWY_API QuadrantAngle reduce_angle(F angle) {
  const F shifted = fma(angle, broadcast(0x1.45f306p-1f), broadcast(kRoundToInteger));
  const F k = shifted - broadcast(kRoundToInteger);
  const F r1 = fma(k, broadcast(-kHalfPi1), angle);  // exact, as in sin
  const F second = k * broadcast(-kHalfPi2);
  const F second_error = fma(k, broadcast(-kHalfPi2), negate(second));
  const F r2 = r1 + second;
  const F rest = (second - (r2 - r1)) + fma(k, broadcast(-kHalfPi3), second_error);
  const F r = r2 + rest;
  QuadrantAngle reduced = {r, (r2 - r) + rest, as_u(shifted)};
  const M large = ~lt(angle, broadcast(kLargeAngle));
  if (HWY_UNLIKELY(any(large))) reduced = reduce_large(angle, large, reduced);
  return reduced;
}

HWY_API F tan(F x) {
  const QuadrantAngle a = reduce_angle(abs(x));
  const F u = a.r * a.r;
  F p = fma(broadcast(0x1.225efcp-8f), u, broadcast(-0x1.61d1eap-16f));
  p = fma(p, u, broadcast(0x1.65f652p-7f));
  p = fma(p, u, broadcast(0x1.5c1d04p-6f));
  p = fma(p, u, broadcast(0x1.baeae2p-5f));
  p = fma(p, u, broadcast(0x1.110d30p-3f));
  p = fma(p, u, broadcast(0x1.555562p-2f));
  const F cubic = a.r * u * p;
  // tan(r + tail) = t + tail · (1 + t²)
  const F rough = a.r + cubic;
  const F t = a.r + fma(fma(rough, rough, broadcast(1.0f)), a.tail, cubic);
  const M odd = ne(a.quadrant & broadcast(1u), zero_u());
  const F value = select(odd, broadcast(-1.0f) / t, t);
  return flip_sign(value, sign_bit(x));
}

// (asin(s) - s) / s for |s| ≤ 1/2, u = s²
HWY_API F asin_polynomial(F u) {
  F p = fma(broadcast(0x1.3367dcp-5f), u, broadcast(0x1.d8b82ap-7f));
  p = fma(p, u, broadcast(0x1.049d6ap-5f));
  p = fma(p, u, broadcast(0x1.6cac82p-5f));
  p = fma(p, u, broadcast(0x1.333896p-4f));
  p = fma(p, u, broadcast(0x1.55554cp-3f));
  return p * u;
}
// asin(a) = π/2 - 2 asin(√((1 - a) / 2)) for a > 1/2; what stands under the root is exact.
HWY_API F asin(F x) {
  const F a = abs(x);
  const M upper = lt(broadcast(0.5f), a);
  const F u = select(upper, (broadcast(1.0f) - a) * broadcast(0.5f), a * a);
  const F s = select(upper, sqrt(u), a);
  const F p = asin_polynomial(u);
  // The root's rounding error, |error| ≤ 2^-25 s: s + error is the root to twice the digits.
  const F error = fma(negate(s), s, u) / max(s + s, broadcast(0x1p-60f));
  const F near_one = broadcast(kHalfPi1) - (fma(s + s, p, error + error) - broadcast(kHalfPi2) + (s + s));
  const F value = select(upper, near_one, fma(s, p, s));
  return flip_sign(value, sign_bit(x));
}
HWY_API F acos(F x) {
  const F a = abs(x);
  const M upper = lt(broadcast(0.5f), a);
  const M negative = lt(x, zero_f());
  const F u = select(upper, (broadcast(1.0f) - a) * broadcast(0.5f), a * a);
  const F s = select(upper, sqrt(u), x);
  const F sp = s * asin_polynomial(u);
  const F half = s + sp;  // asin of the root
  const F below_minus_half = broadcast(kPi1) - (half + half - broadcast(kPi2));
  const F middle = broadcast(kHalfPi1) - (s - (broadcast(kHalfPi2) - sp));
  return select(upper, select(negative, below_minus_half, half + half), middle);
}

// atan(q) for 0 ≤ q ≤ 1
HWY_API F atan_polynomial(F q) {
  const F u = q * q;
  F p = fma(broadcast(-0x1.c7dc84p-10f), u, broadcast(0x1.5d871ap-7f));
  p = fma(p, u, broadcast(-0x1.f722e6p-6f));
  p = fma(p, u, broadcast(0x1.d6de14p-5f));
  p = fma(p, u, broadcast(-0x1.5709bap-4f));
  p = fma(p, u, broadcast(0x1.c0317ep-4f));
  p = fma(p, u, broadcast(-0x1.24177ap-3f));
  p = fma(p, u, broadcast(0x1.999100p-3f));
  p = fma(p, u, broadcast(-0x1.55553ap-2f));
  return fma(q * u, p, q);
}
HWY_API F atan(F x) {
  const F a = abs(x);
  const M upper = lt(broadcast(1.0f), a);
  const F t = atan_polynomial(select(upper, broadcast(1.0f) / a, a));
  const F value = select(upper, broadcast(kHalfPi1) - (t - broadcast(kHalfPi2)), t);
  return flip_sign(value, sign_bit(x));
}
// The angle of (x, y), as C's atan2f: ±0 and ±∞ included.
HWY_API F atan2(F y, F x) {
  const F a = abs(y);
  const F b = abs(x);
  const M steep = lt(b, a);
  const F numerator = select(steep, b, a);
  const F denominator = select(steep, a, b);
  // 0/0 stands for 0 and ∞/∞ for 1.
  F q = numerator / denominator;
  q = select(eq(denominator, zero_f()), zero_f(), q);
  q = select(eq(numerator, infinity()), broadcast(1.0f), q);
  const F t = atan_polynomial(q);
  const M left = lt(as_i(x), zero_i());  // -0 too
  const F base1 = select(steep, broadcast(kHalfPi1), select(left, broadcast(kPi1), zero_f()));
  const F base2 = select(steep, broadcast(kHalfPi2), select(left, broadcast(kPi2), zero_f()));
  const F signed_t = select(steep ^ left, negate(t), t);
  const F value = flip_sign(base1 + (signed_t + base2), sign_bit(y));
  return select(unordered(x, y), quiet_nan(), value);
}

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#endif  // per target
