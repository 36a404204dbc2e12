// Ops: moves and float32 arithmetic.
#include "base/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shader/interpreter/arithmetic.cpp"
#include <hwy/foreach_target.h>

#include "shader/interpreter/handlers.h"
#include "shader/interpreter/machine-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {
namespace {

LAPILLI_OP1(mov, a)
LAPILLI_OP3(select, select(eq(a, zero_u()), c, b))
LAPILLI_OP2(fadd, a + b)
LAPILLI_OP2(fsub, a - b)
LAPILLI_OP2(fmul, a* b)
LAPILLI_OP2(fdiv, a / b)
LAPILLI_OP3(fma, fma(a, b, c))
LAPILLI_OP1(fneg, negate(a))
LAPILLI_OP1(fabs, abs(a))
LAPILLI_OP2(fmin, min(a, b))
LAPILLI_OP2(fmax, max(a, b))
LAPILLI_OP2(nmin, nmin(a, b))
LAPILLI_OP2(nmax, nmax(a, b))
LAPILLI_OP1(ffloor, floor(a))
LAPILLI_OP1(fceil, ceil(a))
LAPILLI_OP1(ftrunc, trunc(a))
LAPILLI_OP1(fround_even, round_even(a))

struct op_fsign {
  static HWY_INLINE F run(F a) {
    const F zero_or_a = select(is_nan(a), zero_f(), a);
    return select(lt(zero_f(), a), broadcast(1.0f), select(lt(a, zero_f()), broadcast(-1.0f), zero_or_a));
  }
};

const HandlerEntry kEntries[] = {
    LAPILLI_HOT1(mov, U(U)),          LAPILLI_HOT3(select, U(U, U, U)), LAPILLI_HOT1(fadd, F(F, F)),
    LAPILLI_HOT2(fsub, F(F, F)),      LAPILLI_HOT1(fmul, F(F, F)),      LAPILLI_HOT2(fdiv, F(F, F)),
    LAPILLI_HOT_FMA(fma, F(F, F, F)), LAPILLI_HOT1(fneg, F(F)),         LAPILLI_HOT1(fabs, F(F)),
    LAPILLI_HOT2(fmin, F(F, F)),      LAPILLI_HOT2(fmax, F(F, F)),      LAPILLI_HOT1(nmin, F(F, F)),
    LAPILLI_HOT1(nmax, F(F, F)),      LAPILLI_HOT1(ffloor, F(F)),       LAPILLI_COLD(fceil, F(F)),
    LAPILLI_COLD(ftrunc, F(F)),       LAPILLI_COLD(fround_even, F(F)),  LAPILLI_COLD(fsign, F(F)),
};

}  // namespace

HandlerList arithmetic_handlers() { return kEntries; }

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lapilli {
const PerTarget<ListHandlers> kArithmeticHandlers = LAPILLI_PER_TARGET(arithmetic_handlers);
}  // namespace lapilli
#endif
