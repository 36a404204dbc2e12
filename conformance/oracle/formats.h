// Numeric formats in float64: components of equal size in order, from the lowest byte on. Specification: "Formats",
// "Fixed-Point Data Conversions"; 16-bit floats are IEEE binary16.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace lapilli::oracle {

enum class Number { kUnorm, kSnorm, kUint, kSint, kFloat };

struct Format {
  Number kind;
  unsigned bits, components;  // of each component; how many
  unsigned bytes() const { return bits / 8 * components; }
  bool integer() const { return kind == Number::kUint || kind == Number::kSint; }
};

inline double half_to_double(uint32_t half) {
  const double sign = (half & 0x8000) != 0 ? -1 : 1, fraction = half & 1023;
  const int exponent = int(half >> 10 & 31);
  if (exponent == 31) return fraction != 0 ? NAN : sign * INFINITY;
  return sign * std::ldexp(exponent == 0 ? fraction : 1024 + fraction, std::max(exponent, 1) - 25);
}

// The half that is nearest, of all there are; the even one of two.
inline uint32_t double_to_half(double value) {
  const uint32_t sign = std::signbit(value) ? 0x8000 : 0;
  const double magnitude = std::abs(value);
  if (magnitude >= 65520) return sign | 0x7C00;
  uint32_t low = 0, high = 0x7C00;  // of the magnitude: low <= it < high
  while (high - low > 1) {
    const uint32_t middle = (low + high) / 2;
    (half_to_double(middle) <= magnitude ? low : high) = middle;
  }
  const double above = high == 0x7C00 ? 65536 : half_to_double(high);
  const double down = magnitude - half_to_double(low), up = above - magnitude;
  return sign | (down < up || (down == up && low % 2 == 0) ? low : high);
}

// Integers come as their bits. Missing components: 0 0 1.
inline std::array<double, 4> decode(const Format& format, const std::byte* texel) {
  std::array<double, 4> out = {0, 0, 0, 1};
  for (unsigned c = 0; c < format.components; ++c) {
    uint32_t code = 0;
    std::memcpy(&code, texel + c * format.bits / 8, format.bits / 8);
    const unsigned unused = 32 - format.bits;
    const int32_t number = int32_t(code << unused) >> unused;
    switch (format.kind) {
      case Number::kUnorm:
        out[c] = code / (std::exp2(format.bits) - 1);
        break;
      case Number::kSnorm:
        out[c] = std::max(number / (std::exp2(format.bits - 1) - 1), -1.0);
        break;
      case Number::kUint:
        out[c] = code;
        break;
      case Number::kSint:
        out[c] = uint32_t(number);
        break;
      default:
        out[c] = format.bits == 16 ? half_to_double(code) : double(std::bit_cast<float>(code));
    }
  }
  return out;
}

// Fixed-point: the code that is nearest. `tie`: so close to the middle of two that a float may be nearer to the other.
inline uint32_t encode(const Format& format, double value, bool* tie) {
  const double largest = format.kind == Number::kUnorm   ? std::exp2(format.bits) - 1
                         : format.kind == Number::kSnorm ? std::exp2(format.bits - 1) - 1
                                                         : 0;
  const uint32_t mask = format.bits == 32 ? ~0u : (1u << format.bits) - 1;
  if (largest != 0) {
    const double scaled = std::clamp(value, format.kind == Number::kUnorm ? 0.0 : -1.0, 1.0) * largest;
    *tie = std::abs(std::abs(scaled - std::trunc(scaled)) - 0.5) < 1e-3;
    return uint32_t(int32_t(std::nearbyint(scaled))) & mask;
  }
  if (format.kind == Number::kFloat)
    return format.bits == 16 ? double_to_half(value) : std::bit_cast<uint32_t>(float(value));
  return uint32_t(value) & mask;
}

}  // namespace lapilli::oracle
