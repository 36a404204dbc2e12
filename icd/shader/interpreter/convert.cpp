// Ops: conversions between float32, integers and half floats.
#include "base/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shader/interpreter/convert.cpp"
#include <hwy/foreach_target.h>

#include "shader/interpreter/handlers.h"
#include "shader/interpreter/machine-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {
namespace {

LAPILLI_OP1(f_to_s, to_int(a))
LAPILLI_OP1(f_to_u, to_uint(a))
LAPILLI_OP1(s_to_f, to_float(a))
LAPILLI_OP1(u_to_f, to_float(a))
LAPILLI_OP1(f_to_half, to_half(a))
LAPILLI_OP1(half_to_f, from_half(a))
LAPILLI_OP1(canonical, canonical(a))

const HandlerEntry kEntries[] = {
    LAPILLI_COLD(f_to_s, I(F)),    LAPILLI_COLD(f_to_u, U(F)),    LAPILLI_HOT1(s_to_f, F(I)),
    LAPILLI_COLD(u_to_f, F(U)),    LAPILLI_COLD(f_to_half, U(F)), LAPILLI_COLD(half_to_f, F(U)),
    LAPILLI_HOT1(canonical, F(F)),
};

}  // namespace

HandlerList convert_handlers() { return kEntries; }

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lapilli {
const PerTarget<ListHandlers> kConvertHandlers = LAPILLI_PER_TARGET(convert_handlers);
}  // namespace lapilli
#endif
