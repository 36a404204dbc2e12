// See numbers.h.
#include "shader/numbers.h"

#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace lapilli::conformance {
namespace {

const float kSpecial[] = {0.0f,
                          -0.0f,
                          1.0f,
                          -1.0f,
                          0.5f,
                          -0.5f,
                          1.5f,
                          2.5f,
                          -2.5f,
                          3.0f,
                          0x1.fffffep-1f,
                          0x1.000002p+0f,
                          8388607.5f,
                          8388609.0f,
                          16777216.0f,
                          2147483648.0f,
                          -2147483648.0f,
                          4294967296.0f,
                          std::numeric_limits<float>::min(),
                          -std::numeric_limits<float>::min(),
                          std::numeric_limits<float>::denorm_min(),
                          0x1.8p-130f,
                          -0x1.4p-140f,
                          std::numeric_limits<float>::max(),
                          -std::numeric_limits<float>::max(),
                          std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity(),
                          std::numeric_limits<float>::quiet_NaN(),
                          3.14159274f,
                          1.57079637f};

constexpr uint32_t kSpecialInts[] = {0,          1,          2,          3,          5,          31,         32,
                                     255,        256,        65535,      65536,      0x7FFFFFFF, 0x80000000, 0x80000001,
                                     0xFFFFFFFE, 0xFFFFFFFF, 0x55555555, 0xAAAAAAAA, 0x00FF00FF, 1000000007, 16777217};

}  // namespace

FloatOperands float_operands(uint32_t seed) {
  std::mt19937 random(seed);
  FloatOperands out;
  const size_t count = std::size(kSpecial);
  for (size_t i = 0; i < count; ++i) {
    for (size_t k = 0; k < count; ++k) {
      out.a.push_back(kSpecial[i]);
      out.b.push_back(kSpecial[k]);
      out.c.push_back(kSpecial[random() % count]);
    }
  }
  std::uniform_real_distribution<float> moderate(-100, 100), unit(0, 1);
  for (int i = 0; i < 6000; ++i) {
    const auto any = [&] { return std::bit_cast<float>(uint32_t(random())); };
    const bool bits = i % 3 == 0;
    out.a.push_back(bits ? any() : i % 3 == 1 ? moderate(random) : unit(random));
    out.b.push_back(bits ? any() : i % 3 == 1 ? moderate(random) : unit(random));
    out.c.push_back(bits ? any() : i % 3 == 1 ? moderate(random) : unit(random));
  }
  return out;
}

std::vector<float> floats_between(uint32_t seed, float low, float high, size_t count) {
  std::mt19937 random(seed);
  std::vector<float> out = {low, high};
  for (const float v : kSpecial) {
    if (v >= low && v <= high) out.push_back(v);
  }
  std::uniform_real_distribution<float> uniform(low, high), exponent(-40, 0);
  while (out.size() < count) {
    const bool small = out.size() % 2 == 0;
    float v = small ? std::exp2(exponent(random)) * uniform(random) : uniform(random);
    if (out.size() % 5 == 0) v = 1 + v * std::exp2(exponent(random));  // dense near 1 as well
    if (v >= low && v <= high) out.push_back(v);
  }
  return out;
}

IntOperands int_operands(uint32_t seed) {
  std::mt19937 random(seed);
  IntOperands out;
  const size_t count = std::size(kSpecialInts);
  for (size_t i = 0; i < count; ++i) {
    for (size_t k = 0; k < count; ++k) {
      out.a.push_back(kSpecialInts[i]);
      out.b.push_back(kSpecialInts[k]);
      out.c.push_back(kSpecialInts[random() % count]);
    }
  }
  for (int i = 0; i < 4000; ++i) {
    // Magnitudes of all sizes.
    out.a.push_back(uint32_t(random()) >> (random() % 32));
    out.b.push_back(uint32_t(random()) >> (random() % 32));
    out.c.push_back(uint32_t(random()) >> (random() % 32));
    if (i % 3 == 0) out.a.back() = ~out.a.back();
    if (i % 4 == 0) out.b.back() = ~out.b.back();
  }
  return out;
}

}  // namespace lapilli::conformance
