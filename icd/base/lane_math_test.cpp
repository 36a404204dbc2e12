// Accuracy, edge cases and equality across targets of lane_math-inl.h. LAPILLI_EXHAUSTIVE=1 runs every one-argument
// function on all 2^32 inputs (minutes each) instead of on every 997th.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "base/lane_math_runs.h"

namespace lapilli {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kMax = std::numeric_limits<float>::max();
constexpr float kDenormal = 0x1p-149f;
constexpr float kPi = 0x1.921fb6p+1f;

// Distance in units of the last place of a float of the reference's size; a float infinity counts as 2^128.
double error_in_ulp(float result, double reference) {
  if (std::isnan(reference) || std::isnan(result)) return std::isnan(reference) && std::isnan(result) ? 0.0 : 1e30;
  const double finite_reference = std::isinf(reference) ? std::copysign(0x1p128, reference) : reference;
  const double finite_result = std::isinf(result) ? std::copysign(0x1p128, result) : static_cast<double>(result);
  if (std::abs(finite_reference) >= 0x1p128 && std::isinf(result)) {
    return std::signbit(result) == std::signbit(reference) ? 0.0 : 1e30;
  }
  int exponent = 0;
  std::frexp(finite_reference, &exponent);
  const int last_place = std::max(exponent, -125) - 24;
  return std::ldexp(std::abs(finite_result - finite_reference), -last_place);
}

// NaNs are canonical only once stored: any NaN equals any other.
bool same_bits(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) || (std::isnan(a) && std::isnan(b));
}

std::string hex(float value) {
  char text[64];
  std::snprintf(text, sizeof text, "%a (0x%08x)", static_cast<double>(value), std::bit_cast<std::uint32_t>(value));
  return text;
}

double reference_inverse_sqrt(double x) { return 1.0 / std::sqrt(x); }
// GLSL: below 1.
double reference_fract(double x) { return std::isinf(x) ? kNaN : std::min(x - std::floor(x), 0x1.fffffep-1); }

struct Accuracy {
  const char* name;
  UnaryRun* MathRuns::*run;
  double (*reference)(double);
  double bound;  // ULP over all inputs
};

const Accuracy kAccuracies[] = {
    {"sin", &MathRuns::sin, std::sin, 1.5},
    {"cos", &MathRuns::cos, std::cos, 1.5},
    {"tan", &MathRuns::tan, std::tan, 2.0},
    {"asin", &MathRuns::asin, std::asin, 2.0},
    {"acos", &MathRuns::acos, std::acos, 2.0},
    {"atan", &MathRuns::atan, std::atan, 2.0},
    {"exp", &MathRuns::exp, std::exp, 1.0},
    {"exp2", &MathRuns::exp2, std::exp2, 1.0},
    {"log", &MathRuns::log, std::log, 1.0},
    {"log2", &MathRuns::log2, std::log2, 1.0},
    {"sinh", &MathRuns::sinh, std::sinh, 0.51},
    {"cosh", &MathRuns::cosh, std::cosh, 0.51},
    {"tanh", &MathRuns::tanh, std::tanh, 0.51},
    {"asinh", &MathRuns::asinh, std::asinh, 0.51},
    {"acosh", &MathRuns::acosh, std::acosh, 0.51},
    {"atanh", &MathRuns::atanh, std::atanh, 0.51},
    {"inverse_sqrt", &MathRuns::inverse_sqrt, reference_inverse_sqrt, 1.5},
    {"sqrt", &MathRuns::sqrt, std::sqrt, 0.5001},
    {"fract", &MathRuns::fract, reference_fract, 0.5001},
};

class UnaryAccuracy : public testing::TestWithParam<Accuracy> {};

TEST_P(UnaryAccuracy, IsWithinItsBoundAndEqualOnAllTargets) {
  const Accuracy& function = GetParam();
  const bool exhaustive = std::getenv("LAPILLI_EXHAUSTIVE") != nullptr;
  const std::uint64_t stride = exhaustive ? 1 : 997;
  const std::vector<SimdTarget> targets = supported_simd_targets();
  constexpr std::size_t kBlock = 4096;
  std::vector<float> x(kBlock), result(kBlock), other(kBlock);
  double worst = 0;
  float worst_x = 0;
  for (std::uint64_t first = 0; first < (std::uint64_t{1} << 32); first += kBlock * stride) {
    for (std::size_t i = 0; i < kBlock; ++i) {
      x[i] = std::bit_cast<float>(static_cast<std::uint32_t>(first + i * stride));
    }
    (math_runs(targets[0]).*function.run)(x.data(), result.data(), kBlock);
    for (std::size_t i = 0; i < kBlock; ++i) {
      const double error = error_in_ulp(result[i], function.reference(static_cast<double>(x[i])));
      if (error > worst) {
        worst = error;
        worst_x = x[i];
      }
    }
    for (std::size_t t = 1; t < targets.size(); ++t) {
      (math_runs(targets[t]).*function.run)(x.data(), other.data(), kBlock);
      for (std::size_t i = 0; i < kBlock; ++i) {
        ASSERT_TRUE(same_bits(result[i], other[i]))
            << function.name << "(" << hex(x[i]) << ") is " << hex(result[i]) << " on " << simd_target_name(targets[0])
            << " and " << hex(other[i]) << " on " << simd_target_name(targets[t]);
      }
    }
  }
  float at = 0;
  std::vector<float> one(16, worst_x);
  (math_runs(targets[0]).*function.run)(one.data(), one.data(), 16);
  at = one[0];
  EXPECT_LE(worst, function.bound) << function.name << "(" << hex(worst_x) << ") gives " << hex(at);
  RecordProperty("worst_ulp", std::to_string(worst));
  std::printf("  %s: %.4f ULP at %s\n", function.name, worst, hex(worst_x).c_str());
}

INSTANTIATE_TEST_SUITE_P(LaneMath, UnaryAccuracy, testing::ValuesIn(kAccuracies),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace lapilli
