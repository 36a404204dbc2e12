// Lane primitives on the x86-64 baseline, SSE2, for which Highway has no target.
// Part of lanes-inl.h, which says what each function means; the list is that of lanes_highway-inl.h.

#if defined(LAPILLI_BASE_LANES_SSE2_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LAPILLI_BASE_LANES_SSE2_INL_H
#undef LAPILLI_BASE_LANES_SSE2_INL_H
#else
#define LAPILLI_BASE_LANES_SSE2_INL_H
#endif

#include <emmintrin.h>

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {

struct F {
  __m128 raw;
};
struct I {
  __m128i raw;
};
struct U {
  __m128i raw;
};
struct M {
  __m128 raw;
};
struct D {
  __m128d low;
  __m128d high;
};

inline constexpr int kVectorLanes = 4;

// Memory.
HWY_API __m128i raw_integer(F v) { return _mm_castps_si128(v.raw); }
HWY_API __m128i raw_integer(I v) { return v.raw; }
HWY_API __m128i raw_integer(U v) { return v.raw; }
HWY_API F from_raw_integer(__m128i raw, F*) { return {_mm_castsi128_ps(raw)}; }
HWY_API I from_raw_integer(__m128i raw, I*) { return {raw}; }
HWY_API U from_raw_integer(__m128i raw, U*) { return {raw}; }
template <class V>
HWY_API V load(const void* p) {
  return from_raw_integer(_mm_load_si128(static_cast<const __m128i*>(p)), static_cast<V*>(nullptr));
}
template <class V>
HWY_API V load_unaligned(const void* p) {
  return from_raw_integer(_mm_loadu_si128(static_cast<const __m128i*>(p)), static_cast<V*>(nullptr));
}
template <class V>
HWY_API void store(V v, void* p) {
  _mm_store_si128(static_cast<__m128i*>(p), raw_integer(v));
}
template <class V>
HWY_API void store_unaligned(V v, void* p) {
  _mm_storeu_si128(static_cast<__m128i*>(p), raw_integer(v));
}
template <size_t kWords>
HWY_API void load_interleaved(const void* p, U* words) {
  if constexpr (kWords == 1) {
    words[0] = load_unaligned<U>(p);
  } else {
    alignas(16) uint32_t lanes[kWords][kVectorLanes];
    const auto* from = static_cast<const char*>(p);
    for (int lane = 0; lane < kVectorLanes; ++lane) {
      for (size_t w = 0; w < kWords; ++w, from += 4) __builtin_memcpy(&lanes[w][lane], from, 4);
    }
    for (size_t w = 0; w < kWords; ++w) words[w] = load<U>(lanes[w]);
  }
}
template <size_t kWords>
HWY_API void store_interleaved(const U* words, void* p) {
  if constexpr (kWords == 1) {
    store_unaligned(words[0], p);
  } else {
    alignas(16) uint32_t lanes[kWords][kVectorLanes];
    for (size_t w = 0; w < kWords; ++w) store(words[w], lanes[w]);
    auto* to = static_cast<char*>(p);
    for (int lane = 0; lane < kVectorLanes; ++lane) {
      for (size_t w = 0; w < kWords; ++w, to += 4) __builtin_memcpy(to, &lanes[w][lane], 4);
    }
  }
}
HWY_API uint32_t first_lane(U v) { return static_cast<uint32_t>(_mm_cvtsi128_si32(v.raw)); }
HWY_API F broadcast(float x) { return {_mm_set1_ps(x)}; }
HWY_API I broadcast(int32_t x) { return {_mm_set1_epi32(x)}; }
HWY_API U broadcast(uint32_t x) { return {_mm_set1_epi32(static_cast<int32_t>(x))}; }
HWY_API F spread_to_quads(const float* const* pointers, size_t offset) { return broadcast(pointers[0][offset]); }

// Bit casts.
template <class V>
HWY_API F as_f(V v) {
  return {_mm_castsi128_ps(raw_integer(v))};
}
template <class V>
HWY_API I as_i(V v) {
  return {raw_integer(v)};
}
template <class V>
HWY_API U as_u(V v) {
  return {raw_integer(v)};
}

// Masks.
HWY_API M mask_from_integer(__m128i raw) { return {_mm_castsi128_ps(raw)}; }
HWY_API __m128i raw_select(M m, __m128i yes, __m128i no) {
  const __m128i mask = _mm_castps_si128(m.raw);
  return _mm_or_si128(_mm_and_si128(mask, yes), _mm_andnot_si128(mask, no));
}
HWY_API M operator&(M a, M b) { return {_mm_and_ps(a.raw, b.raw)}; }
HWY_API M operator|(M a, M b) { return {_mm_or_ps(a.raw, b.raw)}; }
HWY_API M operator^(M a, M b) { return {_mm_xor_ps(a.raw, b.raw)}; }
HWY_API M operator~(M a) { return {_mm_xor_ps(a.raw, _mm_castsi128_ps(_mm_set1_epi32(-1)))}; }
HWY_API M and_not(M a, M b) { return {_mm_andnot_ps(a.raw, b.raw)}; }
HWY_API bool any(M m) { return _mm_movemask_ps(m.raw) != 0; }
HWY_API bool all(M m) { return _mm_movemask_ps(m.raw) == 15; }
HWY_API F select(M m, F yes, F no) { return {_mm_or_ps(_mm_and_ps(m.raw, yes.raw), _mm_andnot_ps(m.raw, no.raw))}; }
HWY_API I select(M m, I yes, I no) { return {raw_select(m, yes.raw, no.raw)}; }
HWY_API U select(M m, U yes, U no) { return {raw_select(m, yes.raw, no.raw)}; }
HWY_API U mask_to_u(M m) { return {_mm_castps_si128(m.raw)}; }

// Integers.
HWY_API __m128i raw_multiply_low(__m128i a, __m128i b) {
  const __m128i even = _mm_mul_epu32(a, b);
  const __m128i odd = _mm_mul_epu32(_mm_srli_epi64(a, 32), _mm_srli_epi64(b, 32));
  return _mm_unpacklo_epi32(_mm_shuffle_epi32(even, _MM_SHUFFLE(3, 1, 2, 0)),
                            _mm_shuffle_epi32(odd, _MM_SHUFFLE(3, 1, 2, 0)));
}
HWY_API I operator+(I a, I b) { return {_mm_add_epi32(a.raw, b.raw)}; }
HWY_API I operator-(I a, I b) { return {_mm_sub_epi32(a.raw, b.raw)}; }
HWY_API I operator*(I a, I b) { return {raw_multiply_low(a.raw, b.raw)}; }
HWY_API I operator&(I a, I b) { return {_mm_and_si128(a.raw, b.raw)}; }
HWY_API I operator|(I a, I b) { return {_mm_or_si128(a.raw, b.raw)}; }
HWY_API I operator^(I a, I b) { return {_mm_xor_si128(a.raw, b.raw)}; }
HWY_API I operator~(I a) { return {_mm_xor_si128(a.raw, _mm_set1_epi32(-1))}; }
HWY_API U operator+(U a, U b) { return {_mm_add_epi32(a.raw, b.raw)}; }
HWY_API U operator-(U a, U b) { return {_mm_sub_epi32(a.raw, b.raw)}; }
HWY_API U operator*(U a, U b) { return {raw_multiply_low(a.raw, b.raw)}; }
HWY_API U operator&(U a, U b) { return {_mm_and_si128(a.raw, b.raw)}; }
HWY_API U operator|(U a, U b) { return {_mm_or_si128(a.raw, b.raw)}; }
HWY_API U operator^(U a, U b) { return {_mm_xor_si128(a.raw, b.raw)}; }
HWY_API U operator~(U a) { return {_mm_xor_si128(a.raw, _mm_set1_epi32(-1))}; }
HWY_API U and_not(U a, U b) { return {_mm_andnot_si128(a.raw, b.raw)}; }
HWY_API M eq(I a, I b) { return mask_from_integer(_mm_cmpeq_epi32(a.raw, b.raw)); }
HWY_API M lt(I a, I b) { return mask_from_integer(_mm_cmplt_epi32(a.raw, b.raw)); }
HWY_API M eq(U a, U b) { return mask_from_integer(_mm_cmpeq_epi32(a.raw, b.raw)); }
HWY_API M lt(U a, U b) {
  const U sign = broadcast(0x80000000u);
  return lt(as_i(a ^ sign), as_i(b ^ sign));
}
HWY_API I min(I a, I b) { return select(lt(b, a), b, a); }
HWY_API I max(I a, I b) { return select(lt(a, b), b, a); }
HWY_API U min(U a, U b) { return select(lt(b, a), b, a); }
HWY_API U max(U a, U b) { return select(lt(a, b), b, a); }
template <int kCount>
HWY_API U shift_left(U a) {
  return {_mm_slli_epi32(a.raw, kCount)};
}
template <int kCount>
HWY_API U shift_right(U a) {
  return {_mm_srli_epi32(a.raw, kCount)};
}
template <int kCount>
HWY_API I shift_right(I a) {
  return {_mm_srai_epi32(a.raw, kCount)};
}
// 2^(count mod 32): as a float from its exponent; 2^31 converts to 0x80000000, the right bits.
HWY_API U power_of_two(U count) {
  const U exponent = (count & broadcast(31u)) + broadcast(127u);
  return {_mm_cvttps_epi32(as_f(shift_left<23>(exponent)).raw)};
}
HWY_API U shift_left(U a, U count) { return a * power_of_two(count); }
HWY_API U shift_right(U a, U count) {
  // One shift for each lane by its own count.
  const __m128i masked = (count & broadcast(31u)).raw;
  const __m128i low_word = _mm_set_epi32(0, 0, 0, -1);
  const __m128i r0 = _mm_srl_epi32(a.raw, _mm_and_si128(masked, low_word));
  const __m128i r1 = _mm_srl_epi32(a.raw, _mm_and_si128(_mm_srli_si128(masked, 4), low_word));
  const __m128i r2 = _mm_srl_epi32(a.raw, _mm_and_si128(_mm_srli_si128(masked, 8), low_word));
  const __m128i r3 = _mm_srl_epi32(a.raw, _mm_srli_si128(masked, 12));
  const __m128 lanes01 = _mm_castsi128_ps(_mm_unpacklo_epi32(r0, _mm_shuffle_epi32(r1, _MM_SHUFFLE(1, 1, 1, 1))));
  const __m128 lanes23 = _mm_castsi128_ps(_mm_unpacklo_epi32(_mm_shuffle_epi32(r2, _MM_SHUFFLE(2, 2, 2, 2)),
                                                             _mm_shuffle_epi32(r3, _MM_SHUFFLE(3, 3, 3, 3))));
  return {_mm_castps_si128(_mm_movelh_ps(lanes01, lanes23))};
}
HWY_API I shift_right(I a, U count) {
  // Negative numbers shift as their complement.
  const I sign = shift_right<31>(a);
  return as_i(shift_right(as_u(a ^ sign), count)) ^ sign;
}
HWY_API U mul_high(U a, U b) {
  const __m128i even = _mm_mul_epu32(a.raw, b.raw);
  const __m128i odd = _mm_mul_epu32(_mm_srli_epi64(a.raw, 32), _mm_srli_epi64(b.raw, 32));
  return {_mm_unpacklo_epi32(_mm_shuffle_epi32(even, _MM_SHUFFLE(2, 0, 3, 1)),
                             _mm_shuffle_epi32(odd, _MM_SHUFFLE(2, 0, 3, 1)))};
}
HWY_API I mul_high(I a, I b) {
  // Signed from unsigned: a negative factor counts 2^32 too much of the other one.
  const I excess = (shift_right<31>(a) & b) + (shift_right<31>(b) & a);
  return as_i(mul_high(as_u(a), as_u(b))) - excess;
}
HWY_API I dot_of_halves(U a, U b) { return {_mm_madd_epi16(a.raw, b.raw)}; }

// Floats.
HWY_API F operator+(F a, F b) { return {_mm_add_ps(a.raw, b.raw)}; }
HWY_API F operator-(F a, F b) { return {_mm_sub_ps(a.raw, b.raw)}; }
HWY_API F operator*(F a, F b) { return {_mm_mul_ps(a.raw, b.raw)}; }
HWY_API F operator/(F a, F b) { return {_mm_div_ps(a.raw, b.raw)}; }
HWY_API F sqrt(F a) { return {_mm_sqrt_ps(a.raw)}; }
HWY_API M eq(F a, F b) { return {_mm_cmpeq_ps(a.raw, b.raw)}; }
HWY_API M lt(F a, F b) { return {_mm_cmplt_ps(a.raw, b.raw)}; }
HWY_API M le(F a, F b) { return {_mm_cmple_ps(a.raw, b.raw)}; }
// minps and maxps give their second operand where the comparison is false.
HWY_API F min(F x, F y) { return {_mm_min_ps(y.raw, x.raw)}; }
HWY_API F max(F x, F y) { return {_mm_max_ps(y.raw, x.raw)}; }
HWY_API float reduce_min(F a) {
  const __m128 two = _mm_min_ps(a.raw, _mm_movehl_ps(a.raw, a.raw));
  return _mm_cvtss_f32(_mm_min_ps(two, _mm_shuffle_ps(two, two, 1)));
}
HWY_API float reduce_max(F a) {
  const __m128 two = _mm_max_ps(a.raw, _mm_movehl_ps(a.raw, a.raw));
  return _mm_cvtss_f32(_mm_max_ps(two, _mm_shuffle_ps(two, two, 1)));
}
HWY_API F to_float(I a) { return {_mm_cvtepi32_ps(a.raw)}; }
HWY_API I truncate_in_range(F a) { return {_mm_cvttps_epi32(a.raw)}; }
HWY_API I nearest_in_range(F a) { return {_mm_cvtps_epi32(a.raw)}; }

HWY_API F with_sign_of(F magnitude, F sign) {
  const __m128 bit = _mm_castsi128_ps(_mm_set1_epi32(INT32_MIN));
  return {_mm_or_ps(_mm_andnot_ps(bit, magnitude.raw), _mm_and_ps(bit, sign.raw))};
}
// From 2^23 on, and for NaN, a float is its own integer part.
HWY_API F if_fraction_possible(F a, F integer_part) {
  const F magnitude = with_sign_of(a, broadcast(0.0f));
  return select(lt(magnitude, broadcast(8388608.0f)), with_sign_of(integer_part, a), a);
}
HWY_API F trunc(F a) { return if_fraction_possible(a, to_float(truncate_in_range(a))); }
HWY_API F round_even(F a) { return if_fraction_possible(a, to_float(nearest_in_range(a))); }
HWY_API F floor(F a) {
  const F whole = to_float(truncate_in_range(a));
  return if_fraction_possible(a, select(lt(a, whole), whole - broadcast(1.0f), whole));
}
HWY_API F ceil(F a) {
  const F whole = to_float(truncate_in_range(a));
  return if_fraction_possible(a, select(lt(whole, a), whole + broadcast(1.0f), whole));
}

// Doubles.
HWY_API D broadcast(double x) { return {_mm_set1_pd(x), _mm_set1_pd(x)}; }
HWY_API D operator+(D a, D b) { return {_mm_add_pd(a.low, b.low), _mm_add_pd(a.high, b.high)}; }
HWY_API D operator-(D a, D b) { return {_mm_sub_pd(a.low, b.low), _mm_sub_pd(a.high, b.high)}; }
HWY_API D operator*(D a, D b) { return {_mm_mul_pd(a.low, b.low), _mm_mul_pd(a.high, b.high)}; }
HWY_API D operator/(D a, D b) { return {_mm_div_pd(a.low, b.low), _mm_div_pd(a.high, b.high)}; }
HWY_API D sqrt(D a) { return {_mm_sqrt_pd(a.low), _mm_sqrt_pd(a.high)}; }
HWY_API D load_d(const double* p) { return {_mm_loadu_pd(p), _mm_loadu_pd(p + 2)}; }
HWY_API void store_d(D a, double* p) {
  _mm_storeu_pd(p, a.low);
  _mm_storeu_pd(p + 2, a.high);
}
HWY_API D to_double(F a) { return {_mm_cvtps_pd(a.raw), _mm_cvtps_pd(_mm_movehl_ps(a.raw, a.raw))}; }
HWY_API D to_double(I a) { return {_mm_cvtepi32_pd(a.raw), _mm_cvtepi32_pd(_mm_srli_si128(a.raw, 8))}; }
HWY_API F to_float(D a) { return {_mm_movelh_ps(_mm_cvtpd_ps(a.low), _mm_cvtpd_ps(a.high))}; }
HWY_API I truncate_in_range(D a) { return {_mm_unpacklo_epi64(_mm_cvttpd_epi32(a.low), _mm_cvttpd_epi32(a.high))}; }
HWY_API __m128d raw_select(__m128d mask, __m128d yes, __m128d no) {
  return _mm_or_pd(_mm_and_pd(mask, yes), _mm_andnot_pd(mask, no));
}
HWY_API D select(M m, D yes, D no) {
  const __m128i lanes = _mm_castps_si128(m.raw);
  return {raw_select(_mm_castsi128_pd(_mm_unpacklo_epi32(lanes, lanes)), yes.low, no.low),
          raw_select(_mm_castsi128_pd(_mm_unpackhi_epi32(lanes, lanes)), yes.high, no.high)};
}
HWY_API M mask_from_double(__m128d low, __m128d high) {
  return {_mm_shuffle_ps(_mm_castpd_ps(low), _mm_castpd_ps(high), _MM_SHUFFLE(2, 0, 2, 0))};
}
HWY_API M lt(D a, D b) { return mask_from_double(_mm_cmplt_pd(a.low, b.low), _mm_cmplt_pd(a.high, b.high)); }
HWY_API M le(D a, D b) { return mask_from_double(_mm_cmple_pd(a.low, b.low), _mm_cmple_pd(a.high, b.high)); }

// a + b to 53 bits, rounded to odd: rounding that once more to 24 bits gives what rounding the exact
// sum to 24 bits gives (Boldo and Melquiond, "Emulation of FMA and correctly rounded sums").
HWY_API __m128d add_to_odd(__m128d a, __m128d b) {
  const __m128d zero = _mm_setzero_pd();
  const __m128d sum = _mm_add_pd(a, b);
  const __m128d b_part = _mm_sub_pd(sum, a);
  const __m128d error = _mm_add_pd(_mm_sub_pd(a, _mm_sub_pd(sum, b_part)), _mm_sub_pd(b, b_part));
  const __m128d error_positive = _mm_cmpgt_pd(error, zero);
  const __m128d error_negative = _mm_cmplt_pd(error, zero);
  const __m128d sum_negative = _mm_cmplt_pd(sum, zero);
  const __m128i bits = _mm_castpd_si128(sum);
  const __m128i one = _mm_set_epi32(0, 1, 0, 1);
  // Where the sum is even and inexact, its odd neighbour on the side of the error. A NaN error
  // (infinite or NaN sum) counts as exact.
  const __m128i inexact = _mm_castpd_si128(_mm_or_pd(error_positive, error_negative));
  const __m128i step = _mm_and_si128(_mm_andnot_si128(bits, one), inexact);
  const __m128i inward = _mm_castpd_si128(_mm_xor_pd(error_negative, sum_negative));
  const __m128i signed_step = _mm_sub_epi64(_mm_xor_si128(step, inward), inward);
  return _mm_castsi128_pd(_mm_add_epi64(bits, signed_step));
}
static HWY_NOINLINE HWY_MAYBE_UNUSED F fma_to_odd(D product, D addend) {
  return to_float(D{add_to_odd(product.low, addend.low), add_to_odd(product.high, addend.high)});
}
// The product of two floats is exact in double. Rounding the sum to double and then to float goes wrong only where the
// double lies halfway between two floats: its low 29 bits are 1000…, or the float is denormal, where more bits count.
HWY_API F fma(F a, F b, F c) {
  const D product = to_double(a) * to_double(b);
  const D addend = to_double(c);
  const D sum = product + addend;
  const __m128 low_words = _mm_shuffle_ps(_mm_castpd_ps(sum.low), _mm_castpd_ps(sum.high), _MM_SHUFFLE(2, 0, 2, 0));
  const __m128 high_words = _mm_shuffle_ps(_mm_castpd_ps(sum.low), _mm_castpd_ps(sum.high), _MM_SHUFFLE(3, 1, 3, 1));
  const I low = {_mm_castps_si128(low_words)};
  const I magnitude = I{_mm_castps_si128(high_words)} & broadcast(0x7FFFFFFF);
  const M halfway = eq(low & broadcast(0x1FFFFFFF), broadcast(0x10000000));
  const M denormal = lt(broadcast(0), magnitude) & lt(magnitude, broadcast((1023 - 126) << 20));
  if (HWY_UNLIKELY(any(halfway | denormal))) return fma_to_odd(product, addend);
  return to_float(sum);
}

// Words of lanes.
HWY_API M mask_of(uint64_t word, int index) {
  const U lane_bit = {_mm_set_epi32(8, 4, 2, 1)};
  const U bits = broadcast(static_cast<uint32_t>(word >> (index * kVectorLanes))) & lane_bit;
  return eq(bits, lane_bit);
}
HWY_API uint64_t bits_of(M m) { return static_cast<uint32_t>(_mm_movemask_ps(m.raw)); }

HWY_API U gather32(const void* base, U byte_offsets, M m) {
  alignas(16) uint32_t lanes[kVectorLanes];
  store(byte_offsets, lanes);
  const uint64_t bits = bits_of(m);
  for (int lane = 0; lane < kVectorLanes; ++lane) {
    const uint32_t offset = lanes[lane];
    lanes[lane] = 0;
    if ((bits >> lane & 1) != 0) {
      __builtin_memcpy(&lanes[lane], static_cast<const char*>(base) + offset, 4);
    }
  }
  return load<U>(lanes);
}
HWY_API U pack_bytes(I c0, I c1, I c2, I c3) {
  const __m128i words02 = _mm_packs_epi32(c0.raw, c2.raw);
  const __m128i words13 = _mm_packs_epi32(c1.raw, c3.raw);
  const __m128i bytes = _mm_packus_epi16(words02, words13);  // four each of c0 c2 c1 c3
  const __m128i pairs = _mm_unpacklo_epi8(bytes, _mm_srli_si128(bytes, 8));
  return {_mm_unpacklo_epi16(pairs, _mm_srli_si128(pairs, 8))};
}
template <int kByte>
HWY_API U byte_of(U a) {
  if constexpr (kByte == 3) return shift_right<24>(a);
  return shift_right<8 * kByte>(a) & broadcast(0xFFu);
}
HWY_API void gather_pairs(const void* base, U byte_offsets, U& first, U& second) {
  alignas(16) uint32_t offsets[kVectorLanes];
  store(byte_offsets, offsets);
  const char* const p = static_cast<const char*>(base);
  const __m128i a = _mm_unpacklo_epi32(_mm_loadu_si64(p + offsets[0]), _mm_loadu_si64(p + offsets[1]));
  const __m128i b = _mm_unpacklo_epi32(_mm_loadu_si64(p + offsets[2]), _mm_loadu_si64(p + offsets[3]));
  first = {_mm_unpacklo_epi64(a, b)};
  second = {_mm_unpackhi_epi64(a, b)};
}
HWY_API U swap_columns(U a) { return {_mm_shuffle_epi32(a.raw, _MM_SHUFFLE(2, 3, 0, 1))}; }
HWY_API U swap_rows(U a) { return {_mm_shuffle_epi32(a.raw, _MM_SHUFFLE(1, 0, 3, 2))}; }
HWY_API U lane_numbers() { return {_mm_set_epi32(3, 2, 1, 0)}; }

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#endif  // per target
