// Rare cases of lane_math, one lane at a time.
#include "base/lane_math_scalar.h"

#include <array>
#include <bit>
#include <limits>

namespace lapilli {
namespace {

// 2/π as a binary fraction, after 32 zero bits.
constexpr std::array<std::uint32_t, 10> kTwoOverPi = {0x00000000, 0xa2f9836e, 0x4e441529, 0xfc2757d1, 0xf534ddc0,
                                                      0xdb629599, 0x3c439041, 0xfe5163ab, 0xdebbc561, 0xb7246e3a};
constexpr int kLeadingZeros = 32;

using Wide = unsigned __int128;

// Bits first … first + 127 of the table, the first one on top.
Wide table_bits(unsigned first) {
  const unsigned word = first / 32;
  const unsigned shift = first % 32;
  Wide bits = 0;
  for (unsigned i = 0; i < 4; ++i) bits = bits << 32 | kTwoOverPi[word + i];
  if (shift != 0) bits = bits << shift | kTwoOverPi[word + 4] >> (32 - shift);
  return bits;
}

// |angle| in quarter turns modulo 4, with 126 bits of fraction. |angle| = significand · 2^exponent; bits of 2/π that
// make multiples of 4 in the product are left out.
Wide quarter_turns_of(std::uint32_t bits) {
  const std::uint32_t significand = (bits & 0x7FFFFF) | 0x800000;
  const int exponent = static_cast<int>(bits >> 23 & 255) - 150;
  return significand * table_bits(static_cast<unsigned>(exponent - 2 + kLeadingZeros));
}

bool finite(std::uint32_t bits) { return (bits >> 23 & 255) != 255; }

// No float comes closer than about 2^-30 to a multiple of π/2, so that what the conversion of a fraction to double
// loses is far below a float's last place.
constexpr double kPi = 0x1.921fb54442d18p+1;

}  // namespace

std::uint32_t reduce_to_half_turn(float angle, std::uint32_t quarter_turns, float* r) {
  const auto bits = std::bit_cast<std::uint32_t>(angle);
  if (!finite(bits)) {
    *r = std::numeric_limits<float>::quiet_NaN();
    return 0;
  }
  const Wide turns = quarter_turns_of(bits) + (static_cast<Wide>(quarter_turns) << 126);
  // The upper bit counts half turns; the rest is their fraction, taken as a signed number in [-1/2, 1/2).
  const auto fraction = static_cast<__int128>(turns << 1);
  *r = static_cast<float>(static_cast<double>(fraction) * 0x1p-128 * kPi);
  return static_cast<std::uint32_t>(turns >> 127) + (fraction < 0 ? 1 : 0);
}

std::uint32_t reduce_to_quadrant(float angle, float* r, float* tail) {
  const auto bits = std::bit_cast<std::uint32_t>(angle);
  if (!finite(bits)) {
    *r = *tail = std::numeric_limits<float>::quiet_NaN();
    return 0;
  }
  const Wide turns = quarter_turns_of(bits);
  const auto fraction = static_cast<__int128>(turns << 2);
  const double reduced = static_cast<double>(fraction) * 0x1p-128 * (kPi / 2);
  *r = static_cast<float>(reduced);
  *tail = static_cast<float>(reduced - static_cast<double>(*r));
  return static_cast<std::uint32_t>(turns >> 126) + (fraction < 0 ? 1 : 0);
}

float exact_remainder(float x, float y) {
  constexpr std::uint32_t kMagnitude = 0x7FFFFFFF;
  const auto x_bits = std::bit_cast<std::uint32_t>(x);
  const std::uint32_t a_bits = x_bits & kMagnitude;
  const std::uint32_t b_bits = std::bit_cast<std::uint32_t>(y) & kMagnitude;
  const std::uint32_t sign = x_bits & ~kMagnitude;
  if (a_bits < b_bits) return x;

  // significand · 2^(exponent - 1), denormals with exponent 1.
  const std::uint32_t a_exponent = a_bits >> 23 == 0 ? 1 : a_bits >> 23;
  const std::uint32_t b_exponent = b_bits >> 23 == 0 ? 1 : b_bits >> 23;
  std::uint64_t rest = a_bits >> 23 == 0 ? a_bits : (a_bits & 0x7FFFFF) | 0x800000;
  const std::uint64_t divisor = b_bits >> 23 == 0 ? b_bits : (b_bits & 0x7FFFFF) | 0x800000;
  // Long division in base 2^32 and less: rest < 2^24, so that the shifted rest fits.
  for (std::uint32_t shift = a_exponent - b_exponent;;) {
    const std::uint32_t step = shift < 32 ? shift : 32;
    rest = (rest << step) % divisor;
    shift -= step;
    if (shift == 0) break;
  }
  if (rest == 0) return std::bit_cast<float>(sign);
  // Back to a float of exponent b_exponent: normalize, at most down to the denormals.
  std::uint32_t exponent = b_exponent;
  while ((rest & 0x800000) == 0 && exponent > 1) {
    rest <<= 1;
    --exponent;
  }
  const auto significand = static_cast<std::uint32_t>(rest);
  const std::uint32_t magnitude = significand < 0x800000 ? significand : (significand & 0x7FFFFF) | exponent << 23;
  return std::bit_cast<float>(sign | magnitude);
}

}  // namespace lapilli
