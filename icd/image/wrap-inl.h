// From a texture coordinate to the texels it reads along one axis: scale, shift, wrap. Per-target header.
// Specification: "Normalized Texel Coordinate Transform", "Wrapping Operation", "(u,v,w,a) to (i,j,k,l,n)
// Transformation".
//
// The specification wraps integers; here a repeating coordinate loses its whole periods first, while it is still a
// float (exact for s ≥ 0), so that huge coordinates keep what precision they have. NaN and infinity become the lower
// end of the range.
#if defined(LAPILLI_IMAGE_WRAP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LAPILLI_IMAGE_WRAP_INL_H
#undef LAPILLI_IMAGE_WRAP_INL_H
#else
#define LAPILLI_IMAGE_WRAP_INL_H
#endif

#include <vulkan/vulkan_core.h>

#include "base/lanes-inl.h"
#include "image/texture.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {

// One axis of a level under a sampler. Sides are at most 8192, so texel positions have 10 bits of fraction or more.
struct Axis {
  F size;   // texels
  F scale;  // texels of one unit of the coordinate: size, or 1 for unnormalized coordinates
  F last;   // size - 1
  I last_index;
  VkSamplerAddressMode mode;
};

HWY_API Axis make_axis(int32_t size, VkSamplerAddressMode mode, bool unnormalized) {
  const float texels = static_cast<float>(size);
  return {broadcast(texels), broadcast(unnormalized ? 1.0f : texels), broadcast(texels - 1.0f), broadcast(size - 1),
          mode};
}

// A texel on one axis; where not inside, the border is read and `index` is not in the image.
struct NearestTap {
  I index;
  M inside;
};
// Two neighbours: weight 1 - alpha and alpha.
struct LinearTaps {
  I index0;
  I index1;
  M inside0;
  M inside1;
  F alpha;
};

HWY_API F clamp_or_low(F x, F low, F high) { return min(max(low, x), high); }  // NaN: low
HWY_API M index_inside(I index, I count) { return lt(as_u(index), as_u(count)); }

struct WrapRepeat {
  static constexpr bool kBorder = false;

  // In [0, 1): then times size stays below size when rounded.
  HWY_API NearestTap nearest(F s, const Axis& axis) {
    const F fraction = clamp_or_low(s - floor(s), zero_f(), broadcast(0x1.FFFFFEp-1f));
    return {truncate_in_range(fraction * axis.size), all_lanes()};
  }
  HWY_API LinearTaps linear(F s, const Axis& axis) {
    const F fraction = max(zero_f(), s - floor(s));  // 1 for tiny negative s
    const F x = fma(fraction, axis.size, broadcast(-0.5f));
    const F x0 = floor(x);
    const I index0 = as_i(min(as_u(truncate_in_range(x0)), as_u(axis.last_index)));  // -1 and size wrap
    const I index1 = select(lt(index0, axis.last_index), index0 + broadcast(1), zero_i());
    return {index0, index1, all_lanes(), all_lanes(), x - x0};
  }
};

struct WrapMirror {
  static constexpr bool kBorder = false;

  // Two periods to one: position in [0, 2] of which the second half runs backwards.
  HWY_API F fold(F s) { return max(zero_f(), s - broadcast(2.0f) * floor(s * broadcast(0.5f))); }
  // Texel -1 … 2 * size of the unfolded row.
  HWY_API I mirror(F index, const Axis& axis) {
    const F backwards = axis.size + axis.last - index;
    const F folded = select(lt(axis.last, index), backwards, index);
    return truncate_in_range(max(zero_f(), folded));
  }
  HWY_API NearestTap nearest(F s, const Axis& axis) { return {mirror(floor(fold(s) * axis.size), axis), all_lanes()}; }
  HWY_API LinearTaps linear(F s, const Axis& axis) {
    const F x = fma(fold(s), axis.size, broadcast(-0.5f));
    const F x0 = floor(x);
    return {mirror(x0, axis), mirror(x0 + broadcast(1.0f), axis), all_lanes(), all_lanes(), x - x0};
  }
};

struct WrapClampToEdge {
  static constexpr bool kBorder = false;

  HWY_API NearestTap nearest(F s, const Axis& axis) {
    return {truncate_in_range(clamp_or_low(s * axis.scale, zero_f(), axis.last)), all_lanes()};
  }
  // Clamping the position does what clamping both indices does: beyond the outer texel centres both are the same texel.
  HWY_API LinearTaps linear(F s, const Axis& axis) {
    const F x = clamp_or_low(fma(s, axis.scale, broadcast(-0.5f)), zero_f(), axis.last);
    const I index0 = truncate_in_range(x);
    const F x0 = to_float(index0);
    const I index1 = min(index0 + broadcast(1), axis.last_index);
    return {index0, index1, all_lanes(), all_lanes(), x - x0};
  }
};

struct WrapClampToBorder {
  static constexpr bool kBorder = true;

  HWY_API NearestTap nearest(F s, const Axis& axis) {
    const I index = truncate_in_range(floor(clamp_or_low(s * axis.scale, broadcast(-1.0f), axis.size)));
    return {index, index_inside(index, truncate_in_range(axis.size))};
  }
  HWY_API LinearTaps linear(F s, const Axis& axis) {
    const F x = clamp_or_low(fma(s, axis.scale, broadcast(-0.5f)), broadcast(-1.0f), axis.size);
    const F x0 = floor(x);
    const I index0 = truncate_in_range(x0);
    const I index1 = index0 + broadcast(1);
    const I count = truncate_in_range(axis.size);
    return {index0, index1, index_inside(index0, count), index_inside(index1, count), x - x0};
  }
};

// Chosen at run time; what is not one of the four above clamps to the edge.
struct WrapAny {
  static constexpr bool kBorder = true;

  HWY_API NearestTap nearest(F s, const Axis& axis) {
    switch (axis.mode) {
      case VK_SAMPLER_ADDRESS_MODE_REPEAT:
        return WrapRepeat::nearest(s, axis);
      case VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT:
        return WrapMirror::nearest(s, axis);
      case VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER:
        return WrapClampToBorder::nearest(s, axis);
      default:
        return WrapClampToEdge::nearest(s, axis);
    }
  }
  HWY_API LinearTaps linear(F s, const Axis& axis) {
    switch (axis.mode) {
      case VK_SAMPLER_ADDRESS_MODE_REPEAT:
        return WrapRepeat::linear(s, axis);
      case VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT:
        return WrapMirror::linear(s, axis);
      case VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER:
        return WrapClampToBorder::linear(s, axis);
      default:
        return WrapClampToEdge::linear(s, axis);
    }
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#endif  // per target
