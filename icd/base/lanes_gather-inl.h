// Reading a few words in a row for each lane: AVX-512 gathers pairs of words (measured twice as fast as loading rows),
// the others load a row for each lane and transpose.
// Per-target header.
#if defined(LAPILLI_BASE_LANES_GATHER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LAPILLI_BASE_LANES_GATHER_INL_H
#undef LAPILLI_BASE_LANES_GATHER_INL_H
#else
#define LAPILLI_BASE_LANES_GATHER_INL_H
#endif

#include "base/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_SCALAR

// Three or four words; with three the fourth is any.
template <size_t kWords>
HWY_API __m128i load_row(const char* p) {
  if constexpr (kWords == 4) return _mm_loadu_si128(reinterpret_cast<const __m128i*>(p));
  return _mm_unpacklo_epi64(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p)), _mm_loadu_si32(p + 8));
}

#if HWY_TARGET == HWY_AVX2
// Row j of the lanes j and j + 4.
template <size_t kWords>
HWY_API __m256i load_rows(const char* base, const uint32_t* offsets) {
  return _mm256_inserti128_si256(_mm256_castsi128_si256(load_row<kWords>(base + offsets[0])),
                                 load_row<kWords>(base + offsets[4]), 1);
}
#define LAPILLI_UNPACK(part, a, b) _mm256_unpack##part(a, b)
using Rows = __m256i;
#else
template <size_t kWords>
HWY_API __m128i load_rows(const char* base, const uint32_t* offsets) {
  return load_row<kWords>(base + offsets[0]);
}
#define LAPILLI_UNPACK(part, a, b) _mm_unpack##part(a, b)
using Rows = __m128i;
#endif

// words[w] := the word at base + offset + 4 * w, in all lanes. kWords: 2, 3 or 4.
template <size_t kWords>
HWY_API void gather_words(const void* base, U byte_offsets, U* words) {
  if constexpr (kWords == 2) {
    gather_pairs(base, byte_offsets, words[0], words[1]);
  } else {
    const char* const bytes = static_cast<const char*>(base);
    alignas(64) uint32_t offsets[kVectorLanes];
    store(byte_offsets, offsets);
    __asm__("" : "+m"(offsets));  // g++ would take the offsets out of the vector, an instruction or two for each
    const Rows r0 = load_rows<kWords>(bytes, offsets);
    const Rows r1 = load_rows<kWords>(bytes, offsets + 1);
    const Rows r2 = load_rows<kWords>(bytes, offsets + 2);
    const Rows r3 = load_rows<kWords>(bytes, offsets + 3);
    const Rows low01 = LAPILLI_UNPACK(lo_epi32, r0, r1);
    const Rows low23 = LAPILLI_UNPACK(lo_epi32, r2, r3);
    const Rows high01 = LAPILLI_UNPACK(hi_epi32, r0, r1);
    const Rows high23 = LAPILLI_UNPACK(hi_epi32, r2, r3);
    words[0] = U{LAPILLI_UNPACK(lo_epi64, low01, low23)};
    words[1] = U{LAPILLI_UNPACK(hi_epi64, low01, low23)};
    words[2] = U{LAPILLI_UNPACK(lo_epi64, high01, high23)};
    if constexpr (kWords == 4) words[3] = U{LAPILLI_UNPACK(hi_epi64, high01, high23)};
  }
}
#undef LAPILLI_UNPACK

#else

template <size_t kWords>
HWY_API void gather_words(const void* base, U byte_offsets, U* words) {
  const char* const second = static_cast<const char*>(base) + 8;
  gather_pairs(base, byte_offsets, words[0], words[1]);
  if constexpr (kWords == 3) words[2] = gather32(second, byte_offsets, all_lanes());
  if constexpr (kWords == 4) gather_pairs(second, byte_offsets, words[2], words[3]);
}

#endif

// table[index] of 16 floats or doubles, 64-byte aligned; every index is below 16.
HWY_API F lookup16(const float* table, U index) {
#if HWY_TARGET == HWY_AVX3
  return F{_mm512_permutexvar_ps(index.raw, _mm512_load_ps(table))};
#elif HWY_TARGET == HWY_AVX2
  const __m256 low = _mm256_permutevar8x32_ps(_mm256_load_ps(table), index.raw);
  const __m256 high = _mm256_permutevar8x32_ps(_mm256_load_ps(table + 8), index.raw);
  return F{_mm256_blendv_ps(low, high, _mm256_castsi256_ps(_mm256_slli_epi32(index.raw, 28)))};
#else
  alignas(64) uint32_t lanes[kVectorLanes];
  store(index, lanes);
  for (uint32_t& lane : lanes) __builtin_memcpy(&lane, table + lane, 4);
  return load<F>(lanes);
#endif
}
HWY_API D lookup16(const double* table, U index) {
#if HWY_TARGET == HWY_AVX3
  const __m512d first = _mm512_load_pd(table), second = _mm512_load_pd(table + 8);
  const __m512i low = _mm512_cvtepu32_epi64(_mm512_castsi512_si256(index.raw));
  const __m512i high = _mm512_cvtepu32_epi64(_mm512_extracti64x4_epi64(index.raw, 1));
  return {hn::Vec<DTag>{_mm512_permutex2var_pd(first, low, second)},
          hn::Vec<DTag>{_mm512_permutex2var_pd(first, high, second)}};
#elif HWY_TARGET == HWY_AVX2
  return {hn::Vec<DTag>{_mm256_i32gather_pd(table, _mm256_castsi256_si128(index.raw), 8)},
          hn::Vec<DTag>{_mm256_i32gather_pd(table, _mm256_extracti128_si256(index.raw, 1), 8)}};
#else
  alignas(64) uint32_t lanes[kVectorLanes];
  alignas(64) double values[kVectorLanes];
  store(index, lanes);
  for (int lane = 0; lane < kVectorLanes; ++lane) values[lane] = table[lanes[lane]];
  return load_d(values);
#endif
}

// The 16 bytes at each of the pointers, one for each four lanes.
HWY_API U load_quads(const void* const* quads) {
#if HWY_TARGET == HWY_AVX3
  __m512i v = _mm512_castsi128_si512(_mm_loadu_si128(static_cast<const __m128i*>(quads[0])));
  v = _mm512_inserti32x4(v, _mm_loadu_si128(static_cast<const __m128i*>(quads[1])), 1);
  v = _mm512_inserti32x4(v, _mm_loadu_si128(static_cast<const __m128i*>(quads[2])), 2);
  return U{_mm512_inserti32x4(v, _mm_loadu_si128(static_cast<const __m128i*>(quads[3])), 3)};
#elif HWY_TARGET == HWY_AVX2
  const __m256i v = _mm256_castsi128_si256(_mm_loadu_si128(static_cast<const __m128i*>(quads[0])));
  return U{_mm256_inserti128_si256(v, _mm_loadu_si128(static_cast<const __m128i*>(quads[1])), 1)};
#else
  return load_unaligned<U>(quads[0]);
#endif
}
// Stores those of four words, 16 bytes aligned, whose bit is set; touches no others.
HWY_API void store_quad(const uint32_t* words, uint32_t lanes, void* quad) {
#if HWY_TARGET == HWY_AVX3
  _mm_mask_storeu_epi32(quad, static_cast<__mmask8>(lanes), _mm_load_si128(reinterpret_cast<const __m128i*>(words)));
#else
  if (lanes == 15) {
    __builtin_memcpy(quad, words, 16);
    return;
  }
  for (int lane = 0; lane < 4; ++lane) {
    if ((lanes >> lane & 1) != 0) __builtin_memcpy(static_cast<char*>(quad) + 4 * lane, words + lane, 4);
  }
#endif
}

// gather_words where m is set; the other lanes become 0 and read what a lane of m reads.
template <size_t kWords>
HWY_API void gather_words(const void* base, U byte_offsets, M m, U* words) {
  if (all(m)) return gather_words<kWords>(base, byte_offsets, words);
  const uint64_t live = bits_of(m);
  if (live == 0) {
    for (size_t w = 0; w < kWords; ++w) words[w] = zero_u();
    return;
  }
  alignas(64) uint32_t offsets[kVectorLanes];
  store(byte_offsets, offsets);
  const U somewhere = broadcast(offsets[__builtin_ctzll(live)]);
  gather_words<kWords>(base, select(m, byte_offsets, somewhere), words);
  words[0] = words[0] & mask_to_u(m);  // a loop would stay one at -O2, and keep the vectors in memory
  words[1] = words[1] & mask_to_u(m);
  if constexpr (kWords > 2) words[2] = words[2] & mask_to_u(m);
  if constexpr (kWords > 3) words[3] = words[3] & mask_to_u(m);
}

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#endif  // per target
