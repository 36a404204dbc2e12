// Reading sampled 2D images, 64 lanes at a time. Specification: chapter "Image Operations".
// Coordinates may be anything (NaN, infinite, huge): memory outside of the view is never touched, and the result is the
// same on every SIMD target. A null view or sampler, and a view without levels, read as 0.
#pragma once

#include <cstdint>

#include "base/simd_dispatch.h"
#include "image/texture.h"

namespace lapilli {

// Where the level of detail comes from (specification: "Scale Factor Operation, LOD Operation and Image Level(s)
// Selection").
enum class LodSource : uint8_t {
  derivatives,  // of u and v in each 2x2 quad of lanes, one level of detail for the whole quad; `lod` is a bias
  operand,      // `lod`
};

// Registers are 64 lanes, 64-byte aligned. They may be the registers of the result too.
struct SampleOperands {
  const float* u = nullptr;  // normalized coordinates, or texels if the sampler is unnormalized
  const float* v = nullptr;
  const float* lod = nullptr;  // null: 0
  LodSource lod_source = LodSource::operand;
  uint64_t lanes = 0;                 // the others keep what the result's registers hold
  const float* reference = nullptr;   // not null: texels become the result of comparing it with their depth, 0 0 1
  const int32_t* offset_x = nullptr;  // texels, added before wrapping; both or none
  const int32_t* offset_y = nullptr;
};

// Texture coordinates of texels: integers, also outside of the image.
struct FetchOperands {
  const int32_t* x = nullptr;
  const int32_t* y = nullptr;
  const int32_t* level = nullptr;  // null: 0
  uint64_t lanes = 0;
};

struct SamplingFunctions {
  // R G B A after the view's swizzle. Filtering is bilinear with full float weights, in each of one or two levels:
  //   row = fma(alpha, right - left, left); result = fma(beta, lower row - upper row, upper row);
  //   two levels: fma(delta, coarser - finer, finer)
  // and alpha = fma(u, width, -0.5) - floor of it, after wrapping u. Formats of four UNORM8 components are filtered as
  // codes 0 … 255 and divided at the end.
  void (*sample_2d)(const TextureView* view, const SamplerState* sampler, const SampleOperands& operands,
                    float* const rgba[4]);
  // texelFetch: 0 0 0 0 (before the swizzle) for coordinates or levels outside of the view.
  void (*fetch_2d)(const TextureView* view, const FetchOperands& operands, float* const rgba[4]);
  // imageStore: nothing for coordinates outside of the view's first level, or for formats that are not stored.
  void (*store_2d)(const TextureView* view, const FetchOperands& operands, const float* const rgba[4]);
  // Where the texels of the view's first level lie, in bytes from its first one; the lanes that have one.
  uint64_t (*find_texels_2d)(const TextureView& view, const FetchOperands& operands, uint32_t* byte_offsets);
  // textureGather: component `component` (after the swizzle) of the four texels that a linear filter would read in the
  // first level: lower left, lower right, upper right, upper left.
  void (*gather_2d)(const TextureView* view, const SamplerState* sampler, const SampleOperands& operands,
                    uint32_t component, float* const texels[4]);
  // textureQueryLod of `operands`: the level that is read, then the level of detail before the sampler's clamp.
  void (*query_lod_2d)(const TextureView* view, const SamplerState* sampler, const SampleOperands& operands,
                       float* level, float* lod);
  // textureSize and textureQueryLevels: width and height are 0 for a level that the view does not have. `level` may be
  // null: 0.
  void (*size_2d)(const TextureView* view, const int32_t* level, uint64_t lanes, int32_t* const size_and_levels[3]);
  // log2 of the larger footprint of a pixel in texels, the same for the lanes of a quad: 0.5 * log2(max(|d/dx|²,
  // |d/dy|²)). -Inf where nothing changes, NaN as 0. Before bias and clamps.
  void (*lod_from_derivatives)(const TextureView& view, const SamplerState& sampler, const float* u, const float* v,
                               float* lod);
};

// For the SIMD target in force, or a given one.
const SamplingFunctions& sampling_functions();
const SamplingFunctions& sampling_functions(SimdTarget target);

}  // namespace lapilli
