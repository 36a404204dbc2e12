// 32-bit integer operations, conversions and packing against C++. Specification: SPIR-V, Arithmetic and Bit
// Instructions; GLSL.std.450.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <optional>

#include "harness/devices.h"
#include "shader/numbers.h"
#include "shaders/int_ops.comp.h"

namespace lapilli::conformance {
namespace {

using U = uint32_t;
using S = int32_t;
using Result = std::optional<U>;  // none: the specification leaves it open

struct Op {
  int op;
  const char* name;
  std::function<Result(U, U, U)> value;
};

float f(U bits) { return std::bit_cast<float>(bits); }
U bits(float v) { return std::bit_cast<U>(v); }

U reversed(U v) {
  U out = 0;
  for (int i = 0; i < 32; ++i) out |= (v >> i & 1u) << (31 - i);
  return out;
}

int msb(U v) { return 31 - std::countl_zero(v); }

U mask_bits(U count) { return count >= 32 ? ~0u : (1u << count) - 1; }

Result float_to(double low, double high, U value, bool is_signed) {
  const double v = double(f(value));
  if (!(v > low && v < high)) return std::nullopt;  // out of range, NaN
  return is_signed ? U(S(v)) : U(v);
}

float half_value(U h) {
  const U exponent = h >> 10 & 31, fraction = h & 1023;
  double v = exponent == 0    ? std::ldexp(double(fraction), -24)
             : exponent == 31 ? (fraction != 0 ? NAN : INFINITY)
                              : std::ldexp(double(fraction | 1024), int(exponent) - 25);
  return float((h & 0x8000) != 0 ? -v : v);
}

// Nearest even; none for NaN.
Result to_half(float v) {
  if (std::isnan(v)) return std::nullopt;
  const U sign = std::signbit(v) ? 0x8000 : 0;
  const double a = std::abs(double(v));
  if (std::isinf(v) || a >= 65520) return sign | 0x7C00;
  const int exponent = a < std::ldexp(1.0, -14) ? -14 : std::ilogb(a);
  const double steps = std::nearbyint(std::ldexp(a, 10 - exponent));  // 10 fraction bits
  const U scaled = U(steps);
  return sign | (exponent == -14 ? scaled : (U(exponent + 14) << 10) + scaled);
}

// Rounding of the packed component is not fixed: the nearest, halves either way; so halves are left open.
Result pack(std::initializer_list<float> values, int width, bool is_signed) {
  U out = 0;
  int shift = 0;
  for (const float v : values) {
    if (std::isnan(v)) return std::nullopt;
    const double scale = is_signed ? double((1 << (width - 1)) - 1) : double((1 << width) - 1);
    const double scaled = std::fmin(std::fmax(double(v), is_signed ? -1.0 : 0.0), 1.0) * scale;
    if (std::abs(scaled - std::floor(scaled) - 0.5) < 1e-3) return std::nullopt;
    out |= (U(S(std::nearbyint(scaled))) & mask_bits(U(width))) << shift;
    shift += width;
  }
  return out;
}

// c / (2^b - 1), correctly rounded to float; signed clamped to -1. Tolerance below.
float unpack(U word, U index, int width, bool is_signed) {
  const U field = word >> (index * U(width)) & mask_bits(U(width));
  if (!is_signed) return float(double(field) / double(mask_bits(U(width))));
  const S value = S(field << (32 - width)) >> (32 - width);
  return float(std::fmax(double(value) / double((1 << (width - 1)) - 1), -1.0));
}

const Op kOps[] = {
    {0, "add", [](U a, U b, U) -> Result { return a + b; }},
    {1, "sub", [](U a, U b, U) -> Result { return a - b; }},
    {2, "mul", [](U a, U b, U) -> Result { return a * b; }},
    {3, "udiv", [](U a, U b, U) -> Result { return b == 0 ? Result() : a / b; }},
    {4, "umod", [](U a, U b, U) -> Result { return b == 0 ? Result() : a % b; }},
    {5, "sdiv",
     [](U a, U b, U) -> Result { return b == 0 || (a == 0x80000000 && b == ~0u) ? Result() : U(S(a) / S(b)); }},
    // glslang makes OpSMod of GLSL's %. Vulkan leaves negative operands open; Lapilli takes SPIR-V's meaning.
    {6, "smod",
     [](U a, U b, U) -> Result {
       if (b == 0 || (a == 0x80000000 && b == ~0u)) return std::nullopt;
       if (!subject_is_lapilli() && (S(a) < 0 || S(b) < 0)) return std::nullopt;
       const S r = S(a) % S(b);
       return U(r != 0 && (r < 0) != (S(b) < 0) ? r + S(b) : r);
     }},
    {7, "negate", [](U a, U, U) -> Result { return 0 - a; }},
    {8, "abs", [](U a, U, U) -> Result { return S(a) < 0 ? 0 - a : a; }},
    {9, "sign", [](U a, U, U) -> Result { return U((S(a) > 0) - (S(a) < 0)); }},
    {10, "smin", [](U a, U b, U) -> Result { return U(std::min(S(a), S(b))); }},
    {11, "smax", [](U a, U b, U) -> Result { return U(std::max(S(a), S(b))); }},
    {12, "umin", [](U a, U b, U) -> Result { return std::min(a, b); }},
    {13, "umax", [](U a, U b, U) -> Result { return std::max(a, b); }},
    {14, "sclamp",
     [](U a, U b, U c) -> Result { return U(std::clamp(S(a), std::min(S(b), S(c)), std::max(S(b), S(c)))); }},
    {15, "uclamp", [](U a, U b, U c) -> Result { return std::clamp(a, std::min(b, c), std::max(b, c)); }},
    {16, "and", [](U a, U b, U) -> Result { return a & b; }},
    {17, "or", [](U a, U b, U) -> Result { return a | b; }},
    {18, "xor", [](U a, U b, U) -> Result { return a ^ b; }},
    {19, "not", [](U a, U, U) -> Result { return ~a; }},
    {20, "shift left", [](U a, U b, U) -> Result { return a << (b & 31); }},
    {21, "shift right", [](U a, U b, U) -> Result { return a >> (b & 31); }},
    {22, "shift right, arithmetic", [](U a, U b, U) -> Result { return U(S(a) >> (b & 31)); }},
    {23, "bitCount", [](U a, U, U) -> Result { return U(std::popcount(a)); }},
    {24, "bitfieldReverse", [](U a, U, U) -> Result { return reversed(a); }},
    {25, "findLSB", [](U a, U, U) -> Result { return a == 0 ? ~0u : U(std::countr_zero(a)); }},
    {26, "findMSB, unsigned", [](U a, U, U) -> Result { return U(msb(a)); }},
    {27, "findMSB, signed", [](U a, U, U) -> Result { return U(msb(S(a) < 0 ? ~a : a)); }},
    {28, "bitfieldExtract, unsigned",
     [](U a, U b, U c) -> Result {
       const U offset = b & 31, count = c % (33 - offset);
       return count == 0 ? 0 : a >> offset & mask_bits(count);
     }},
    {29, "bitfieldExtract, signed",
     [](U a, U b, U c) -> Result {
       const U offset = b & 31, count = c % (33 - offset);
       return count == 0 ? 0 : U(S(a << (32 - offset - count)) >> (32 - count));
     }},
    {30, "bitfieldInsert",
     [](U a, U b, U c) -> Result {
       const U offset = b & 31, count = c % (33 - offset);
       const U mask = count == 0 ? 0 : mask_bits(count) << offset;
       return (a & ~mask) | ((~a << offset) & mask);
     }},
    {31, "uaddCarry, carry", [](U a, U b, U) -> Result { return a + b < a; }},
    {32, "uaddCarry, sum", [](U a, U b, U) -> Result { return a + b; }},
    {33, "usubBorrow", [](U a, U b, U) -> Result { return a < b; }},
    {34, "umulExtended, high", [](U a, U b, U) -> Result { return U(uint64_t(a) * b >> 32); }},
    {35, "imulExtended, high", [](U a, U b, U) -> Result { return U(int64_t(S(a)) * S(b) >> 32); }},
    {36, "imulExtended, low", [](U a, U b, U) -> Result { return a * b; }},
    {37, "unsigned comparisons",
     [](U a, U b, U) -> Result {
       return U(a < b) | U(a <= b) << 1 | U(a > b) << 2 | U(a >= b) << 3 | U(a == b) << 4 | U(a != b) << 5;
     }},
    {38, "signed comparisons",
     [](U a, U b, U) -> Result {
       return U(S(a) < S(b)) | U(S(a) <= S(b)) << 1 | U(S(a) > S(b)) << 2 | U(S(a) >= S(b)) << 3;
     }},
    {39, "int to float", [](U a, U, U) -> Result { return bits(float(S(a))); }},
    {40, "uint to float", [](U a, U, U) -> Result { return bits(float(a)); }},
    {41, "float to int", [](U a, U, U) { return float_to(-2147483649.0, 2147483648.0, a, true); }},
    {42, "float to uint", [](U a, U, U) { return float_to(-1.0, 4294967296.0, a, false); }},
    {43, "bool", [](U a, U b, U) -> Result { return U(a != 0) + U(b == 0); }},
    {44, "packHalf2x16",
     [](U a, U b, U) -> Result {
       const Result low = to_half(f(a)), high = to_half(f(b));
       return low && high ? Result(*low | *high << 16) : Result();
     }},
    {45, "unpackHalf2x16, low", [](U a, U, U) -> Result { return bits(half_value(a & 0xFFFF)); }},
    {46, "unpackHalf2x16, high", [](U a, U, U) -> Result { return bits(half_value(a >> 16)); }},
    {47, "packUnorm4x8", [](U a, U b, U c) -> Result { const auto r = pack({f(a), f(b), f(c)}, 8, false); return r ? Result(*r | 0x80000000u) : r; }},
    {48, "packSnorm4x8", [](U a, U b, U c) { return pack({f(a), f(b), f(c), -1.0f}, 8, true); }},
    {49, "packUnorm2x16", [](U a, U b, U) { return pack({f(a), f(b)}, 16, false); }},
    {50, "packSnorm2x16", [](U a, U b, U) { return pack({f(a), f(b)}, 16, true); }},
    {51, "unpackUnorm4x8", [](U a, U b, U) -> Result { return bits(unpack(a, b & 3, 8, false)); }},
    {52, "unpackSnorm4x8", [](U a, U b, U) -> Result { return bits(unpack(a, b & 3, 8, true)); }},
    {53, "unpackUnorm2x16", [](U a, U b, U) -> Result { return bits(unpack(a, b & 1, 16, false)); }},
    {54, "unpackSnorm2x16", [](U a, U b, U) -> Result { return bits(unpack(a, b & 1, 16, true)); }},
    {55, "any, all", [](U a, U b, U c) -> Result { return U(a < b || b < c || c < a) | U(a != b && b != c) << 1; }},
};

bool near_enough(int op, U got, U want) {
  if (got == want) return true;
  // A NaN's bits are open; unpacked values may be one place off (the specification asks for a division).
  if (op >= 45 && op <= 46 && std::isnan(f(want))) return std::isnan(f(got));
  if (op >= 51 && op <= 54) return std::abs(f(got) - f(want)) <= 6e-8f;
  // packUnorm4x8: the fixed fourth component 0.5 is 127.5.
  if (op == 47) return (got & 0xFFFFFF) == (want & 0xFFFFFF) && (got >> 24 == 127 || got >> 24 == 128);
  return false;
}

bool flushes(U v) { return (v & 0x7F800000) == 0 && (v & 0x7FFFFF) != 0; }

TEST(IntegerArithmetic, AllOperations) {
  IntOperands in = int_operands(1);
  const FloatOperands floats = float_operands(3);
  for (const Op& op : kOps) {
    const bool takes_floats = op.op == 41 || op.op == 42 || op.op == 44 || (op.op >= 47 && op.op <= 50);
    IntOperands operands = in;
    if (takes_floats) {
      operands = {};
      for (size_t i = 0; i < floats.a.size(); ++i) {
        operands.a.push_back(bits(floats.a[i]));
        operands.b.push_back(bits(floats.b[i]));
        operands.c.push_back(bits(floats.c[i]));
      }
    }
    const std::vector<U> got = run_op(subject(), shaders::kIntOpsComp, op.op, operands.a, operands.b, operands.c);
    int wrong = 0, compared = 0;
    for (size_t i = 0; i < got.size(); ++i) {
      const U a = operands.a[i], b = operands.b[i], c = operands.c[i];
      const Result want = op.value(a, b, c);
      if (!want) continue;
      ++compared;
      if (near_enough(op.op, got[i], *want)) continue;
      // Other drivers may flush denormals and half denormals.
      if (!subject_is_lapilli() && (op.op >= 44 && op.op <= 46)) continue;
      if (!subject_is_lapilli() && takes_floats && (flushes(a) || flushes(b))) continue;
      if (++wrong <= 3) {
        ADD_FAILURE() << op.name << std::hex << "(0x" << a << ", 0x" << b << ", 0x" << c << ") = 0x" << got[i]
                      << ", expected 0x" << *want;
      }
    }
    EXPECT_EQ(wrong, 0) << op.name;
    EXPECT_GT(compared, 500) << op.name;
  }
}

}  // namespace
}  // namespace lapilli::conformance
