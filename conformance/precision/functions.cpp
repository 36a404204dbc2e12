// The functions of one operand, and where operands come from. Bounds: Vulkan specification, "Precision of Individual
// Operations".
#include "precision/functions.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace lapilli::precision {
namespace {

using oracle::ulp;

constexpr const char* kCorrect = "correctly rounded";

Inexact correctly_rounded(double, double exact) { return oracle::rounded(exact, 0); }
Inexact no_error(double, double exact) { return {exact, 0, 0}; }

bool exp_overflows(double x) { return std::isinf(float(std::exp(std::abs(x)))); }
Inexact sinh_formula(Inexact x) { return (oracle::exp(x) - oracle::exp(-x)) * 0.5; }
Inexact cosh_formula(Inexact x) { return (oracle::exp(x) + oracle::exp(-x)) * 0.5; }

// As the formulas have it: infinite where exp(|x|) is, although the exact value fits up to 89.4.
double sinh_or_overflow(double x) { return exp_overflows(x) ? std::copysign(HUGE_VAL, x) : std::sinh(x); }
double cosh_or_overflow(double x) { return exp_overflows(x) ? HUGE_VAL : std::cosh(x); }

double fraction(double x) { return std::isinf(x) ? NAN : x - std::floor(x); }

double significand(double x) {
  int exponent;
  return std::frexp(x, &exponent);
}

// Float to int32 and back. What does not fit is saturated here, and NaN is 0; the specification leaves both open.
double whole(double x) {
  return std::isnan(x) ? 0
                       : std::clamp(std::trunc(x), double(std::numeric_limits<int32_t>::min()),
                                    double(std::numeric_limits<int32_t>::max()));
}
Inexact whole_allowed(double x, double exact) {
  return std::abs(x) < 0x1p31 ? oracle::rounded(exact, 0) : Inexact(exact, INFINITY, 0);
}

double half_ulp(double x) { return std::ldexp(1.0, std::max(x == 0 ? -14 : std::ilogb(x), -14) - 10); }
double nearest_half(double x) {
  if (!std::isfinite(x)) return x;
  const double rounded = std::nearbyint(x / half_ulp(x)) * half_ulp(x);
  return std::abs(rounded) >= 65536 ? std::copysign(INFINITY, x) : rounded;
}
double low_half(double x) {
  const auto bits = static_cast<uint32_t>(x);
  const int exponent = bits >> 10 & 31, fraction_bits = bits & 1023;
  const double magnitude = exponent == 31  ? (fraction_bits == 0 ? INFINITY : NAN)
                           : exponent == 0 ? std::ldexp(fraction_bits, -24)
                                           : std::ldexp(1024 + fraction_bits, exponent - 25);
  return (bits & 0x8000) != 0 ? -magnitude : magnitude;
}

const OneOperand kOfOne[] = {
    {0, "sin", false, std::sin, [](double x, double) { return oracle::sin(x); }, "2^-11 absolute in [-π, π]", 2},
    {1, "cos", false, std::cos, [](double x, double) { return oracle::cos(x); }, "2^-11 absolute in [-π, π]", 2},
    {2, "tan", false, std::tan, [](double x, double) { return oracle::sin(x) / oracle::cos(x); }, "sin(x) / cos(x)", 2},
    {3, "asin", false, std::asin, [](double x, double) { return atan2(Inexact(x), sqrt(1.0 - Inexact(x) * x)); },
     "atan2(x, sqrt(1 - x * x))", 2},
    {4, "acos", false, std::acos, [](double x, double) { return atan2(sqrt(1.0 - Inexact(x) * x), x); },
     "atan2(sqrt(1 - x * x), x)", 2},
    {5, "atan", false, std::atan, [](double x, double) { return oracle::atan2(x, 1.0); }, "4096 ULP", 2},
    {6, "sinh", false, sinh_or_overflow, [](double x, double) { return sinh_formula(x); }, "(exp(x) - exp(-x)) * 0.5",
     2},
    {7, "cosh", false, cosh_or_overflow, [](double x, double) { return cosh_formula(x); }, "(exp(x) + exp(-x)) * 0.5",
     2},
    {8, "tanh", false, std::tanh, [](double x, double) { return sinh_formula(x) / cosh_formula(x); },
     "sinh(x) / cosh(x)", 2},
    {9, "asinh", false, std::asinh, [](double x, double) { return log(x + sqrt(Inexact(x) * x + 1.0)); },
     "log(x + sqrt(x * x + 1))", 2},
    {10, "acosh", false, std::acosh, [](double x, double) { return log(x + sqrt(Inexact(x) * x - 1.0)); },
     "log(x + sqrt(x * x - 1))", 2},
    {11, "atanh", false, std::atanh,
     [](double x, double) { return log((1.0 + Inexact(x)) / (1.0 - Inexact(x))) * 0.5; },
     "log((1 + x) / (1 - x)) * 0.5", 2},
    {12, "exp", false, std::exp, [](double x, double) { return oracle::exp(x); }, "3 + 2 × abs(x) ULP", 2},
    {13, "exp2", false, std::exp2, [](double x, double) { return oracle::exp2(x); }, "3 + 2 × abs(x) ULP", 2},
    {14, "log", false, std::log, [](double x, double) { return oracle::log(x); }, "3 ULP; 2^-21 absolute in [0.5, 2]",
     2},
    {15, "log2", false, std::log2, [](double x, double) { return oracle::log2(x); },
     "3 ULP; 2^-21 absolute in [0.5, 2]", 2},
    {16, "sqrt", false, std::sqrt, [](double x, double) { return oracle::sqrt(x); }, "1 / inversesqrt(x)", 0.5},
    {17, "inversesqrt", false, [](double x) { return 1 / std::sqrt(x); },
     [](double x, double) { return oracle::inverse_sqrt(x); }, "2 ULP", 2},
    {18, "floor", false, std::floor, no_error, kCorrect, 0},
    {19, "ceil", false, std::ceil, no_error, kCorrect, 0},
    {20, "trunc", false, std::trunc, no_error, kCorrect, 0},
    {21, "roundEven", false, std::nearbyint, no_error, kCorrect, 0},
    {22, "fract", false, fraction, correctly_rounded, kCorrect, 1},
    {23, "radians", false, [](double x) { return x * (M_PI / 180); },
     [](double x, double) { return x * oracle::rounded(M_PI / 180, 0); }, "x * π / 180", 2},
    {24, "degrees", false, [](double x) { return x * (180 / M_PI); },
     [](double x, double) { return x * oracle::rounded(180 / M_PI, 0); }, "x * 180 / π", 2},
    {25, "modf (fraction)", false, [](double x) { return std::isinf(x) ? std::copysign(0.0, x) : x - std::trunc(x); },
     no_error, kCorrect, 0},
    {26, "frexp (significand)", false, significand,
     [](double x, double exact) { return std::isfinite(x) ? Inexact(exact) : Inexact(exact, INFINITY, 0); }, kCorrect,
     0},
    {27, "1.0 / x", false, [](double x) { return 1 / x; }, [](double x, double) { return 1.0 / Inexact(x); },
     "2.5 ULP for abs(x) in [2^-126, 2^126]", 0.5},
    {28, "float(int(x))", false, whole, whole_allowed, kCorrect, 0.5},
    {29, "int to float", true, [](double x) { return double(int32_t(uint32_t(x))); }, correctly_rounded, kCorrect, 0.5},
    {30, "uint to float", true, [](double x) { return x; }, correctly_rounded, kCorrect, 0.5},
    {31, "unpackHalf2x16", true, low_half, no_error, kCorrect, 0},
    {32, "packHalf2x16, unpacked", false, nearest_half,
     [](double x, double exact) { return Inexact(exact, 0, std::abs(x) <= 65504 ? half_ulp(x) : INFINITY); },
     "correctly rounded to half", 0},
    {33, "unpackSnorm4x8", true, [](double x) { return std::max((int32_t(uint32_t(x)) >> 24) / 127.0, -1.0); },
     [](double, double exact) { return Inexact(exact, 0, 2.5 * ulp(exact)); }, "f / 127", 0.5},
    {34, "unpackUnorm2x16", true, [](double x) { return (uint32_t(x) & 0xFFFF) / 65535.0; },
     [](double, double exact) { return Inexact(exact, 0, 2.5 * ulp(exact)); }, "f / 65535", 0.5},
};

constexpr float kMax = std::numeric_limits<float>::max(), kMin = std::numeric_limits<float>::min();
constexpr std::array kSpecial = {0.0f,      -0.0f, 1.0f,           -1.0f,          2.0f,      -2.0f,      3.0f,
                                 -3.0f,     0.5f,  -0.5f,          1e10f,          1e30f,     -1e30f,     1e-30f,
                                 kMax,      -kMax, kMin,           -kMin,          0x1p-149f, -0x1p-140f, INFINITY,
                                 -INFINITY, NAN,   0x1.fffffep-1f, 0x1.000002p+0f, 127.0f,    128.0f,     -149.0f};

}  // namespace

std::span<const OneOperand> functions_of_one() { return kOfOne; }

std::vector<float> operands_for(const SeveralOperands& function, size_t count, uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> moderate(-100, 100), unit(0, 1);
  std::vector<float> out;
  out.reserve(count * function.operands);
  for (size_t call = 0; call < count; ++call) {
    for (uint32_t i = 0; i < function.operands; ++i) {
      if (call < kSpecial.size() * kSpecial.size()) {
        out.push_back(i == 0   ? kSpecial[call / kSpecial.size()]
                      : i == 1 ? kSpecial[call % kSpecial.size()]
                               : kSpecial[random() % kSpecial.size()]);
      } else {
        out.push_back(call % 3 == 0   ? std::bit_cast<float>(uint32_t(random()))
                      : call % 3 == 1 ? moderate(random)
                                      : unit(random));
      }
    }
  }
  return out;
}

}  // namespace lapilli::precision
