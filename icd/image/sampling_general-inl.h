// Reading one mip level in every way that is not hot: any format, texel offsets, depth comparison, gathers. Each step
// is done for the whole batch, and the format is known to one function alone. Per-target header, for sampling.cpp.
// Specification: "Wrapping Operation", "Texel Replacement", "Depth Compare Operation", "Texel Filtering".
#if defined(LAPILLI_IMAGE_SAMPLING_GENERAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LAPILLI_IMAGE_SAMPLING_GENERAL_INL_H
#undef LAPILLI_IMAGE_SAMPLING_GENERAL_INL_H
#else
#define LAPILLI_IMAGE_SAMPLING_GENERAL_INL_H
#endif

#include <array>

#include "image/compare-inl.h"
#include "image/sampling-inl.h"
#include "image/texel.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {

extern const std::array<TexelFunctions, kFormatCount> kTexelTable;  // texel.cpp

struct Registers {
  alignas(64) float lane[4][kLanes];
  float* const rgba[4] = {lane[0], lane[1], lane[2], lane[3]};
};

// Upper left and right, lower left and right texel of a footprint; nearest texels are the first.
struct Footprints {
  alignas(64) uint32_t offset[4][kLanes];  // bytes, in the level
  uint64_t inside[4];                      // lanes whose texel is in the level
  alignas(64) float alpha[kLanes];         // weights of the right column and the lower row
  alignas(64) float beta[kLanes];
};

// A coordinate in texels, before wrapping; whole periods are gone, so that it is small. NaN: the lower end.
HWY_API F texel_position(F s, const Axis& axis) {
  constexpr float kFar = 32768.0f;  // beyond every level and texel offset
  switch (axis.mode) {
    case VK_SAMPLER_ADDRESS_MODE_REPEAT:
      return clamp_or_low(s - floor(s), zero_f(), broadcast(0x1.FFFFFEp-1f)) * axis.size;
    case VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT:
      return WrapMirror::fold(s) * axis.size;
    default:
      return clamp_or_low(s * axis.scale, broadcast(-kFar), broadcast(kFar));
  }
}

// Of integers below 2^17 in magnitude; exact.
HWY_API F positive_remainder(F index, F period) { return index - period * floor(index / period); }

HWY_API NearestTap wrap_texel(F index, const Axis& axis) {
  switch (axis.mode) {
    case VK_SAMPLER_ADDRESS_MODE_REPEAT:
      return {truncate_in_range(positive_remainder(index, axis.size)), all_lanes()};
    case VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT: {
      const F unfolded = positive_remainder(index, axis.size + axis.size);
      return {truncate_in_range(min(unfolded, axis.size + axis.last - unfolded)), all_lanes()};
    }
    case VK_SAMPLER_ADDRESS_MODE_MIRROR_CLAMP_TO_EDGE:
      return {truncate_in_range(min(max(index, broadcast(-1.0f) - index), axis.last)), all_lanes()};
    case VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER: {
      const F clamped = clamp_or_low(index, zero_f(), axis.last);
      return {truncate_in_range(clamped), eq(clamped, index)};
    }
    default:
      return {truncate_in_range(clamp_or_low(index, zero_f(), axis.last)), all_lanes()};
  }
}

HWY_API F offset_of_texels(const int32_t* offset, int first) {
  constexpr int32_t kFar = 32768;
  if (offset == nullptr) return zero_f();
  return to_float(min(max(load<I>(offset + first), broadcast(-kFar)), broadcast(kFar)));
}

// Where the texels lie: of the nearest filter, or of the linear one.
inline HWY_NOINLINE void find_footprints(const LevelJob& job, bool linear, uint64_t lanes, Footprints& out) {
  const TextureLevel& level = *job.level;
  const Axis x_axis = make_axis(level.width, job.sampler->address_u, job.sampler->unnormalized);
  const Axis y_axis = make_axis(level.height, job.sampler->address_v, job.sampler->unnormalized);
  const F to_corner = broadcast(linear ? -0.5f : 0.0f);
  const I row_pitch = broadcast(level.row_pitch);
  const I texel_size = broadcast(static_cast<int32_t>(job.format->texel_size));
  for (uint64_t& inside : out.inside) inside = 0;
  for (int vector = 0; vector < kVectorsPerBatch; ++vector) {
    const int first = vector * kVectorLanes;
    const F x = texel_position(load<F>(job.u + first), x_axis) + to_corner;
    const F y = texel_position(load<F>(job.v + first), y_axis) + to_corner;
    const F x0 = floor(x), y0 = floor(y);
    store(x - x0, out.alpha + first);
    store(y - y0, out.beta + first);
    const F x_moved = x0 + offset_of_texels(job.offset_x, first), y_moved = y0 + offset_of_texels(job.offset_y, first);
    const M live = mask_of(lanes, vector);
    for (int tap = 0; tap < (linear ? 4 : 1); ++tap) {
      const NearestTap column = wrap_texel(x_moved + broadcast(static_cast<float>(tap & 1)), x_axis);
      const NearestTap row = wrap_texel(y_moved + broadcast(static_cast<float>(tap >> 1)), y_axis);
      store(as_u(row.index * row_pitch + column.index * texel_size), out.offset[tap] + first);
      out.inside[tap] |= bits_of(live & column.inside & row.inside) << first;
    }
  }
}

// The texels of one tap as the filter sees them: the border outside, with a reference the result of the comparison.
inline HWY_NOINLINE void read_tap(const LevelJob& job, const Footprints& where, int tap, uint64_t lanes,
                                  Registers& out) {
  kTexelTable[job.format->index].load_gathered(job.level->data, where.offset[tap], where.inside[tap], out.rgba);
  const uint64_t outside = lanes & ~where.inside[tap];
  if (outside != 0) {
    for (size_t c = 0; c < 4; ++c) {
      if (job.format->components[c].kind == ComponentKind::none) continue;
      const F border = as_f(broadcast(job.sampler->border[c]));
      for (int i = 0; i < kVectorsPerBatch; ++i) {
        float* const at = out.lane[c] + i * kVectorLanes;
        store(select(mask_of(outside, i), border, load<F>(at)), at);
      }
    }
  }
  if (job.reference == nullptr) return;
  // Fixed-point depth lies in [0, 1], and so does what it is compared with.
  const bool fixed_point = job.format->components[0].kind == ComponentKind::unorm;
  for (int i = 0; i < kLanes; i += kVectorLanes) {
    F reference = load<F>(job.reference + i);
    if (fixed_point) reference = clamp_or_low(reference, zero_f(), broadcast(1.0f));
    const M passed = compare_depth(static_cast<uint32_t>(job.sampler->compare_op), reference, load<F>(out.lane[0] + i));
    store(select(passed, broadcast(1.0f), zero_f()), out.lane[0] + i);
    store(zero_f(), out.lane[1] + i);
    store(zero_f(), out.lane[2] + i);
    store(broadcast(1.0f), out.lane[3] + i);
  }
}

// LevelFunctions, like those of LevelReader.
inline void general_nearest(const LevelJob& job, uint64_t lanes, float* const rgba[4]) {
  Footprints where;
  Registers texels;
  find_footprints(job, false, lanes, where);
  read_tap(job, where, 0, lanes, texels);
  for (int c = 0; c < 4; ++c) copy_lanes(texels.lane[c], lanes, rgba[c]);
}

inline void general_linear(const LevelJob& job, uint64_t lanes, float* const rgba[4]) {
  Footprints where;
  Registers tap[4];
  find_footprints(job, true, lanes, where);
  for (int t = 0; t < 4; ++t) read_tap(job, where, t, lanes, tap[t]);
  for (int c = 0; c < 4; ++c) {
    for (int i = 0; i < kVectorsPerBatch; ++i) {
      const int first = i * kVectorLanes;
      const F alpha = load<F>(where.alpha + first), beta = load<F>(where.beta + first);
      const F left = load<F>(tap[0].lane[c] + first), lower_left = load<F>(tap[2].lane[c] + first);
      const F upper = fma(alpha, load<F>(tap[1].lane[c] + first) - left, left);
      const F lower = fma(alpha, load<F>(tap[3].lane[c] + first) - lower_left, lower_left);
      store_where(mask_of(lanes, i), fma(beta, lower - upper, upper), rgba[c] + first);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#endif  // per target
