// Lane primitives on Highway vectors: AVX2, AVX3 and NEON. Part of lanes-inl.h, which says what
// each function means; lanes_sse2-inl.h is the same list for the x86-64 baseline.

#if defined(LAPILLI_BASE_LANES_HIGHWAY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LAPILLI_BASE_LANES_HIGHWAY_INL_H
#undef LAPILLI_BASE_LANES_HIGHWAY_INL_H
#else
#define LAPILLI_BASE_LANES_HIGHWAY_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using FTag = hn::ScalableTag<float>;
using ITag = hn::ScalableTag<int32_t>;
using UTag = hn::ScalableTag<uint32_t>;
using DTag = hn::ScalableTag<double>;
using LTag = hn::ScalableTag<uint64_t>;

using F = hn::Vec<FTag>;
using I = hn::Vec<ITag>;
using U = hn::Vec<UTag>;

struct M {
  hn::Mask<FTag> raw;
};
// As many doubles as F has floats, in two vectors: lanes 0 … n/2-1, then the rest.
struct D {
  hn::Vec<DTag> low;
  hn::Vec<DTag> high;
};

inline constexpr int kVectorLanes = HWY_LANES(float);

// Memory.
template <class V>
struct LaneTag;
template <>
struct LaneTag<F> {
  using Type = FTag;
};
template <>
struct LaneTag<I> {
  using Type = ITag;
};
template <>
struct LaneTag<U> {
  using Type = UTag;
};
template <class V>
HWY_API V load(const void* p) {
  using Tag = typename LaneTag<V>::Type;
  return hn::Load(Tag(), static_cast<const hn::TFromD<Tag>*>(p));
}
template <class V>
HWY_API V load_unaligned(const void* p) {
  using Tag = typename LaneTag<V>::Type;
  return hn::LoadU(Tag(), static_cast<const hn::TFromD<Tag>*>(p));
}
template <class V>
HWY_API void store(V v, void* p) {
  using Tag = typename LaneTag<V>::Type;
  hn::Store(v, Tag(), static_cast<hn::TFromD<Tag>*>(p));
}
template <class V>
HWY_API void store_unaligned(V v, void* p) {
  using Tag = typename LaneTag<V>::Type;
  hn::StoreU(v, Tag(), static_cast<hn::TFromD<Tag>*>(p));
}
// Word w of lane i lies at 4 * (kWords * i + w); any alignment.
template <size_t kWords>
HWY_API void load_interleaved(const void* p, U* words) {
  const auto* from = static_cast<const uint32_t*>(p);
  if constexpr (kWords == 1) words[0] = hn::LoadU(UTag(), from);
  if constexpr (kWords == 2) hn::LoadInterleaved2(UTag(), from, words[0], words[1]);
  if constexpr (kWords == 3) hn::LoadInterleaved3(UTag(), from, words[0], words[1], words[2]);
  if constexpr (kWords == 4) hn::LoadInterleaved4(UTag(), from, words[0], words[1], words[2], words[3]);
}
template <size_t kWords>
HWY_API void store_interleaved(const U* words, void* p) {
  auto* to = static_cast<uint32_t*>(p);
  if constexpr (kWords == 1) hn::StoreU(words[0], UTag(), to);
  if constexpr (kWords == 2) hn::StoreInterleaved2(words[0], words[1], UTag(), to);
  if constexpr (kWords == 3) hn::StoreInterleaved3(words[0], words[1], words[2], UTag(), to);
  if constexpr (kWords == 4) hn::StoreInterleaved4(words[0], words[1], words[2], words[3], UTag(), to);
}
HWY_API uint32_t first_lane(U v) { return hn::GetLane(v); }
HWY_API F broadcast(float x) { return hn::Set(FTag(), x); }
HWY_API I broadcast(int32_t x) { return hn::Set(ITag(), x); }
HWY_API U broadcast(uint32_t x) { return hn::Set(UTag(), x); }

// pointers[i][offset] in the four lanes of quad i.
HWY_API F spread_to_quads(const float* const* pointers, size_t offset) {
#if HWY_TARGET == HWY_AVX3
  __m512 v = _mm512_set1_ps(pointers[0][offset]);
  v = _mm512_mask_broadcastss_ps(v, 0x00F0, _mm_load_ss(pointers[1] + offset));
  v = _mm512_mask_broadcastss_ps(v, 0x0F00, _mm_load_ss(pointers[2] + offset));
  return F{_mm512_mask_broadcastss_ps(v, 0xF000, _mm_load_ss(pointers[3] + offset))};
#elif HWY_TARGET == HWY_AVX2
  return F{_mm256_insertf128_ps(_mm256_set1_ps(pointers[0][offset]), _mm_broadcast_ss(pointers[1] + offset), 1)};
#else
  return hn::Set(FTag(), pointers[0][offset]);
#endif
}

// Bit casts.
template <class V>
HWY_API F as_f(V v) {
  return hn::BitCast(FTag(), v);
}
template <class V>
HWY_API I as_i(V v) {
  return hn::BitCast(ITag(), v);
}
template <class V>
HWY_API U as_u(V v) {
  return hn::BitCast(UTag(), v);
}

// Masks.
HWY_API M operator&(M a, M b) { return {hn::And(a.raw, b.raw)}; }
HWY_API M operator|(M a, M b) { return {hn::Or(a.raw, b.raw)}; }
HWY_API M operator^(M a, M b) { return {hn::Xor(a.raw, b.raw)}; }
HWY_API M operator~(M a) { return {hn::Not(a.raw)}; }
// not a, and b
HWY_API M and_not(M a, M b) { return {hn::AndNot(a.raw, b.raw)}; }
HWY_API bool any(M m) { return !hn::AllFalse(FTag(), m.raw); }
HWY_API bool all(M m) { return hn::AllTrue(FTag(), m.raw); }
HWY_API F select(M m, F yes, F no) { return hn::IfThenElse(m.raw, yes, no); }
HWY_API I select(M m, I yes, I no) { return hn::IfThenElse(hn::RebindMask(ITag(), m.raw), yes, no); }
HWY_API U select(M m, U yes, U no) { return hn::IfThenElse(hn::RebindMask(UTag(), m.raw), yes, no); }
HWY_API U mask_to_u(M m) { return as_u(hn::VecFromMask(FTag(), m.raw)); }

// Integers.
HWY_API I operator~(I a) { return hn::Not(a); }
HWY_API U operator~(U a) { return hn::Not(a); }
HWY_API U and_not(U a, U b) { return hn::AndNot(a, b); }
HWY_API M eq(I a, I b) { return {hn::RebindMask(FTag(), hn::Eq(a, b))}; }
HWY_API M lt(I a, I b) { return {hn::RebindMask(FTag(), hn::Lt(a, b))}; }
HWY_API M eq(U a, U b) { return {hn::RebindMask(FTag(), hn::Eq(a, b))}; }
HWY_API M lt(U a, U b) { return {hn::RebindMask(FTag(), hn::Lt(a, b))}; }
HWY_API I min(I a, I b) { return hn::Min(a, b); }
HWY_API I max(I a, I b) { return hn::Max(a, b); }
HWY_API U min(U a, U b) { return hn::Min(a, b); }
HWY_API U max(U a, U b) { return hn::Max(a, b); }
template <int kCount>
HWY_API U shift_left(U a) {
  return hn::ShiftLeft<kCount>(a);
}
template <int kCount>
HWY_API U shift_right(U a) {
  return hn::ShiftRight<kCount>(a);
}
template <int kCount>
HWY_API I shift_right(I a) {
  return hn::ShiftRight<kCount>(a);
}
HWY_API U shift_left(U a, U count) { return a << hn::And(count, broadcast(31u)); }
HWY_API U shift_right(U a, U count) { return a >> hn::And(count, broadcast(31u)); }
HWY_API I shift_right(I a, U count) { return a >> as_i(hn::And(count, broadcast(31u))); }

template <class V>
HWY_API V join_high_halves(V even_product, V odd_product) {
  const LTag tag;
  const auto high = hn::Set(tag, 0xFFFFFFFF00000000ull);
  const auto even = hn::ShiftRight<32>(hn::BitCast(tag, even_product));
  const auto odd = hn::And(hn::BitCast(tag, odd_product), high);
  return hn::BitCast(typename LaneTag<V>::Type(), hn::Or(even, odd));
}
template <class V>
HWY_API V move_odd_lanes_to_even(V v) {
  return hn::BitCast(typename LaneTag<V>::Type(), hn::ShiftRight<32>(hn::BitCast(LTag(), v)));
}
HWY_API U mul_high(U a, U b) {
  const auto even = hn::MulEven(a, b);
  const auto odd = hn::MulEven(move_odd_lanes_to_even(a), move_odd_lanes_to_even(b));
  return join_high_halves(as_u(even), as_u(odd));
}
HWY_API I mul_high(I a, I b) {
  const auto even = hn::MulEven(a, b);
  const auto odd = hn::MulEven(move_odd_lanes_to_even(a), move_odd_lanes_to_even(b));
  return join_high_halves(as_i(even), as_i(odd));
}
// The sum of the products of both signed 16-bit halves.
HWY_API I dot_of_halves(U a, U b) {
#if HWY_TARGET == HWY_AVX3
  return I{_mm512_madd_epi16(a.raw, b.raw)};
#elif HWY_TARGET == HWY_AVX2
  return I{_mm256_madd_epi16(a.raw, b.raw)};
#else
  const auto low = [](U v) { return shift_right<16>(as_i(shift_left<16>(v))); };
  return low(a) * low(b) + shift_right<16>(as_i(a)) * shift_right<16>(as_i(b));
#endif
}

// Floats.
HWY_API F sqrt(F a) { return hn::Sqrt(a); }
#if HWY_TARGET == HWY_AVX3
// 1 / √a in two rounded steps. The units for root and quotient take 22 cycles for a vector, this 10. Both steps end in
// an exact remainder, so that the estimate's bits do not matter: lane_math_test with LAPILLI_MATH_STRIDE=1 tries all
// arguments. The last rounds correctly but where all bits of the root's significand are set.
HWY_API F inverse_sqrt(F a) {
  constexpr uint32_t kLeast = (127u - 100) << 23, kInfinity = 0x7F800000u;  // 2^-100 and up
  const F one = hn::Set(FTag(), 1.0f), half = hn::Set(FTag(), 0.5f);
  const F estimate = F{_mm512_rsqrt14_ps(a.raw)};
  F root = a * estimate;
  F half_inverse = half * estimate;
  const F error = hn::NegMulAdd(root, half_inverse, half);
  root = hn::MulAdd(root, error, root);
  half_inverse = hn::MulAdd(half_inverse, error, half_inverse);
  root = hn::MulAdd(hn::NegMulAdd(root, root, a), half_inverse, root);  // correctly rounded
  const F inverse = half_inverse + half_inverse;
  const auto usual = hn::Lt(hn::BitCast(UTag(), a) - hn::Set(UTag(), kLeast), hn::Set(UTag(), kInfinity - kLeast));
  const U ones = hn::BitCast(UTag(), root) | hn::Set(UTag(), 0xFF800000u);
  if (HWY_LIKELY(hn::AllTrue(UTag(), hn::And(usual, hn::Ne(ones, hn::Set(UTag(), 0xFFFFFFFFu)))))) {
    return hn::MulAdd(hn::NegMulAdd(root, inverse, one), inverse, inverse);
  }
  return one / hn::Sqrt(a);
}
#endif
HWY_API F fma(F a, F b, F c) { return hn::MulAdd(a, b, c); }
HWY_API M eq(F a, F b) { return {hn::Eq(a, b)}; }
HWY_API M lt(F a, F b) { return {hn::Lt(a, b)}; }
HWY_API M le(F a, F b) { return {hn::Le(a, b)}; }
#if HWY_ARCH_X86
// minps and maxps give their second operand where the comparison is false.
HWY_API F min(F x, F y) { return hn::Min(y, x); }
HWY_API F max(F x, F y) { return hn::Max(y, x); }
#else
HWY_API F min(F x, F y) { return select(lt(y, x), y, x); }
HWY_API F max(F x, F y) { return select(lt(x, y), y, x); }
#endif
// Of all lanes; no NaN among them.
HWY_API float reduce_min(F a) { return hn::GetLane(hn::MinOfLanes(FTag(), a)); }
HWY_API float reduce_max(F a) { return hn::GetLane(hn::MaxOfLanes(FTag(), a)); }
HWY_API F trunc(F a) { return hn::Trunc(a); }
HWY_API F round_even(F a) { return hn::Round(a); }
HWY_API F floor(F a) { return hn::Floor(a); }
HWY_API F ceil(F a) { return hn::Ceil(a); }
HWY_API F to_float(I a) { return hn::ConvertTo(FTag(), a); }
// |a| < 2^31; the other rounds to nearest even. Highway's own conversions saturate, in five instructions. On x86 what
// is out of range, or a NaN, becomes INT_MIN.
#if HWY_TARGET == HWY_AVX3
HWY_API I truncate_in_range(F a) { return I{_mm512_cvttps_epi32(a.raw)}; }
HWY_API I nearest_in_range(F a) { return I{_mm512_cvtps_epi32(a.raw)}; }
#elif HWY_TARGET == HWY_AVX2
HWY_API I truncate_in_range(F a) { return I{_mm256_cvttps_epi32(a.raw)}; }
HWY_API I nearest_in_range(F a) { return I{_mm256_cvtps_epi32(a.raw)}; }
#else
HWY_API I truncate_in_range(F a) { return hn::ConvertTo(ITag(), a); }
HWY_API I nearest_in_range(F a) { return hn::NearestInt(a); }
#endif

// Doubles.
HWY_API D broadcast(double x) { return {hn::Set(DTag(), x), hn::Set(DTag(), x)}; }
HWY_API D operator+(D a, D b) { return {a.low + b.low, a.high + b.high}; }
HWY_API D operator-(D a, D b) { return {a.low - b.low, a.high - b.high}; }
HWY_API D operator*(D a, D b) { return {a.low * b.low, a.high * b.high}; }
HWY_API D operator/(D a, D b) { return {a.low / b.low, a.high / b.high}; }
HWY_API D sqrt(D a) { return {hn::Sqrt(a.low), hn::Sqrt(a.high)}; }
HWY_API D load_d(const double* p) { return {hn::LoadU(DTag(), p), hn::LoadU(DTag(), p + kVectorLanes / 2)}; }
HWY_API void store_d(D a, double* p) {
  hn::StoreU(a.low, DTag(), p);
  hn::StoreU(a.high, DTag(), p + kVectorLanes / 2);
}
HWY_API D to_double(F a) {
  const hn::Half<FTag> half;
  return {hn::PromoteTo(DTag(), hn::LowerHalf(half, a)), hn::PromoteTo(DTag(), hn::UpperHalf(half, a))};
}
HWY_API D to_double(I a) {
  const hn::Half<ITag> half;
  return {hn::PromoteTo(DTag(), hn::LowerHalf(half, a)), hn::PromoteTo(DTag(), hn::UpperHalf(half, a))};
}
HWY_API F to_float(D a) {
  const hn::Half<FTag> half;
#if HWY_TARGET == HWY_AVX3
  const __m512 low = _mm512_castps256_ps512(hn::DemoteTo(half, a.low).raw);
  return F{_mm512_insertf32x8(low, hn::DemoteTo(half, a.high).raw, 1)};
#else
  return hn::Combine(FTag(), hn::DemoteTo(half, a.high), hn::DemoteTo(half, a.low));
#endif
}
// |a| < 2^31
HWY_API I truncate_in_range(D a) {
  const hn::Half<ITag> half;
  return hn::Combine(ITag(), hn::DemoteTo(half, a.high), hn::DemoteTo(half, a.low));
}
HWY_API D select(M m, D yes, D no) {
  // The mask's 32-bit lanes, sign-extended.
  const hn::Half<ITag> half;
  const hn::ScalableTag<int64_t> wide;
  const I lanes = as_i(mask_to_u(m));
  const auto low = hn::MaskFromVec(hn::BitCast(DTag(), hn::PromoteTo(wide, hn::LowerHalf(half, lanes))));
  const auto high = hn::MaskFromVec(hn::BitCast(DTag(), hn::PromoteTo(wide, hn::UpperHalf(half, lanes))));
  return {hn::IfThenElse(low, yes.low, no.low), hn::IfThenElse(high, yes.high, no.high)};
}
HWY_API M lt(D a, D b) {
  const auto one = hn::Set(DTag(), 1.0);
  const D ones = {hn::IfThenElseZero(hn::Lt(a.low, b.low), one), hn::IfThenElseZero(hn::Lt(a.high, b.high), one)};
  return {hn::Ne(to_float(ones), hn::Zero(FTag()))};
}
HWY_API M le(D a, D b) {
  const auto one = hn::Set(DTag(), 1.0);
  const D ones = {hn::IfThenElseZero(hn::Le(a.low, b.low), one), hn::IfThenElseZero(hn::Le(a.high, b.high), one)};
  return {hn::Ne(to_float(ones), hn::Zero(FTag()))};
}

// Words of lanes. Vector `index` of a batch holds lanes index * kVectorLanes and up.
HWY_API M mask_of(uint64_t word, int index) {
#if HWY_TARGET == HWY_AVX3
  return {hn::Mask<FTag>{static_cast<__mmask16>(word >> (index * kVectorLanes))}};
#else
  const U bits = broadcast(static_cast<uint32_t>(word >> (index * kVectorLanes)) & ((1u << kVectorLanes) - 1));
  const U lane_bit = shift_left(broadcast(1u), hn::Iota(UTag(), 0));
  return eq(hn::And(bits, lane_bit), lane_bit);
#endif
}
// Bit i of the result is lane i of the vector; the caller shifts it to the vector's place.
HWY_API uint64_t bits_of(M m) {
  uint64_t bits = 0;
  hn::StoreMaskBits(FTag(), m.raw, reinterpret_cast<uint8_t*>(&bits));
  return bits;
}

HWY_API U gather32(const void* base, U byte_offsets, M m) {
#if HWY_TARGET == HWY_AVX3
  return U{_mm512_mask_i32gather_epi32(_mm512_setzero_si512(), m.raw.raw, byte_offsets.raw, base, 1)};
#elif HWY_TARGET == HWY_AVX2
  return U{_mm256_mask_i32gather_epi32(_mm256_setzero_si256(), static_cast<const int*>(base), byte_offsets.raw,
                                       mask_to_u(m).raw, 1)};
#else
  alignas(64) uint32_t lanes[kVectorLanes];
  store(hn::And(byte_offsets, mask_to_u(m)), lanes);
  for (uint64_t bits = bits_of(m), lane = 0; lane < kVectorLanes; ++lane) {
    const uint32_t offset = lanes[lane];
    lanes[lane] = 0;
    if ((bits >> lane & 1) != 0) {
      __builtin_memcpy(&lanes[lane], static_cast<const char*>(base) + offset, 4);
    }
  }
  return load<U>(lanes);
#endif
}
// Byte c of every lane: its c-th operand, 0 where negative, 255 where greater.
HWY_API U pack_bytes(I c0, I c1, I c2, I c3) {
#if HWY_TARGET == HWY_AVX3
  const __m512i words01 = _mm512_packs_epi32(c0.raw, c1.raw);
  const __m512i words23 = _mm512_packs_epi32(c2.raw, c3.raw);
  const __m512i transpose = _mm512_set4_epi32(0x0F0B0703, 0x0E0A0602, 0x0D090501, 0x0C080400);
  return U{_mm512_shuffle_epi8(_mm512_packus_epi16(words01, words23), transpose)};
#elif HWY_TARGET == HWY_AVX2
  const __m256i words01 = _mm256_packs_epi32(c0.raw, c1.raw);
  const __m256i words23 = _mm256_packs_epi32(c2.raw, c3.raw);
  const __m256i transpose = _mm256_broadcastsi128_si256(_mm_set_epi32(0x0F0B0703, 0x0E0A0602, 0x0D090501, 0x0C080400));
  return U{_mm256_shuffle_epi8(_mm256_packus_epi16(words01, words23), transpose)};
#else
  const auto byte = [](I c) { return as_u(min(max(c, broadcast(0)), broadcast(255))); };
  return hn::Or(hn::Or(byte(c0), shift_left<8>(byte(c1))), hn::Or(shift_left<16>(byte(c2)), shift_left<24>(byte(c3))));
#endif
}
// Byte kByte of every lane as a number.
template <int kByte>
HWY_API U byte_of(U a) {
  if constexpr (kByte == 0) return hn::And(a, broadcast(0xFFu));
  if constexpr (kByte == 3) return shift_right<24>(a);
#if HWY_TARGET == HWY_AVX3
  constexpr int b = static_cast<int>(0x80808000u) + kByte;  // 0x80 writes a zero
  return U{_mm512_shuffle_epi8(a.raw, _mm512_set4_epi32(b + 12, b + 8, b + 4, b))};
#elif HWY_TARGET == HWY_AVX2
  constexpr int b = static_cast<int>(0x80808000u) + kByte;
  return U{_mm256_shuffle_epi8(a.raw, _mm256_broadcastsi128_si256(_mm_set_epi32(b + 12, b + 8, b + 4, b)))};
#else
  return hn::And(shift_right<8 * kByte>(a), broadcast(0xFFu));
#endif
}
// The two words at base + offset, in all lanes.
HWY_API void gather_pairs(const void* base, U byte_offsets, U& first, U& second) {
#if HWY_TARGET == HWY_AVX3
  const __m512i low = _mm512_i32gather_epi64(_mm512_castsi512_si256(byte_offsets.raw), base, 1);
  const __m512i high = _mm512_i32gather_epi64(_mm512_extracti64x4_epi64(byte_offsets.raw, 1), base, 1);
  const __m512i even = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
  const __m512i odd = _mm512_setr_epi32(1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31);
  first = U{_mm512_permutex2var_epi32(low, even, high)};
  second = U{_mm512_permutex2var_epi32(low, odd, high)};
#elif HWY_TARGET == HWY_AVX2
  const auto* const pairs = static_cast<const long long*>(base);
  const __m256i low = _mm256_i32gather_epi64(pairs, _mm256_castsi256_si128(byte_offsets.raw), 1);
  const __m256i high = _mm256_i32gather_epi64(pairs, _mm256_extracti128_si256(byte_offsets.raw, 1), 1);
  const __m256 a = _mm256_castsi256_ps(low), b = _mm256_castsi256_ps(high);
  // In each half: two of `low`, two of `high`.
  const __m256i even = _mm256_castps_si256(_mm256_shuffle_ps(a, b, _MM_SHUFFLE(2, 0, 2, 0)));
  const __m256i odd = _mm256_castps_si256(_mm256_shuffle_ps(a, b, _MM_SHUFFLE(3, 1, 3, 1)));
  first = U{_mm256_permute4x64_epi64(even, _MM_SHUFFLE(3, 1, 2, 0))};
  second = U{_mm256_permute4x64_epi64(odd, _MM_SHUFFLE(3, 1, 2, 0))};
#else
  alignas(64) uint32_t offsets[kVectorLanes], pairs[2][kVectorLanes];
  store(byte_offsets, offsets);
  for (int lane = 0; lane < kVectorLanes; ++lane) {
    __builtin_memcpy(&pairs[0][lane], static_cast<const char*>(base) + offsets[lane], 4);
    __builtin_memcpy(&pairs[1][lane], static_cast<const char*>(base) + offsets[lane] + 4, 4);
  }
  first = load<U>(pairs[0]);
  second = load<U>(pairs[1]);
#endif
}
// Within each 2x2 quad: lanes (1, 0, 3, 2) and lanes (2, 3, 0, 1).
HWY_API U swap_columns(U a) { return hn::Shuffle2301(a); }
HWY_API U swap_rows(U a) { return hn::Shuffle1032(a); }
HWY_API U lane_numbers() { return hn::Iota(UTag(), 0); }

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#endif  // per target
