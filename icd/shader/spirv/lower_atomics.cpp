// Lowering: atomic instructions and barriers. Specification: SPIR-V, "Atomic Instructions", "Barrier Instructions".
#include <algorithm>
#include <array>
#include <iterator>

#include "shader/batch.h"
#include "shader/spirv/lowering.h"

namespace lapilli::spirv {
namespace {

// `pointer`, `value`, `comparator`: their words; 0: there is none.
struct AtomicRow {
  spv::Op op;
  AtomicOp atomic;
  uint32_t pointer, value, comparator;
};
constexpr AtomicRow kAtomics[] = {
    {spv::Op::OpAtomicLoad, AtomicOp::load, 3, 0, 0},
    {spv::Op::OpAtomicStore, AtomicOp::exchange, 1, 4, 0},
    {spv::Op::OpAtomicExchange, AtomicOp::exchange, 3, 6, 0},
    {spv::Op::OpAtomicCompareExchange, AtomicOp::compare_exchange, 3, 7, 8},
    {spv::Op::OpAtomicIIncrement, AtomicOp::add, 3, 0, 0},
    {spv::Op::OpAtomicIDecrement, AtomicOp::add, 3, 0, 0},
    {spv::Op::OpAtomicIAdd, AtomicOp::add, 3, 6, 0},
    {spv::Op::OpAtomicISub, AtomicOp::add, 3, 6, 0},
    {spv::Op::OpAtomicSMin, AtomicOp::smin, 3, 6, 0},
    {spv::Op::OpAtomicUMin, AtomicOp::umin, 3, 6, 0},
    {spv::Op::OpAtomicSMax, AtomicOp::smax, 3, 6, 0},
    {spv::Op::OpAtomicUMax, AtomicOp::umax, 3, 6, 0},
    {spv::Op::OpAtomicAnd, AtomicOp::bit_and, 3, 6, 0},
    {spv::Op::OpAtomicOr, AtomicOp::bit_or, 3, 6, 0},
    {spv::Op::OpAtomicXor, AtomicOp::bit_xor, 3, 6, 0},
};

}  // namespace

// False: it is another instruction.
bool Lowering::lower_atomics(const SpirvInst& inst) {
  if (inst.op == spv::Op::OpControlBarrier || inst.op == spv::Op::OpMemoryBarrier) {
    lower_barrier(inst);
    return true;
  }
  const auto row =
      std::find_if(std::begin(kAtomics), std::end(kAtomics), [&](const AtomicRow& each) { return each.op == inst.op; });
  if (row == std::end(kAtomics)) return false;
  const bool has_result = row->pointer == 3;
  const Pointer* at = pointer(inst[row->pointer]);
  if (at == nullptr) return true;
  const Type& word = type(at->type);
  const bool moves = row->atomic == AtomicOp::load || row->atomic == AtomicOp::exchange;
  const bool image = at->space == Space::texel;
  if ((!image && at->space != Space::buffer && at->space != Space::shared) || at->uniform)
    return fail("works on buffers, shared memory and images only"), true;
  if (!word.is_integer() && !(word.kind == Kind::real && moves)) return fail("is not supported for this type"), true;
  if (has_result && inst[1] != at->type) return fail("its type is not what the pointer points to"), true;
  for (const uint32_t operand : {row->value, row->comparator}) {
    if (operand == 0) continue;
    const Type& given = type_of(inst[operand]);  // glslang gives a uint an int where it reads HLSL
    if (given.kind != word.kind && !(given.is_integer() && word.is_integer()))
      return fail("an operand has another type than what the pointer points to"), true;
  }
  const auto [resource, descriptor] = resource_of(*at);
  std::vector<Reg> operands = {descriptor, kNoReg, at->texel[0], at->texel[1]};
  if (!image) {
    const Reg offset = constant(at->offset);
    operands = {at->dynamic == kNoReg ? offset : emit(Opcode::iadd, at->dynamic, offset), descriptor};
  }
  Reg value = row->value != 0 ? scalar(inst[row->value]) : kNoReg;
  if (inst.op == spv::Op::OpAtomicIIncrement) value = constant(1);
  if (inst.op == spv::Op::OpAtomicIDecrement) value = constant(~0u);
  if (inst.op == spv::Op::OpAtomicISub) value = emit(Opcode::ineg, value);
  if (word.kind == Kind::real && row->value != 0) value = canonical(value);
  operands.push_back(value);
  operands.push_back(row->comparator != 0 ? scalar(inst[row->comparator]) : kNoReg);
  if (failed()) return true;
  Instruction& instruction = code_.append(image ? Opcode::atomic_2d : Opcode::atomic, 1);
  instruction.imm = resource;
  instruction.imm2 = static_cast<uint32_t>(row->atomic);
  const Reg old = instruction.dst;
  code_.set_list(instruction, operands);
  if (has_result) bind(inst[2], {&old, 1});
  out_.stores |= row->atomic != AtomicOp::load;
  return true;
}

void Lowering::lower_barrier(const SpirvInst& inst) {
  // The lanes of one batch are at the same place anyway.
  bool waits = false;
  if (inst.op == spv::Op::OpControlBarrier) {
    const std::vector<uint32_t>* scope = constant_data(inst[1]);
    if (which_ != VK_SHADER_STAGE_COMPUTE_BIT) return fail("is for compute shaders");
    if (scope == nullptr || scope->size() != 1) return fail("its scope is no constant");
    const auto execution = static_cast<spv::Scope>((*scope)[0]);
    if (execution != spv::Scope::Workgroup && execution != spv::Scope::Subgroup && execution != spv::Scope::Invocation)
      return fail("its scope is more than a workgroup");
    waits = execution == spv::Scope::Workgroup && code_.invocations() > kBatchLanes;
  }
  code_.emit_void(waits ? Opcode::barrier : Opcode::memory_barrier);
}

}  // namespace lapilli::spirv
