// Signed 24.8 fixed point for window coordinates: 8 subpixel bits (VkPhysicalDeviceLimits::subPixelPrecisionBits).
#pragma once

#include <cstdint>

namespace lapilli {

inline constexpr int kSubpixelBits = 8;
inline constexpr std::int32_t kSubpixelOne = 1 << kSubpixelBits;  // one pixel
inline constexpr std::int32_t kSubpixelHalf = kSubpixelOne / 2;   // a pixel's centre from its corner
inline constexpr std::int32_t kSubpixelMask = kSubpixelOne - 1;
inline constexpr float kSnapLimit = 8388608.0f;  // pixels, 2^23

struct Snapped {
  std::int32_t value;  // 24.8
  bool valid;          // false: NaN (value 0), or beyond ±2^23 pixels (value saturated)
};

// v pixels to the nearest 1/256, ties to even.
inline Snapped snap(float v) {
  // At or above the upper limit the product does not fit; the lower limit itself does.
  if (!(v < kSnapLimit)) return {v >= kSnapLimit ? INT32_MAX : 0, false};
  if (v < -kSnapLimit) return {INT32_MIN, false};
  // The product is exact. Adding 1.5 · 2^52 leaves no bits below 1, so that the sum is rounded to an integer.
  constexpr double kRound = 6755399441055744.0;
  const double rounded = static_cast<double>(v) * kSubpixelOne + kRound;
  return {static_cast<std::int32_t>(rounded - kRound), true};
}

constexpr float fixed_to_float(std::int32_t fixed) {
  return static_cast<float>(fixed) * (1.0f / static_cast<float>(kSubpixelOne));
}
constexpr double fixed_to_double(std::int32_t fixed) { return fixed * (1.0 / kSubpixelOne); }
// The pixel that holds the point, toward -∞.
constexpr std::int32_t fixed_floor(std::int32_t fixed) { return fixed >> kSubpixelBits; }
constexpr std::int32_t fixed_ceil(std::int32_t fixed) {
  return static_cast<std::int32_t>((std::int64_t{fixed} + kSubpixelMask) >> kSubpixelBits);
}
// The position within the pixel, 0 … 255.
constexpr std::int32_t fixed_fraction(std::int32_t fixed) { return fixed & kSubpixelMask; }
// |pixel| ≤ 2^23 - 1
constexpr std::int32_t pixel_to_fixed(std::int32_t pixel) { return pixel * kSubpixelOne; }
constexpr std::int32_t pixel_center(std::int32_t pixel) { return pixel * kSubpixelOne + kSubpixelHalf; }

}  // namespace lapilli
