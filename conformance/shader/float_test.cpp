// float32 arithmetic against IEEE 754 and against float64. Specification: appendix "Vulkan Environment for SPIR-V",
// Precision and Operation of SPIR-V Instructions. Lapilli promises more where it says so.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "harness/devices.h"
#include "oracle/ulp.h"
#include "shader/numbers.h"
#include "shaders/float_basic.comp.h"
#include "shaders/float_functions.comp.h"

namespace lapilli::conformance {
namespace {

using oracle::ulp;

// The host's own float32 arithmetic: IEEE, because this file is compiled without contraction.
struct ExactOp {
  int op;
  const char* name;
  std::function<float(float, float, float)> value;
  double other_drivers_ulp = 0;  // what the specification allows where Lapilli promises the exact result
  bool nan_in = true;            // false: results for NaN operands are left open
};

float mix_sign(float v) { return v > 0 ? 1.0f : v < 0 ? -1.0f : v; }

const ExactOp kExact[] = {
    {0, "add", [](float a, float b, float) { return a + b; }},
    {1, "sub", [](float a, float b, float) { return a - b; }},
    {2, "mul", [](float a, float b, float) { return a * b; }},
    {3, "div", [](float a, float b, float) { return a / b; }, 2.5},
    {4, "fma", [](float a, float b, float c) { return std::fma(a, b, c); }, INFINITY},
    {5, "negate", [](float a, float, float) { return -a; }},
    {6, "abs", [](float a, float, float) { return std::abs(a); }},
    {7, "sign", [](float a, float, float) { return mix_sign(a); }, 0, false},
    {8, "min", [](float a, float b, float) { return b < a ? b : a; }, 0, false},
    {9, "max", [](float a, float b, float) { return a < b ? b : a; }, 0, false},
    {10, "clamp", [](float a, float b, float c) { return std::fmin(std::fmax(a, std::fmin(b, c)), std::fmax(b, c)); },
     0, false},
    {11, "floor", [](float a, float, float) { return std::floor(a); }},
    {12, "ceil", [](float a, float, float) { return std::ceil(a); }},
    {13, "trunc", [](float a, float, float) { return std::trunc(a); }},
    {14, "roundEven", [](float a, float, float) { return std::nearbyint(a); }},
    {16, "fract", [](float a, float, float) { return std::isinf(a) ? NAN : a - std::floor(a); }, 0, false},
    {18, "step", [](float a, float b, float) { return b < a ? 0.0f : 1.0f; }, 0, false},
    {21, "sqrt", [](float a, float, float) { return std::sqrt(a); }, 3},
    {28, "equal", [](float a, float b, float) { return float(a == b); }},
    // OpFOrdNotEqual would say false for a NaN; glslang makes OpFUnordNotEqual of !=.
    {29, "not equal", [](float a, float b, float) { return float(a != b); }},
    {30, "less", [](float a, float b, float) { return float(a < b); }},
    {31, "less or equal", [](float a, float b, float) { return float(a <= b); }},
    {32, "greater", [](float a, float b, float) { return float(a > b); }},
    {33, "greater or equal", [](float a, float b, float) { return float(a >= b); }},
    {34, "isnan", [](float a, float, float) { return float(std::isnan(a)); }},
    {35, "isinf", [](float a, float, float) { return float(std::isinf(a)); }},
    {36, "not less", [](float a, float b, float) { return float(!(a < b)); }},
    {39, "logical", [](float a, float b, float c) { return float((a < b && b < c) || a > c); }},
    {40, "select", [](float a, float b, float c) { return a < b ? c : a; }},
};

bool denormal(float v) { return v != 0 && std::abs(v) < std::numeric_limits<float>::min(); }

// Drivers may flush denormals, and may treat NaN and infinities as numbers; Lapilli does neither.
bool excused(float a, float b, float c, float want) {
  if (subject_is_lapilli()) return false;
  for (const float v : {a, b, c, want}) {
    if (denormal(v) || !std::isfinite(v)) return true;
  }
  return false;
}

TEST(FloatArithmetic, CorrectlyRounded) {
  const FloatOperands in = float_operands(1);
  for (const ExactOp& op : kExact) {
    const std::vector<float> got = run_op(subject(), shaders::kFloatBasicComp, op.op, in.a, in.b, in.c);
    int wrong = 0;
    for (size_t i = 0; i < got.size(); ++i) {
      const float a = in.a[i], b = in.b[i], c = in.c[i];
      if (!op.nan_in && (std::isnan(a) || std::isnan(b) || std::isnan(c))) continue;
      const float want = op.value(a, b, c);
      const double allowed = subject_is_lapilli() ? 0 : op.other_drivers_ulp;
      // The sign of a zero: kept by arithmetic, left open by min, max and clamp.
      const bool zero_sign = want != 0 || std::signbit(got[i]) == std::signbit(want) || !subject_is_lapilli() ||
                             op.op == 7 || op.op == 8 || op.op == 9 || op.op == 10;
      const bool same = std::isnan(want) ? std::isnan(got[i]) : oracle::ulp_error(got[i], double(want)) <= allowed;
      // x - floor(x) of a small negative number rounds to 1; the largest number below 1 is right as well.
      const bool below_one = op.op == 16 && want == 1.0f && got[i] == 0x1.fffffep-1f;
      if ((same && zero_sign) || below_one || excused(a, b, c, want)) continue;
      if (++wrong <= 3) {
        ADD_FAILURE() << op.name << std::hexfloat << "(" << a << ", " << b << ", " << c << ") = " << got[i]
                      << ", expected " << want;
      }
    }
    EXPECT_EQ(wrong, 0) << op.name;
  }
}

// Operations whose result has a bound: absolute error allowed by the specification (or inherited), and by Lapilli.
struct BoundedOp {
  int op;
  const char* name;
  std::function<double(double, double, double)> value;
  std::function<double(double want, double a, double b, double c)> allowed;
  std::function<bool(double, double, double)> domain;
};

double modulo(double a, double b) { return a - b * std::floor(a / b); }

const BoundedOp kBounded[] = {
    {15, "round", [](double a, double, double) { return std::round(a); },
     // A half may go either way.
     [](double, double a, double, double) { return a - std::floor(a) == 0.5 ? 1.0 : 0.0; },
     [](double a, double, double) { return std::isfinite(a); }},
    {17, "mod", [](double a, double b, double) { return modulo(a, b); },
     [](double, double a, double b, double) { return 2 * ulp(a) + 2 * ulp(b); },
     [](double a, double b, double) {
       // Close to a multiple of b the quotient may be rounded to the next integer.
       const double q = a / b;
       return std::abs(b) > 1e-3 && std::abs(q) < 1000 && std::abs(q - std::nearbyint(q)) > 1e-4;
     }},
    {19, "mix", [](double a, double b, double c) { return a * (1 - c) + b * c; },
     [](double, double a, double b, double c) { return 2 * ulp(a * (1 - c)) + 2 * ulp(b * c) + ulp(a) * std::abs(c); },
     [](double a, double b, double c) {
       return std::abs(a) < 1e30 && std::abs(b) < 1e30 && std::abs(c) < 1e6 && std::abs(a * c) > 1e-30 &&
              std::abs(b * c) > 1e-30;
     }},
    {20, "smoothstep",
     [](double a, double b, double c) {
       const double t = std::fmin(std::fmax((c - a) / (b - a), 0.0), 1.0);
       return t * t * (3 - 2 * t);
     },
     [](double, double, double, double) { return 2e-6; },
     [](double a, double b, double c) { return a < b && b < 1e6 && a > -1e6 && std::abs(c) < 1e6 && b - a > 1e-3; }},
    {22, "inversesqrt", [](double a, double, double) { return 1 / std::sqrt(a); },
     [](double want, double, double, double) { return 2 * ulp(want); },
     [](double a, double, double) { return a > 0 && std::isfinite(a); }},
    {23, "modf", [](double a, double, double) { return a - std::trunc(a); },
     [](double, double, double, double) { return 0.0; }, [](double a, double, double) { return std::isfinite(a); }},
    {24, "modf, whole", [](double a, double, double) { return std::trunc(a); },
     [](double, double, double, double) { return 0.0; }, [](double a, double, double) { return std::isfinite(a); }},
    {25, "frexp",
     [](double a, double, double) {
       int e;
       return std::frexp(a, &e);
     },
     [](double, double, double, double) { return 0.0; }, [](double a, double, double) { return std::isfinite(a); }},
    {26, "frexp, exponent",
     [](double a, double, double) {
       int e = 0;
       (void)std::frexp(a, &e);
       return double(e);
     },
     [](double, double, double, double) { return 0.0; }, [](double a, double, double) { return std::isfinite(a); }},
    {27, "ldexp", [](double a, double b, double) { return double(float(std::ldexp(a, int(b)))); },
     [](double want, double, double, double) { return subject_is_lapilli() ? 0.0 : ulp(want); },
     [](double a, double b, double) {
       return std::isfinite(a) && std::abs(b) < 280 && std::abs(std::ldexp(a, int(b))) < 3e38;
     }},
    {37, "radians", [](double a, double, double) { return a * M_PI / 180; },
     [](double want, double, double, double) { return 2 * ulp(want); },
     [](double a, double, double) { return std::abs(a) < 1e30 && std::abs(a) > 1e-30; }},
    {38, "degrees", [](double a, double, double) { return a * 180 / M_PI; },
     [](double want, double, double, double) { return 2 * ulp(want); },
     [](double a, double, double) { return std::abs(a) < 1e30 && std::abs(a) > 1e-30; }},
};

TEST(FloatArithmetic, WithinBounds) {
  const FloatOperands in = float_operands(2);
  for (const BoundedOp& op : kBounded) {
    const std::vector<float> got = run_op(subject(), shaders::kFloatBasicComp, op.op, in.a, in.b, in.c);
    int wrong = 0, compared = 0;
    for (size_t i = 0; i < got.size(); ++i) {
      const double a = double(in.a[i]), b = double(in.b[i]), c = double(in.c[i]);
      if (!op.domain(a, b, c)) continue;
      const double want = op.value(a, b, c);
      if (excused(in.a[i], in.b[i], in.c[i], float(want))) continue;
      ++compared;
      if (std::abs(double(got[i]) - want) <= op.allowed(want, a, b, c)) continue;
      if (++wrong <= 3) {
        ADD_FAILURE() << op.name << std::hexfloat << "(" << in.a[i] << ", " << in.b[i] << ", " << in.c[i]
                      << ") = " << got[i] << ", expected " << want << std::defaultfloat << ", off by "
                      << oracle::ulp_error(got[i], want) << " ULP";
      }
    }
    EXPECT_EQ(wrong, 0) << op.name;
    EXPECT_GT(compared, 1000) << op.name;
  }
}

// Functions of one or two arguments. `spec` is the specification's bound (absolute); Lapilli's own is kOwnBound ULP.
struct Function {
  int op;
  const char* name;
  std::function<double(double, double)> value;
  float low, high;
  std::function<double(double want, double x, double y)> spec;
  float low_b = 0, high_b = 0;
};

constexpr double kOwnBound = 3;  // ULP

double absolute(double want, double bound) { return std::max(bound, ulp(want)); }
double atan_bound(double want) { return 4096 * ulp(want); }
double exp_bound(double want, double x) { return (3 + 2 * std::abs(x)) * ulp(want); }
double log_bound(double want, double x) { return x >= 0.5 && x <= 2 ? 0x1p-21 : 3 * ulp(want); }
// Inherited from sin and cos, exp, log … as the formulas of the specification combine them.
double loose(double want) { return 1e-3 * std::abs(want) + 1e-3; }

const Function kFunctions[] = {
    {0, "sin", [](double x, double) { return std::sin(x); }, -3.1415927f, 3.1415927f,
     [](double want, double, double) { return absolute(want, 0x1p-11); }},
    {1, "cos", [](double x, double) { return std::cos(x); }, -3.1415927f, 3.1415927f,
     [](double want, double, double) { return absolute(want, 0x1p-11); }},
    {2, "tan", [](double x, double) { return std::tan(x); }, -1.5f, 1.5f,
     [](double want, double, double) { return loose(want * 30); }},
    {3, "asin", [](double x, double) { return std::asin(x); }, -1, 1,
     [](double want, double, double) { return atan_bound(want) + loose(want); }},
    {4, "acos", [](double x, double) { return std::acos(x); }, -1, 1,
     [](double want, double, double) { return atan_bound(want) + loose(want); }},
    {5, "atan", [](double x, double) { return std::atan(x); }, -1e6f, 1e6f,
     [](double want, double, double) { return atan_bound(want); }},
    {6, "sinh", [](double x, double) { return std::sinh(x); }, -80, 80,
     [](double want, double, double) { return loose(want); }},
    {7, "cosh", [](double x, double) { return std::cosh(x); }, -80, 80,
     [](double want, double, double) { return loose(want); }},
    {8, "tanh", [](double x, double) { return std::tanh(x); }, -40, 40,
     [](double want, double, double) { return loose(want); }},
    {9, "asinh", [](double x, double) { return std::asinh(x); }, -1e6f, 1e6f,
     // ln(x + sqrt(x^2 + 1)) cancels for negative x: nothing is asked there.
     [](double want, double x, double) { return x < -100 ? INFINITY : loose(want); }},
    {10, "acosh", [](double x, double) { return std::acosh(x); }, 1, 1e6f,
     [](double want, double, double) { return loose(want); }},
    {11, "atanh", [](double x, double) { return std::atanh(x); }, -0.9999f, 0.9999f,
     [](double want, double, double) { return loose(want); }},
    {12, "atan2", [](double y, double x) { return std::atan2(y, x); }, -100, 100,
     [](double want, double, double) { return atan_bound(want); }, -100, 100},
    {13, "pow", [](double x, double y) { return std::pow(x, y); }, 0x1p-20f, 1000,
     // exp2(y * log2(x)): the error of the logarithm, multiplied by y, is relative in the result.
     [](double want, double x, double y) {
       const double log2x = std::log2(x), exponent_error = std::abs(y) * log_bound(log2x, x) + ulp(y * log2x);
       return want * exponent_error + exp_bound(want, y * log2x);
     },
     -8, 8},
    {14, "exp", [](double x, double) { return std::exp(x); }, -87, 88,
     [](double want, double x, double) { return exp_bound(want, x); }},
    {15, "log", [](double x, double) { return std::log(x); }, 0x1p-126f, 1e30f,
     [](double want, double x, double) { return log_bound(want, x); }},
    {16, "exp2", [](double x, double) { return std::exp2(x); }, -125, 127.9f,
     [](double want, double x, double) { return exp_bound(want, x); }},
    {17, "log2", [](double x, double) { return std::log2(x); }, 0x1p-126f, 1e30f,
     [](double want, double x, double) { return log_bound(want, x); }},
};

TEST(FloatFunctions, WithinTheSpecificationsBoundsAndOurs) {
  for (const Function& f : kFunctions) {
    const std::vector<float> a = floats_between(uint32_t(f.op), f.low, f.high, 8000);
    std::vector<float> b = floats_between(uint32_t(f.op) + 50, f.low_b, f.high_b, 2);
    if (f.high_b > f.low_b) b = floats_between(uint32_t(f.op) + 50, f.low_b, f.high_b, 8000);
    b.resize(a.size(), 0);
    const std::vector<float> got = run_op(subject(), shaders::kFloatFunctionsComp, f.op, a, b, b);
    int wrong = 0;
    double worst = 0;
    size_t worst_at = 0;
    for (size_t i = 0; i < got.size(); ++i) {
      const double x = double(a[i]), y = double(b[i]);
      if (!subject_is_lapilli() && (denormal(a[i]) || denormal(b[i]))) continue;
      const double want = f.value(x, y);
      // Vulkan leaves atan(0, 0) open.
      if (f.op == 12 && x == 0 && y == 0) continue;
      if (!subject_is_lapilli() && (denormal(float(want)) || std::abs(want) < 1e-35)) continue;
      const double error = oracle::ulp_error(got[i], want);
      if (error > worst) {
        worst = error;
        worst_at = i;
      }
      const bool in_spec = error == 0 || std::abs(double(got[i]) - want) <= f.spec(want, x, y);
      if (in_spec && (!subject_is_lapilli() || error <= kOwnBound)) continue;
      if (++wrong <= 3) {
        ADD_FAILURE() << f.name << std::hexfloat << "(" << a[i] << ", " << b[i] << ") = " << got[i] << ", expected "
                      << want << std::defaultfloat << ": " << error << " ULP, " << (in_spec ? "within" : "beyond")
                      << " the specification's bound";
      }
    }
    EXPECT_EQ(wrong, 0) << f.name;
    std::printf("  %-6s worst %.3g ULP at %a, %a\n", f.name, worst, double(a[worst_at]), double(b[worst_at]));
  }
}

// Beyond the ranges in which the specification gives bounds: the values that mathematics gives.
TEST(FloatFunctions, LimitsAndLargeArguments) {
  if (!subject_is_lapilli()) GTEST_SKIP() << "the specification asks for nothing here";
  const float inf = INFINITY;
  const struct {
    int op;
    float a, b, want;
  } cases[] = {{14, inf, 0, inf},
               {14, -inf, 0, 0},
               {14, 100, 0, inf},
               {14, -200, 0, 0},
               {16, 128, 0, inf},
               {16, -160, 0, 0},
               {16, -149, 0, 0x1p-149f},
               {15, 0, 0, -inf},
               {15, inf, 0, inf},
               {15, -1, 0, NAN},
               {17, 0x1p-149f, 0, -149},
               {17, 0, 0, -inf},
               {17, 8, 0, 3},
               {0, inf, 0, NAN},
               {1, -inf, 0, NAN},
               {5, inf, 0, 1.57079637f},
               {5, -inf, 0, -1.57079637f},
               {8, inf, 0, 1},
               {8, -inf, 0, -1},
               {6, inf, 0, inf},
               {7, -inf, 0, inf},
               {3, 2, 0, NAN},
               {4, -2, 0, NAN},
               {10, 0.5f, 0, NAN},
               {11, 1, 0, inf},
               {11, 2, 0, NAN},
               {13, 2, 10, 1024},
               {13, 0, 2, 0},
               {13, 1, 100, 1},
               {13, 10, 0, 1},
               {13, inf, 2, inf},
               {13, 2, -inf, 0},
               {14, NAN, 0, NAN},
               {0, NAN, 0, NAN}};
  for (const auto& c : cases) {
    const float got = run_op<float>(subject(), shaders::kFloatFunctionsComp, c.op, {c.a}, {c.b}, {0})[0];
    if (std::isnan(c.want)) {
      EXPECT_TRUE(std::isnan(got)) << "function " << c.op << "(" << c.a << ", " << c.b << ") = " << got;
    } else {
      EXPECT_EQ(got, c.want) << "function " << c.op << "(" << c.a << ", " << c.b << ")";
    }
  }
  for (const int op : {0, 1, 2}) {
    const std::vector<float> a = {1e4f, 123456.789f, 1e10f, 0x1p+100f, 3e38f, -7e22f};
    const std::vector<float> zero(a.size());
    const std::vector<float> got = run_op(subject(), shaders::kFloatFunctionsComp, op, a, zero, zero);
    for (size_t i = 0; i < a.size(); ++i) {
      const double x = double(a[i]), want = op == 0 ? std::sin(x) : op == 1 ? std::cos(x) : std::tan(x);
      EXPECT_LE(oracle::ulp_error(got[i], want), kOwnBound) << "function " << op << "(" << a[i] << ")";
    }
  }
}

}  // namespace
}  // namespace lapilli::conformance
