#include "shader/passes/evaluate.h"

#include <cstring>

#include "shader/interpreter/op_reference.h"

namespace lapilli {
namespace {

uint32_t word_at(const std::vector<std::byte>& bytes, uint64_t at) {
  uint32_t word = 0;
  if (at + 4 <= bytes.size()) std::memcpy(&word, bytes.data() + at, 4);
  return word;
}

class Evaluator {
 public:
  Evaluator(const Code& code, EvaluationInput& input)
      : code_(code),
        input_(input),
        values_(code.registers.size()),
        outputs_(code.output_slots),
        masks_(code.mask_count) {
    for (size_t reg = 0; reg < values_.size(); ++reg) values_[reg].fill(code.registers[reg].bits);
  }

  std::vector<LaneValues> run(uint64_t limit) {
    exec_ = write_ = input_.lanes;
    for (size_t at = 0; code_.instructions[at].op != Opcode::end;) {
      if (limit-- == 0) return {};
      if (!step(code_.instructions[at], at)) return {};
    }
    return outputs_;
  }

 private:
  uint64_t condition(Reg reg) const {
    uint64_t bits = 0;
    for (size_t lane = 0; lane < 64; ++lane) bits |= uint64_t{values_[reg][lane] != 0} << lane;
    return bits;
  }

  bool step(const Instruction& i, size_t& at) {
    size_t next = at + 1;
    switch (i.op) {
      case Opcode::branch:
        masks_[i.imm] |= exec_;
        break;
      case Opcode::branch_if:
        masks_[i.imm] |= exec_ & condition(i.a);
        masks_[i.imm2] |= exec_ & ~condition(i.a);
        break;
      case Opcode::branch_where:
        masks_[i.imm] |= exec_ & condition(i.a);
        break;
      case Opcode::enter:
        exec_ = masks_[i.imm];
        masks_[i.imm] = 0;
        if (exec_ == 0) next = code_.labels[i.imm2];
        break;
      case Opcode::loop:
        if (masks_[i.imm] != 0) next = code_.labels[i.imm2];
        break;
      case Opcode::jump_if_none:
        if (exec_ == 0) next = code_.labels[i.imm];
        break;
      case Opcode::kill:
        write_ &= ~exec_;
        exec_ = 0;
        break;
      default:
        for (uint32_t lane = 0; lane < 64; ++lane) {
          if (!lane_step(i, lane)) return false;
        }
    }
    at = next;
    return true;
  }

  bool lane_step(const Instruction& i, uint32_t lane) {
    const auto operand = [&](Reg reg) { return reg == kNoReg ? 0 : values_[reg][lane]; };
    const bool active = (exec_ >> lane & 1) != 0;
    const uint32_t a = operand(i.a);
    const uint32_t b = operand(i.b);
    switch (i.op) {
      case Opcode::set:
        if (active) values_[i.dst][lane] = a;
        return true;
      case Opcode::load_array:
        values_[i.dst][lane] = a < code_.arrays[i.imm].count ? values_[code_.arrays[i.imm].first + a][lane] : 0;
        return true;
      case Opcode::store_array:
        if (active && a < code_.arrays[i.imm].count) values_[code_.arrays[i.imm].first + a][lane] = b;
        return true;
      case Opcode::builtin:
        values_[i.dst][lane] = lane;
        return i.imm == static_cast<uint32_t>(BuiltIn::lane_index);
      case Opcode::load_push:
        for (uint32_t k = 0; k < i.results; ++k)
          values_[i.dst + k][lane] = word_at(input_.push_constants, i.imm2 + 4 * k);
        return true;
      case Opcode::load_buffer:
        for (uint32_t k = 0; active && k < i.results; ++k) {
          values_[i.dst + k][lane] = word_at(input_.buffer, uint64_t{a} + i.imm2 + 4 * k);
        }
        return true;
      case Opcode::store_buffer: {
        const uint64_t to = uint64_t{a} + i.imm2;
        if (active && (write_ >> lane & 1) != 0 && to + 4 <= input_.buffer.size())
          std::memcpy(input_.buffer.data() + to, &b, 4);
        return true;
      }
      case Opcode::store_output:
        outputs_[i.imm][lane] = a;
        return true;
      default:
        break;
    }
    const OpReference* const reference = find_reference(i.op);
    if (reference == nullptr || reference->exact == nullptr) return false;
    values_[i.dst][lane] = reference->exact(a, b, operand(i.c));
    return true;
  }

  const Code& code_;
  EvaluationInput& input_;
  std::vector<LaneValues> values_;
  std::vector<LaneValues> outputs_;
  std::vector<uint64_t> masks_;
  uint64_t exec_ = 0;
  uint64_t write_ = 0;
};

}  // namespace

std::vector<LaneValues> evaluate(const Code& code, EvaluationInput& input, uint64_t limit) {
  return Evaluator(code, input).run(limit);
}

}  // namespace lapilli
