// Ordering of expressions for the accumulator.
//
// An instruction is a leaf of a tree if its only use is another instruction of the same block and nothing keeps it
// where it is. Trees are laid out in postorder before their roots; the roots stay in order.
#include <algorithm>

#include "shader/interpreter/op.h"
#include "shader/passes/passes.h"

namespace lapilli {
namespace {

constexpr uint32_t kNone = 0xFFFFFFFF;

class Scheduler {
 public:
  explicit Scheduler(Code& code)
      : code_(code),
        definition_(code.registers.size(), kNone),
        uses_(code.registers.size(), 0),
        user_(code.registers.size(), kNone),
        last_write_(code.registers.size(), kNone),
        movable_(code.instructions.size(), 0),
        weight_(code.instructions.size(), 1) {}

  void run() {
    for (uint32_t i = 0; i < code_.instructions.size(); ++i) note(i);
    const std::vector<uint8_t> starts = block_starts(code_);
    order_.reserve(code_.instructions.size());
    uint32_t first = 0;
    for (uint32_t i = 1; i <= code_.instructions.size(); ++i) {
      if (starts[i] == 0 && i < code_.instructions.size()) continue;
      schedule_block(first, i);
      first = i;
    }
    std::vector<Instruction> sorted;
    sorted.reserve(order_.size());
    for (uint32_t i : order_) sorted.push_back(code_.instructions[i]);
    code_.instructions = std::move(sorted);
  }

 private:
  void note(uint32_t i) {
    const Instruction& instruction = code_.instructions[i];
    for_each_operand(code_, instruction, [&](Reg reg) {
      ++uses_[reg];
      user_[reg] = i;
    });
    for (uint32_t k = 0; k < instruction.results; ++k) definition_[instruction.dst + k] = i;
    // An operand list has no accumulator forms.
    for (uint32_t k = 0; k < instruction.list_count; ++k) {
      const Reg reg = code_.operand_list[instruction.list_first + k];
      if (reg != kNoReg) ++uses_[reg];
    }
  }

  // May the instruction move down to its only user?
  bool is_movable(uint32_t i, uint32_t end) const {
    const Instruction& instruction = code_.instructions[i];
    const bool batch_input = instruction.results == 1 && (op_info(instruction.op).effects & kBatchInput) != 0;
    if (!is_pure(instruction) && !batch_input) return false;
    if (code_.registers[instruction.dst].kind != RegKind::value || uses_[instruction.dst] != 1) return false;
    const uint32_t user = user_[instruction.dst];
    if (user <= i || user >= end) return false;
    bool stays = false;
    for_each_operand(code_, instruction, [&](Reg reg) {
      stays |= code_.registers[reg].kind == RegKind::variable && last_write_[reg] != kNone && last_write_[reg] > i;
    });
    return !stays;
  }

  void schedule_block(uint32_t first, uint32_t end) {
    for (uint32_t i = first; i < end; ++i) {
      const Instruction& instruction = code_.instructions[i];
      for (uint32_t k = 0; k < instruction.results; ++k) last_write_[instruction.dst + k] = i;
      if (instruction.op == Opcode::store_array) {
        const RegArray& array = code_.arrays[instruction.imm];
        std::fill_n(last_write_.begin() + array.first, array.count, i);
      }
    }
    for (uint32_t i = first; i < end; ++i) {
      movable_[i] = is_movable(i, end);
      if (movable_[i] != 0) weight_[user_[code_.instructions[i].dst]] += weight_[i];
    }
    // Backwards: the root, then its last operand's tree, and so on; turned around in the end.
    const size_t begin = order_.size();
    for (uint32_t i = end; i-- > first;) {
      if (movable_[i] != 0) continue;
      stack_.push_back(i);
      while (!stack_.empty()) {
        const uint32_t next = stack_.back();
        stack_.pop_back();
        order_.push_back(next);
        push_operands(next);
      }
    }
    std::reverse(order_.begin() + static_cast<std::ptrdiff_t>(begin), order_.end());
  }

  // Pushes the trees of the operands in the order of their evaluation: the heavy ones first, because fewer registers
  // are in use then; last of all one that the instruction can take from the accumulator.
  void push_operands(uint32_t i) {
    const Instruction& instruction = code_.instructions[i];
    struct Tree {
      uint32_t root;
      bool in_accumulator;
    };
    Tree trees[3];
    int count = 0;
    const Reg operands[3] = {instruction.a, instruction.b, instruction.c};
    for (uint32_t k = 0; k < 3; ++k) {
      if (operands[k] == kNoReg) continue;
      const uint32_t root = definition_[operands[k]];
      if (root == kNone || movable_[root] == 0 || user_[operands[k]] != i) continue;
      const uint32_t form = 2 * (k + 1) | kStore;
      const bool swapped = k == 1 && (op_info(instruction.op).effects & kCommutes) != 0;
      const bool possible =
          has_form(instruction.op, form) || (swapped && has_form(instruction.op, kAccumulatorIsA | kStore));
      trees[count++] = {root, possible};
    }
    std::stable_sort(trees, trees + count,
                     [this](const Tree& x, const Tree& y) { return weight_[x.root] > weight_[y.root]; });
    for (int k = count - 1; k >= 0; --k) {
      if (!trees[k].in_accumulator) continue;
      std::rotate(trees + k, trees + k + 1, trees + count);
      break;
    }
    for (int k = 0; k < count; ++k) stack_.push_back(trees[k].root);
  }

  static bool has_form(Opcode op, uint32_t form) { return find_handler(SimdTarget::kBaseline, op, form) != nullptr; }

  Code& code_;
  std::vector<uint32_t> definition_;
  std::vector<uint32_t> uses_;
  std::vector<uint32_t> user_;        // the last one
  std::vector<uint32_t> last_write_;  // in the block that is being scheduled, or an earlier one
  std::vector<uint8_t> movable_;
  std::vector<uint32_t> weight_;  // instructions of the tree
  std::vector<uint32_t> order_;
  std::vector<uint32_t> stack_;
};

}  // namespace

void schedule(Code& code) { Scheduler(code).run(); }

}  // namespace lapilli
