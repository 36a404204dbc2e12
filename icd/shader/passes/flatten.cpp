// Control flow that costs more than it spares: a branch to the next block, and short ifs, whose two sides are computed
// in all lanes and chosen from.
#include <algorithm>
#include <numeric>

#include "shader/passes/passes.h"

namespace lapilli {
namespace {

constexpr uint32_t kMostCost = 16;  // of both sides, in the unit of ops.def: about what the branches cost
constexpr int kMostRounds = 4;      // ifs in ifs

class Flattener {
 public:
  explicit Flattener(Code& code) : code_(code) {}

  // False: nothing was found.
  bool run() {
    count();
    std::vector<uint32_t> moved(code_.instructions.size() + 1);
    const size_t size = code_.instructions.size();
    for (uint32_t at = 0; at < size;) {
      const uint32_t first = at, place = static_cast<uint32_t>(out_.size());
      if (!straight(at) && !if_else(at)) out_.push_back(code_.instructions[at++]);
      std::fill(moved.begin() + first, moved.begin() + at, place);
    }
    const bool found = out_.size() != size;
    moved[size] = static_cast<uint32_t>(out_.size());
    for (uint32_t& position : code_.labels) {
      if (position != kNoLabelPosition) position = moved[place_of(position)];
    }
    code_.instructions = std::move(out_);
    return found;
  }

 private:
  // One side of an if: between its `enter` and the branch to what follows both.
  struct Side {
    uint32_t first, end;
    bool yes;  // of the lanes where the condition holds
  };
  // A value that a side gives to a variable.
  struct Assignment {
    Reg variable, value;
  };

  void count() {
    mask_uses_.assign(code_.mask_count, 0);
    label_uses_.assign(code_.labels.size(), 0);
    labels_at_.assign(code_.instructions.size() + 1, 0);
    skipped_to_.resize(code_.instructions.size() + 1);
    std::iota(skipped_to_.begin(), skipped_to_.end(), 0u);
    for (uint32_t position : code_.labels) {
      if (position != kNoLabelPosition) ++labels_at_[position];
    }
    for (const Instruction& instruction : code_.instructions) {
      const ImmRoles roles = imm_roles(instruction.op);
      if (roles.imm == ImmRole::mask) ++mask_uses_[instruction.imm];
      if (roles.imm2 == ImmRole::mask) ++mask_uses_[instruction.imm2];
      if (roles.imm == ImmRole::forward) ++label_uses_[instruction.imm];
      if (roles.imm2 == ImmRole::forward || roles.imm2 == ImmRole::backward) ++label_uses_[instruction.imm2];
    }
    out_.reserve(code_.instructions.size());
  }

  bool is(uint32_t at, Opcode op) const { return at < code_.instructions.size() && code_.instructions[at].op == op; }
  bool is(uint32_t at, Opcode op, uint32_t mask) const { return is(at, op) && code_.instructions[at].imm == mask; }
  uint32_t end_of(const Instruction& enter) { return place_of(code_.labels[enter.imm2]); }
  // Where those go on who jump to `position`.
  uint32_t place_of(uint32_t position) {
    while (skipped_to_[position] != position) position = skipped_to_[position] = skipped_to_[skipped_to_[position]];
    return position;
  }

  // A branch to what comes next, and to which nothing else leads. Who skipped the block before skips this one too.
  bool straight(uint32_t& at) {
    if (!is(at, Opcode::branch)) return false;
    const Instruction& enter = code_.instructions[at + 1];
    if (!is(at + 1, Opcode::enter, code_.instructions[at].imm) || mask_uses_[enter.imm] != 2 || labels_at_[at] != 0)
      return false;
    skip(at + 1, enter);
    at += 2;
    return true;
  }

  // Who jumped to `place`, finding no lanes there, goes where `enter` would have sent them on.
  void skip(uint32_t place, const Instruction& enter) {
    const uint32_t behind = end_of(enter);
    leave_label(enter.imm2);
    labels_at_[behind] += labels_at_[place];
    skipped_to_[place] = behind;
  }

  void leave_label(uint32_t label) {
    if (--label_uses_[label] != 0) return;
    --labels_at_[place_of(code_.labels[label])];
    code_.labels[label] = kNoLabelPosition;
  }

  // Reads the side that mask `mask` enters at `at`, up to its branch. False: it is none that may run in all lanes.
  bool read_side(uint32_t at, uint32_t mask, Side& side, uint32_t& cost) const {
    if (!is(at, Opcode::enter, mask) || mask_uses_[mask] != 2) return false;
    for (side.first = side.end = at + 1; !is(side.end, Opcode::branch); ++side.end) {
      const Instruction& instruction = code_.instructions[side.end];
      const bool sets = instruction.op == Opcode::set && code_.registers[instruction.dst].array == kNoReg;
      const bool computes = is_pure(instruction) && (op_info(instruction.op).effects & kCrossLane) == 0 &&
                            code_.registers[instruction.dst].kind == RegKind::value;
      cost += op_info(instruction.op).cost;
      if ((!sets && !computes) || cost > kMostCost || labels_at_[side.end] != 0) return false;
    }
    return labels_at_[side.end] == 0;
  }

  bool if_else(uint32_t& at) {
    if (!is(at, Opcode::branch_if)) return false;
    const Instruction branch = code_.instructions[at];
    if (code_.registers[branch.a].kind == RegKind::variable || !is(at + 1, Opcode::enter)) return false;
    Side one = {}, other = {};
    uint32_t cost = 0;
    one.yes = code_.instructions[at + 1].imm == branch.imm;
    other.yes = !one.yes;
    const uint32_t one_mask = one.yes ? branch.imm : branch.imm2, other_mask = one.yes ? branch.imm2 : branch.imm;
    if (!read_side(at + 1, one_mask, one, cost)) return false;
    const uint32_t merge = code_.instructions[one.end].imm;
    uint32_t behind = one.end + 1;  // the `enter` after both
    if (!is_end_of(at + 1, behind)) return false;
    if (merge != other_mask) {
      if (!read_side(behind, other_mask, other, cost) || code_.instructions[other.end].imm != merge) return false;
      if (!is_end_of(behind, other.end + 1)) return false;
      behind = other.end + 1;
    }
    if (!is(behind, Opcode::enter, merge) || mask_uses_[merge] != 3) return false;
    choose(branch.a, one, other);
    leave_label(code_.instructions[at + 1].imm2);
    if (merge != other_mask) leave_label(code_.instructions[one.end + 1].imm2);
    skip(at + 1, code_.instructions[behind]);
    at = behind + 1;
    return true;
  }

  // Whether the `enter` jumps to `place`, and nobody else does.
  bool is_end_of(uint32_t enter, uint32_t place) {
    return end_of(code_.instructions[enter]) == place && labels_at_[place] == 1 &&
           label_uses_[code_.instructions[enter].imm2] == 1;
  }

  // Both sides one after the other. What the first one assigns waits for the second one's value where it can.
  void choose(Reg condition, const Side& one, const Side& other) {
    std::vector<Assignment> waiting;
    for (uint32_t i = one.first; i < one.end; ++i) {
      const Instruction& instruction = code_.instructions[i];
      if (instruction.op == Opcode::set && may_wait(i, one, other)) {
        waiting.push_back({instruction.dst, instruction.a});
      } else {
        append(instruction, condition, one.yes, instruction.dst);
      }
    }
    for (uint32_t i = other.first; i < other.end; ++i) {
      const Instruction& instruction = code_.instructions[i];
      const auto first = std::find_if(waiting.begin(), waiting.end(),
                                      [&](const Assignment& each) { return each.variable == instruction.dst; });
      if (instruction.op == Opcode::set && first != waiting.end()) {
        append(instruction, condition, other.yes, first->value);
        waiting.erase(first);
      } else {
        append(instruction, condition, other.yes, instruction.dst);
      }
    }
    for (const Assignment& each : waiting) {
      Instruction set = {.op = Opcode::set, .results = 1, .dst = each.variable, .a = each.value};
      append(set, condition, one.yes, each.variable);
    }
  }

  // The variable has its old value in all that follows, and what it is set to stays what it is.
  bool may_wait(uint32_t at, const Side& one, const Side& other) const {
    const Instruction& set = code_.instructions[at];
    if (code_.registers[set.a].kind == RegKind::variable) return false;
    const auto names = [&](uint32_t i) {
      const Instruction& each = code_.instructions[i];
      return each.a == set.dst || each.b == set.dst || each.c == set.dst;
    };
    for (uint32_t i = at + 1; i < one.end; ++i) {
      if (names(i) || code_.instructions[i].dst == set.dst) return false;
    }
    for (uint32_t i = other.first; i < other.end; ++i) {
      if (names(i)) return false;
    }
    return true;
  }

  // An instruction of one side; a `set` takes `otherwise` in the other side's lanes.
  void append(const Instruction& instruction, Reg condition, bool yes, Reg otherwise) {
    if (instruction.op != Opcode::set) return out_.push_back(instruction);
    Instruction select = instruction, set = instruction;
    select.op = Opcode::select;
    select.dst = code_.new_value();
    select.a = condition;
    select.b = yes ? instruction.a : otherwise;
    select.c = yes ? otherwise : instruction.a;
    set.a = select.dst;
    out_.push_back(select);
    out_.push_back(set);
  }

  Code& code_;
  std::vector<Instruction> out_;
  std::vector<uint32_t> mask_uses_, label_uses_;
  std::vector<uint32_t> labels_at_;   // by instruction, as is
  std::vector<uint32_t> skipped_to_;  // another one where who jumps here goes on; itself if there is none
};

}  // namespace

void flatten(Code& code) {
  for (int round = 0; round < kMostRounds && code.mask_count != 0 && Flattener(code).run(); ++round) {
  }
}

}  // namespace lapilli
