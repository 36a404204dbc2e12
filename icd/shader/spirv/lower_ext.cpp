// Lowering: GLSL.std.450, functions of single components. How they are made of ops (fma where it says so):
//   mix(x, y, a)       fma(y, a, x * (1 - a))               clamp(x, lo, hi)   min(max(x, lo), hi)
//   step(e, x)         x < e ? 0 : 1                        smoothstep         t * t * (3 - 2 * t), t = clamp((x - e0)
//   / (e1 - e0), 0, 1) radians, degrees   x * (pi / 180), x * (180 / pi)       round              half to even
#include <spirv/unified1/GLSL.std.450.h>
#include <algorithm>
#include <iterator>

#include "shader/spirv/grammar.h"
#include "shader/spirv/lowering.h"

namespace lapilli::spirv {
namespace {

constexpr uint32_t kFirstOperand = 5;  // words before: opcode, type, result, set, instruction

struct Row {
  uint32_t from;
  Opcode to;
  uint8_t count;  // of operands
};

constexpr Row kRows[] = {
    {GLSLstd450Round, Opcode::fround_even, 1}, {GLSLstd450RoundEven, Opcode::fround_even, 1},
    {GLSLstd450Trunc, Opcode::ftrunc, 1},      {GLSLstd450FAbs, Opcode::fabs, 1},
    {GLSLstd450SAbs, Opcode::iabs, 1},         {GLSLstd450FSign, Opcode::fsign, 1},
    {GLSLstd450SSign, Opcode::isign, 1},       {GLSLstd450Floor, Opcode::ffloor, 1},
    {GLSLstd450Ceil, Opcode::fceil, 1},        {GLSLstd450Fract, Opcode::ffract, 1},
    {GLSLstd450Sin, Opcode::fsin, 1},          {GLSLstd450Cos, Opcode::fcos, 1},
    {GLSLstd450Tan, Opcode::ftan, 1},          {GLSLstd450Asin, Opcode::fasin, 1},
    {GLSLstd450Acos, Opcode::facos, 1},        {GLSLstd450Atan, Opcode::fatan, 1},
    {GLSLstd450Sinh, Opcode::fsinh, 1},        {GLSLstd450Cosh, Opcode::fcosh, 1},
    {GLSLstd450Tanh, Opcode::ftanh, 1},        {GLSLstd450Asinh, Opcode::fasinh, 1},
    {GLSLstd450Acosh, Opcode::facosh, 1},      {GLSLstd450Atanh, Opcode::fatanh, 1},
    {GLSLstd450Atan2, Opcode::fatan2, 2},      {GLSLstd450Pow, Opcode::fpow, 2},
    {GLSLstd450Exp, Opcode::fexp, 1},          {GLSLstd450Log, Opcode::flog, 1},
    {GLSLstd450Exp2, Opcode::fexp2, 1},        {GLSLstd450Log2, Opcode::flog2, 1},
    {GLSLstd450Sqrt, Opcode::fsqrt, 1},        {GLSLstd450InverseSqrt, Opcode::frsqrt, 1},
    {GLSLstd450FMin, Opcode::fmin, 2},         {GLSLstd450UMin, Opcode::umin, 2},
    {GLSLstd450SMin, Opcode::smin, 2},         {GLSLstd450FMax, Opcode::fmax, 2},
    {GLSLstd450UMax, Opcode::umax, 2},         {GLSLstd450SMax, Opcode::smax, 2},
    {GLSLstd450NMin, Opcode::nmin, 2},         {GLSLstd450NMax, Opcode::nmax, 2},
    {GLSLstd450Fma, Opcode::fma, 3},           {GLSLstd450Ldexp, Opcode::fldexp, 2},
    {GLSLstd450FindILsb, Opcode::find_lsb, 1}, {GLSLstd450FindSMsb, Opcode::find_smsb, 1},
    {GLSLstd450FindUMsb, Opcode::find_msb, 1},
};

struct ClampOps {
  uint32_t from;
  Opcode max, min;
};
constexpr ClampOps kClamps[] = {{GLSLstd450FClamp, Opcode::fmax, Opcode::fmin},
                                {GLSLstd450UClamp, Opcode::umax, Opcode::umin},
                                {GLSLstd450SClamp, Opcode::smax, Opcode::smin},
                                {GLSLstd450NClamp, Opcode::nmax, Opcode::nmin}};

// Operands that each instruction needs beside those of the tables.
uint32_t operand_count(uint32_t number) {
  switch (number) {
    case GLSLstd450FClamp:
    case GLSLstd450UClamp:
    case GLSLstd450SClamp:
    case GLSLstd450NClamp:
    case GLSLstd450FMix:
    case GLSLstd450SmoothStep:
    case GLSLstd450FaceForward:
    case GLSLstd450Refract:
      return 3;
    case GLSLstd450Step:
    case GLSLstd450Modf:
    case GLSLstd450Frexp:
    case GLSLstd450Distance:
    case GLSLstd450Cross:
    case GLSLstd450Reflect:
    case GLSLstd450InterpolateAtSample:
    case GLSLstd450InterpolateAtOffset:
      return 2;
    default:
      return 1;
  }
}

}  // namespace

void Lowering::lower_ext_inst(const SpirvInst& inst) {
  const SpirvInst set = m_.definition(inst[3]);
  if (set.op != spv::Op::OpExtInstImport) return fail("its instruction set is none");
  if (spirv_string(set.words + 2, set.count - 2) != "GLSL.std.450") return;  // non-semantic
  const uint32_t number = inst[4];
  if (inst.count < kFirstOperand + operand_count(number)) return fail("operands are missing");
  if (lower_ext_by_table(inst) || lower_ext_geometric(inst) || lower_ext_packing(inst) || failed()) return;
  switch (number) {
    case GLSLstd450Modf:
    case GLSLstd450ModfStruct:
    case GLSLstd450Frexp:
    case GLSLstd450FrexpStruct:
      return lower_parts(inst);
    case GLSLstd450InterpolateAtCentroid:
    case GLSLstd450InterpolateAtSample:
    case GLSLstd450InterpolateAtOffset:
      return lower_interpolation(inst);
    case GLSLstd450Determinant:
    case GLSLstd450MatrixInverse:
      return lower_matrix_function(inst);
    default:
      return fail(spirv_enum_name(SpirvEnum::ExtInst, number) + " is not supported");
  }
}

bool Lowering::lower_ext_by_table(const SpirvInst& inst) {
  const uint32_t number = inst[4];
  const auto row = std::find_if(std::begin(kRows), std::end(kRows), [&](const Row& r) { return r.from == number; });
  const uint32_t operands = row != std::end(kRows) ? row->count : operand_count(number);
  if (inst.count < kFirstOperand + operands) {
    fail("operands are missing");
    return true;
  }
  std::vector<Reg> regs;
  const uint64_t count = type(inst[1]).components;
  const auto operand = [&](uint32_t i) { return data(inst[kFirstOperand + i], count); };
  if (row != std::end(kRows)) {
    const std::span<const Reg> a = operand(0);
    const std::span<const Reg> b = operands > 1 ? operand(1) : a;
    const std::span<const Reg> c = operands > 2 ? operand(2) : a;
    if (failed()) return true;
    for (size_t i = 0; i < a.size(); ++i)
      regs.push_back(emit(row->to, a[i], operands > 1 ? b[i] : kNoReg, operands > 2 ? c[i] : kNoReg));
    bind(inst[2], regs);
    return true;
  }
  const auto clamp =
      std::find_if(std::begin(kClamps), std::end(kClamps), [&](const ClampOps& r) { return r.from == number; });
  const bool other = number == GLSLstd450FMix || number == GLSLstd450Step || number == GLSLstd450SmoothStep ||
                     number == GLSLstd450Radians || number == GLSLstd450Degrees;
  if (clamp == std::end(kClamps) && !other) return false;
  const std::span<const Reg> a = operand(0);
  const std::span<const Reg> b = operands > 1 ? operand(1) : a;
  const std::span<const Reg> c = operands > 2 ? operand(2) : a;
  if (failed()) return true;
  const Reg zero = constant(0), one = constant_f(1.0f);
  for (size_t i = 0; i < a.size(); ++i) {
    switch (number) {
      case GLSLstd450FMix:
        regs.push_back(emit(Opcode::fma, b[i], c[i], emit(Opcode::fmul, a[i], emit(Opcode::fsub, one, c[i]))));
        break;
      case GLSLstd450Step:
        regs.push_back(emit(Opcode::select, emit(Opcode::flt, b[i], a[i]), zero, one));
        break;
      case GLSLstd450SmoothStep: {
        const Reg ratio = emit(Opcode::fdiv, emit(Opcode::fsub, c[i], a[i]), emit(Opcode::fsub, b[i], a[i]));
        const Reg t = emit(Opcode::fmin, emit(Opcode::fmax, ratio, zero), one);
        const Reg factor = emit(Opcode::fsub, constant_f(3.0f), emit(Opcode::fmul, constant_f(2.0f), t));
        regs.push_back(emit(Opcode::fmul, emit(Opcode::fmul, t, t), factor));
        break;
      }
      case GLSLstd450Radians:
        regs.push_back(emit(Opcode::fmul, a[i], constant_f(0.01745329251994329577f)));
        break;
      case GLSLstd450Degrees:
        regs.push_back(emit(Opcode::fmul, a[i], constant_f(57.29577951308232088f)));
        break;
      default:
        regs.push_back(emit(clamp->min, emit(clamp->max, a[i], b[i]), c[i]));
    }
  }
  bind(inst[2], regs);
  return true;
}

// Modf and Frexp: the second result goes through a pointer or into a structure.
void Lowering::lower_parts(const SpirvInst& inst) {
  const uint32_t number = inst[4];
  const bool modf = number == GLSLstd450Modf || number == GLSLstd450ModfStruct;
  std::vector<Reg> first, second;
  for (const Reg x : data(inst[kFirstOperand])) {
    if (modf) {
      const Reg whole = emit(Opcode::ftrunc, x);
      // An infinity has the fraction 0, and the fraction has the sign of x.
      const Reg magnitude = emit(Opcode::fabs, emit(Opcode::fsub, x, whole));
      const Reg finite = emit(Opcode::select, emit(Opcode::fisinf, x), constant(0), magnitude);
      first.push_back(emit(Opcode::ior, finite, emit(Opcode::iand, x, constant(0x80000000u))));
      second.push_back(whole);
    } else {
      first.push_back(emit(Opcode::ffrexp_significand, x));
      second.push_back(emit(Opcode::ffrexp_exponent, x));
    }
  }
  if (number == GLSLstd450ModfStruct || number == GLSLstd450FrexpStruct) {
    first.insert(first.end(), second.begin(), second.end());
  } else if (const Pointer* to = pointer(inst[kFirstOperand + 1]); to != nullptr) {
    if (type(to->type).components != second.size()) return fail("its pointer has another type");
    store(*to, second);
  }
  if (!failed()) bind(inst[2], first);
}

bool Lowering::lower_ext_packing(const SpirvInst& inst) {
  struct Format {
    uint32_t pack, unpack;
    uint32_t count, bits;
    bool is_signed;
    float scale;  // 0: half floats
  };
  static constexpr Format kFormats[] = {
      {GLSLstd450PackSnorm4x8, GLSLstd450UnpackSnorm4x8, 4, 8, true, 127.0f},
      {GLSLstd450PackUnorm4x8, GLSLstd450UnpackUnorm4x8, 4, 8, false, 255.0f},
      {GLSLstd450PackSnorm2x16, GLSLstd450UnpackSnorm2x16, 2, 16, true, 32767.0f},
      {GLSLstd450PackUnorm2x16, GLSLstd450UnpackUnorm2x16, 2, 16, false, 65535.0f},
      {GLSLstd450PackHalf2x16, GLSLstd450UnpackHalf2x16, 2, 16, false, 0.0f},
  };
  const auto format = std::find_if(std::begin(kFormats), std::end(kFormats),
                                   [&](const Format& f) { return f.pack == inst[4] || f.unpack == inst[4]; });
  if (format == std::end(kFormats)) return false;
  const Reg low = constant_f(format->is_signed ? -1.0f : 0.0f), high = constant_f(1.0f);
  const Reg field = constant((1u << format->bits) - 1);
  if (inst[4] == format->pack) {
    Reg packed = kNoReg;
    const std::span<const Reg> values = data(inst[kFirstOperand], format->count);
    for (uint32_t i = 0; i < format->count && !failed(); ++i) {
      Reg part;
      if (format->scale == 0.0f) {
        part = emit(Opcode::f_to_half, values[i]);
      } else {  // round(clamp(x) * scale); a NaN becomes 0 or the lowest value
        const Reg clamped = emit(Opcode::fmin, high, emit(Opcode::fmax, low, values[i]));
        const Reg rounded = emit(Opcode::fround_even, emit(Opcode::fmul, clamped, constant_f(format->scale)));
        part = emit(Opcode::iand, emit(Opcode::f_to_s, rounded), field);
      }
      if (i != 0) part = emit(Opcode::shl, part, constant(i * format->bits));
      packed = packed == kNoReg ? part : emit(Opcode::ior, packed, part);
    }
    if (!failed()) bind(inst[2], {&packed, 1});
    return true;
  }
  std::vector<Reg> regs;
  const Reg packed = scalar(inst[kFirstOperand]);
  for (uint32_t i = 0; i < format->count; ++i) {
    const Reg first = constant(i * format->bits), bits = constant(format->bits);
    if (format->scale == 0.0f) {
      regs.push_back(emit(Opcode::half_to_f, emit(Opcode::ubit_extract, packed, first, bits)));
      continue;
    }
    const Opcode extract = format->is_signed ? Opcode::sbit_extract : Opcode::ubit_extract;
    const Reg number = emit(Opcode::s_to_f, emit(extract, packed, first, bits));
    const Reg scaled = emit(Opcode::fdiv, number, constant_f(format->scale));
    regs.push_back(format->is_signed ? emit(Opcode::fmax, scaled, low) : scaled);
  }
  if (!failed()) bind(inst[2], regs);
  return true;
}

}  // namespace lapilli::spirv
