// Reading one mip level with the nearest or the bilinear filter, for one format and kind of wrapping. Per-target
// header. Specification: "Texel Filtering". The equations are stated in sampling.h.
#if defined(LAPILLI_IMAGE_SAMPLING_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LAPILLI_IMAGE_SAMPLING_INL_H
#undef LAPILLI_IMAGE_SAMPLING_INL_H
#else
#define LAPILLI_IMAGE_SAMPLING_INL_H
#endif

#include "base/lanes-inl.h"
#include "image/sampling.h"
#include "image/texel-inl.h"
#include "image/wrap-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {

struct LevelJob {
  const TextureLevel* level;
  const SamplerState* sampler;
  const float* u;
  const float* v;
  // For sampling_general-inl.h alone.
  const FormatInfo* format = nullptr;
  const float* reference = nullptr;
  const int32_t* offset_x = nullptr;
  const int32_t* offset_y = nullptr;
};

// Writes the lanes of `m`; the others keep their value.
HWY_API void store_where(M m, F value, float* target) {
  store(all(m) ? value : select(m, value, load<F>(target)), target);
}

inline void copy_lanes(const float* source, uint64_t lanes, float* target) {
  for (int vector = 0; vector < kVectorsPerBatch; ++vector) {
    const int first = vector * kVectorLanes;
    store_where(mask_of(lanes, vector), load<F>(source + first), target + first);
  }
}

template <size_t kFormat>
struct LevelReader {
  using T = Texel<kFormat>;

  // Components that the format has not are constants, whatever the texel or the border.
  static constexpr bool present(int c) { return T::component(c).kind != ComponentKind::none; }

  // Byte offsets; below 2^31, see TextureLevel.
  HWY_API U offset_of(I row_offset, I x) {
    return as_u(row_offset + x * broadcast(static_cast<int32_t>(T::kInfo.texel_size)));
  }

  // What filters work on: a code of UNORM8, otherwise the value.
  template <int c>
  HWY_API F filtered_value(const U* texel) {
    const F code = T::template decode_code<c>(texel);
    return T::kFiltersCodes ? code : T::template finish_code<c>(code);
  }
  template <int c>
  HWY_API F border_value(const SamplerState& sampler) {
    const F border = as_f(broadcast(sampler.border[c]));
    return T::kFiltersCodes ? border * broadcast(255.0f) : border;
  }

  template <int c>
  HWY_API F or_border(F value, M inside, const SamplerState& sampler) {
    return present(c) ? select(inside, value, as_f(broadcast(sampler.border[c]))) : value;
  }

  static void nearest(const LevelJob& job, uint64_t lanes, float* const rgba[4]) {
    const TextureLevel& level = *job.level;
    const Axis x_axis = make_axis(level.width, job.sampler->address_u, job.sampler->unnormalized);
    const Axis y_axis = make_axis(level.height, job.sampler->address_v, job.sampler->unnormalized);
    const I row_pitch = broadcast(level.row_pitch);
    for (int vector = 0; vector < kVectorsPerBatch; ++vector) {
      const M live = mask_of(lanes, vector);
      if (!any(live)) continue;
      const int first = vector * kVectorLanes;
      const NearestTap x = WrapAny::nearest(load<F>(job.u + first), x_axis);
      const NearestTap y = WrapAny::nearest(load<F>(job.v + first), y_axis);
      const M inside = x.inside & y.inside;
      U texel[T::kWords];
      T::gather(level.data, offset_of(y.index * row_pitch, x.index), inside, texel);
      F value[4];
      T::decode(texel, value);
      store_where(live, or_border<0>(value[0], inside, *job.sampler), rgba[0] + first);
      store_where(live, or_border<1>(value[1], inside, *job.sampler), rgba[1] + first);
      store_where(live, or_border<2>(value[2], inside, *job.sampler), rgba[2] + first);
      store_where(live, or_border<3>(value[3], inside, *job.sampler), rgba[3] + first);
    }
  }

  // Four texels: upper left and right, lower left and right.
  struct Footprint {
    U texel[4][T::kWords];
    M inside[4];
    F alpha;
    F beta;
  };

  template <class Wrap, int c>
  HWY_API F corner(const Footprint& footprint, int index, const SamplerState& sampler) {
    const F value = filtered_value<c>(footprint.texel[index]);
    return Wrap::kBorder ? select(footprint.inside[index], value, border_value<c>(sampler)) : value;
  }

  template <class Wrap, int c>
  HWY_API F linear_component(const Footprint& footprint, const SamplerState& sampler) {
    if constexpr (!present(c)) return T::template decode_code<c>(footprint.texel[0]);
    const F upper_left = corner<Wrap, c>(footprint, 0, sampler);
    const F upper_right = corner<Wrap, c>(footprint, 1, sampler);
    const F lower_left = corner<Wrap, c>(footprint, 2, sampler);
    const F lower_right = corner<Wrap, c>(footprint, 3, sampler);
    const F upper = fma(footprint.alpha, upper_right - upper_left, upper_left);
    const F lower = fma(footprint.alpha, lower_right - lower_left, lower_left);
    const F value = fma(footprint.beta, lower - upper, upper);
    return T::kFiltersCodes ? unorm8_between_to_float(value) : value;
  }

  template <class Wrap>
  static void linear(const LevelJob& job, uint64_t lanes, float* const rgba[4]) {
    const TextureLevel& level = *job.level;
    const Axis x_axis = make_axis(level.width, job.sampler->address_u, job.sampler->unnormalized);
    const Axis y_axis = make_axis(level.height, job.sampler->address_v, job.sampler->unnormalized);
    const I row_pitch = broadcast(level.row_pitch);
    for (int vector = 0; vector < kVectorsPerBatch; ++vector) {
      const M live = mask_of(lanes, vector);
      if (!any(live)) continue;
      const int first = vector * kVectorLanes;
      const LinearTaps x = Wrap::linear(load<F>(job.u + first), x_axis);
      const LinearTaps y = Wrap::linear(load<F>(job.v + first), y_axis);
      const I upper = y.index0 * row_pitch;
      const I lower = y.index1 * row_pitch;
      Footprint footprint = {
          {},
          {x.inside0 & y.inside0, x.inside1 & y.inside0, x.inside0 & y.inside1, x.inside1 & y.inside1},
          x.alpha,
          y.alpha};
      // Nearly always the left and the right texel are neighbours in memory: half as many reads.
      if (T::kWords == 1 && !Wrap::kBorder && all(eq(x.index1, x.index0 + broadcast(1)))) {
        gather_pairs(level.data, offset_of(upper, x.index0), footprint.texel[0][0], footprint.texel[1][0]);
        gather_pairs(level.data, offset_of(lower, x.index0), footprint.texel[2][0], footprint.texel[3][0]);
      } else {
        T::gather(level.data, offset_of(upper, x.index0), footprint.inside[0], footprint.texel[0]);
        T::gather(level.data, offset_of(upper, x.index1), footprint.inside[1], footprint.texel[1]);
        T::gather(level.data, offset_of(lower, x.index0), footprint.inside[2], footprint.texel[2]);
        T::gather(level.data, offset_of(lower, x.index1), footprint.inside[3], footprint.texel[3]);
      }
      store_where(live, linear_component<Wrap, 0>(footprint, *job.sampler), rgba[0] + first);
      store_where(live, linear_component<Wrap, 1>(footprint, *job.sampler), rgba[1] + first);
      store_where(live, linear_component<Wrap, 2>(footprint, *job.sampler), rgba[2] + first);
      store_where(live, linear_component<Wrap, 3>(footprint, *job.sampler), rgba[3] + first);
    }
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#endif  // per target
