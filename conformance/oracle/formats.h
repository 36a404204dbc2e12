// Numeric formats in float64: components from the lowest bit on. Specification: "Formats", "Fixed-Point Data
// Conversions"; 16-bit floats are IEEE binary16, unsigned ones the same without a sign and the last bits.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace lapilli::oracle {

enum class Number { kUnorm, kSnorm, kUint, kSint, kFloat, kSmallFloat };

struct Format {
  Number kind;
  unsigned bits, components;            // of each component; how many
  std::array<unsigned, 4> widths = {};  // instead of `bits`, in a word of 32 bits
  unsigned bytes() const { return bits == 0 ? 4 : bits / 8 * components; }
  unsigned width(unsigned c) const { return bits == 0 ? widths[c] : bits; }
  unsigned first(unsigned c) const { return c == 0 ? 0 : first(c - 1) + width(c - 1); }
  uint32_t code(const std::byte* texel, unsigned c) const {
    uint64_t word = 0;
    std::memcpy(&word, texel + first(c) / 8, (first(c) % 8 + width(c) + 7) / 8);
    return uint32_t(word >> first(c) % 8 & ((uint64_t{1} << width(c)) - 1));
  }
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
    const uint32_t code = format.code(texel, c);
    const unsigned bits = format.width(c), unused = 32 - bits;
    const int32_t number = int32_t(code << unused) >> unused;
    switch (format.kind) {
      case Number::kUnorm:
        out[c] = code / (std::exp2(bits) - 1);
        break;
      case Number::kSnorm:
        out[c] = std::max(number / (std::exp2(bits - 1) - 1), -1.0);
        break;
      case Number::kUint:
        out[c] = code;
        break;
      case Number::kSint:
        out[c] = uint32_t(number);
        break;
      case Number::kSmallFloat:
        out[c] = half_to_double(code << (15 - bits));
        break;
      default:
        out[c] = bits == 16 ? half_to_double(code) : double(std::bit_cast<float>(code));
    }
  }
  return out;
}

// Of component c; fixed-point: the code that is nearest. `tie`: so close to the middle of two that a float may be
// nearer to the other; small floats: any that is not exact.
inline uint32_t encode(const Format& format, unsigned c, double value, bool* tie) {
  const unsigned bits = format.width(c);
  const double largest = format.kind == Number::kUnorm   ? std::exp2(bits) - 1
                         : format.kind == Number::kSnorm ? std::exp2(bits - 1) - 1
                                                         : 0;
  const uint32_t mask = bits == 32 ? ~0u : (1u << bits) - 1;
  if (largest != 0) {
    const double scaled = std::clamp(value, format.kind == Number::kUnorm ? 0.0 : -1.0, 1.0) * largest;
    *tie = std::abs(std::abs(scaled - std::trunc(scaled)) - 0.5) < 1e-3;
    return uint32_t(int32_t(std::nearbyint(scaled))) & mask;
  }
  if (format.kind == Number::kSmallFloat) {
    const uint32_t half = double_to_half(std::max(value, 0.0)), dropped = 15 - bits;
    *tie = (half & ((1u << dropped) - 1)) != 0;
    return half >> dropped;
  }
  if (format.kind == Number::kFloat) return bits == 16 ? double_to_half(value) : std::bit_cast<uint32_t>(float(value));
  return uint32_t(value) & mask;
}

}  // namespace lapilli::oracle
