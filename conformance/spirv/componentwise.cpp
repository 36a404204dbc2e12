// The table of componentwise instructions. Specification: SPIR-V, "Instructions"; "SPIR-V Extended Instructions for
// GLSL".
#include "spirv/componentwise.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace lapilli::conformance::spirv {
namespace {

using Operands = const uint32_t*;

float f(uint32_t bits) { return std::bit_cast<float>(bits); }
double d(uint32_t bits) { return double(f(bits)); }
int32_t s(uint32_t bits) { return std::bit_cast<int32_t>(bits); }
uint32_t u(float value) { return std::bit_cast<uint32_t>(value); }
uint32_t u(double value) { return u(static_cast<float>(value)); }  // rounded to nearest even
uint32_t u(int32_t value) { return std::bit_cast<uint32_t>(value); }

bool nan_in(Operands x) { return std::isnan(f(x[0])); }
bool nan_in_2(Operands x) { return nan_in(x) || nan_in(x + 1); }
bool nan_in_3(Operands x) { return nan_in_2(x) || nan_in(x + 2); }
bool divides(Operands x) { return x[1] != 0 && !(x[0] == 0x80000000 && x[1] == 0xFFFFFFFF); }
// OpSRem and OpSMod of negative operands: open in Vulkan.
bool divides_positive(Operands x) { return divides(x) && s(x[0]) >= 0 && s(x[1]) >= 0; }
bool shifts(Operands x) { return x[1] < 32; }
uint32_t low_ones(uint32_t count) { return count >= 32 ? 0xFFFFFFFF : (1u << count) - 1; }
// Offset and count are at most 16.
uint32_t field(Operands x, bool extend) {
  if (x[2] == 0) return 0;
  const uint32_t value = x[0] >> x[1] & low_ones(x[2]);
  return extend && (value >> (x[2] - 1) & 1) != 0 ? value | ~low_ones(x[2]) : value;
}
uint32_t inserted(Operands x) {
  const uint32_t mask = low_ones(x[3]) << x[2];
  return (x[0] & ~mask) | (x[1] << x[2] & mask);
}

uint32_t to_signed(double value) {
  return std::isnan(value) ? 0 : u(int32_t(std::clamp(std::trunc(value), -0x1p31, 0x1p31 - 1)));
}
uint32_t to_unsigned(double value) {
  return std::isnan(value) ? 0 : uint32_t(std::clamp(std::trunc(value), 0.0, 0x1p32 - 1));
}

// sinh and cosh do too then: their precision is derived from exp.
bool exp_overflows(uint32_t bits) { return std::isinf(float(std::exp(std::abs(d(bits))))); }

uint32_t sign_of(double value) { return u(value > 0 ? 1.0f : value < 0 ? -1.0f : f(u(value))); }

// To half and back: nearest even, denormal halves flushed or kept.
uint32_t quantized(uint32_t bits) {
  const double x = d(bits);
  if (!std::isfinite(x) || x == 0) return bits;
  const double last = std::ldexp(1.0, std::max(std::ilogb(x), -14) - 10);
  const double rounded = std::nearbyint(x / last) * last;
  if (std::abs(rounded) >= 65536) return u(std::copysign(INFINITY, f(bits)));
  // OpQuantizeToF16: results below 2^-14 become zero.
  return std::abs(rounded) < 0x1p-14 ? u(std::copysign(0.0f, f(bits))) : u(rounded);
}

double remainder_of(double a, double b) { return std::fmod(a, b); }
double modulo_of(double a, double b) {
  const double rest = std::fmod(a, b);
  return rest != 0 && (rest < 0) != (b < 0) ? rest + b : rest;
}
bool near_one_quotient(Operands x) {
  const double quotient = d(x[0]) / d(x[1]);
  return d(x[1]) != 0 && std::abs(quotient) < 100 && std::abs(quotient - std::nearbyint(quotient)) > 1e-3 &&
         std::abs(d(x[1])) > 1e-20;
}

#define OP(name) #name, uint32_t(spv::Op::Op##name), false
#define EXT(name) #name, uint32_t(GLSLstd450##name), true
#define VALUE(expression) [](Operands x) -> uint32_t { return expression; }
#define WHEN(expression) [](Operands x) -> bool { return expression; }

const Componentwise kTable[] = {
    // Arithmetic.
    {OP(FNegate), "ff", VALUE(x[0] ^ 0x80000000)},
    {OP(SNegate), "ii", VALUE(0 - x[0])},
    {OP(FAdd), "fff", VALUE(u(f(x[0]) + f(x[1])))},
    {OP(FSub), "fff", VALUE(u(f(x[0]) - f(x[1])))},
    {OP(FMul), "fff", VALUE(u(f(x[0]) * f(x[1])))},
    {OP(FDiv), "fff", VALUE(u(f(x[0]) / f(x[1]))), 0, 2.5},
    {OP(FRem), "fff", VALUE(u(remainder_of(d(x[0]), d(x[1])))), 0, 1e5, near_one_quotient},
    {OP(FMod), "fff", VALUE(u(modulo_of(d(x[0]), d(x[1])))), 0, 1e5, near_one_quotient,
     WHEN(!std::isfinite(f(x[1])) || !std::isfinite(f(x[0])))},
    {OP(IAdd), "iii", VALUE(x[0] + x[1])},
    {OP(ISub), "uuu", VALUE(x[0] - x[1])},
    {OP(IMul), "iii", VALUE(x[0] * x[1])},
    {OP(UDiv), "uuu", VALUE(x[1] == 0 ? 0xFFFFFFFF : x[0] / x[1]), 0, 0, WHEN(x[1] != 0)},
    {OP(UMod), "uuu", VALUE(x[1] == 0 ? x[0] : x[0] % x[1]), 0, 0, WHEN(x[1] != 0)},
    {OP(SDiv), "iii",
     VALUE(x[1] == 0    ? 0
           : divides(x) ? u(s(x[0]) / s(x[1]))
                        : x[0]),
     0, 0, divides},
    {OP(SRem), "iii",
     VALUE(x[1] == 0    ? x[0]
           : divides(x) ? u(s(x[0]) % s(x[1]))
                        : 0),
     0, 0, divides_positive},
    {OP(SMod), "iii", VALUE(x[1] == 0 ? x[0] : u(int32_t((int64_t{s(x[0])} % s(x[1]) + s(x[1])) % int64_t{s(x[1])}))),
     0, 0, divides_positive},
    // Comparisons.
    {OP(FOrdEqual), "bff", VALUE(f(x[0]) == f(x[1]))},
    {OP(FUnordEqual), "bff", VALUE(nan_in_2(x) || f(x[0]) == f(x[1]))},
    {OP(FOrdNotEqual), "bff", VALUE(!nan_in_2(x) && f(x[0]) != f(x[1]))},
    {OP(FUnordNotEqual), "bff", VALUE(nan_in_2(x) || f(x[0]) != f(x[1]))},
    {OP(FOrdLessThan), "bff", VALUE(f(x[0]) < f(x[1]))},
    {OP(FUnordLessThan), "bff", VALUE(nan_in_2(x) || f(x[0]) < f(x[1]))},
    {OP(FOrdGreaterThan), "bff", VALUE(f(x[0]) > f(x[1]))},
    {OP(FUnordGreaterThan), "bff", VALUE(nan_in_2(x) || f(x[0]) > f(x[1]))},
    {OP(FOrdLessThanEqual), "bff", VALUE(f(x[0]) <= f(x[1]))},
    {OP(FUnordLessThanEqual), "bff", VALUE(nan_in_2(x) || f(x[0]) <= f(x[1]))},
    {OP(FOrdGreaterThanEqual), "bff", VALUE(f(x[0]) >= f(x[1]))},
    {OP(FUnordGreaterThanEqual), "bff", VALUE(nan_in_2(x) || f(x[0]) >= f(x[1]))},
    {OP(IsNan), "bf", VALUE(nan_in(x))},
    {OP(IsInf), "bf", VALUE(std::isinf(f(x[0])))},
    {OP(IEqual), "bii", VALUE(x[0] == x[1])},
    {OP(INotEqual), "buu", VALUE(x[0] != x[1])},
    {OP(UGreaterThan), "buu", VALUE(x[0] > x[1])},
    {OP(UGreaterThanEqual), "buu", VALUE(x[0] >= x[1])},
    {OP(ULessThan), "buu", VALUE(x[0] < x[1])},
    {OP(ULessThanEqual), "buu", VALUE(x[0] <= x[1])},
    {OP(SGreaterThan), "bii", VALUE(s(x[0]) > s(x[1]))},
    {OP(SGreaterThanEqual), "bii", VALUE(s(x[0]) >= s(x[1]))},
    {OP(SLessThan), "bii", VALUE(s(x[0]) < s(x[1]))},
    {OP(SLessThanEqual), "bii", VALUE(s(x[0]) <= s(x[1]))},
    {OP(LogicalEqual), "bbb", VALUE(x[0] == x[1])},
    {OP(LogicalNotEqual), "bbb", VALUE(x[0] != x[1])},
    {OP(LogicalOr), "bbb", VALUE(x[0] | x[1])},
    {OP(LogicalAnd), "bbb", VALUE(x[0] & x[1])},
    {OP(LogicalNot), "bb", VALUE(1 - x[0])},
    {OP(Select), "fbff", VALUE(x[0] != 0 ? x[1] : x[2])},
    // Bits.
    {OP(ShiftRightLogical), "uuu", VALUE(x[0] >> (x[1] & 31)), 0, 0, shifts},
    {OP(ShiftRightArithmetic), "iiu", VALUE(u(s(x[0]) >> (x[1] & 31))), 0, 0, shifts},
    {OP(ShiftLeftLogical), "uui", VALUE(x[0] << (x[1] & 31)), 0, 0, shifts},
    {OP(BitwiseOr), "uuu", VALUE(x[0] | x[1])},
    {OP(BitwiseXor), "iii", VALUE(x[0] ^ x[1])},
    {OP(BitwiseAnd), "uuu", VALUE(x[0] & x[1])},
    {OP(Not), "uu", VALUE(~x[0])},
    {OP(BitFieldInsert), "uuuoo", VALUE(inserted(x))},
    {OP(BitFieldSExtract), "iioo", VALUE(field(x, true))},
    {OP(BitFieldUExtract), "uuoo", VALUE(field(x, false))},
    {OP(BitReverse), "uu", VALUE([](uint32_t v) {
       uint32_t out = 0;
       for (int i = 0; i < 32; ++i) out |= (v >> i & 1) << (31 - i);
       return out;
     }(x[0]))},
    {OP(BitCount), "uu", VALUE(uint32_t(std::popcount(x[0])))},
    // Conversions.
    {OP(ConvertFToU), "uf", VALUE(to_unsigned(d(x[0]))), 0, 0, WHEN(d(x[0]) > -1 && d(x[0]) < 0x1p32)},
    {OP(ConvertFToS), "if", VALUE(to_signed(d(x[0]))), 0, 0, WHEN(std::abs(d(x[0])) < 0x1p31)},
    {OP(ConvertSToF), "fi", VALUE(u(float(s(x[0])))), 0, 1},
    {OP(ConvertUToF), "fu", VALUE(u(float(x[0]))), 0, 1},
    {OP(Bitcast), "uf", VALUE(x[0]), 0, 0, nullptr, nan_in},
    {OP(CopyObject), "uu", VALUE(x[0])},
    {OP(QuantizeToF16), "ff", VALUE(quantized(x[0])), 0, 0, WHEN(std::abs(d(x[0])) < 65504)},
    // GLSL.std.450: rounding and parts.
    {EXT(Round), "ff", VALUE(u(std::round(f(x[0])))), 0, 0, nullptr,
     WHEN(std::abs(d(x[0])) < 0x1p24 && std::abs(d(x[0]) - std::trunc(d(x[0]))) == 0.5)},
    {EXT(RoundEven), "ff", VALUE(u(std::nearbyint(f(x[0]))))},
    {EXT(Trunc), "ff", VALUE(u(std::trunc(f(x[0]))))},
    {EXT(Floor), "ff", VALUE(u(std::floor(f(x[0]))))},
    {EXT(Ceil), "ff", VALUE(u(std::ceil(f(x[0]))))},
    {EXT(Fract), "ff",
     VALUE(std::isinf(f(x[0])) ? u(NAN) : std::min(u(f(x[0]) - std::floor(f(x[0]))), u(0x1.FFFFFEp-1f))), 0, 1, nullptr,
     nan_in},
    {EXT(FAbs), "ff", VALUE(x[0] & 0x7FFFFFFF)},
    {EXT(SAbs), "ii", VALUE(s(x[0]) < 0 ? 0 - x[0] : x[0]), 0, 0, WHEN(x[0] != 0x80000000)},
    {EXT(FSign), "ff", VALUE(sign_of(d(x[0]))), 0, 0, nullptr, nan_in},
    {EXT(SSign), "ii", VALUE(u(int32_t{s(x[0]) > 0} - int32_t{s(x[0]) < 0}))},
    // Minimum, maximum, clamping.
    {EXT(FMin), "fff", VALUE(f(x[1]) < f(x[0]) ? x[1] : x[0]), 0, 0, nullptr, nan_in_2},
    {EXT(FMax), "fff", VALUE(f(x[0]) < f(x[1]) ? x[1] : x[0]), 0, 0, nullptr, nan_in_2},
    {EXT(FClamp), "ffff", VALUE(u(std::fmin(std::fmax(f(x[0]), f(x[1])), f(x[2])))), 0, 0, WHEN(f(x[1]) <= f(x[2])),
     nan_in_3},
    {EXT(NMin), "fff",
     VALUE(std::isnan(f(x[0])) ? x[1]
           : f(x[1]) < f(x[0]) ? x[1]
                               : x[0])},
    {EXT(NMax), "fff",
     VALUE(std::isnan(f(x[0])) ? x[1]
           : f(x[0]) < f(x[1]) ? x[1]
                               : x[0])},
    {EXT(NClamp), "ffff", VALUE(u(std::fmin(std::isnan(f(x[0])) ? f(x[1]) : std::fmax(f(x[0]), f(x[1])), f(x[2])))), 0,
     0, WHEN(f(x[1]) <= f(x[2])), WHEN(nan_in_2(x + 1))},
    {EXT(UMin), "uuu", VALUE(std::min(x[0], x[1]))},
    {EXT(UMax), "uuu", VALUE(std::max(x[0], x[1]))},
    {EXT(UClamp), "uuuu", VALUE(std::min(std::max(x[0], x[1]), x[2])), 0, 0, WHEN(x[1] <= x[2])},
    {EXT(SMin), "iii", VALUE(u(std::min(s(x[0]), s(x[1]))))},
    {EXT(SMax), "iii", VALUE(u(std::max(s(x[0]), s(x[1]))))},
    {EXT(SClamp), "iiii", VALUE(u(std::min(std::max(s(x[0]), s(x[1])), s(x[2])))), 0, 0, WHEN(s(x[1]) <= s(x[2]))},
    {EXT(Step), "fff", VALUE(u(f(x[1]) < f(x[0]) ? 0.0f : 1.0f)), 0, 0, nullptr, nan_in_2},
    {EXT(Fma), "ffff", VALUE(u(std::fma(f(x[0]), f(x[1]), f(x[2])))), 0, 1e9},
    {EXT(Ldexp), "ffi", VALUE(u(std::ldexp(d(x[0]), std::clamp(s(x[1]), -500, 500)))), 0, 0,
     WHEN(s(x[1]) >= -126 && s(x[1]) <= 128)},
    {EXT(FindILsb), "iu", VALUE(x[0] == 0 ? 0xFFFFFFFF : uint32_t(std::countr_zero(x[0])))},
    {EXT(FindUMsb), "iu", VALUE(31u - uint32_t(std::countl_zero(x[0])))},
    {EXT(FindSMsb), "ii", VALUE(31u - uint32_t(std::countl_zero(s(x[0]) < 0 ? ~x[0] : x[0])))},
    // Functions with a bound: docs/precision.md has them in full; here the shapes and stages matter.
    {EXT(Radians), "ff", VALUE(u(d(x[0]) * (M_PI / 180))), 2, 4},
    {EXT(Degrees), "ff", VALUE(u(d(x[0]) * (180 / M_PI))), 2, 4},
    {EXT(Sin), "ff", VALUE(u(std::sin(d(x[0])))), 2, 1e9, WHEN(std::abs(d(x[0])) <= M_PI)},
    {EXT(Cos), "ff", VALUE(u(std::cos(d(x[0])))), 2, 1e9, WHEN(std::abs(d(x[0])) <= M_PI)},
    {EXT(Tan), "ff", VALUE(u(std::tan(d(x[0])))), 2, 1e5, WHEN(std::abs(d(x[0])) <= 1)},
    {EXT(Asin), "ff", VALUE(u(std::asin(d(x[0])))), 2, 1e5, WHEN(std::abs(d(x[0])) <= 1)},
    {EXT(Acos), "ff", VALUE(u(std::acos(d(x[0])))), 2, 1e5, WHEN(std::abs(d(x[0])) <= 1)},
    {EXT(Atan), "ff", VALUE(u(std::atan(d(x[0])))), 2, 4096},
    {EXT(Sinh), "ff", VALUE(u(exp_overflows(x[0]) ? std::copysign(HUGE_VAL, d(x[0])) : std::sinh(d(x[0])))), 2, 1e9,
     WHEN(std::abs(d(x[0])) < 50)},
    {EXT(Cosh), "ff", VALUE(u(exp_overflows(x[0]) ? HUGE_VAL : std::cosh(d(x[0])))), 2, 1e9,
     WHEN(std::abs(d(x[0])) < 50)},
    {EXT(Tanh), "ff", VALUE(u(std::tanh(d(x[0])))), 2, 1e9, WHEN(std::abs(d(x[0])) < 10)},
    {EXT(Asinh), "ff", VALUE(u(std::asinh(d(x[0])))), 2, 1e9, WHEN(d(x[0]) > 0 && d(x[0]) < 1e6)},
    {EXT(Acosh), "ff", VALUE(u(std::acosh(d(x[0])))), 2, 1e9, WHEN(d(x[0]) >= 1 && d(x[0]) < 1e6)},
    {EXT(Atanh), "ff", VALUE(u(std::atanh(d(x[0])))), 2, 1e9, WHEN(std::abs(d(x[0])) < 0.99)},
    {EXT(Atan2), "fff", VALUE(u(std::atan2(d(x[0]), d(x[1])))), 2, 4096, WHEN(d(x[0]) != 0 && d(x[1]) != 0)},
    {EXT(Pow), "fff", VALUE(u(std::pow(d(x[0]), d(x[1])))), 2, 1e5,
     WHEN(d(x[0]) > 0.01 && d(x[0]) < 100 && std::abs(d(x[1])) < 8)},
    {EXT(Exp), "ff", VALUE(u(std::exp(d(x[0])))), 2, 300},
    {EXT(Exp2), "ff", VALUE(u(std::exp2(d(x[0])))), 2, 300},
    {EXT(Log), "ff", VALUE(u(std::log(d(x[0])))), 2, 4, WHEN(d(x[0]) > 0 && !(d(x[0]) > 0.4 && d(x[0]) < 2.5))},
    {EXT(Log2), "ff", VALUE(u(std::log2(d(x[0])))), 2, 4, WHEN(d(x[0]) > 0 && !(d(x[0]) > 0.4 && d(x[0]) < 2.5))},
    {EXT(Sqrt), "ff", VALUE(u(std::sqrt(f(x[0])))), 0, 4, WHEN(d(x[0]) >= 0)},
    {EXT(InverseSqrt), "ff", VALUE(u(1 / std::sqrt(d(x[0])))), 2, 2, WHEN(d(x[0]) > 0)},
};

}  // namespace

std::span<const Componentwise> componentwise_instructions() { return kTable; }

}  // namespace lapilli::conformance::spirv
