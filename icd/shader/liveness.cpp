// Which registers matter to a program's effects; decides which inputs a shader reads.
#include "shader/stage_code.h"

namespace lapilli {
namespace {
constexpr int kMostRounds = 64;  // loops inside loops; beyond them everything counts as live
}

std::vector<bool> find_live_registers(const Code& code) {
  std::vector<bool> live(code.registers.size());
  std::vector<bool> live_array(code.arrays.size());
  std::vector<bool> done(code.instructions.size());
  bool changed = true;
  for (int round = 0; changed; ++round) {
    if (round == kMostRounds) return std::vector<bool>(code.registers.size(), true);
    changed = false;
    for (size_t i = code.instructions.size(); i-- > 0;) {
      const Instruction& instruction = code.instructions[i];
      if (done[i]) continue;
      bool needed = (op_info(instruction.op).effects & (kWritesMemory | kControl)) != 0;
      if (instruction.op == Opcode::store_array) needed = live_array[instruction.imm];
      for (Reg reg = instruction.dst; reg < instruction.dst + instruction.results; ++reg) {
        const uint32_t array = code.registers[reg].array;
        needed = needed || live[reg] || (array != kNoReg && live_array[array]);
      }
      if (!needed) continue;
      done[i] = true;
      changed = true;
      if (instruction.op == Opcode::load_array) live_array[instruction.imm] = true;
      for (const Reg reg : {instruction.a, instruction.b, instruction.c}) {
        if (reg != kNoReg) live[reg] = true;
      }
      for (uint32_t n = 0; n < instruction.list_count; ++n) {
        const Reg reg = code.operand_list[instruction.list_first + n];
        if (reg != kNoReg) live[reg] = true;
      }
    }
  }
  return live;
}

}  // namespace lapilli
