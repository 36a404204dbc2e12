// Choice of forms: which operand is taken from the accumulator, and which results need a register at all.
#include <cstring>

#include "shader/interpreter/op.h"
#include "shader/passes/passes.h"

namespace lapilli {
namespace {

bool has_form(Opcode op, uint32_t form) { return find_handler(SimdTarget::kBaseline, op, form) != nullptr; }

// What the accumulator holds after an instruction that held `before`.
Reg accumulator_after(const Instruction& instruction, Reg before) {
  if (instruction.results == 1) return instruction.dst;
  switch (instruction.op) {
    case Opcode::store_output:
    case Opcode::branch:
    case Opcode::branch_if:
    case Opcode::branch_where:
      return before;
    default:
      return kNoReg;
  }
}

// The form's source bits for an instruction while the accumulator holds a register; may swap a and b.
uint32_t accumulator_operand(Instruction& instruction, Reg accumulator) {
  if (accumulator == kNoReg) return kFromRegisters;
  if (instruction.a == accumulator && has_form(instruction.op, kAccumulatorIsA | kStore)) return kAccumulatorIsA;
  if (instruction.b == accumulator) {
    if (has_form(instruction.op, kAccumulatorIsB | kStore)) return kAccumulatorIsB;
    if ((op_info(instruction.op).effects & kCommutes) != 0 && has_form(instruction.op, kAccumulatorIsA | kStore)) {
      std::swap(instruction.a, instruction.b);
      return kAccumulatorIsA;
    }
  }
  if (instruction.c == accumulator && has_form(instruction.op, kAccumulatorIsC | kStore)) return kAccumulatorIsC;
  return kFromRegisters;
}

}  // namespace

FormChoice choose_forms(Code& code) {
  FormChoice choice;
  choice.forms.resize(code.instructions.size());
  choice.in_memory.assign(code.registers.size(), 0);
  std::vector<uint8_t> is_target(code.instructions.size() + 1, 0);
  for (uint32_t position : code.labels) {
    if (position != kNoLabelPosition) is_target[position] = 1;
  }
  Reg accumulator = kNoReg;
  for (uint32_t i = 0; i < code.instructions.size(); ++i) {
    Instruction& instruction = code.instructions[i];
    if (is_target[i] != 0) accumulator = kNoReg;
    const uint32_t source = accumulator_operand(instruction, accumulator);
    choice.forms[i] = static_cast<uint8_t>(source);
    const Reg operands[] = {instruction.a, instruction.b, instruction.c};
    for (uint32_t k = 0; k < 3; ++k) {
      if (operands[k] != kNoReg && source != 2 * (k + 1)) choice.in_memory[operands[k]] = 1;
    }
    for (uint32_t k = 0; k < instruction.list_count; ++k) {
      const Reg reg = code.operand_list[instruction.list_first + k];
      if (reg != kNoReg) choice.in_memory[reg] = 1;
    }
    accumulator = accumulator_after(instruction, accumulator);
  }
  for (const RegArray& array : code.arrays) std::memset(choice.in_memory.data() + array.first, 1, array.count);
  for (uint32_t i = 0; i < code.instructions.size(); ++i) {
    const Instruction& instruction = code.instructions[i];
    if (instruction.results == 0) {
      choice.forms[i] |= kStore;
      continue;
    }
    const bool keeps = instruction.results == 1 && choice.in_memory[instruction.dst] == 0 &&
                       code.registers[instruction.dst].kind == RegKind::value &&
                       has_form(instruction.op, choice.forms[i]);
    if (keeps) continue;
    choice.forms[i] |= kStore;
    for (uint32_t k = 0; k < instruction.results; ++k) choice.in_memory[instruction.dst + k] = 1;
  }
  return choice;
}

}  // namespace lapilli
