// Integer division and bit operations on lanes. Part of lanes-inl.h.
// What SPIR-V leaves undefined is defined: x / 0 is 0xFFFFFFFF unsigned and 0 signed, the remainder of both is x;
// INT_MIN / -1 is INT_MIN with remainder 0.

#if defined(LAPILLI_BASE_LANES_INTEGER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LAPILLI_BASE_LANES_INTEGER_INL_H
#undef LAPILLI_BASE_LANES_INTEGER_INL_H
#else
#define LAPILLI_BASE_LANES_INTEGER_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {

// The double quotient rounds to an integer only where it is one: it lies at least 1/b from the next integer, which is
// more than 2^-33 of its value. b is not 0.
HWY_API U divide_by_nonzero(U a, U b) { return truncate_to_uint_in_range(to_double(a) / to_double(b)); }

HWY_API U divide(U a, U b) {
  const M by_zero = eq(b, zero_u());
  const U quotient = divide_by_nonzero(a, select(by_zero, broadcast(1u), b));
  return select(by_zero, broadcast(0xFFFFFFFFu), quotient);
}
HWY_API U remainder(U a, U b) {
  const U divisor = select(eq(b, zero_u()), broadcast(1u), b);
  return select(eq(b, zero_u()), a, a - divide_by_nonzero(a, divisor) * divisor);
}

HWY_API I divide(I a, I b) {
  const M by_zero = eq(b, zero_i());
  const U quotient = divide_by_nonzero(as_u(abs(a)), as_u(select(by_zero, broadcast(1), abs(b))));
  const I sign = shift_right<31>(a ^ b);
  const I signed_quotient = (as_i(quotient) ^ sign) - sign;
  return select(by_zero, zero_i(), signed_quotient);
}
// SPIR-V SRem: the sign of a.
HWY_API I remainder(I a, I b) { return a - divide(a, b) * b; }
// SPIR-V SMod: the sign of b.
HWY_API I modulo(I a, I b) {
  const I rest = remainder(a, b);
  const M other_side = ne(rest, zero_i()) & lt(rest ^ b, zero_i()) & ne(b, zero_i());
  return select(other_side, rest + b, rest);
}

// The carry or borrow as 0 or 1.
HWY_API U add_carry(U a, U b) { return select(lt(a + b, a), broadcast(1u), zero_u()); }
HWY_API U sub_borrow(U a, U b) { return select(lt(a, b), broadcast(1u), zero_u()); }

HWY_API U bit_count(U a) {
  U sum = a - (shift_right<1>(a) & broadcast(0x55555555u));
  sum = (sum & broadcast(0x33333333u)) + (shift_right<2>(sum) & broadcast(0x33333333u));
  sum = (sum + shift_right<4>(sum)) & broadcast(0x0F0F0F0Fu);
  return shift_right<24>(sum * broadcast(0x01010101u));
}
HWY_API U bit_reverse(U a) {
  U bits = (shift_right<1>(a) & broadcast(0x55555555u)) | shift_left<1>(a & broadcast(0x55555555u));
  bits = (shift_right<2>(bits) & broadcast(0x33333333u)) | shift_left<2>(bits & broadcast(0x33333333u));
  bits = (shift_right<4>(bits) & broadcast(0x0F0F0F0Fu)) | shift_left<4>(bits & broadcast(0x0F0F0F0Fu));
  bits = (shift_right<8>(bits) & broadcast(0x00FF00FFu)) | shift_left<8>(bits & broadcast(0x00FF00FFu));
  return shift_right<16>(bits) | shift_left<16>(bits);
}
// The number of the lowest bit that is 1; -1 if none is (GLSL findLSB).
HWY_API I find_lsb(U a) {
  const U below = (a & negate(a)) - broadcast(1u);
  return select(eq(a, zero_u()), broadcast(-1), as_i(bit_count(below)));
}
// The number of the highest bit that is 1; -1 if none is (GLSL findMSB of an unsigned number).
HWY_API I find_msb(U a) {
  U smeared = a | shift_right<1>(a);
  smeared = smeared | shift_right<2>(smeared);
  smeared = smeared | shift_right<4>(smeared);
  smeared = smeared | shift_right<8>(smeared);
  smeared = smeared | shift_right<16>(smeared);
  return as_i(bit_count(smeared)) - broadcast(1);
}
// The highest bit that differs from the sign; -1 for 0 and -1 (GLSL findMSB of a signed number).
HWY_API I find_msb(I a) { return find_msb(as_u(a ^ shift_right<31>(a))); }

// The lowest `count` bits set, count ≤ 32.
HWY_API U low_bits(U count) {
  const U some = shift_left(broadcast(1u), count) - broadcast(1u);
  return select(lt(count, broadcast(32u)), some, broadcast(0xFFFFFFFFu));
}
// SPIR-V BitFieldInsert and BitField[SU]Extract. offset + count ≤ 32 (beyond: some value, the same on all targets).
HWY_API U bitfield_insert(U base, U insert, U offset, U count) {
  const U field = shift_left(low_bits(count), offset);
  return and_not(field, base) | (shift_left(insert, offset) & field);
}
HWY_API U bitfield_extract(U base, U offset, U count) { return shift_right(base, offset) & low_bits(count); }
HWY_API I bitfield_extract(I base, U offset, U count) {
  const U field = bitfield_extract(as_u(base), offset, count);
  const U sign = shift_left(broadcast(1u), count - broadcast(1u));
  return select(eq(count, zero_u()), zero_i(), as_i((field ^ sign) - sign));
}

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#endif  // per target
