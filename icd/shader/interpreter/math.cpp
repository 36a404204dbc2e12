// Ops: the functions of GLSL.std.450 (base/lane_math-inl.h).
#include "base/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shader/interpreter/math.cpp"
#include <hwy/foreach_target.h>

#include "base/lane_math-inl.h"
#include "shader/interpreter/handlers.h"
#include "shader/interpreter/machine-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {
namespace {

LAPILLI_OP1(fsqrt, sqrt(a))
LAPILLI_OP1(frsqrt, inverse_sqrt(a))
LAPILLI_OP1(ffract, fract(a))
LAPILLI_OP2(frem, frem(a, b))
LAPILLI_OP2(fmod, fmod(a, b))
LAPILLI_OP1(fsin, sin(a))
LAPILLI_OP1(fcos, cos(a))
LAPILLI_OP1(ftan, tan(a))
LAPILLI_OP1(fasin, asin(a))
LAPILLI_OP1(facos, acos(a))
LAPILLI_OP1(fatan, atan(a))
LAPILLI_OP2(fatan2, atan2(a, b))
LAPILLI_OP1(fsinh, sinh(a))
LAPILLI_OP1(fcosh, cosh(a))
LAPILLI_OP1(ftanh, tanh(a))
LAPILLI_OP1(fasinh, asinh(a))
LAPILLI_OP1(facosh, acosh(a))
LAPILLI_OP1(fatanh, atanh(a))
LAPILLI_OP1(fexp, exp(a))
LAPILLI_OP1(fexp2, exp2(a))
LAPILLI_OP1(flog, log(a))
LAPILLI_OP1(flog2, log2(a))
LAPILLI_OP2(fpow, pow(a, b))
LAPILLI_OP2(fldexp, ldexp(a, b))
LAPILLI_OP1(ffrexp_significand, frexp(a).significand)
LAPILLI_OP1(ffrexp_exponent, frexp(a).exponent)

const HandlerEntry kEntries[] = {
    LAPILLI_HOT1(fsqrt, F(F)),
    LAPILLI_HOT1(frsqrt, F(F)),
    LAPILLI_HOT1(ffract, F(F)),
    LAPILLI_COLD(frem, F(F, F)),
    LAPILLI_COLD(fmod, F(F, F)),
    LAPILLI_COLD(fsin, F(F)),
    LAPILLI_COLD(fcos, F(F)),
    LAPILLI_COLD(ftan, F(F)),
    LAPILLI_COLD(fasin, F(F)),
    LAPILLI_COLD(facos, F(F)),
    LAPILLI_COLD(fatan, F(F)),
    LAPILLI_COLD(fatan2, F(F, F)),
    LAPILLI_COLD(fsinh, F(F)),
    LAPILLI_COLD(fcosh, F(F)),
    LAPILLI_COLD(ftanh, F(F)),
    LAPILLI_COLD(fasinh, F(F)),
    LAPILLI_COLD(facosh, F(F)),
    LAPILLI_COLD(fatanh, F(F)),
    LAPILLI_COLD(fexp, F(F)),
    LAPILLI_COLD(fexp2, F(F)),
    LAPILLI_COLD(flog, F(F)),
    LAPILLI_COLD(flog2, F(F)),
    LAPILLI_COLD(fpow, F(F, F)),
    LAPILLI_COLD(fldexp, F(F, I)),
    LAPILLI_COLD(ffrexp_significand, F(F)),
    LAPILLI_COLD(ffrexp_exponent, I(F)),
};

}  // namespace

HandlerList math_handlers() { return kEntries; }

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lapilli {
const PerTarget<ListHandlers> kMathHandlers = LAPILLI_PER_TARGET(math_handlers);
}  // namespace lapilli
#endif
