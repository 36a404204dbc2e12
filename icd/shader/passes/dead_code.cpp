// Removal of what nobody needs, from effects back to what they read.
#include "shader/passes/passes.h"

namespace lapilli {
namespace {

constexpr uint32_t kNone = 0xFFFFFFFF;

class Marker {
 public:
  explicit Marker(const Code& code)
      : code_(code),
        live_(code.instructions.size(), 0),
        needed_(code.registers.size(), 0),
        last_writer_(code.registers.size(), kNone),
        writer_before_(code.instructions.size(), kNone) {
    work_.reserve(code.instructions.size());
  }

  void run() {
    list_writers();
    for (Reg reg : code_.kept) need(reg);
    for (uint32_t i = 0; i < code_.instructions.size(); ++i) {
      // A store to an array counts where the array is read.
      const Opcode op = code_.instructions[i].op;
      if ((op_info(op).effects & (kWritesMemory | kControl)) != 0 && op != Opcode::store_array) mark(i);
    }
    while (!work_.empty()) {
      const Instruction& instruction = code_.instructions[work_.back()];
      work_.pop_back();
      for_each_operand(code_, instruction, [this](Reg reg) { need(reg); });
      if (instruction.op != Opcode::load_array) continue;
      const RegArray& array = code_.arrays[instruction.imm];
      for (Reg reg = array.first; reg < array.first + array.count; ++reg) need(reg);
    }
  }

  bool is_live(uint32_t i) const { return live_[i] != 0; }
  const std::vector<uint8_t>& live() const { return live_; }

  // Drops results at both ends where the instruction says how many there are.
  void trim(Instruction& instruction) const {
    if (op_info(instruction.op).results >= 0) return;
    while (instruction.results > 1 && needed_[instruction.dst + instruction.results - 1u] == 0) --instruction.results;
    const ImmRoles roles = imm_roles(instruction.op);
    if (roles.imm != ImmRole::varying && roles.imm2 != ImmRole::bytes) return;
    for (; instruction.results > 1 && needed_[instruction.dst] == 0; ++instruction.dst, --instruction.results) {
      if (roles.imm == ImmRole::varying) {
        ++instruction.imm;
      } else {
        instruction.imm2 += 4;
      }
    }
  }

 private:
  // The instructions that write a register, from the last one back: an instruction that writes a variable writes
  // nothing else. Stores to an array stand with its first element.
  void list_writers() {
    for (uint32_t i = 0; i < code_.instructions.size(); ++i) {
      const Instruction& instruction = code_.instructions[i];
      const bool array = instruction.op == Opcode::store_array;
      if (instruction.results == 1 || array) {
        uint32_t& last = last_writer_[array ? code_.arrays[instruction.imm].first : instruction.dst];
        writer_before_[i] = last;
        last = i;
        continue;
      }
      for (uint32_t k = 0; k < instruction.results; ++k) last_writer_[instruction.dst + k] = i;
    }
  }

  void mark(uint32_t i) {
    if (live_[i] != 0) return;
    live_[i] = 1;
    work_.push_back(i);
  }

  void need(Reg reg) {
    if (needed_[reg] != 0) return;
    needed_[reg] = 1;
    for (uint32_t i = last_writer_[reg]; i != kNone; i = writer_before_[i]) mark(i);
    const uint32_t array = code_.registers[reg].array;
    if (array != kNoReg) need(code_.arrays[array].first);
  }

  const Code& code_;
  std::vector<uint8_t> live_;
  std::vector<uint8_t> needed_;
  std::vector<uint32_t> last_writer_;    // by register
  std::vector<uint32_t> writer_before_;  // by instruction: the one before it that writes the same register
  std::vector<uint32_t> work_;
};

}  // namespace

void remove_dead_code(Code& code) {
  Marker marker(code);
  marker.run();
  for (uint32_t i = 0; i < code.instructions.size(); ++i) {
    if (marker.is_live(i)) marker.trim(code.instructions[i]);
  }
  keep_marked(code, marker.live());
}

LiveWork live_work(const Code& code) {
  Marker marker(code);
  marker.run();
  LiveWork work;
  for (uint32_t i = 0; i < code.instructions.size(); ++i) {
    if (!marker.is_live(i)) continue;
    ++work.ops;
    work.cost += op_info(code.instructions[i].op).cost;
  }
  return work;
}

}  // namespace lapilli
