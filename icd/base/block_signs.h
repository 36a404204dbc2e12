// The signs of a linear function over an 8x8 block of pixels as one mask word, with instructions that every x86-64 has.
#pragma once

#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace lapilli {

// Bit 4*q + s is set where origin + a*x + b*y < 0 at pixel x = 2*(q%4) + (s&1), y = 2*(q/4) + (s>>1). Nothing may
// overflow.
inline uint64_t negative_in_block(int32_t origin, int32_t a, int32_t b) {
  uint64_t bits = 0;
#if defined(__SSE2__)
  const __m128i step_x = _mm_set1_epi32(2 * a);
  const __m128i step_y = _mm_set1_epi32(2 * b);
  __m128i row = _mm_add_epi32(_mm_set1_epi32(origin), _mm_setr_epi32(0, a, b, a + b));
  for (int i = 0; i < 64; i += 16) {
    const __m128i quad1 = _mm_add_epi32(row, step_x);
    const __m128i quad2 = _mm_add_epi32(quad1, step_x);
    const __m128i quad3 = _mm_add_epi32(quad2, step_x);
    // Saturating packs keep the sign: 16 words become 16 bytes.
    const __m128i bytes = _mm_packs_epi16(_mm_packs_epi32(row, quad1), _mm_packs_epi32(quad2, quad3));
    bits |= static_cast<uint64_t>(static_cast<uint32_t>(_mm_movemask_epi8(bytes))) << i;
    row = _mm_add_epi32(row, step_y);
  }
#else
  for (int32_t lane = 0; lane < 64; ++lane) {
    const int32_t x = lane / 4 % 4 * 2 + (lane & 1);
    const int32_t y = lane / 16 * 2 + (lane >> 1 & 1);
    bits |= static_cast<uint64_t>(origin + a * x + b * y < 0) << lane;
  }
#endif
  return bits;
}

}  // namespace lapilli
