// Bounds against float32 computations of the host, and against the specification's words.
#include "oracle/inexact.h"

#include <gtest/gtest.h>

#include <random>

namespace lapilli::oracle {
namespace {

TEST(Inexact, ContainsWhatFloat32Computes) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> numbers(-100, 100);
  double largest = 0;
  for (int i = 0; i < 100'000; ++i) {
    const float a = numbers(random), b = numbers(random), c = numbers(random), d = numbers(random);
    const float got = (a * b - c * d) / (a - 150.0f);
    const Inexact x = a, y = b, z = c, w = d, want = (x * y - z * w) / (x - Inexact(150.0));
    const double error = std::abs(double(got) - want.value);
    ASSERT_LE(error, want.error) << a << ' ' << b << ' ' << c << ' ' << d;
    largest = std::max(largest, error / want.error);
  }
  EXPECT_GT(largest, 0.1) << "a bound that nothing comes near says little";
}

TEST(Inexact, StatesTheSpecificationsBounds) {
  EXPECT_EQ((Inexact(1.0) + 2.0).error, ulp(3));
  EXPECT_EQ((Inexact(1.0) / 3.0).error, 2.5 * ulp(1.0 / 3));
  EXPECT_TRUE(std::isinf((Inexact(1.0) / 0x1p127).error)) << "nothing is asked beyond 2^126";
  EXPECT_EQ(exp(-4.0).error, 11 * ulp(std::exp(-4.0)));
  EXPECT_EQ(log2(8.0).error, 3 * ulp(3));
  EXPECT_EQ(log(1.5).error, 0x1p-21);
  EXPECT_EQ(inverse_sqrt(4.0).error, 2 * ulp(0.5));
  EXPECT_EQ(sin(3.0).error, 0x1p-11);
  EXPECT_TRUE(std::isinf(sin(4.0).error));
  EXPECT_EQ(atan2(1.0, 1.0).error, 4096 * ulp(M_PI / 4));
  EXPECT_TRUE(std::isinf((Inexact(0x1p100) * 0x1p100).error)) << "overflow";
}

TEST(Inexact, ErrorsOfOperandsAreInherited) {
  Inexact x = 3.0;
  x.error = 0x1p-10;
  EXPECT_GE(exp2(x).error, std::exp2(3.0 + 0x1p-10) - 8);
  EXPECT_GE(log(x).error, std::log(3.0) - std::log(3.0 - 0x1p-10));
  EXPECT_GE(sqrt(x).error, std::sqrt(3.0) - std::sqrt(3.0 - 0x1p-10));
  EXPECT_EQ(floor(x).error, 1) << "3 - 2^-10 would be 2";
  EXPECT_EQ(floor(Inexact(2.5)).error, 0);
}

}  // namespace
}  // namespace lapilli::oracle
