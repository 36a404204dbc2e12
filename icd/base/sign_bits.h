// The sign bits of 64 integers as one mask word, with instructions that every x86-64 has.
#pragma once

#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace lapilli {

// Bit i is set where values[i] < 0. 16-byte aligned.
inline uint64_t sign_bits(const int32_t (&values)[64]) {
  uint64_t bits = 0;
#if defined(__SSE2__)
  for (int i = 0; i < 64; i += 16) {
    const __m128i* v = reinterpret_cast<const __m128i*>(values + i);
    // Saturating packs keep the sign: 16 words become 16 bytes.
    const __m128i low = _mm_packs_epi32(_mm_load_si128(v), _mm_load_si128(v + 1));
    const __m128i high = _mm_packs_epi32(_mm_load_si128(v + 2), _mm_load_si128(v + 3));
    bits |= static_cast<uint64_t>(static_cast<uint32_t>(_mm_movemask_epi8(_mm_packs_epi16(low, high)))) << i;
  }
#else
  for (int i = 0; i < 64; ++i) bits |= static_cast<uint64_t>(values[i] < 0) << i;
#endif
  return bits;
}

}  // namespace lapilli
