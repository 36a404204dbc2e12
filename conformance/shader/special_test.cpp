// Instructions that glslang never emits, from SPIR-V assembly (special.comp.spvasm).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "harness/devices.h"
#include "oracle/ulp.h"
#include "shader/numbers.h"
#include "shaders/special.comp.h"

namespace lapilli::conformance {
namespace {

using Row = std::array<uint32_t, 16>;

class Special : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    operands = float_operands(9);
    std::vector<std::array<float, 2>> in;
    for (size_t i = 0; i < operands.a.size(); ++i) in.push_back({operands.a[i], operands.b[i]});
    in.resize((in.size() + 63) / 64 * 64);
    ComputeRun run;
    run.shader = shaders::kSpecialComp;
    run.buffers = {to_bytes(in), Bytes(in.size() * sizeof(Row))};
    run.groups[0] = uint32_t(in.size() / 64);
    rows = from_bytes<Row>(run_compute(subject(), run)[1]);
  }
  // Calls check(a, b, row) until one fails.
  template <typename Check>
  static void for_all(Check check) {
    for (size_t i = 0; i < operands.a.size() && !HasFailure(); ++i) {
      SCOPED_TRACE(testing::Message() << std::hexfloat << "a = " << operands.a[i] << ", b = " << operands.b[i]);
      check(operands.a[i], operands.b[i], rows[i]);
    }
  }
  static bool ordinary(float v) { return std::isfinite(v) && (v == 0 || std::abs(v) >= 0x1p-126f); }
  static inline FloatOperands operands;
  static inline std::vector<Row> rows;
};

TEST_F(Special, FloatRemainders) {
  // Vulkan only asks for what x - y * trunc(x / y) gives, so large quotients are left out for other drivers.
  for_all([](float a, float b, const Row& row) {
    if (!ordinary(a) || !ordinary(b) || b == 0) return;
    const double quotient = double(a) / double(b);
    if (!subject_is_lapilli() && (std::abs(quotient) > 100 || std::abs(b) < 1e-20f)) return;
    const double rem = std::fmod(double(a), double(b));
    const double mod = rem != 0 && (rem < 0) != (b < 0) ? rem + double(b) : rem;
    const double bound = subject_is_lapilli() ? oracle::ulp(mod) : 8 * oracle::ulp(double(a)) + oracle::ulp(double(b));
    const auto near = [&](float got, double want) {
      const double error = std::abs(double(got) - want);
      return error <= bound || (!subject_is_lapilli() && std::abs(error - std::abs(double(b))) <= bound);
    };
    EXPECT_TRUE(near(std::bit_cast<float>(row[0]), rem)) << "OpFRem " << std::bit_cast<float>(row[0]);
    EXPECT_TRUE(near(std::bit_cast<float>(row[1]), mod)) << "OpFMod " << std::bit_cast<float>(row[1]);
  });
}

TEST_F(Special, IntegerRemainders) {
  for_all([](float a, float b, const Row& row) {
    const auto x = std::bit_cast<int32_t>(a), y = std::bit_cast<int32_t>(b);
    if (y == 0 || (x == INT32_MIN && y == -1)) return;
    if (!subject_is_lapilli() && (x < 0 || y < 0)) return;  // Vulkan leaves negative operands open
    const int32_t rem = x % y, mod = rem != 0 && (rem < 0) != (y < 0) ? rem + y : rem;
    EXPECT_EQ(int32_t(row[2]), rem) << x << " " << y;
    EXPECT_EQ(int32_t(row[3]), mod) << x << " " << y;
    EXPECT_EQ(row[11], 0u - uint32_t(x));
  });
}

TEST_F(Special, OrderedAndUnorderedComparisons) {
  for_all([](float a, float b, const Row& row) {
    if (!subject_is_lapilli() && (!ordinary(a) || !ordinary(b))) return;
    const bool unordered = std::isnan(a) || std::isnan(b);
    const bool ordered[] = {a == b, a != b && !unordered, a<b, a> b, a <= b, a >= b};
    uint32_t want = 0;
    for (int i = 0; i < 6; ++i) {
      want |= uint32_t(ordered[i]) << (2 * i) | uint32_t(ordered[i] || unordered) << (2 * i + 1);
    }
    EXPECT_EQ(row[4], want);
  });
}

TEST_F(Special, NumberPreferringMinMaxClamp) {
  for_all([](float a, float b, const Row& row) {
    if (!subject_is_lapilli() && (!ordinary(a) || !ordinary(b))) return;
    const auto same = [](uint32_t got, float want) {
      const float value = std::bit_cast<float>(got);
      return std::isnan(want) ? std::isnan(value) : value == want;
    };
    // Not std::fmin: of a signalling NaN and a number it may give NaN.
    const float smaller = std::isnan(a) ? b : std::isnan(b) || a < b ? a : b;
    const float larger = std::isnan(a) ? b : std::isnan(b) || a > b ? a : b;
    EXPECT_TRUE(same(row[5], smaller)) << "NMin";
    EXPECT_TRUE(same(row[6], larger)) << "NMax";
    EXPECT_TRUE(same(row[7], std::isnan(a) ? -1.0f : std::clamp(a, -1.0f, 1.0f))) << "NClamp";
  });
}

TEST_F(Special, ShufflesCopiesAndBits) {
  for_all([](float a, float b, const Row& row) {
    if (std::isnan(a) || std::isnan(b)) return;
    EXPECT_EQ(row[8], std::bit_cast<uint32_t>(a));
    EXPECT_EQ(row[9], std::bit_cast<uint32_t>(b));
    EXPECT_EQ(row[10], std::bit_cast<uint32_t>(-a));
    EXPECT_EQ(row[13], uint32_t(std::isinf(a)));
  });
  for (uint32_t i = 0; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i][12], uint32_t(31 - std::countl_zero(i)));  // FindUMsb; -1 of 0
  }
}

}  // namespace
}  // namespace lapilli::conformance
