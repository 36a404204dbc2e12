// For tests: the functions of lane_math-inl.h over arrays, for each SIMD target.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/simd_dispatch.h"

namespace lapilli {

// Counts are multiples of 16.
using UnaryRun = void(const float* x, float* result, std::size_t count);
using BinaryRun = void(const float* x, const float* y, float* result, std::size_t count);

// clang-format off
#define LAPILLI_UNARY_MATH(X)                                                                   \
  X(sin) X(cos) X(tan) X(asin) X(acos) X(atan) X(sinh) X(cosh) X(tanh) X(asinh) X(acosh) X(atanh) \
  X(exp) X(exp2) X(log) X(log2) X(inverse_sqrt) X(sqrt) X(fract) X(trunc) X(floor) X(ceil) X(round_even)
// clang-format on
#define LAPILLI_BINARY_MATH(X) X(pow) X(atan2) X(frem) X(fmod) X(min) X(max) X(nmin) X(nmax)

struct MathRuns {
#define LAPILLI_MEMBER(name) UnaryRun* name;
  LAPILLI_UNARY_MATH(LAPILLI_MEMBER)
#undef LAPILLI_MEMBER
#define LAPILLI_MEMBER(name) BinaryRun* name;
  LAPILLI_BINARY_MATH(LAPILLI_MEMBER)
#undef LAPILLI_MEMBER
  void (*fma)(const float* a, const float* b, const float* c, float* result, std::size_t count);
  void (*ldexp)(const float* x, const std::int32_t* exponent, float* result, std::size_t count);
  void (*frexp)(const float* x, float* significand, std::int32_t* exponent, std::size_t count);
  void (*modf)(const float* x, float* whole, float* fraction, std::size_t count);
};

const MathRuns& math_runs(SimdTarget target);

}  // namespace lapilli
