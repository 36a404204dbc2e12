// The functions of several operands: vectors, matrices and what is defined by a formula.
#include <algorithm>
#include <cmath>
#include <limits>

#include "precision/functions.h"

namespace lapilli::precision {
namespace {

constexpr const char* kCorrect = "correctly rounded";

// Each formula is written once, for double and for Inexact.
double square_root(double x) { return std::sqrt(x); }
Inexact square_root(Inexact x) { return oracle::sqrt(x); }
double inverse_root(double x) { return 1 / std::sqrt(x); }
Inexact inverse_root(Inexact x) { return oracle::inverse_sqrt(x); }
double clamped(double x) { return std::isnan(x) ? x : std::clamp(x, 0.0, 1.0); }
Inexact clamped(Inexact x) { return oracle::clamp01(x); }
double value_of(double x) { return x; }
double value_of(Inexact x) { return x.value; }
double error_of(double) { return 0; }
double error_of(Inexact x) { return x.error; }

// Where rounding decides between two results nothing is asked.
void leave_open(double*, int) {}
void leave_open(Inexact* y, int count) {
  for (int i = 0; i < count; ++i) y[i].error = INFINITY;
}

template <class N>
N dot3(const N* a, const N* b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class N>
struct Formula {
  static void mix(const N* x, N* y) { y[0] = x[0] * (N(1.0) - x[2]) + x[1] * x[2]; }
  static void smoothstep(const N* x, N* y) {
    const N t = clamped((x[2] - x[0]) / (x[1] - x[0]));
    y[0] = t * t * (N(3.0) - N(2.0) * t);
    if (!(value_of(x[0]) < value_of(x[1]))) leave_open(y, 1);
  }
  template <int kCount>
  static void length(const N* x, N* y) {
    N sum = x[0] * x[0];
    for (int i = 1; i < kCount; ++i) sum = sum + x[i] * x[i];
    y[0] = square_root(sum);
  }
  static void distance(const N* x, N* y) {
    const N difference[] = {x[0] - x[3], x[1] - x[4], x[2] - x[5]};
    length<3>(difference, y);
  }
  static void dot(const N* x, N* y) { y[0] = dot3(x, x + 3); }
  static void cross(const N* x, N* y) {
    for (int i = 0; i < 3; ++i) {
      const int k = (i + 1) % 3, l = (i + 2) % 3;
      y[i] = x[k] * x[3 + l] - x[l] * x[3 + k];
    }
  }
  static void normalize(const N* x, N* y) {
    for (int i = 0; i < 3; ++i) y[i] = x[i] * inverse_root(dot3(x, x));
  }
  static void reflect(const N* x, N* y) {
    for (int i = 0; i < 3; ++i) y[i] = x[i] - N(2.0) * dot3(x + 3, x) * x[3 + i];
  }
  static void refract(const N* x, N* y) {
    const N eta = x[6], cosine = dot3(x + 3, x), k = N(1.0) - eta * eta * (N(1.0) - cosine * cosine);
    for (int i = 0; i < 3; ++i) {
      y[i] = value_of(k) < 0 ? N(0.0) : eta * x[i] - (eta * cosine + square_root(k)) * x[3 + i];
    }
    if (!(std::abs(value_of(k)) > error_of(k))) leave_open(y, 3);
  }
  static void faceforward(const N* x, N* y) {
    const N side = dot3(x + 6, x + 3);
    for (int i = 0; i < 3; ++i) y[i] = value_of(side) < 0 ? x[i] : -x[i];
    if (!(std::abs(value_of(side)) > error_of(side))) leave_open(y, 3);
  }

  // Along the first row; `rows` and `columns` are those that are not taken out.
  template <int kSize>
  static N minor(const N* m, int row, unsigned rows, unsigned columns) {
    while (row < kSize && (rows >> row & 1) == 0) ++row;
    if (row == kSize) return N(1.0);
    N sum(0.0);
    bool negative = false, first = true;
    for (int column = 0; column < kSize; ++column) {
      if ((columns >> column & 1) == 0) continue;
      const N element = m[column * kSize + row];
      const bool last = (columns & (columns - 1)) == 0;
      const N term = last ? element : element * minor<kSize>(m, row + 1, rows, columns & ~(1u << column));
      sum = first ? term : negative ? sum - term : sum + term;
      negative = !negative;
      first = false;
    }
    return sum;
  }
  template <int kSize>
  static void determinant(const N* x, N* y) {
    y[0] = minor<kSize>(x, 0, (1u << kSize) - 1, (1u << kSize) - 1);
  }
  template <int kSize>
  static void inverse(const N* x, N* y) {
    constexpr unsigned kAll = (1u << kSize) - 1;
    const N all = minor<kSize>(x, 0, kAll, kAll);
    for (int column = 0; column < kSize; ++column) {
      for (int row = 0; row < kSize; ++row) {
        const N cofactor = minor<kSize>(x, 0, kAll & ~(1u << column), kAll & ~(1u << row));
        y[column * kSize + row] = ((row + column) % 2 == 0 ? cofactor : -cofactor) / all;
      }
    }
  }
};

// As in precision.comp.
int exponent_of(double x) { return x > -400 ? int(std::min(x, 400.0)) : -400; }

// The order of the terms is open: nothing is asked where a product of elements could overflow or underflow.
template <int kSize>
void open_if_extreme(const double* m, Inexact* y, int count) {
  double largest = 1, smallest = 1;
  for (int i = 0; i < kSize * kSize; ++i) {
    if (m[i] != 0) smallest = std::min(smallest, std::abs(m[i]));
    largest = std::max(largest, std::abs(m[i]));
  }
  const bool fits = std::pow(largest, kSize) * 24 < 0x1p127 && std::pow(smallest, kSize) > 0x1p-126;
  if (!fits) leave_open(y, count);
}

// Lets a Formula<Inexact> take operands without error.
template <void (*kFormula)(const Inexact*, Inexact*)>
void bound_of(const double* x, Inexact* y) {
  Inexact operands[kMaxOperands];
  std::copy_n(x, kMaxOperands, operands);
  kFormula(operands, y);
}

template <int kSize>
void determinant_bound(const double* x, Inexact* y) {
  bound_of<Formula<Inexact>::determinant<kSize>>(x, y);
  open_if_extreme<kSize>(x, y, 1);
}
template <int kSize>
void inverse_bound(const double* x, Inexact* y) {
  bound_of<Formula<Inexact>::inverse<kSize>>(x, y);
  open_if_extreme<kSize>(x, y, kSize * kSize);
}

using Exact = Formula<double>;
using Allowed = Formula<Inexact>;

constexpr double kOpen = std::numeric_limits<double>::infinity();

const SeveralOperands kOfSeveral[] = {
    {50, "a + b", 2, 1, [](const double* x, double* y) { y[0] = x[0] + x[1]; },
     [](const double* x, Inexact* y) { y[0] = Inexact(x[0]) + x[1]; }, kCorrect, 0.5},
    {51, "a - b", 2, 1, [](const double* x, double* y) { y[0] = x[0] - x[1]; },
     [](const double* x, Inexact* y) { y[0] = Inexact(x[0]) - x[1]; }, kCorrect, 0.5},
    {52, "a * b", 2, 1, [](const double* x, double* y) { y[0] = x[0] * x[1]; },
     [](const double* x, Inexact* y) { y[0] = Inexact(x[0]) * x[1]; }, kCorrect, 0.5},
    {53, "a / b", 2, 1, [](const double* x, double* y) { y[0] = x[0] / x[1]; },
     [](const double* x, Inexact* y) { y[0] = Inexact(x[0]) / x[1]; }, "2.5 ULP for abs(b) in [2^-126, 2^126]", 0.5},
    // In double, a product of floats is exact and only the sum is rounded, far below a float's last place.
    {54, "fma", 3, 1, [](const double* x, double* y) { y[0] = x[0] * x[1] + x[2]; },
     [](const double* x, Inexact* y) { y[0] = Inexact(x[0]) * x[1] + x[2]; }, "a * b + c", 0.5001},
    {55, "pow", 2, 1, [](const double* x, double* y) { y[0] = std::pow(x[0], x[1]); },
     [](const double* x, Inexact* y) {
       y[0] = exp2(Inexact(x[1]) * oracle::log2(x[0]));
       if (!(x[0] > 0)) y[0].error = INFINITY;
     },
     "exp2(y * log2(x))", 2},
    {56, "atan(y, x)", 2, 1, [](const double* x, double* y) { y[0] = std::atan2(x[0], x[1]); },
     [](const double* x, Inexact* y) {
       y[0] = oracle::atan2(x[0], x[1]);
       if (x[0] == 0 && x[1] == 0) y[0].error = INFINITY;
     },
     "4096 ULP", 2},
    {57, "mod", 2, 1,
     [](const double* x, double* y) {
       const double rest = std::fmod(x[0], x[1]);
       y[0] = rest != 0 && (rest < 0) != (x[1] < 0) ? rest + x[1] : rest;
     },
     [](const double* x, Inexact* y) { y[0] = Inexact(x[0]) - x[1] * floor(Inexact(x[0]) / x[1]); },
     "x - y * floor(x / y)", kOpen},
    {58, "ldexp", 2, 1, [](const double* x, double* y) { y[0] = std::ldexp(x[0], exponent_of(x[1])); },
     [](const double* x, Inexact* y) {
       y[0] = oracle::rounded(std::ldexp(x[0], exponent_of(x[1])), 0);
       if (!(x[1] >= -126 && x[1] <= 128)) y[0].error = INFINITY;
     },
     kCorrect, 0.5},
    {59, "mix", 3, 1, Exact::mix, bound_of<Allowed::mix>, "x * (1 - a) + y * a", kOpen},
    {60, "smoothstep", 3, 1, Exact::smoothstep, bound_of<Allowed::smoothstep>, "t * t * (3 - 2 * t)", kOpen},
    {61, "length(vec2)", 2, 1, Exact::length<2>, bound_of<Allowed::length<2>>, "sqrt(dot(x, x))", kOpen},
    {62, "length(vec3)", 3, 1, Exact::length<3>, bound_of<Allowed::length<3>>, "sqrt(dot(x, x))", kOpen},
    {63, "length(vec4)", 4, 1, Exact::length<4>, bound_of<Allowed::length<4>>, "sqrt(dot(x, x))", kOpen},
    {64, "distance(vec3)", 6, 1, Exact::distance, bound_of<Allowed::distance>, "length(x - y)", kOpen},
    {65, "dot(vec3)", 6, 1, Exact::dot, bound_of<Allowed::dot>, "sum of x[i] * y[i]", kOpen},
    {66, "cross", 6, 3, Exact::cross, bound_of<Allowed::cross>, "x[k] * y[l] - x[l] * y[k]", kOpen},
    {67, "normalize(vec3)", 3, 3, Exact::normalize, bound_of<Allowed::normalize>, "x * inversesqrt(dot(x, x))", kOpen},
    {68, "reflect(vec3)", 6, 3, Exact::reflect, bound_of<Allowed::reflect>, "I - 2 * dot(N, I) * N", kOpen},
    {69, "refract(vec3)", 7, 3, Exact::refract, bound_of<Allowed::refract>, "eta * I - (eta * dot(N, I) + sqrt(k)) * N",
     kOpen},
    {70, "faceforward(vec3)", 9, 3, Exact::faceforward, bound_of<Allowed::faceforward>, "dot(Nref, I) < 0 ? N : -N",
     kOpen},
    {71, "determinant(mat2)", 4, 1, Exact::determinant<2>, determinant_bound<2>, "by cofactors", kOpen},
    {72, "determinant(mat3)", 9, 1, Exact::determinant<3>, determinant_bound<3>, "by cofactors", kOpen},
    {73, "determinant(mat4)", 16, 1, Exact::determinant<4>, determinant_bound<4>, "by cofactors", kOpen},
    {74, "inverse(mat2)", 4, 4, Exact::inverse<2>, inverse_bound<2>, "cofactors / determinant", kOpen},
    {75, "inverse(mat3)", 9, 9, Exact::inverse<3>, inverse_bound<3>, "cofactors / determinant", kOpen},
    {76, "inverse(mat4)", 16, 16, Exact::inverse<4>, inverse_bound<4>, "cofactors / determinant", kOpen},
};

}  // namespace

std::span<const SeveralOperands> functions_of_several() { return kOfSeveral; }

}  // namespace lapilli::precision
