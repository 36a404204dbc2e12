// Accuracy, edge cases and equality across targets of lane_math-inl.h. LAPILLI_MATH_STRIDE=1 runs every one-argument
// function on all 2^32 inputs (minutes each) instead of on every 997th.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
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

// They overflow where e^|x| does as a float, not where their halves would.
bool exp_overflows(double x) { return std::isinf(static_cast<float>(std::exp(std::abs(x)))); }
double reference_sinh(double x) { return exp_overflows(x) ? std::copysign(HUGE_VAL, x) : std::sinh(x); }
double reference_cosh(double x) { return exp_overflows(x) ? HUGE_VAL : std::cosh(x); }

struct Accuracy {
  const char* name;
  UnaryRun* MathRuns::*run;
  double (*reference)(double);
  double bound;  // ULP over all inputs
};

const Accuracy kAccuracies[] = {
    {"sin", &MathRuns::sin, std::sin, 2.0},
    {"cos", &MathRuns::cos, std::cos, 2.0},
    {"tan", &MathRuns::tan, std::tan, 2.0},
    {"asin", &MathRuns::asin, std::asin, 2.0},
    {"acos", &MathRuns::acos, std::acos, 2.0},
    {"atan", &MathRuns::atan, std::atan, 2.0},
    {"exp", &MathRuns::exp, std::exp, 1.1},
    {"exp2", &MathRuns::exp2, std::exp2, 1.0},
    {"log", &MathRuns::log, std::log, 1.0},
    {"log2", &MathRuns::log2, std::log2, 1.1},
    {"sinh", &MathRuns::sinh, reference_sinh, 0.51},
    {"cosh", &MathRuns::cosh, reference_cosh, 0.51},
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
  const char* asked = std::getenv("LAPILLI_MATH_STRIDE");
  const std::uint64_t stride = asked != nullptr ? std::strtoull(asked, nullptr, 10) : 997;
  ASSERT_GT(stride, 0u);
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
  std::vector<float> one(16, worst_x);
  (math_runs(targets[0]).*function.run)(one.data(), one.data(), 16);
  EXPECT_LE(worst, function.bound) << function.name << "(" << hex(worst_x) << ") gives " << hex(one[0]);
  RecordProperty("worst_ulp", std::to_string(worst));
  std::printf("  %s: %.4f ULP at %s\n", function.name, worst, hex(worst_x).c_str());
}

INSTANTIATE_TEST_SUITE_P(LaneMath, UnaryAccuracy, testing::ValuesIn(kAccuracies),
                         [](const auto& test) { return std::string(test.param.name); });

// Runs a one- or two-argument function on every target; all targets must agree.
float evaluate(UnaryRun* MathRuns::*run, float x) {
  std::vector<float> xs(16, x), result(16);
  float first = 0;
  for (const SimdTarget target : supported_simd_targets()) {
    (math_runs(target).*run)(xs.data(), result.data(), 16);
    for (const float r : result) EXPECT_TRUE(same_bits(r, result[0]));
    if (target == SimdTarget::kBaseline) first = result[0];
    EXPECT_TRUE(same_bits(first, result[0])) << simd_target_name(target) << " " << hex(x);
  }
  return first;
}
float evaluate(BinaryRun* MathRuns::*run, float x, float y) {
  std::vector<float> xs(16, x), ys(16, y), result(16);
  float first = 0;
  for (const SimdTarget target : supported_simd_targets()) {
    (math_runs(target).*run)(xs.data(), ys.data(), result.data(), 16);
    for (const float r : result) EXPECT_TRUE(same_bits(r, result[0]));
    if (target == SimdTarget::kBaseline) first = result[0];
    EXPECT_TRUE(same_bits(first, result[0])) << simd_target_name(target) << " " << hex(x) << ", " << hex(y);
  }
  return first;
}

struct Edge {
  const char* name;
  UnaryRun* MathRuns::*run;
  float x;
  float expected;
};

// C's Annex F, which GLSL.std.450 is at least as loose as.
TEST(LaneMath, EdgesOfOneArgument) {
  const Edge edges[] = {
      {"sin", &MathRuns::sin, 0.0f, 0.0f},
      {"sin", &MathRuns::sin, -0.0f, -0.0f},
      {"sin", &MathRuns::sin, kInf, kNaN},
      {"sin", &MathRuns::sin, -kInf, kNaN},
      {"sin", &MathRuns::sin, kNaN, kNaN},
      {"sin", &MathRuns::sin, kDenormal, kDenormal},
      {"cos", &MathRuns::cos, 0.0f, 1.0f},
      {"cos", &MathRuns::cos, -kDenormal, 1.0f},
      {"cos", &MathRuns::cos, kInf, kNaN},
      {"tan", &MathRuns::tan, -0.0f, -0.0f},
      {"tan", &MathRuns::tan, -kDenormal, -kDenormal},
      {"tan", &MathRuns::tan, kInf, kNaN},
      {"asin", &MathRuns::asin, -0.0f, -0.0f},
      {"asin", &MathRuns::asin, 1.0f, 0x1.921fb6p+0f},
      {"asin", &MathRuns::asin, -1.0f, -0x1.921fb6p+0f},
      {"asin", &MathRuns::asin, 0x1.000002p+0f, kNaN},
      {"asin", &MathRuns::asin, kInf, kNaN},
      {"acos", &MathRuns::acos, 1.0f, 0.0f},
      {"acos", &MathRuns::acos, -1.0f, kPi},
      {"acos", &MathRuns::acos, 0.0f, 0x1.921fb6p+0f},
      {"acos", &MathRuns::acos, -0x1.000002p+0f, kNaN},
      {"acos", &MathRuns::acos, kNaN, kNaN},
      {"atan", &MathRuns::atan, -0.0f, -0.0f},
      {"atan", &MathRuns::atan, kInf, 0x1.921fb6p+0f},
      {"atan", &MathRuns::atan, -kInf, -0x1.921fb6p+0f},
      {"atan", &MathRuns::atan, kNaN, kNaN},
      {"exp", &MathRuns::exp, 0.0f, 1.0f},
      {"exp", &MathRuns::exp, -0.0f, 1.0f},
      {"exp", &MathRuns::exp, kInf, kInf},
      {"exp", &MathRuns::exp, -kInf, 0.0f},
      {"exp", &MathRuns::exp, kMax, kInf},
      {"exp", &MathRuns::exp, -kMax, 0.0f},
      {"exp", &MathRuns::exp, kNaN, kNaN},
      {"exp2", &MathRuns::exp2, 10.0f, 1024.0f},
      {"exp2", &MathRuns::exp2, 127.0f, 0x1p127f},
      {"exp2", &MathRuns::exp2, 128.0f, kInf},
      {"exp2", &MathRuns::exp2, -126.0f, 0x1p-126f},
      {"exp2", &MathRuns::exp2, -149.0f, kDenormal},
      {"exp2", &MathRuns::exp2, -150.0f, 0.0f},
      {"exp2", &MathRuns::exp2, -kInf, 0.0f},
      {"exp2", &MathRuns::exp2, kNaN, kNaN},
      {"log", &MathRuns::log, 1.0f, 0.0f},
      {"log", &MathRuns::log, 0.0f, -kInf},
      {"log", &MathRuns::log, -0.0f, -kInf},
      {"log", &MathRuns::log, -1.0f, kNaN},
      {"log", &MathRuns::log, -kInf, kNaN},
      {"log", &MathRuns::log, kInf, kInf},
      {"log", &MathRuns::log, kNaN, kNaN},
      {"log2", &MathRuns::log2, 1.0f, 0.0f},
      {"log2", &MathRuns::log2, 8.0f, 3.0f},
      {"log2", &MathRuns::log2, kDenormal, -149.0f},
      {"log2", &MathRuns::log2, 0.0f, -kInf},
      {"log2", &MathRuns::log2, -kDenormal, kNaN},
      {"log2", &MathRuns::log2, kInf, kInf},
      {"sinh", &MathRuns::sinh, -0.0f, -0.0f},
      {"sinh", &MathRuns::sinh, -kInf, -kInf},
      {"sinh", &MathRuns::sinh, kDenormal, kDenormal},
      {"sinh", &MathRuns::sinh, kNaN, kNaN},
      {"sinh", &MathRuns::sinh, -0x1.62e430p6f, -kInf},
      {"cosh", &MathRuns::cosh, 0x1.65a84ep6f, kInf},
      {"cosh", &MathRuns::cosh, 0.0f, 1.0f},
      {"cosh", &MathRuns::cosh, -kInf, kInf},
      {"cosh", &MathRuns::cosh, kNaN, kNaN},
      {"tanh", &MathRuns::tanh, -0.0f, -0.0f},
      {"tanh", &MathRuns::tanh, kInf, 1.0f},
      {"tanh", &MathRuns::tanh, -kInf, -1.0f},
      {"tanh", &MathRuns::tanh, kNaN, kNaN},
      {"asinh", &MathRuns::asinh, -0.0f, -0.0f},
      {"asinh", &MathRuns::asinh, -kInf, -kInf},
      {"asinh", &MathRuns::asinh, kNaN, kNaN},
      {"acosh", &MathRuns::acosh, 1.0f, 0.0f},
      {"acosh", &MathRuns::acosh, 0x1.fffffep-1f, kNaN},
      {"acosh", &MathRuns::acosh, -kInf, kNaN},
      {"acosh", &MathRuns::acosh, kInf, kInf},
      {"acosh", &MathRuns::acosh, kNaN, kNaN},
      {"atanh", &MathRuns::atanh, -0.0f, -0.0f},
      {"atanh", &MathRuns::atanh, 1.0f, kInf},
      {"atanh", &MathRuns::atanh, -1.0f, -kInf},
      {"atanh", &MathRuns::atanh, 0x1.000002p+0f, kNaN},
      {"atanh", &MathRuns::atanh, kNaN, kNaN},
      {"inverse_sqrt", &MathRuns::inverse_sqrt, 4.0f, 0.5f},
      {"inverse_sqrt", &MathRuns::inverse_sqrt, 0.0f, kInf},
      {"inverse_sqrt", &MathRuns::inverse_sqrt, kInf, 0.0f},
      {"inverse_sqrt", &MathRuns::inverse_sqrt, -1.0f, kNaN},
      {"fract", &MathRuns::fract, -0.25f, 0.75f},
      {"fract", &MathRuns::fract, -kDenormal, 0x1.fffffep-1f},
      {"fract", &MathRuns::fract, 3.0f, 0.0f},
  };
  for (const Edge& edge : edges) {
    const float result = evaluate(edge.run, edge.x);
    EXPECT_TRUE(same_bits(result, edge.expected))
        << edge.name << "(" << hex(edge.x) << ") is " << hex(result) << ", expected " << hex(edge.expected);
  }
}

// pow and atan2 at every pair of these follow C's functions exactly in what is special (0, 1, ∞, NaN, sign).
TEST(LaneMath, EdgesOfTwoArguments) {
  const float values[] = {0.0f,           0.5f,           1.0f,        1.5f,        2.0f,   3.0f, 4.0f,
                          0x1.fffffep-1f, 0x1.000002p+0f, 1e10f,       kMax,        kInf,   kNaN, 1e-3f,
                          kDenormal,      8388607.0f,     16777215.0f, 16777216.0f, 1e-30f, 7.0f, 0x1p-126f};
  for (const float a : values) {
    for (const float b : values) {
      for (const float x : {a, -a}) {
        for (const float y : {b, -b}) {
          const double power = std::pow(static_cast<double>(x), static_cast<double>(y));
          const float result = evaluate(&MathRuns::pow, x, y);
          EXPECT_LE(error_in_ulp(result, power), 1.5) << "pow(" << hex(x) << ", " << hex(y) << ") " << hex(result);
          if (power == 0.0) {
            EXPECT_EQ(std::signbit(result), std::signbit(power)) << hex(x) << " " << hex(y);
          }

          const double angle = std::atan2(static_cast<double>(y), static_cast<double>(x));
          const float at = evaluate(&MathRuns::atan2, y, x);
          EXPECT_LE(error_in_ulp(at, angle), 2.0) << "atan2(" << hex(y) << ", " << hex(x) << ") " << hex(at);
          if (angle == 0.0) {
            EXPECT_EQ(std::signbit(at), std::signbit(angle)) << hex(x) << " " << hex(y);
          }

          // C's remainder is exact, and so is ours.
          EXPECT_TRUE(same_bits(evaluate(&MathRuns::frem, x, y), std::fmod(x, y))) << hex(x) << " " << hex(y);
        }
      }
    }
  }
}

struct Pairs {
  std::vector<float> x, y;
};
// Pairs of every magnitude and sign; x limited to [low, high] in exponent.
Pairs random_pairs(std::size_t count, unsigned seed, int low, int high, int y_low, int y_high) {
  std::mt19937 random(seed);
  Pairs pairs;
  const auto value = [&random](int least, int most) {
    const auto exponent = static_cast<int>(random() % static_cast<unsigned>(most - least + 1)) + least;
    const float significand = 1.0f + static_cast<float>(random() % (1u << 23)) * 0x1p-23f;
    return std::ldexp(random() % 2 != 0 ? significand : -significand, exponent);
  };
  for (std::size_t i = 0; i < count; ++i) {
    pairs.x.push_back(value(low, high));
    pairs.y.push_back(value(y_low, y_high));
  }
  return pairs;
}

void check_pairs(const char* name, BinaryRun* MathRuns::*run, const Pairs& pairs, double bound,
                 double (*reference)(double, double)) {
  const std::size_t count = pairs.x.size();
  std::vector<float> first(count), result(count);
  for (const SimdTarget target : supported_simd_targets()) {
    (math_runs(target).*run)(pairs.x.data(), pairs.y.data(), result.data(), count);
    if (target == SimdTarget::kBaseline) first = result;
    double worst = 0;
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_TRUE(same_bits(result[i], first[i])) << name << " " << hex(pairs.x[i]) << ", " << hex(pairs.y[i]);
      const double expected = reference(static_cast<double>(pairs.x[i]), static_cast<double>(pairs.y[i]));
      const double error = error_in_ulp(result[i], expected);
      worst = std::max(worst, error);
      ASSERT_LE(error, bound) << simd_target_name(target) << " " << name << " " << hex(pairs.x[i]) << ", "
                              << hex(pairs.y[i]) << " is " << hex(result[i]);
    }
    if (target == SimdTarget::kBaseline) std::printf("  %s: %.4f ULP\n", name, worst);
  }
}

TEST(LaneMath, PowIsWithinItsBound) {
  Pairs pairs = random_pairs(1 << 20, 1, -126, 127, -10, 7);
  for (float& x : pairs.x) x = std::abs(x);
  check_pairs("pow", &MathRuns::pow, pairs, 1.5, std::pow);
  // Near 1, where y may be huge.
  pairs = random_pairs(1 << 20, 2, -24, -1, 0, 24);
  for (float& x : pairs.x) x = 1.0f + x;
  check_pairs("pow near 1", &MathRuns::pow, pairs, 1.5, std::pow);
  pairs = random_pairs(1 << 18, 3, -4, 6, 0, 6);
  for (float& y : pairs.y) y = std::trunc(y);
  check_pairs("pow, integer powers of either sign", &MathRuns::pow, pairs, 1.5, std::pow);
}

TEST(LaneMath, Atan2IsWithinItsBound) {
  check_pairs("atan2", &MathRuns::atan2, random_pairs(1 << 20, 4, -3, 3, -3, 3), 2.0, std::atan2);
  check_pairs("atan2 of all sizes", &MathRuns::atan2, random_pairs(1 << 20, 5, -149, 127, -149, 127), 2.0, std::atan2);
}

// The exact remainder of two floats is a float: no error at all.
TEST(LaneMath, RemaindersAreExact) {
  const auto exact = [](double x, double y) { return std::fmod(x, y); };
  check_pairs("frem", &MathRuns::frem, random_pairs(1 << 20, 6, -5, 20, -5, 5), 0.0, exact);
  check_pairs("frem of all sizes", &MathRuns::frem, random_pairs(1 << 18, 7, -149, 127, -149, 127), 0.0, exact);
  // Multiples and their neighbours.
  Pairs pairs = random_pairs(1 << 18, 8, 0, 22, -10, 10);
  for (std::size_t i = 0; i < pairs.x.size(); ++i) {
    pairs.x[i] = std::trunc(pairs.x[i]) * pairs.y[i];
    if (i % 3 == 1) pairs.x[i] = std::nextafter(pairs.x[i], kInf);
    if (i % 3 == 2) pairs.x[i] = std::nextafter(pairs.x[i], -kInf);
  }
  check_pairs("frem near multiples", &MathRuns::frem, pairs, 0.0, exact);
}

// The remainder moved to the sign of y: one rounding.
TEST(LaneMath, ModuloHasTheSignOfTheDivisor) {
  const auto modulo = [](double x, double y) {
    const double rest = std::fmod(x, y);
    return rest != 0 && std::signbit(rest) != std::signbit(y) ? rest + y : rest;
  };
  check_pairs("fmod", &MathRuns::fmod, random_pairs(1 << 20, 9, -5, 20, -5, 5), 0.5001, modulo);
  EXPECT_EQ(evaluate(&MathRuns::fmod, -1.0f, 3.0f), 2.0f);
  EXPECT_EQ(evaluate(&MathRuns::fmod, 1.0f, -3.0f), -2.0f);
  EXPECT_TRUE(same_bits(evaluate(&MathRuns::fmod, -3.0f, 3.0f), 0.0f));
  EXPECT_TRUE(same_bits(evaluate(&MathRuns::fmod, 3.0f, -3.0f), -0.0f));
  EXPECT_TRUE(std::isnan(evaluate(&MathRuns::fmod, 3.0f, 0.0f)));
}

std::vector<float> all_kinds_of_floats() {
  std::vector<float> x = {0.0f, -0.0f, kInf, -kInf, kNaN, kDenormal, 0x1p-126f, 0x1.fffffcp-127f, kMax, 1.0f};
  for (std::uint64_t bits = 0; bits < (std::uint64_t{1} << 32); bits += 9973) {
    x.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
  }
  x.resize(x.size() & ~std::size_t{15});
  return x;
}

TEST(LaneMath, LdexpRoundsOnceForEveryExponent) {
  const std::vector<float> x = all_kinds_of_floats();
  std::vector<std::int32_t> exponent(x.size());
  std::mt19937 random(10);
  for (std::size_t i = 0; i < x.size(); ++i) {
    exponent[i] = static_cast<std::int32_t>(random() % 641) - 320;
    if (i % 64 == 0) exponent[i] = std::bit_cast<std::int32_t>(static_cast<std::uint32_t>(random()));
  }
  std::vector<float> result(x.size());
  for (const SimdTarget target : supported_simd_targets()) {
    math_runs(target).ldexp(x.data(), exponent.data(), result.data(), x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      ASSERT_TRUE(same_bits(result[i], std::ldexp(x[i], exponent[i]))) << hex(x[i]) << " " << exponent[i];
    }
  }
}

TEST(LaneMath, FrexpAndModfTakeFloatsApart) {
  const std::vector<float> x = all_kinds_of_floats();
  std::vector<float> significand(x.size()), whole(x.size()), fraction(x.size());
  std::vector<std::int32_t> exponent(x.size());
  for (const SimdTarget target : supported_simd_targets()) {
    math_runs(target).frexp(x.data(), significand.data(), exponent.data(), x.size());
    math_runs(target).modf(x.data(), whole.data(), fraction.data(), x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      int expected_exponent = 0;
      const float expected = std::frexp(x[i], &expected_exponent);
      ASSERT_TRUE(same_bits(significand[i], expected)) << hex(x[i]);
      // C leaves the exponent of ∞ and NaN open; ours is 0.
      ASSERT_EQ(exponent[i], std::isfinite(x[i]) ? expected_exponent : 0) << hex(x[i]);
      float expected_whole = 0;
      const float expected_fraction = std::modf(x[i], &expected_whole);
      ASSERT_TRUE(same_bits(whole[i], expected_whole)) << hex(x[i]);
      ASSERT_TRUE(same_bits(fraction[i], expected_fraction)) << hex(x[i]);
    }
  }
}

}  // namespace
}  // namespace lapilli
