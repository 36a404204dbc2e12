// Ops: comparisons. Their results are 0 or ~0.
#include "base/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shader/interpreter/compare.cpp"
#include <hwy/foreach_target.h>

#include "shader/interpreter/handlers.h"
#include "shader/interpreter/machine-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {
namespace {

LAPILLI_OP2(feq, mask_to_u(eq(a, b)))
LAPILLI_OP2(fne, mask_to_u(ordered_ne(a, b)))
LAPILLI_OP2(flt, mask_to_u(lt(a, b)))
LAPILLI_OP2(fle, mask_to_u(le(a, b)))
LAPILLI_OP2(funeq, mask_to_u(unordered_eq(a, b)))
LAPILLI_OP2(funne, mask_to_u(ne(a, b)))
LAPILLI_OP2(funlt, mask_to_u(unordered_lt(a, b)))
LAPILLI_OP2(funle, mask_to_u(unordered_le(a, b)))
LAPILLI_OP1(fisnan, mask_to_u(is_nan(a)))
LAPILLI_OP1(fisinf, mask_to_u(is_inf(a)))
LAPILLI_OP2(ieq, mask_to_u(eq(a, b)))
LAPILLI_OP2(ine, mask_to_u(ne(a, b)))
LAPILLI_OP2(slt, mask_to_u(lt(a, b)))
LAPILLI_OP2(sle, mask_to_u(le(a, b)))
LAPILLI_OP2(ult, mask_to_u(lt(a, b)))
LAPILLI_OP2(ule, mask_to_u(le(a, b)))

const HandlerEntry kEntries[] = {
    LAPILLI_HOT1(feq, U(F, F)),   LAPILLI_COLD(fne, U(F, F)),   LAPILLI_HOT2(flt, U(F, F)),
    LAPILLI_HOT2(fle, U(F, F)),   LAPILLI_COLD(funeq, U(F, F)), LAPILLI_HOT1(funne, U(F, F)),
    LAPILLI_HOT2(funlt, U(F, F)), LAPILLI_HOT2(funle, U(F, F)), LAPILLI_COLD(fisnan, U(F)),
    LAPILLI_COLD(fisinf, U(F)),   LAPILLI_HOT1(ieq, U(U, U)),   LAPILLI_HOT1(ine, U(U, U)),
    LAPILLI_HOT2(slt, U(I, I)),   LAPILLI_COLD(sle, U(I, I)),   LAPILLI_HOT2(ult, U(U, U)),
    LAPILLI_COLD(ule, U(U, U)),
};

}  // namespace

HandlerList compare_handlers() { return kEntries; }

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lapilli {
const PerTarget<ListHandlers> kCompareHandlers = LAPILLI_PER_TARGET(compare_handlers);
}  // namespace lapilli
#endif
