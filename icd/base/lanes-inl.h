// Lanes: one native vector of 32-bit values, and everything that the driver does to lanes. The same bits on every
// target. Per-target header. A file that uses it looks like lanes_runs.cpp.
//
//   F, I, U   vectors of kVectorLanes floats, signed and unsigned integers (4, 8 or 16 lanes)
//   M         one condition per lane;  D  as many doubles as F has floats
//   load<F>(p), store(v, p)   aligned to the vector; load_unaligned<F>, store_unaligned; load_d, store_d for doubles
//   load_interleaved<n>(p, words), store_interleaved<n>(words, p)  n vectors whose lanes take turns in memory
//   spread_to_quads(pointers, offset)  pointers[i][offset] to lanes 4i .. 4i+3
//   broadcast(x)              by the type of x: 1.0f, 1, 1u, 1.0
//   as_f, as_i, as_u          bit casts
//   + - * /                   F and D, correctly rounded; + - * & | ^ ~ wrap on I and U; & | ^ ~ and and_not(a, b) on M
//   fma(a, b, c)              a * b + c rounded once, on every target, overflow and denormals included
//   fma_exact(a, b, c)        the same where a * b needs no rounding, which is quicker
//   eq lt le ne gt ge         ordered comparisons (false for NaN, but ne is true); unordered_… are true for NaN
//   select(m, yes, no)        any(m), all(m)
//   min(x, y)                 y < x ? y : x, max(x, y)  x < y ? y : x (SPIR-V FMin, FMax); nmin, nmax prefer what
//                             is no NaN; min and max on I and U as expected
//   reduce_min, reduce_max    of the lanes of an F without NaN
//   mul_high                  the upper 32 bits of a 64-bit product
//   dot_of_halves             the sum of the products of both signed 16-bit halves
//   shift_left, shift_right   by a vector count modulo 32, or shift_left<n>(v); arithmetic for I, logical for U
//   divide, remainder, modulo integers, defined for every operand: lanes_integer-inl.h
//   trunc floor ceil round_even  sqrt  abs  negate  copy_sign
//   to_float, to_int, to_uint, to_double  conversions: lanes_convert-inl.h; pack_half, unpack_half
//   mask_of(word, index)      lanes index * kVectorLanes … of a 64-lane word as M; bits_of(m) the other way, unshifted;
//                             bits_not_zero(u)
//   gather32(base, byte_offsets, m)  32-bit values at base + offset (below 2^31, any alignment), 0 where m is not set
//   gather_pairs(base, byte_offsets, first, second)  the words at base + offset and 4 bytes behind it, in all lanes
//   byte_of<n>(u)             byte n of each lane
//   pack_bytes(c0, c1, c2, c3)  bytes from integers, as near as they come; byte_over_255<n>(u) a byte as a fraction
//   swap_columns, swap_rows   of U, within each 2x2 quad of lanes
//   canonical(f)              every NaN as 0x7FC00000
//   first_lane(u)             lane 0 as a number
#if defined(LAPILLI_BASE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LAPILLI_BASE_LANES_INL_H
#undef LAPILLI_BASE_LANES_INL_H
#else
#define LAPILLI_BASE_LANES_INL_H
#endif

#ifndef HWY_DISABLED_TARGETS
#include "base/simd_targets.h"
#endif

#include <hwy/highway.h>

#include <cstdint>

#if HWY_TARGET == HWY_SCALAR
#include "base/lanes_sse2-inl.h"
#else
#include "base/lanes_highway-inl.h"
#endif

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {

// A batch, DESIGN.md "The interpreter".
inline constexpr int kLanes = 64;
inline constexpr int kVectorsPerBatch = kLanes / kVectorLanes;

HWY_API F fma_exact(F a, F b, F c) {
#if HWY_TARGET == HWY_SCALAR
  return a * b + c;
#else
  return fma(a, b, c);
#endif
}
HWY_API F zero_f() { return broadcast(0.0f); }
HWY_API I zero_i() { return broadcast(0); }
HWY_API U zero_u() { return broadcast(0u); }
// bits_of(ne(a, 0))
HWY_API uint64_t bits_not_zero(U a) {
#if HWY_TARGET == HWY_AVX3
  return _mm512_test_epi32_mask(a.raw, a.raw);
#else
  return bits_of(~eq(a, zero_u()));
#endif
}
HWY_API M all_lanes() { return eq(zero_u(), zero_u()); }
HWY_API M no_lanes() { return ~all_lanes(); }

// Comparisons, all from eq, lt and le.
template <class V>
HWY_API M ne(V a, V b) {
  return ~eq(a, b);
}
template <class V>
HWY_API M gt(V a, V b) {
  return lt(b, a);
}
HWY_API M ge(F a, F b) { return le(b, a); }
HWY_API M ge(D a, D b) { return le(b, a); }
HWY_API M le(I a, I b) { return ~lt(b, a); }
HWY_API M le(U a, U b) { return ~lt(b, a); }
HWY_API M ge(I a, I b) { return ~lt(a, b); }
HWY_API M ge(U a, U b) { return ~lt(a, b); }
HWY_API D min(D x, D y) { return select(lt(y, x), y, x); }
HWY_API D max(D x, D y) { return select(lt(x, y), y, x); }
HWY_API M is_nan(F a) { return ~eq(a, a); }
HWY_API M unordered(F a, F b) { return is_nan(a) | is_nan(b); }
HWY_API M ordered(F a, F b) { return eq(a, a) & eq(b, b); }
HWY_API M ordered_ne(F a, F b) { return lt(a, b) | lt(b, a); }
HWY_API M unordered_eq(F a, F b) { return ~ordered_ne(a, b); }
HWY_API M unordered_lt(F a, F b) { return ~le(b, a); }
HWY_API M unordered_gt(F a, F b) { return ~le(a, b); }
HWY_API M unordered_le(F a, F b) { return ~lt(b, a); }
HWY_API M unordered_ge(F a, F b) { return ~lt(a, b); }

// Sign and NaN.
HWY_API F abs(F a) { return as_f(as_u(a) & broadcast(0x7FFFFFFFu)); }
HWY_API F negate(F a) { return as_f(as_u(a) ^ broadcast(0x80000000u)); }
HWY_API I negate(I a) { return zero_i() - a; }
HWY_API U negate(U a) { return zero_u() - a; }
HWY_API I abs(I a) { return max(a, negate(a)); }  // INT_MIN stays
HWY_API U sign_bit(F a) { return as_u(a) & broadcast(0x80000000u); }
HWY_API F copy_sign(F magnitude, F sign) { return as_f((as_u(magnitude) & broadcast(0x7FFFFFFFu)) | sign_bit(sign)); }
HWY_API F flip_sign(F a, U sign) { return as_f(as_u(a) ^ sign); }
HWY_API M is_inf(F a) { return eq(as_u(abs(a)), broadcast(0x7F800000u)); }
HWY_API M is_finite(F a) { return lt(as_i(abs(a)), broadcast(0x7F800000)); }
HWY_API F quiet_nan() { return as_f(broadcast(0x7FC00000u)); }
HWY_API F infinity() { return as_f(broadcast(0x7F800000u)); }
HWY_API F canonical(F a) { return select(eq(a, a), a, quiet_nan()); }
HWY_API F nmin(F x, F y) { return select(is_nan(x), y, min(x, y)); }
HWY_API F nmax(F x, F y) { return select(is_nan(x), y, max(x, y)); }

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#include "base/lanes_convert-inl.h"
#include "base/lanes_integer-inl.h"

#endif  // per target
