// The small headers: floating-point environment, results, text, and the choice of the SIMD target.
#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "base/fp_environment.h"
#include "base/lane_math_runs.h"
#include "base/result.h"
#include "base/simd_dispatch.h"
#include "base/text.h"

namespace lapilli {
namespace {

#if defined(__x86_64__)
constexpr unsigned kFlushToZero = 0x8000;
constexpr unsigned kDenormalsAreZero = 0x0040;

TEST(FpEnvironment, SetsTheDefaultsAndPutsEverythingBack) {
  const unsigned original = _mm_getcsr();
  // Flushing, rounding up, a trap on division by zero, and two sticky flags.
  const unsigned application =
      (original & ~0xE3Fu) | kFlushToZero | kDenormalsAreZero | _MM_ROUND_UP | _MM_EXCEPT_INEXACT | _MM_EXCEPT_OVERFLOW;
  _mm_setcsr(application & ~static_cast<unsigned>(_MM_MASK_DIV_ZERO));
  const unsigned set = _mm_getcsr();
  float product = 0;
  float quotient = 0;
  {
    const FpEnvironment environment;
    EXPECT_EQ(_mm_getcsr(), 0x1F80u);
    // The functions of the tables are called through pointers: nothing moves out of this block.
    std::vector<float> x(16, -149.0f), result(16);
    math_runs(SimdTarget::kBaseline).exp2(x.data(), result.data(), 16);
    product = result[0];
    x.assign(16, 0.0f);
    math_runs(SimdTarget::kBaseline).inverse_sqrt(x.data(), result.data(), 16);
    quotient = result[0];
  }
  EXPECT_EQ(_mm_getcsr(), set);
  _mm_setcsr(original);
  EXPECT_EQ(product, 0x1p-149f);
  EXPECT_TRUE(std::isinf(quotient));
}
#endif

TEST(Result, HoldsAValueOrAnError) {
  Result<std::unique_ptr<int>> good = std::make_unique<int>(3);
  ASSERT_TRUE(good.ok());
  EXPECT_EQ(**good, 3);
  const std::unique_ptr<int> taken = *std::move(good);
  EXPECT_EQ(*taken, 3);

  Result<std::string> bad = Error{VK_ERROR_FORMAT_NOT_SUPPORTED, "R5G6B5"};
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().code, VK_ERROR_FORMAT_NOT_SUPPORTED);
  EXPECT_EQ(bad.error().message, "R5G6B5");

  EXPECT_TRUE(Result<void>().ok());
  EXPECT_FALSE(Result<void>(Error{VK_ERROR_UNKNOWN, ""}).ok());
}

TEST(SimdDispatch, OffersTheBaselineFirstAndNamesTargets) {
  const std::vector<SimdTarget> targets = supported_simd_targets();
  ASSERT_FALSE(targets.empty());
  EXPECT_EQ(targets.front(), SimdTarget::kBaseline);
  EXPECT_EQ(best_simd_target(), targets.back());
  for (const SimdTarget target : targets) {
    EXPECT_EQ(simd_target_of_name(simd_target_name(target)), target);
    const SimdTarget before = simd_target();
    EXPECT_TRUE(set_simd_target(target));
    EXPECT_EQ(simd_target(), target);
    EXPECT_TRUE(set_simd_target(before));
  }
  EXPECT_FALSE(simd_target_of_name("mmx").has_value());
  for (const SimdTarget target : {SimdTarget::kAvx2, SimdTarget::kAvx3}) {
    if (simd_target_supported(target)) continue;
    const SimdTarget before = simd_target();
    EXPECT_FALSE(set_simd_target(target));
    EXPECT_EQ(simd_target(), before);
  }
}

TEST(Text, AppendsTextOfAnyLength) {
  std::string text = "a";
  append_format(text, "%d%s", 1, "");
  EXPECT_EQ(text, "a1");
  const std::string longer(1000, 'x');
  append_format(text, "%s!", longer.c_str());
  EXPECT_EQ(text, "a1" + longer + "!");
  append_format(text, "%s", "");
  EXPECT_EQ(text.size(), 1003u);
}

}  // namespace
}  // namespace lapilli
