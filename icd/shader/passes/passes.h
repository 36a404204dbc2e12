// The passes that turn a Code into what the interpreter runs well. Each is a function over the whole program; all of
// them keep what `verify` checks, and take time that grows with the length of the program only.
#pragma once

#include <cstdint>
#include <vector>

#include "base/simd_dispatch.h"
#include "shader/ir.h"

namespace lapilli {

// All of the passes below, up to scheduling; split_once unless LAPILLI_KEEP names uniforms.
void optimize(Code& code, SimdTarget target);
// Whether every program goes to stderr: as it was lowered, after each pass, and as the interpreter runs it.
bool dumps_passes();
void set_dump_passes(bool on);

// Leaves out branches to the next block, and computes both sides of short ifs in all lanes, to choose from.
void flatten(Code& code);

// Constant folding, forwarding of copies, algebra that keeps every bit, common subexpressions within a block, stores to
// variables that are overwritten. What became superfluous stays until remove_dead_code.
void simplify(Code& code, SimdTarget target);

// Removes what has no effect and whose results nobody reads, and results at the ends of multi-result instructions.
void remove_dead_code(Code& code);

// What would be left.
struct LiveWork {
  uint32_t ops = 0;
  uint32_t cost = 0;  // in the unit of ops.def
};
LiveWork live_work(const Code& code);

// Moves what is the same in all lanes of a draw to Code::once.
void split_once(Code& code);

// Within each block, moves each expression that is used once to the place before its use, so that the use finds it in
// the accumulator.
void schedule(Code& code);

// Where instruction operands come from and results go (Form, interpreter/op.h), one for each instruction; and which
// registers are in memory at all. Swaps operands of ops that commute.
struct FormChoice {
  std::vector<uint8_t> forms;
  std::vector<uint8_t> in_memory;  // for each virtual register
};
FormChoice choose_forms(Code& code);

// The instructions, first to last, during which a register holds something.
struct Interval {
  static constexpr uint32_t kNever = 0xFFFFFFFF;
  uint32_t first = kNever;
  uint32_t last = 0;
};
// In linear order, extended over loops. Constants have none.
std::vector<Interval> live_intervals(const Code& code);

// Physical registers of the virtual ones; kNoOperand for those that are not in memory.
struct Allocation {
  std::vector<uint16_t> physical;
  uint32_t count = 0;  // above kMaxRegisters: the program does not fit
};
Allocation allocate_registers(const Code& code, const FormChoice& choice);

// Shared by the passes.

// Depends on its operands only, and has one result.
bool is_pure(const Instruction& instruction);
// For tables of instructions without operand lists: results aside.
size_t hash_of(const Instruction& instruction);
bool computes_the_same(const Instruction& x, const Instruction& y);
// 1 for each instruction that begins a block: at a label, or after a control instruction.
std::vector<uint8_t> block_starts(const Code& code);
// Drops the instructions whose mark is 0; labels follow.
void keep_marked(Code& code, const std::vector<uint8_t>& marks);

// Calls visit(Reg&) for each operand that is there.
template <class CodeType, class InstructionType, class Visit>
void for_each_operand(CodeType& code, InstructionType& instruction, Visit&& visit) {
  if (instruction.a != kNoReg) visit(instruction.a);
  if (instruction.b != kNoReg) visit(instruction.b);
  if (instruction.c != kNoReg) visit(instruction.c);
  for (uint32_t i = 0; i < instruction.list_count; ++i) {
    auto& reg = code.operand_list[instruction.list_first + i];
    if (reg != kNoReg) visit(reg);
  }
}

}  // namespace lapilli
