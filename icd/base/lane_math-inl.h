// The functions of GLSL.std.450 on lanes (the SPIR-V extended instruction set), float32. Per-target header.
//
// Every function is a fixed sequence of IEEE operations, exact fma and integer operations: the same bits on all
// targets. Denormals, ±0, infinities and NaN are handled as C's math library does. The largest errors over all inputs
// are in lane_math_test.cpp, which asserts them; the coefficients come from lane_math_fit.py.
//   lane_trig-inl.h        sin cos tan asin acos atan atan2
//   lane_exp-inl.h         exp exp2 log log2 pow inverse_sqrt
//   lane_hyperbolic-inl.h  sinh cosh tanh asinh acosh atanh
//   lane_parts-inl.h       frem fmod modf frexp ldexp fract

#if defined(LAPILLI_BASE_LANE_MATH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LAPILLI_BASE_LANE_MATH_INL_H
#undef LAPILLI_BASE_LANE_MATH_INL_H
#else
#define LAPILLI_BASE_LANE_MATH_INL_H
#endif

#include "base/lanes-inl.h"
//
#include "base/lane_exp-inl.h"
#include "base/lane_hyperbolic-inl.h"
#include "base/lane_parts-inl.h"
#include "base/lane_trig-inl.h"

#endif  // per target
