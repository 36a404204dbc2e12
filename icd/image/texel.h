// Texels to lanes and back, 64 at a time: one set of functions for each format, compiled for each SIMD target.
// Resolve it once, when a program is built; the functions hold no format switch. Specification: "Formats", numeric
// formats.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/simd_dispatch.h"
#include "image/format.h"

namespace lapilli {

// Where the quads of a batch lie in a plane (tile.h).
struct QuadPlaces {
  const uint16_t* quad;  // 16 of them; quad q holds texels 4q … 4q+3
  // quad[i] is quad[0] + i, and all of them may be read: 64 texels in a row.
  bool whole_block = false;
};

// result = fma(destination, destination factor, source * source factor), where a factor is fma(source alpha, slope,
// offset) and the source is clamped to [0, 1] first, a NaN to 0. Slopes are -1, 0 or 1. [0]: R G B, [1]: A.
struct BlendEquation {
  struct Factor {
    float slope, offset;
  };
  Factor source[2], destination[2];
  uint32_t components;  // those that are written
  bool same_color;      // R G B of the source are known to be the same in all lanes
  bool over;            // the factors are source alpha, one minus it; one, one minus it; and all is added
};

// Registers are 64 floats (or integers' bits), 64-byte aligned; a null register of a load is not written. Lane i is bit
// i of `lanes`. Lanes 4q … 4q+3 are the four texels of places.quad[q], which is touched only where one of its lanes is
// set (or in a whole block), and written in the lanes that are set only.
//   UNORM: c / (2^b - 1), correctly rounded; stored: clamped to [0, 1], NaN as 0, times 2^b - 1, to the nearest
//   integer, half to even. SNORM: max(c / (2^(b-1) - 1), -1), and back alike. A NaN stored as a float becomes
//   0x7FC00000 (0x7E00 in 16 bits), an integer keeps its lowest bits. Components that the format lacks load as 0, alpha
//   as 1.
// The functions on quads are null for formats of no attachment.
struct TexelFunctions {
  // Blends registers of a source colour into the texels. Formats of four UNORM8 components; null for others.
  void (*blend_quads)(std::byte* plane, const QuadPlaces& places, uint64_t lanes, const float* const source[4],
                      const BlendEquation& equation);
  // Lanes outside of `lanes` get some value.
  void (*load_quads)(const std::byte* plane, const QuadPlaces& places, uint64_t lanes, float* const registers[4]);
  // Changes the components whose bit is set in `components` (1 R, 2 G, 4 B, 8 A), in the lanes of `lanes`.
  void (*store_quads)(std::byte* plane, const QuadPlaces& places, uint64_t lanes, const float* const registers[4],
                      uint32_t components);
  // The same for whole texels anywhere: base + byte_offsets[lane] (below 2^31), in the order of the lanes.
  void (*store_scattered)(std::byte* base, const uint32_t* byte_offsets, uint64_t lanes,
                          const float* const registers[4]);
  // Texels at base + byte_offsets[lane] (below 2^31, any alignment). Other lanes: 0 0 0 1, and their memory is not
  // touched.
  void (*load_gathered)(const std::byte* base, const uint32_t* byte_offsets, uint64_t lanes, float* const registers[4]);
};

// `format` from find_format(), for the SIMD target in force or a given one.
const TexelFunctions& texel_functions(const FormatInfo& format);
const TexelFunctions& texel_functions(const FormatInfo& format, SimdTarget target);

}  // namespace lapilli
