// Numbers with the error that the specification allows them, so that a formula that a bound is "inherited from" is
// written once and gives the bound at any operands. Specification: appendix "Vulkan Environment for SPIR-V", "Precision
// of Individual Operations".
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "oracle/ulp.h"

namespace lapilli::oracle {

// The exact value in double, and how far from it a float32 computation may be; infinity where nothing is asked.
struct Inexact {
  double value = 0;
  double error = 0;

  Inexact() = default;
  Inexact(double exact) : value(exact) {}  // NOLINT: operands are exact
  // A result whose operands' errors made `inherited` of it, itself with a bound of `own` (absolute).
  Inexact(double result, double inherited, double own) : value(result), error(inherited + own) {
    const double largest = double(std::numeric_limits<float>::max());
    if (!(std::abs(value) + error <= largest)) error = INFINITY;  // NaN, or overflow on the way
  }
};

// "Correctly rounded": to either neighbour.
inline Inexact rounded(double value, double inherited) { return {value, inherited, ulp(value)}; }

inline Inexact operator-(Inexact a) {
  a.value = -a.value;
  return a;
}
inline Inexact operator+(Inexact a, Inexact b) { return rounded(a.value + b.value, a.error + b.error); }
inline Inexact operator-(Inexact a, Inexact b) { return rounded(a.value - b.value, a.error + b.error); }
inline Inexact operator*(Inexact a, Inexact b) {
  return rounded(a.value * b.value, std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error);
}
// 2.5 ULP for divisors in [2^-126, 2^126].
inline Inexact operator/(Inexact a, Inexact b) {
  const double quotient = a.value / b.value, magnitude = std::abs(b.value);
  if (!(magnitude - b.error >= 0x1p-126 && magnitude + b.error <= 0x1p126)) return {quotient, INFINITY, 0};
  return {quotient, (a.error + std::abs(quotient) * b.error) / (magnitude - b.error), 2.5 * ulp(quotient)};
}

inline Inexact exp2(Inexact x) {
  const double value = std::exp2(x.value);
  return {value, value * std::expm1(x.error * std::log(2.0)), (3 + 2 * std::abs(x.value)) * ulp(value)};
}
inline Inexact exp(Inexact x) {
  const double value = std::exp(x.value);
  return {value, value * std::expm1(x.error), (3 + 2 * std::abs(x.value)) * ulp(value)};
}
// 3 ULP outside of [0.5, 2], 2^-21 inside.
inline double logarithm_bound(double x, double value) { return x >= 0.5 && x <= 2 ? 0x1p-21 : 3 * ulp(value); }
inline Inexact log2(Inexact x) {
  const double value = std::log2(x.value);
  if (!(x.error < x.value)) return {value, INFINITY, 0};
  return {value, value - std::log2(x.value - x.error), logarithm_bound(x.value, value)};
}
inline Inexact log(Inexact x) {
  const double value = std::log(x.value);
  if (!(x.error < x.value)) return {value, INFINITY, 0};
  return {value, value - std::log(x.value - x.error), logarithm_bound(x.value, value)};
}
inline Inexact inverse_sqrt(Inexact x) {
  const double value = 1 / std::sqrt(x.value);
  if (!(x.error < x.value)) return {value, INFINITY, 0};
  return {value, 1 / std::sqrt(x.value - x.error) - value, 2 * ulp(value)};
}
inline Inexact sqrt(Inexact x) {
  Inexact root = Inexact(1.0) / inverse_sqrt(x);
  root.value = std::sqrt(x.value);
  return root;
}
// 2^-11 in [-pi, pi].
inline Inexact circular(double value, Inexact x) {
  return {value, x.error, std::abs(x.value) <= M_PI ? 0x1p-11 : INFINITY};
}
inline Inexact sin(Inexact x) { return circular(std::sin(x.value), x); }
inline Inexact cos(Inexact x) { return circular(std::cos(x.value), x); }
inline Inexact atan2(Inexact y, Inexact x) {
  const double value = std::atan2(y.value, x.value);
  const double square = x.value * x.value + y.value * y.value;
  const double inherited =
      y.error + x.error == 0 ? 0 : (std::abs(x.value) * y.error + std::abs(y.value) * x.error) / square;
  return {value, inherited, 4096 * ulp(value)};
}
// An error that reaches over a whole number makes it one more.
inline Inexact floor(Inexact x) {
  const double low = std::floor(x.value - x.error), high = std::floor(x.value + x.error);
  return {std::floor(x.value), high - low, 0};
}
inline Inexact clamp01(Inexact x) {
  x.value = std::clamp(x.value, 0.0, 1.0);
  return x;
}

}  // namespace lapilli::oracle
