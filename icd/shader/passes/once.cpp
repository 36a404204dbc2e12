// Uniformity analysis: what is the same in all lanes of a draw moves to the section that runs once per draw.
//
// Values only: a variable may differ from lane to lane by its history. Ops without effects may move out of branches
// that nobody takes. A load gives 0 to idle lanes where it stands, but the same value to all of them once it has moved:
// only ops that look at other lanes could tell, so where there are any, loads move from the first block alone.
#include <algorithm>

#include "shader/fixed_function.h"
#include "shader/interpreter/op.h"
#include "shader/passes/passes.h"

namespace lapilli {
namespace {

constexpr uint32_t kNone = 0xFFFFFFFF;
constexpr size_t kMostResults = 1 << 14;  // scalars of a program

class Splitter {
 public:
  explicit Splitter(Code& code) : code_(code) {
    for (const Instruction& instruction : code.instructions) {
      stores_ |= writes_resource(instruction);
      crosses_lanes_ |= (op_info(instruction.op).effects & kCrossLane) != 0;
    }
  }

  void run() {
    marks_.assign(code_.instructions.size(), 1);
    size_t results = 0;
    size_t first_block = 0;
    while (first_block < marks_.size() && (op_info(code_.instructions[first_block].op).effects & kControl) == 0)
      ++first_block;
    for (size_t i = 0; i < marks_.size(); ++i) {
      Instruction& instruction = code_.instructions[i];
      for_each_operand(code_, instruction, [this](Reg& reg) {
        if (reg < same_as_.size() && same_as_[reg] != kNoReg) reg = same_as_[reg];
      });
      if (!is_uniform(instruction, i < first_block) || results + instruction.results > kMostResults) continue;
      marks_[i] = 0;
      if (reuse(instruction)) continue;
      results += instruction.results;
      for (uint32_t k = 0; k < instruction.results; ++k) code_.registers[instruction.dst + k].kind = RegKind::uniform;
      code_.once.push_back(instruction);
    }
    if (!code_.once.empty()) keep_marked(code_, marks_);
    for (Instruction& instruction : code_.instructions) {
      if (instruction.op == Opcode::blend_color && has_same_color(instruction)) instruction.imm2 |= kBlendSameColor;
    }
  }

 private:
  bool is_uniform(const Instruction& instruction, bool in_first_block) const {
    if (instruction.results == 0 || find_handler(SimdTarget::kBaseline, instruction.op, kOnce) == nullptr) return false;
    for (uint32_t k = 0; k < instruction.results; ++k) {
      if (code_.registers[instruction.dst + k].kind != RegKind::value) return false;
    }
    for (Reg reg : {instruction.a, instruction.b, instruction.c}) {
      if (reg != kNoReg && !is_same_in_all_lanes(reg)) return false;
    }
    switch (instruction.op) {
      case Opcode::builtin:
        return instruction.imm >= static_cast<uint32_t>(BuiltIn::blend_constant_r) &&
               instruction.imm <= static_cast<uint32_t>(BuiltIn::blend_constant_a);
      case Opcode::load_buffer:
        if (code_.resources[instruction.imm].set == kSharedMemory) return false;
        if (stores_ && !code_.resources[instruction.imm].uniform) return false;
        return in_first_block || !crosses_lanes_;
      case Opcode::load_push_indexed:
        return in_first_block || !crosses_lanes_;
      default:
        return true;
    }
  }

  bool is_same_in_all_lanes(Reg reg) const {
    return code_.registers[reg].kind == RegKind::constant || code_.registers[reg].kind == RegKind::uniform;
  }

  bool has_same_color(const Instruction& blend) const {
    const Reg* const color = &code_.operand_list[blend.list_first];
    return std::all_of(color, color + 3, [this](Reg reg) { return reg == kNoReg || is_same_in_all_lanes(reg); });
  }

  // The same was computed already: in another branch, for simplify() looks at one block at a time.
  bool reuse(const Instruction& instruction) {
    size_t& slot = find(instruction);
    if (slot == kNone) {
      slot = code_.once.size();
      return false;
    }
    same_as_.resize(code_.registers.size(), kNoReg);
    for (uint32_t k = 0; k < instruction.results; ++k) same_as_[instruction.dst + k] = code_.once[slot].dst + k;
    return true;
  }

  size_t& find(const Instruction& instruction) {
    if (table_.empty()) {
      size_t size = 16;
      while (size < 2 * code_.instructions.size()) size *= 2;
      table_.assign(size, kNone);
    }
    const size_t mask = table_.size() - 1;
    size_t at = hash_of(instruction) & mask;
    while (table_[at] != kNone && !computes_the_same(code_.once[table_[at]], instruction)) at = (at + 1) & mask;
    return table_[at];
  }

  Code& code_;
  bool stores_ = false;
  bool crosses_lanes_ = false;
  std::vector<uint8_t> marks_;
  std::vector<Reg> same_as_;
  std::vector<size_t> table_;  // open addressing: places in Code::once
};

}  // namespace

void split_once(Code& code) { Splitter(code).run(); }

}  // namespace lapilli
