// Ops: 32-bit integers.
#include "base/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shader/interpreter/integer.cpp"
#include <hwy/foreach_target.h>

#include "shader/interpreter/handlers.h"
#include "shader/interpreter/machine-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {
namespace {

LAPILLI_OP2(iadd, a + b)
LAPILLI_OP2(isub, a - b)
LAPILLI_OP2(imul, a* b)
LAPILLI_OP2(umul_high, mul_high(a, b))
LAPILLI_OP2(smul_high, mul_high(a, b))
LAPILLI_OP2(udiv, divide(a, b))
LAPILLI_OP2(umod, remainder(a, b))
LAPILLI_OP2(sdiv, divide(a, b))
LAPILLI_OP2(srem, remainder(a, b))
LAPILLI_OP2(smod, modulo(a, b))
LAPILLI_OP1(ineg, negate(a))
LAPILLI_OP1(iabs, abs(a))
LAPILLI_OP1(isign, max(min(a, broadcast(1)), broadcast(-1)))
LAPILLI_OP2(smin, min(a, b))
LAPILLI_OP2(smax, max(a, b))
LAPILLI_OP2(umin, min(a, b))
LAPILLI_OP2(umax, max(a, b))
LAPILLI_OP2(iand, a& b)
LAPILLI_OP2(ior, a | b)
LAPILLI_OP2(ixor, a ^ b)
LAPILLI_OP1(inot, ~a)
LAPILLI_OP2(shl, shift_left(a, b))
LAPILLI_OP2(shr, shift_right(a, b))
LAPILLI_OP2(sar, shift_right(a, b))
LAPILLI_OP1(bit_count, bit_count(a))
LAPILLI_OP1(bit_reverse, bit_reverse(a))
LAPILLI_OP1(find_lsb, find_lsb(a))
LAPILLI_OP1(find_msb, find_msb(a))
LAPILLI_OP1(find_smsb, find_msb(a))
LAPILLI_OP3(bit_insert, bitfield_insert(a, b, c& broadcast(0xFFFFu), shift_right<16>(c)))
LAPILLI_OP3(ubit_extract, bitfield_extract(a, b, c))
LAPILLI_OP3(sbit_extract, bitfield_extract(a, b, c))
LAPILLI_OP2(uadd_carry, add_carry(a, b))
LAPILLI_OP2(usub_borrow, sub_borrow(a, b))

const HandlerEntry kEntries[] = {
    LAPILLI_HOT1(iadd, U(U, U)),
    LAPILLI_HOT2(isub, U(U, U)),
    LAPILLI_HOT1(imul, U(U, U)),
    LAPILLI_COLD(umul_high, U(U, U)),
    LAPILLI_COLD(smul_high, I(I, I)),
    LAPILLI_COLD(udiv, U(U, U)),
    LAPILLI_COLD(umod, U(U, U)),
    LAPILLI_COLD(sdiv, I(I, I)),
    LAPILLI_COLD(srem, I(I, I)),
    LAPILLI_COLD(smod, I(I, I)),
    LAPILLI_COLD(ineg, U(U)),
    LAPILLI_COLD(iabs, I(I)),
    LAPILLI_COLD(isign, I(I)),
    LAPILLI_COLD(smin, I(I, I)),
    LAPILLI_COLD(smax, I(I, I)),
    LAPILLI_COLD(umin, U(U, U)),
    LAPILLI_COLD(umax, U(U, U)),
    LAPILLI_HOT1(iand, U(U, U)),
    LAPILLI_HOT1(ior, U(U, U)),
    LAPILLI_HOT1(ixor, U(U, U)),
    LAPILLI_HOT1(inot, U(U)),
    LAPILLI_HOT1(shl, U(U, U)),
    LAPILLI_HOT1(shr, U(U, U)),
    LAPILLI_COLD(sar, I(I, U)),
    LAPILLI_COLD(bit_count, U(U)),
    LAPILLI_COLD(bit_reverse, U(U)),
    LAPILLI_COLD(find_lsb, I(U)),
    LAPILLI_COLD(find_msb, I(U)),
    LAPILLI_COLD(find_smsb, I(I)),
    LAPILLI_COLD(bit_insert, U(U, U, U)),
    LAPILLI_COLD(ubit_extract, U(U, U, U)),
    LAPILLI_COLD(sbit_extract, I(I, U, U)),
    LAPILLI_COLD(uadd_carry, U(U, U)),
    LAPILLI_COLD(usub_borrow, U(U, U)),
};

}  // namespace

HandlerList integer_handlers() { return kEntries; }

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lapilli {
const PerTarget<ListHandlers> kIntegerHandlers = LAPILLI_PER_TARGET(integer_handlers);
}  // namespace lapilli
#endif
