#include "shader/interpreter/op_reference.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace lapilli {
namespace {

using U32 = uint32_t;
float f(U32 bits) { return std::bit_cast<float>(bits); }
int32_t s(U32 bits) { return static_cast<int32_t>(bits); }
U32 u(float value) { return std::bit_cast<U32>(value); }
U32 u(int32_t value) { return static_cast<U32>(value); }
U32 u(bool condition) { return condition ? 0xFFFFFFFFu : 0; }

float smaller(float a, float b) { return b < a ? b : a; }
float larger(float a, float b) { return a < b ? b : a; }
float sign_of(float a) { return a > 0 ? 1.0f : a < 0 ? -1.0f : std::isnan(a) ? 0.0f : a; }

// sinh and cosh do too then (lane_hyperbolic-inl.h).
bool exp_overflows(double a) { return std::isinf(static_cast<float>(std::exp(std::abs(a)))); }

float modulo(float a, float b) {
  const float rest = std::fmod(a, b);
  if (rest == 0) return std::copysign(0.0f, b);
  return std::signbit(rest) != std::signbit(b) ? rest + b : rest;
}

template <class Integer>
U32 saturate(float a) {
  if (std::isnan(a)) return 0;
  const double low = std::numeric_limits<Integer>::min();
  const double high = std::numeric_limits<Integer>::max();
  return static_cast<U32>(static_cast<Integer>(std::clamp<double>(std::trunc(static_cast<double>(a)), low, high)));
}

// From the value, without looking at the float's bits.
U32 half_of(float a) {
  if (std::isnan(a)) return 0x7E00;
  const U32 sign = std::signbit(a) ? 0x8000 : 0;
  const double magnitude = std::fabs(static_cast<double>(a));
  if (magnitude >= 65520.0) return sign | 0x7C00;
  const int exponent = magnitude == 0 ? -14 : std::max(std::ilogb(magnitude), -14);
  const double steps = std::nearbyint(std::ldexp(magnitude, 10 - exponent));
  const bool denormal = magnitude < 0x1p-14;
  // A significand that rounds up to 2048 carries into the exponent.
  return sign | (static_cast<U32>(steps) + (denormal ? 0 : static_cast<U32>(exponent + 14) << 10));
}
float float_of_half(U32 bits) {
  const U32 exponent = bits >> 10 & 31;
  const double fraction = bits & 1023;
  const double sign = (bits & 0x8000) != 0 ? -1 : 1;
  if (exponent == 31) return fraction != 0 ? f(0x7FC00000) : static_cast<float>(sign) * INFINITY;
  if (exponent == 0) return static_cast<float>(sign * std::ldexp(fraction, -24));
  return static_cast<float>(sign * std::ldexp(1024 + fraction, static_cast<int>(exponent) - 25));
}

U32 signed_divide(U32 a, U32 b) {
  if (b == 0) return 0;
  return static_cast<U32>(int64_t{s(a)} / int64_t{s(b)});
}
U32 signed_remainder(U32 a, U32 b) { return b == 0 ? a : static_cast<U32>(int64_t{s(a)} % int64_t{s(b)}); }
U32 signed_modulo(U32 a, U32 b) {
  const U32 rest = signed_remainder(a, b);
  return b != 0 && rest != 0 && (s(rest) < 0) != (s(b) < 0) ? rest + b : rest;
}

U32 reverse(U32 a) {
  U32 result = 0;
  for (U32 i = 0; i < 32; ++i) result |= (a >> i & 1) << (31 - i);
  return result;
}
U32 highest(U32 a) { return a == 0 ? 0xFFFFFFFFu : static_cast<U32>(31 - std::countl_zero(a)); }
U32 ones(U32 count) { return static_cast<U32>((uint64_t{1} << count) - 1); }
U32 insert_bits(U32 base, U32 insert, U32 offset, U32 count) {
  const U32 field = static_cast<U32>(uint64_t{ones(count)} << offset);
  return (base & ~field) | (static_cast<U32>(uint64_t{insert} << offset) & field);
}
U32 extract(U32 a, U32 offset, U32 count) { return static_cast<U32>(uint64_t{a} >> offset) & ones(count); }
U32 extract_signed(U32 a, U32 offset, U32 count) {
  if (count == 0) return 0;
  const U32 field = extract(a, offset, count);
  return (field >> (count - 1) & 1) != 0 ? field | ~ones(count) : field;
}
bool field_inside(U32 offset, U32 count) { return offset <= 32 && count <= 32 && offset + count <= 32; }

#define EXACT(name, expression)      \
  {                                  \
    Opcode::name,                    \
        [](U32 a, U32 b, U32 c) {    \
          (void)a, (void)b, (void)c; \
          return expression;         \
        },                           \
        nullptr, 0, true, nullptr    \
  }
#define EXACT_BITS(name, expression) \
  {                                  \
    Opcode::name,                    \
        [](U32 a, U32 b, U32 c) {    \
          (void)a, (void)b, (void)c; \
          return U32{expression};    \
        },                           \
        nullptr, 0, false, nullptr   \
  }
#define WITHIN(name, bound, expression) \
  {                                     \
    Opcode::name, nullptr,              \
        [](double a, double b) {        \
          (void)b;                      \
          return expression;            \
        },                              \
        bound, true, nullptr            \
  }

const OpReference kReferences[] = {
    EXACT_BITS(mov, a),
    EXACT_BITS(select, a != 0 ? b : c),
    EXACT(fadd, u(f(a) + f(b))),
    EXACT(fsub, u(f(a) - f(b))),
    EXACT(fmul, u(f(a) * f(b))),
    EXACT(fdiv, u(f(a) / f(b))),
    EXACT(fma, u(std::fma(f(a), f(b), f(c)))),
    EXACT_BITS(fneg, a ^ 0x80000000u),
    EXACT_BITS(fabs, a & 0x7FFFFFFFu),
    EXACT(fsign, u(sign_of(f(a)))),
    EXACT(fmin, u(smaller(f(a), f(b)))),
    EXACT(fmax, u(larger(f(a), f(b)))),
    EXACT(nmin, u(std::isnan(f(a)) ? f(b) : smaller(f(a), f(b)))),
    EXACT(nmax, u(std::isnan(f(a)) ? f(b) : larger(f(a), f(b)))),
    EXACT(ffloor, u(std::floor(f(a)))),
    EXACT(fceil, u(std::ceil(f(a)))),
    EXACT(ftrunc, u(std::trunc(f(a)))),
    EXACT(fround_even, u(std::nearbyint(f(a)))),
    EXACT(ffract, u(std::isnan(f(a)) ? f(a) : smaller(f(a) - std::floor(f(a)), 0x1.fffffep-1f))),
    EXACT(frem, u(std::fmod(f(a), f(b)))),
    EXACT(fmod, u(modulo(f(a), f(b)))),
    EXACT(fsqrt, u(std::sqrt(f(a)))),
    EXACT(frsqrt, u(1.0f / std::sqrt(f(a)))),
    WITHIN(fsin, 2, std::sin(a)),
    WITHIN(fcos, 2, std::cos(a)),
    WITHIN(ftan, 4, std::tan(a)),
    WITHIN(fasin, 4, std::asin(a)),
    WITHIN(facos, 4, std::acos(a)),
    WITHIN(fatan, 4, std::atan(a)),
    WITHIN(fatan2, 4, std::atan2(a, b)),
    WITHIN(fsinh, 4, exp_overflows(a) ? std::copysign(HUGE_VAL, a) : std::sinh(a)),
    WITHIN(fcosh, 4, exp_overflows(a) ? HUGE_VAL : std::cosh(a)),
    WITHIN(ftanh, 4, std::tanh(a)),
    WITHIN(fasinh, 4, std::asinh(a)),
    WITHIN(facosh, 4, std::acosh(a)),
    WITHIN(fatanh, 4, std::atanh(a)),
    WITHIN(fexp, 2, std::exp(a)),
    WITHIN(fexp2, 2, std::exp2(a)),
    WITHIN(flog, 2, std::log(a)),
    WITHIN(flog2, 2, std::log2(a)),
    WITHIN(fpow, 4, std::pow(a, b)),
    EXACT(fldexp, u(static_cast<float>(std::ldexp(static_cast<double>(f(a)), std::clamp(s(b), -400, 400))))),
    {Opcode::ffrexp_significand,
     [](U32 a, U32, U32) {
       int exponent = 0;
       return u(std::frexp(f(a), &exponent));
     },
     nullptr, 0, true, nullptr},
    {Opcode::ffrexp_exponent,
     [](U32 a, U32, U32) {
       int exponent = 0;
       if (std::isfinite(f(a))) std::frexp(f(a), &exponent);
       return u(exponent);
     },
     nullptr, 0, false, nullptr},

    EXACT_BITS(feq, u(f(a) == f(b))),
    EXACT_BITS(fne, u(f(a) < f(b) || f(a) > f(b))),
    EXACT_BITS(flt, u(f(a) < f(b))),
    EXACT_BITS(fle, u(f(a) <= f(b))),
    EXACT_BITS(funeq, u(!(f(a) < f(b) || f(a) > f(b)))),
    EXACT_BITS(funne, u(!(f(a) == f(b)))),
    EXACT_BITS(funlt, u(!(f(a) >= f(b)))),
    EXACT_BITS(funle, u(!(f(a) > f(b)))),
    EXACT_BITS(fisnan, u(std::isnan(f(a)))),
    EXACT_BITS(fisinf, u(std::isinf(f(a)))),
    EXACT_BITS(ieq, u(a == b)),
    EXACT_BITS(ine, u(a != b)),
    EXACT_BITS(slt, u(s(a) < s(b))),
    EXACT_BITS(sle, u(s(a) <= s(b))),
    EXACT_BITS(ult, u(a < b)),
    EXACT_BITS(ule, u(a <= b)),

    EXACT_BITS(iadd, a + b),
    EXACT_BITS(isub, a - b),
    EXACT_BITS(imul, a* b),
    EXACT_BITS(umul_high, static_cast<U32>(uint64_t{a} * b >> 32)),
    EXACT_BITS(smul_high, static_cast<U32>(static_cast<uint64_t>(int64_t{s(a)} * s(b)) >> 32)),
    EXACT_BITS(udiv, b == 0 ? 0xFFFFFFFFu : a / b),
    EXACT_BITS(umod, b == 0 ? a : a % b),
    EXACT_BITS(sdiv, signed_divide(a, b)),
    EXACT_BITS(srem, signed_remainder(a, b)),
    EXACT_BITS(smod, signed_modulo(a, b)),
    EXACT_BITS(ineg, 0u - a),
    EXACT_BITS(iabs, s(a) < 0 ? 0u - a : a),
    EXACT_BITS(isign, u(s(a) > 0 ? 1 : s(a) < 0 ? -1 : 0)),
    EXACT_BITS(smin, u(std::min(s(a), s(b)))),
    EXACT_BITS(smax, u(std::max(s(a), s(b)))),
    EXACT_BITS(umin, std::min(a, b)),
    EXACT_BITS(umax, std::max(a, b)),
    EXACT_BITS(iand, a& b),
    EXACT_BITS(ior, a | b),
    EXACT_BITS(ixor, a ^ b),
    EXACT_BITS(inot, ~a),
    EXACT_BITS(shl, a << (b & 31)),
    EXACT_BITS(shr, a >> (b & 31)),
    EXACT_BITS(sar, u(s(a) >> (b & 31))),
    EXACT_BITS(bit_count, static_cast<U32>(std::popcount(a))),
    EXACT_BITS(bit_reverse, reverse(a)),
    EXACT_BITS(find_lsb, a == 0 ? 0xFFFFFFFFu : static_cast<U32>(std::countr_zero(a))),
    EXACT_BITS(find_msb, highest(a)),
    EXACT_BITS(find_smsb, highest(s(a) < 0 ? ~a : a)),
    {Opcode::bit_insert, [](U32 a, U32 b, U32 c) { return insert_bits(a, b, c & 0xFFFF, c >> 16); }, nullptr, 0, false,
     [](U32, U32, U32 c) { return field_inside(c & 0xFFFF, c >> 16); }},
    {Opcode::ubit_extract, [](U32 a, U32 b, U32 c) { return extract(a, b, c); }, nullptr, 0, false,
     [](U32, U32 b, U32 c) { return field_inside(b, c); }},
    {Opcode::sbit_extract, [](U32 a, U32 b, U32 c) { return extract_signed(a, b, c); }, nullptr, 0, false,
     [](U32, U32 b, U32 c) { return field_inside(b, c); }},
    EXACT_BITS(uadd_carry, static_cast<U32>((uint64_t{a} + b) >> 32)),
    EXACT_BITS(usub_borrow, a < b ? 1u : 0u),

    EXACT_BITS(f_to_s, saturate<int32_t>(f(a))),
    EXACT_BITS(f_to_u, saturate<uint32_t>(f(a))),
    EXACT(s_to_f, u(static_cast<float>(s(a)))),
    EXACT(u_to_f, u(static_cast<float>(a))),
    EXACT_BITS(f_to_half, half_of(f(a))),
    EXACT(half_to_f, u(float_of_half(a & 0xFFFF))),
    EXACT_BITS(canonical, std::isnan(f(a)) ? 0x7FC00000u : a),
};

const U32 kEdges[] = {
    // Floats.
    0x00000000, 0x80000000, 0x3F800000, 0xBF800000, 0x3F000000, 0xBF000000, 0x3FC00000, 0x40200000, 0xC0200000,
    0x40490FDB, 0x3FC90FDB, 0xC0490FDB, 0x00000001, 0x80000001, 0x007FFFFF, 0x807FFFFF, 0x00800000, 0x80800000,
    0x7F7FFFFF, 0xFF7FFFFF, 0x7F800000, 0xFF800000, 0x7FC00000, 0xFFC12345, 0x4AFFFFFF, 0x4B000000, 0x4B800000,
    0x4EFFFFFF, 0x4F000000, 0xCF000000, 0xCF000001, 0x4F7FFFFF, 0x4F800000, 0x2EDBE6FF, 0xAEDBE6FF, 0x477FE000,
    0x477FEFFF, 0x477FF000, 0x33000000, 0x33000001, 0x387FFFFF, 0x3F7FFFFF, 0x3F800001, 0xBF7FFFFF, 0x47C35000,
    0x42B17218, 0xC2CE8ED0, 0x3EFFFFFF, 0x3E99999A, 0x447A0000,
    // Integers.
    1, 2, 3, 5, 7, 8, 16, 24, 31, 32, 33, 63, 255, 256, 0x7FFF, 0x8000, 0xFFFF, 0x10000, 0x00080004, 0x00200000,
    0x00010001, 0x55555555, 0xAAAAAAAA, 0x12345678, 0x7FFFFFFF, 0x7FFFFFFE, 0xFFFFFFFF, 0xFFFFFFFE, 0xFFFF0000,
    0xFFFFFF00, 0x00FF00FF};

}  // namespace

std::span<const OpReference> op_references() { return kReferences; }

const OpReference* find_reference(Opcode op) {
  for (const OpReference& reference : kReferences) {
    if (reference.op == op) return &reference;
  }
  return nullptr;
}

std::span<const uint32_t> edge_values() { return kEdges; }

bool is_nan_bits(uint32_t bits) { return (bits & 0x7FFFFFFF) > 0x7F800000; }

}  // namespace lapilli
