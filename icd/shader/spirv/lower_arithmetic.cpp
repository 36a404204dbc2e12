// Lowering: arithmetic, comparisons, conversions and bit operations, component by component.
// Where fma is used: OpDot and all matrix products (lower_vector.cpp), mix and Fma (lower_ext.cpp). A plain OpFMul and
// OpFAdd stay two operations.
#include <algorithm>
#include <bit>
#include <iterator>

#include "shader/spirv/lowering.h"

namespace lapilli::spirv {
namespace {

struct Row {
  spv::Op from;
  Opcode to;
  char operands;  // f: floats, i: integers, b: booleans
  uint8_t count;  // of operands
  bool swapped = false;
};

constexpr Row kRows[] = {
    {spv::Op::OpConvertFToU, Opcode::f_to_u, 'f', 1},
    {spv::Op::OpConvertFToS, Opcode::f_to_s, 'f', 1},
    {spv::Op::OpConvertSToF, Opcode::s_to_f, 'i', 1},
    {spv::Op::OpConvertUToF, Opcode::u_to_f, 'i', 1},
    {spv::Op::OpSNegate, Opcode::ineg, 'i', 1},
    {spv::Op::OpFNegate, Opcode::fneg, 'f', 1},
    {spv::Op::OpIAdd, Opcode::iadd, 'i', 2},
    {spv::Op::OpFAdd, Opcode::fadd, 'f', 2},
    {spv::Op::OpISub, Opcode::isub, 'i', 2},
    {spv::Op::OpFSub, Opcode::fsub, 'f', 2},
    {spv::Op::OpIMul, Opcode::imul, 'i', 2},
    {spv::Op::OpFMul, Opcode::fmul, 'f', 2},
    {spv::Op::OpUDiv, Opcode::udiv, 'i', 2},
    {spv::Op::OpSDiv, Opcode::sdiv, 'i', 2},
    {spv::Op::OpFDiv, Opcode::fdiv, 'f', 2},
    {spv::Op::OpUMod, Opcode::umod, 'i', 2},
    {spv::Op::OpSRem, Opcode::srem, 'i', 2},
    {spv::Op::OpSMod, Opcode::smod, 'i', 2},
    {spv::Op::OpFRem, Opcode::frem, 'f', 2},
    {spv::Op::OpFMod, Opcode::fmod, 'f', 2},
    {spv::Op::OpIsNan, Opcode::fisnan, 'f', 1},
    {spv::Op::OpIsInf, Opcode::fisinf, 'f', 1},
    {spv::Op::OpLogicalEqual, Opcode::ieq, 'b', 2},
    {spv::Op::OpLogicalNotEqual, Opcode::ixor, 'b', 2},
    {spv::Op::OpLogicalOr, Opcode::ior, 'b', 2},
    {spv::Op::OpLogicalAnd, Opcode::iand, 'b', 2},
    {spv::Op::OpLogicalNot, Opcode::inot, 'b', 1},
    {spv::Op::OpIEqual, Opcode::ieq, 'i', 2},
    {spv::Op::OpINotEqual, Opcode::ine, 'i', 2},
    {spv::Op::OpUGreaterThan, Opcode::ult, 'i', 2, true},
    {spv::Op::OpSGreaterThan, Opcode::slt, 'i', 2, true},
    {spv::Op::OpUGreaterThanEqual, Opcode::ule, 'i', 2, true},
    {spv::Op::OpSGreaterThanEqual, Opcode::sle, 'i', 2, true},
    {spv::Op::OpULessThan, Opcode::ult, 'i', 2},
    {spv::Op::OpSLessThan, Opcode::slt, 'i', 2},
    {spv::Op::OpULessThanEqual, Opcode::ule, 'i', 2},
    {spv::Op::OpSLessThanEqual, Opcode::sle, 'i', 2},
    {spv::Op::OpFOrdEqual, Opcode::feq, 'f', 2},
    {spv::Op::OpFUnordEqual, Opcode::funeq, 'f', 2},
    {spv::Op::OpFOrdNotEqual, Opcode::fne, 'f', 2},
    {spv::Op::OpFUnordNotEqual, Opcode::funne, 'f', 2},
    {spv::Op::OpFOrdLessThan, Opcode::flt, 'f', 2},
    {spv::Op::OpFUnordLessThan, Opcode::funlt, 'f', 2},
    {spv::Op::OpFOrdGreaterThan, Opcode::flt, 'f', 2, true},
    {spv::Op::OpFUnordGreaterThan, Opcode::funlt, 'f', 2, true},
    {spv::Op::OpFOrdLessThanEqual, Opcode::fle, 'f', 2},
    {spv::Op::OpFUnordLessThanEqual, Opcode::funle, 'f', 2},
    {spv::Op::OpFOrdGreaterThanEqual, Opcode::fle, 'f', 2, true},
    {spv::Op::OpFUnordGreaterThanEqual, Opcode::funle, 'f', 2, true},
    {spv::Op::OpShiftRightLogical, Opcode::shr, 'i', 2},
    {spv::Op::OpShiftRightArithmetic, Opcode::sar, 'i', 2},
    {spv::Op::OpShiftLeftLogical, Opcode::shl, 'i', 2},
    {spv::Op::OpBitwiseOr, Opcode::ior, 'i', 2},
    {spv::Op::OpBitwiseXor, Opcode::ixor, 'i', 2},
    {spv::Op::OpBitwiseAnd, Opcode::iand, 'i', 2},
    {spv::Op::OpNot, Opcode::inot, 'i', 1},
    {spv::Op::OpBitReverse, Opcode::bit_reverse, 'i', 1},
    {spv::Op::OpBitCount, Opcode::bit_count, 'i', 1},
    {spv::Op::OpDPdx, Opcode::ddx_fine, 'f', 1},
    {spv::Op::OpDPdy, Opcode::ddy_fine, 'f', 1},
    {spv::Op::OpDPdxFine, Opcode::ddx_fine, 'f', 1},
    {spv::Op::OpDPdyFine, Opcode::ddy_fine, 'f', 1},
    {spv::Op::OpDPdxCoarse, Opcode::ddx_coarse, 'f', 1},
    {spv::Op::OpDPdyCoarse, Opcode::ddy_coarse, 'f', 1},
};

bool fits(Kind kind, char operands) {
  switch (operands) {
    case 'f':
      return kind == Kind::real;
    case 'i':
      return kind == Kind::sint || kind == Kind::uint;
    default:
      return kind == Kind::boolean;
  }
}

bool is_derivative(spv::Op op) { return op >= spv::Op::OpDPdx && op <= spv::Op::OpFwidthCoarse; }

}  // namespace

bool Lowering::lower_by_table(const SpirvInst& inst) {
  if (is_derivative(inst.op) && which_ != VK_SHADER_STAGE_FRAGMENT_BIT) {
    fail("is for fragment shaders");
    return true;
  }
  const auto row =
      std::find_if(std::begin(kRows), std::end(kRows), [&](const Row& each) { return each.from == inst.op; });
  if (row == std::end(kRows)) return false;
  const uint64_t count = type(inst[1]).components;
  const bool two = row->count == 2;
  for (uint32_t i = 3; i < 3u + row->count; ++i) {
    if (!fits(scalar_kind(type_of(inst[i])), row->operands)) {
      fail(m_.name(inst[i]) + " has the wrong type");
      return true;
    }
  }
  const std::span<const Reg> a = data(inst[3], count);
  const std::span<const Reg> b = two ? data(inst[4], count) : a;
  if (failed()) return true;
  std::vector<Reg> regs(a.size());
  for (size_t i = 0; i < regs.size(); ++i) {
    regs[i] = !two ? emit(row->to, a[i]) : row->swapped ? emit(row->to, b[i], a[i]) : emit(row->to, a[i], b[i]);
  }
  bind(inst[2], regs);
  return true;
}

// What the table does not say.
bool Lowering::lower_arithmetic(const SpirvInst& inst) {
  std::vector<Reg> regs;
  const auto pairs = [&](Opcode low, Opcode high) {  // a structure of both results
    const std::span<const Reg> a = data(inst[3]);
    const std::span<const Reg> b = data(inst[4], a.size());
    for (const Opcode op : {low, high}) {
      for (size_t i = 0; i < a.size(); ++i) regs.push_back(emit(op, a[i], b[i]));
    }
  };
  switch (inst.op) {
    case spv::Op::OpIAddCarry:
      pairs(Opcode::iadd, Opcode::uadd_carry);
      break;
    case spv::Op::OpISubBorrow:
      pairs(Opcode::isub, Opcode::usub_borrow);
      break;
    case spv::Op::OpUMulExtended:
      pairs(Opcode::imul, Opcode::umul_high);
      break;
    case spv::Op::OpSMulExtended:
      pairs(Opcode::imul, Opcode::smul_high);
      break;
    case spv::Op::OpBitcast: {
      const bool from_float = scalar_kind(type_of(inst[3])) == Kind::real;
      if (scalar_kind(type(inst[1])) == Kind::none || scalar_kind(type(inst[1])) == Kind::boolean)
        fail("casts to what is no number");
      for (const Reg reg : data(inst[3])) regs.push_back(from_float ? canonical(reg) : reg);
      break;
    }
    case spv::Op::OpQuantizeToF16:
      for (const Reg reg : data(inst[3])) {
        // What no normalized half is becomes a zero.
        const Reg half = emit(Opcode::half_to_f, emit(Opcode::f_to_half, reg));
        const Reg small = emit(Opcode::flt, emit(Opcode::fabs, half), constant(std::bit_cast<uint32_t>(0x1p-14f)));
        regs.push_back(emit(Opcode::select, small, emit(Opcode::iand, half, constant(0x80000000)), half));
      }
      break;
    case spv::Op::OpBitFieldInsert: {
      const std::span<const Reg> base = data(inst[3]);
      const std::span<const Reg> insert = data(inst[4], base.size());
      const Reg offset = emit(Opcode::iand, scalar(inst[5]), constant(0xFFFF));
      const Reg field = emit(Opcode::ior, emit(Opcode::shl, scalar(inst[6]), constant(16)), offset);
      for (size_t i = 0; i < base.size(); ++i) regs.push_back(emit(Opcode::bit_insert, base[i], insert[i], field));
      break;
    }
    case spv::Op::OpBitFieldSExtract:
    case spv::Op::OpBitFieldUExtract: {
      const Opcode op = inst.op == spv::Op::OpBitFieldSExtract ? Opcode::sbit_extract : Opcode::ubit_extract;
      const Reg offset = scalar(inst[4]), bits = scalar(inst[5]);
      for (const Reg reg : data(inst[3])) regs.push_back(emit(op, reg, offset, bits));
      break;
    }
    case spv::Op::OpSelect: {
      const std::span<const Reg> condition = data(inst[3]);
      const std::span<const Reg> yes = data(inst[4]);
      const std::span<const Reg> no = data(inst[5], yes.size());
      if (scalar_kind(type_of(inst[3])) != Kind::boolean) fail("its condition is no boolean");
      if (condition.size() != 1 && condition.size() != yes.size()) fail("its condition has another size");
      if (failed()) return true;
      for (size_t i = 0; i < yes.size(); ++i)
        regs.push_back(emit(Opcode::select, condition[condition.size() == 1 ? 0 : i], yes[i], no[i]));
      break;
    }
    case spv::Op::OpAny:
    case spv::Op::OpAll: {
      const std::span<const Reg> values = data(inst[3]);
      if (values.empty() || scalar_kind(type_of(inst[3])) != Kind::boolean) fail("its operand is no boolean vector");
      if (failed()) return true;
      Reg reg = values[0];
      for (const Reg next : values.subspan(1))
        reg = emit(inst.op == spv::Op::OpAny ? Opcode::ior : Opcode::iand, reg, next);
      regs = {reg};
      break;
    }
    case spv::Op::OpFwidth:
    case spv::Op::OpFwidthFine:
    case spv::Op::OpFwidthCoarse: {
      const bool coarse = inst.op == spv::Op::OpFwidthCoarse;
      for (const Reg reg : data(inst[3])) {
        const Reg x = emit(coarse ? Opcode::ddx_coarse : Opcode::ddx_fine, reg);
        const Reg y = emit(coarse ? Opcode::ddy_coarse : Opcode::ddy_fine, reg);
        regs.push_back(emit(Opcode::fadd, emit(Opcode::fabs, x), emit(Opcode::fabs, y)));
      }
      break;
    }
    default:
      return false;
  }
  if (!failed()) bind(inst[2], regs);
  return true;
}

}  // namespace lapilli::spirv
