// Ordering of a block for the accumulator, and for few registers.
//
// Instructions with effects, and those whose results are used in other blocks, are roots; they stay in order. All
// others move down to just before their first use. Seen from the end of the block: when all uses of a result are
// placed, its instruction comes next, depth first, and of several the one whose result its user can take from the
// accumulator.
#include <algorithm>

#include "shader/interpreter/op.h"
#include "shader/passes/passes.h"

namespace lapilli {
namespace {

constexpr uint32_t kNone = 0xFFFFFFFF;
constexpr uint32_t kMaxWeight = 1u << 20;

class Scheduler {
 public:
  explicit Scheduler(Code& code)
      : code_(code),
        definition_(code.registers.size(), kNone),
        uses_(code.registers.size(), 0),
        next_write_(code.registers.size(), kNone),
        state_(code.instructions.size()) {}

  void run() {
    for (uint32_t i = 0; i < size(); ++i) {
      const Instruction& instruction = code_.instructions[i];
      for_each_operand(code_, instruction, [this](Reg reg) { ++uses_[reg]; });
      for (uint32_t k = 0; k < instruction.results; ++k) definition_[instruction.dst + k] = i;
    }
    const std::vector<uint8_t> starts = block_starts(code_);
    order_.reserve(size());
    for (uint32_t first = 0, i = 1; i <= size(); ++i) {
      if (starts[i] == 0 && i < size()) continue;
      schedule_block(first, i);
      first = i;
    }
    std::vector<Instruction> sorted;
    sorted.reserve(size());
    for (uint32_t i : order_) sorted.push_back(code_.instructions[i]);
    code_.instructions = std::move(sorted);
  }

 private:
  struct State {
    uint32_t uses_left = 0;    // within the block, by instructions that are not placed yet
    uint32_t weight = 1;       // instructions of the tree below, about
    uint32_t barrier = kNone;  // the next instruction that writes what this one reads
    uint32_t waiting = kNone;  // list of instructions that wait for this one, their barrier
    uint32_t next_waiting = kNone;
    bool movable = false;
    bool placed = false;
  };

  uint32_t size() const { return static_cast<uint32_t>(code_.instructions.size()); }

  // The instruction of this block that defines the register.
  uint32_t definition_in_block(Reg reg) const {
    const uint32_t i = definition_[reg];
    const bool inside = i != kNone && i >= first_ && code_.registers[reg].kind == RegKind::value;
    return inside ? i : kNone;
  }

  void schedule_block(uint32_t first, uint32_t end) {
    first_ = first;
    find_barriers(first, end);
    for (uint32_t i = first; i < end; ++i) {
      for_each_operand(code_, code_.instructions[i], [this](Reg reg) {
        const uint32_t from = definition_in_block(reg);
        if (from != kNone) ++state_[from].uses_left;
      });
    }
    for (uint32_t i = first; i < end; ++i) {
      state_[i].movable = is_movable(code_.instructions[i], state_[i].uses_left);
      for_each_operand(code_, code_.instructions[i], [&](Reg reg) {
        const uint32_t from = definition_in_block(reg);
        if (from == kNone || !state_[from].movable || state_[from].uses_left != 1) return;
        state_[i].weight = std::min(state_[i].weight + state_[from].weight, kMaxWeight);
      });
    }
    const size_t begin = order_.size();
    for (uint32_t i = end; i-- > first;) {
      if (state_[i].movable) continue;
      stack_.push_back(i);
      while (!stack_.empty()) {
        const uint32_t next = stack_.back();
        stack_.pop_back();
        place(next);
      }
    }
    std::reverse(order_.begin() + static_cast<std::ptrdiff_t>(begin), order_.end());
  }

  void find_barriers(uint32_t first, uint32_t end) {
    uint32_t memory_write = kNone;
    for (uint32_t i = end; i-- > first;) {
      const Instruction& instruction = code_.instructions[i];
      const uint32_t effects = op_info(instruction.op).effects;
      uint32_t& barrier = state_[i].barrier;
      if ((effects & kReadsMemory) != 0) barrier = memory_write;
      for_each_operand(code_, instruction, [&](Reg reg) {
        if (code_.registers[reg].kind != RegKind::variable) return;
        // Elements of arrays count as memory.
        const uint32_t write = code_.registers[reg].array == kNoReg ? next_write_[reg] : memory_write;
        if (write != kNone && write < end && write > i) barrier = std::min(barrier, write);
      });
      if ((effects & kWritesMemory) != 0) memory_write = i;
      for (uint32_t k = 0; k < instruction.results; ++k) {
        next_write_[instruction.dst + k] = i;
        if (code_.registers[instruction.dst + k].array != kNoReg) memory_write = i;
      }
    }
  }

  bool is_movable(const Instruction& instruction, uint32_t uses_in_block) const {
    if (instruction.results == 0 || uses_in_block == 0) return false;
    if ((op_info(instruction.op).effects & (kWritesMemory | kControl | kMasked)) != 0) return false;
    uint32_t uses = 0;
    for (Reg reg = instruction.dst; reg < instruction.dst + instruction.results; ++reg) {
      if (code_.registers[reg].kind != RegKind::value) return false;
      uses += uses_[reg];
    }
    return uses == uses_in_block;
  }

  // Puts the instruction before all that are placed already; then come those that have no other uses left.
  void place(uint32_t i) {
    order_.push_back(i);
    State& state = state_[i];
    state.placed = true;
    struct Ready {
      uint32_t root;
      bool in_accumulator;
    };
    Ready ready[3];
    int count = 0;
    const Instruction& instruction = code_.instructions[i];
    const Reg operands[3] = {instruction.a, instruction.b, instruction.c};
    for (uint32_t k = 0; k < instruction.list_count; ++k) release(code_.operand_list[instruction.list_first + k]);
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t root = last_use(operands[k]);
      if (root != kNone) ready[count++] = {root, has_form(instruction.op, k)};
    }
    for (uint32_t next = state.waiting; next != kNone; next = state_[next].next_waiting) stack_.push_back(next);
    // Heavy trees first, because fewer registers are in use then; last of all one for the accumulator.
    for (int k = 1; k < count; ++k) {
      for (int j = k; j > 0 && state_[ready[j].root].weight > state_[ready[j - 1].root].weight; --j)
        std::swap(ready[j], ready[j - 1]);
    }
    for (int k = count - 1; k >= 0; --k) {
      if (!ready[k].in_accumulator) continue;
      std::rotate(ready + k, ready + k + 1, ready + count);
      break;
    }
    for (int k = 0; k < count; ++k) push(ready[k].root);
  }

  // The instruction that defines the operand, if that was the last use of its results.
  uint32_t last_use(Reg reg) {
    const uint32_t from = reg == kNoReg ? kNone : definition_in_block(reg);
    if (from == kNone || --state_[from].uses_left != 0 || !state_[from].movable) return kNone;
    return from;
  }
  void release(Reg reg) {
    const uint32_t from = last_use(reg);
    if (from != kNone) push(from);
  }
  void push(uint32_t i) {
    const uint32_t barrier = state_[i].barrier;
    if (barrier == kNone || state_[barrier].placed) return stack_.push_back(i);
    state_[i].next_waiting = state_[barrier].waiting;
    state_[barrier].waiting = i;
  }

  // Can operand k come from the accumulator?
  static bool has_form(Opcode op, uint32_t k) {
    if (find_handler(SimdTarget::kBaseline, op, 2 * (k + 1) | kStore) != nullptr) return true;
    const bool swapped = k == 1 && (op_info(op).effects & kCommutes) != 0;
    return swapped && find_handler(SimdTarget::kBaseline, op, kAccumulatorIsA | kStore) != nullptr;
  }

  Code& code_;
  uint32_t first_ = 0;  // of the block
  std::vector<uint32_t> definition_;
  std::vector<uint32_t> uses_;
  std::vector<uint32_t> next_write_;  // of variables, while barriers are searched
  std::vector<State> state_;
  std::vector<uint32_t> order_;
  std::vector<uint32_t> stack_;
};

}  // namespace

void schedule(Code& code) { Scheduler(code).run(); }

}  // namespace lapilli
