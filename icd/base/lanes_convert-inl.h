// Conversions of lanes between float, integer, double and half. Part of lanes-inl.h.
// Out of range saturates and NaN gives 0, on every target (SPIR-V leaves both undefined).

#if defined(LAPILLI_BASE_LANES_CONVERT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LAPILLI_BASE_LANES_CONVERT_INL_H
#undef LAPILLI_BASE_LANES_CONVERT_INL_H
#else
#define LAPILLI_BASE_LANES_CONVERT_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {

inline constexpr float kTwoTo31 = 2147483648.0f;

// Toward zero, SPIR-V ConvertFToS.
HWY_API I to_int(F a) {
  const M in_range = lt(abs(a), broadcast(kTwoTo31));
  const I inside = truncate_in_range(select(in_range, a, zero_f()));
  // INT_MAX, or INT_MIN below zero; 0 for NaN.
  const I limit = broadcast(INT32_MAX) ^ shift_right<31>(as_i(a));
  const I outside = select(is_nan(a), zero_i(), limit);
  return select(in_range, inside, outside);
}

// Toward zero, SPIR-V ConvertFToU; negative numbers give 0.
HWY_API U to_uint(F a) {
  const M upper = ge(a, broadcast(kTwoTo31));
  const F reduced = select(upper, a - broadcast(kTwoTo31), a);
  const M inside = gt(reduced, zero_f()) & lt(reduced, broadcast(kTwoTo31));
  const U low = as_u(truncate_in_range(select(inside, reduced, zero_f())));
  const U whole = low ^ select(upper, broadcast(0x80000000u), zero_u());
  return select(ge(a, broadcast(2.0f * kTwoTo31)), broadcast(0xFFFFFFFFu), whole);
}

// Both halves are exact as floats; their sum rounds once.
HWY_API F to_float(U a) {
#if HWY_TARGET == HWY_AVX3
  return F{_mm512_cvtepu32_ps(a.raw)};
#else
  const F high = to_float(as_i(shift_right<16>(a)));
  const F low = to_float(as_i(a & broadcast(0xFFFFu)));
  return high * broadcast(65536.0f) + low;
#endif
}

// Byte kByte of every lane over 255, correctly rounded; first over kByteScale, which is a power of two.
#if HWY_TARGET == HWY_AVX3
// 1/255 is 0x0.01010101…: the byte four times over is its quotient's first 32 bits. A byte of n bits leaves itself
// behind the 24 that a float holds, which is half a unit at least, and the true quotient goes on: always up.
inline constexpr float kByteScale = 0x1p-32f;
template <int kByte>
HWY_API F scaled_byte_over_255(U a) {
  constexpr int b = kByte * 0x01010101;
  const __m512i four_times = _mm512_set4_epi32(b + 0x0C0C0C0C, b + 0x08080808, b + 0x04040404, b);
  constexpr int kUp = _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC;
  return F{_mm512_cvt_roundepu32_ps(_mm512_shuffle_epi8(a.raw, four_times), kUp)};
}
template <int kByte>
HWY_API F byte_over_255(U a) {
  return scaled_byte_over_255<kByte>(a) * broadcast(kByteScale);
}
#else
inline constexpr float kByteScale = 1;
template <int kByte>
HWY_API F byte_over_255(U a) {
  // 1/255 as two floats. The upper one has 9 bits, so that its product with a byte is exact and the sum is rounded
  // once.
  const F code = to_float(as_i(byte_of<kByte>(a)));
  return fma_exact(code, broadcast(0x1.01p-8f), code * broadcast(0x1.010102p-24f));
}
template <int kByte>
HWY_API F scaled_byte_over_255(U a) {
  return byte_over_255<kByte>(a);
}
#endif

HWY_API D to_double(U a) { return to_double(as_i(a ^ broadcast(0x80000000u))) + broadcast(2147483648.0); }

// Toward zero. 0 ≤ a < 2^32
HWY_API U truncate_to_uint_in_range(D a) {
  const D limit = broadcast(2147483648.0);
  const M upper = le(limit, a);
  const U low = as_u(truncate_in_range(select(upper, a - limit, a)));
  return low ^ select(upper, broadcast(0x80000000u), zero_u());
}

// IEEE binary16 in the low 16 bits, rounded to nearest even; overflow gives infinity, NaN 0x7E00.
// In integers, so that no target's own conversion decides.
HWY_API U to_half(F a) {
  const U bits = as_u(a);
  const U sign = shift_right<16>(bits) & broadcast(0x8000u);
  const U magnitude = bits & broadcast(0x7FFFFFFFu);
  // Normal numbers: 2^-14 and up. Rounds at bit 13, with a carry into the exponent where due.
  const U odd = shift_right<13>(magnitude) & broadcast(1u);
  const U normal = shift_right<13>(magnitude - broadcast(112u << 23) + broadcast(0xFFFu) + odd);
  // Smaller ones: the sum with 0.5 has the half's denormal step, 2^-24, as its last place.
  const F with_half = as_f(magnitude) + broadcast(0.5f);
  const U denormal = as_u(with_half) - as_u(broadcast(0.5f));
  U half = select(lt(magnitude, broadcast(113u << 23)), denormal, normal);
  half = select(lt(broadcast(0x477FEFFFu), magnitude), broadcast(0x7C00u), half);
  half = select(lt(broadcast(0x7F800000u), magnitude), broadcast(0x7E00u), half);
  const M is_a_nan = lt(broadcast(0x7F800000u), magnitude);
  return half | select(is_a_nan, zero_u(), sign);
}

// From the low 16 bits; the upper ones are ignored.
HWY_API F from_half(U half) {
  const U sign = shift_left<16>(half & broadcast(0x8000u));
  const U magnitude = shift_left<13>(half & broadcast(0x7FFFu));
  const M special = ge(magnitude, broadcast(31u << 23));
  const U rebiased = magnitude + broadcast(112u << 23);
  // Denormals: read as 2^-14 · (1 + m) and lose the 2^-14; exact.
  const F denormal = as_f(magnitude + broadcast(113u << 23)) - as_f(broadcast(113u << 23));
  U bits = select(lt(magnitude, broadcast(1u << 23)), as_u(denormal), rebiased);
  bits = select(special, magnitude | broadcast(0x7F800000u), bits);
  return canonical(as_f(bits | sign));
}

// GLSL packHalf2x16 and its inverse: x in the low half.
HWY_API U pack_half(F x, F y) { return to_half(x) | shift_left<16>(to_half(y)); }
HWY_API F unpack_half_low(U packed) { return from_half(packed); }
HWY_API F unpack_half_high(U packed) { return from_half(shift_right<16>(packed)); }

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#endif  // per target
