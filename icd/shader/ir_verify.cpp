// Checks what the passes and the interpreter rely on. The first defect found is described; an empty string means none.
#include <array>

#include "shader/batch.h"
#include "shader/fixed_function.h"
#include "shader/ir.h"
#include "shader/resources.h"

namespace lapilli {
namespace {

constexpr uint32_t kMaxResults = 16;
constexpr uint32_t kNoLoop = 0xFFFFFFFF;

struct Loop {
  uint32_t header = 0;
  uint32_t last = 0;  // the instruction `loop`
  uint32_t parent = 0;
};

// Columns of ops.def: bit 0 to 2 for a, b, c.
struct Operands {
  uint8_t required = 0, allowed = 0;
  bool list = false;
};
constexpr auto kOperands = [] {
  std::array<Operands, static_cast<size_t>(Opcode::kCount)> all{};
  for (size_t op = 0; op < all.size(); ++op) {
    for (const char* letter = kOps[op].operands; *letter != 0; ++letter) {
      const bool optional = *letter >= 'A' && *letter <= 'C';
      if (*letter == 'l') {
        all[op].list = true;
        continue;
      }
      const uint8_t bit = static_cast<uint8_t>(1 << (*letter - (optional ? 'A' : 'a')));
      all[op].allowed = static_cast<uint8_t>(all[op].allowed | bit);
      if (!optional) all[op].required = static_cast<uint8_t>(all[op].required | bit);
    }
  }
  return all;
}();

class Verifier {
 public:
  explicit Verifier(const Code& code) : code_(code) {}

  std::string run() {
    if (!check_tables() || !find_loops()) return error_;
    definition_.assign(code_.registers.size(), kUndefined);
    for (const Instruction& instruction : code_.once) {
      if (!check_once(instruction)) return error_;
    }
    for (at_ = 0; at_ < size(); ++at_) {
      if (!check_instruction(code_.instructions[at_])) return error_;
    }
    return error_;
  }

 private:
  static constexpr uint32_t kUndefined = 0xFFFFFFFF;

  uint32_t size() const { return static_cast<uint32_t>(code_.instructions.size()); }

  bool fail(const std::string& what) {
    error_ = what;
    return false;
  }
  bool fail_here(const std::string& what) {
    return fail("instruction " + std::to_string(at_) + " (" + op_info(code_.instructions[at_].op).name + "): " + what);
  }

  bool check_tables() {
    if (code_.invocations() == 0 || code_.invocations() > kMaxWorkgroupInvocations ||
        code_.shared_bytes > kMaxSharedBytes)
      return fail("a workgroup of an impossible size");
    for (const ResourceRef& ref : code_.resources) {
      if (ref.set == kSharedMemory && uint64_t{ref.first} + ref.count > code_.shared_bytes)
        return fail("a resource is outside the shared memory");
    }
    for (Reg reg : code_.kept) {
      if (reg >= code_.registers.size()) return fail("keeps what is no register");
    }
    for (const Instruction& instruction : code_.instructions) {
      if (instruction.op >= Opcode::kCount) return fail("an instruction has no opcode");
    }
    if (size() == 0 || code_.instructions.back().op != Opcode::end) return fail("the last instruction is not end");
    for (size_t label = 0; label < code_.labels.size(); ++label) {
      if (code_.labels[label] == kNoLabelPosition) continue;  // an error only where it is used
      if (code_.labels[label] >= size()) return fail("label " + std::to_string(label) + " is outside the program");
    }
    for (size_t i = 0; i < code_.arrays.size(); ++i) {
      const RegArray& array = code_.arrays[i];
      const uint64_t end = uint64_t{array.first} + array.count;
      if (array.count == 0 || end > code_.registers.size())
        return fail("array " + std::to_string(i) + " is outside the registers");
      for (Reg reg = array.first; reg < end; ++reg) {
        if (code_.registers[reg].array != i || code_.registers[reg].kind != RegKind::variable) {
          return fail("array " + std::to_string(i) + " contains a register that is not its own");
        }
      }
    }
    return true;
  }

  // innermost_[i]: index of the innermost loop around instruction i. Loops must nest.
  bool find_loops() {
    innermost_.assign(size(), kNoLoop);
    for (at_ = 0; at_ < size(); ++at_) {
      const Instruction& instruction = code_.instructions[at_];
      if (instruction.op != Opcode::loop) continue;
      if (instruction.imm2 >= code_.labels.size() || code_.labels[instruction.imm2] > at_)
        return fail_here("no label further up");
      const uint32_t header = code_.labels[instruction.imm2];
      const Instruction& enter = code_.instructions[header];
      if (enter.op != Opcode::enter || enter.imm != instruction.imm)
        return fail_here("the header does not enter its mask");
      loops_.push_back({header, at_, kNoLoop});
    }
    // In order of their ends inner loops come first. `done`: those that have no parent yet, one behind the other.
    std::vector<uint32_t> done;
    for (uint32_t loop = 0; loop < loops_.size(); ++loop) {
      const Loop& outer = loops_[loop];
      uint32_t end = outer.last + 1;  // what lies behind has its loop
      for (; !done.empty() && loops_[done.back()].header >= outer.header; done.pop_back()) {
        Loop& inner = loops_[done.back()];
        inner.parent = loop;
        std::fill(innermost_.begin() + inner.last + 1, innermost_.begin() + end, loop);
        end = inner.header;
      }
      if (!done.empty() && loops_[done.back()].last >= outer.header) return fail("loops overlap");
      std::fill(innermost_.begin() + outer.header, innermost_.begin() + end, loop);
      done.push_back(loop);
    }
    return true;
  }

  // What runs once per draw: no lanes, no effects, nothing but uniforms.
  bool check_once(const Instruction& instruction) {
    constexpr uint32_t kEffects = kWritesMemory | kControl | kMasked | kCrossLane;
    if (instruction.op >= Opcode::kCount) return fail("an instruction has no opcode");
    const std::string name = std::string("once: ") + op_info(instruction.op).name;
    if ((op_info(instruction.op).effects & kEffects) != 0 || instruction.list_count != 0)
      return fail(name + " cannot run on scalars");
    for (Reg reg : {instruction.a, instruction.b, instruction.c}) {
      if (reg == kNoReg) continue;
      const bool known = reg < code_.registers.size() &&
                         (code_.registers[reg].kind == RegKind::constant ||
                          (code_.registers[reg].kind == RegKind::uniform && definition_[reg] != kUndefined));
      if (!known) return fail(name + ": an operand is not uniform");
    }
    const uint64_t end = uint64_t{instruction.dst} + instruction.results;
    if (instruction.results == 0 || end > code_.registers.size()) return fail(name + ": the result is no register");
    for (Reg reg = instruction.dst; reg < end; ++reg) {
      if (code_.registers[reg].kind != RegKind::uniform || definition_[reg] != kUndefined)
        return fail(name + ": the result is no new uniform");
      definition_[reg] = 0;
    }
    const ImmRoles roles = imm_roles(instruction.op);
    if (roles.imm == ImmRole::resource && instruction.imm >= code_.resources.size())
      return fail(name + ": no such resource");
    return true;
  }

  bool check_instruction(const Instruction& instruction) {
    const OpInfo& info = op_info(instruction.op);
    if (instruction.op == Opcode::end && at_ + 1 != size()) return fail_here("not the last instruction");
    if (info.results >= 0 && instruction.results != info.results) return fail_here("wrong number of results");
    if (info.results < 0 && (instruction.results == 0 || instruction.results > kMaxResults)) {
      return fail_here("wrong number of results");
    }
    const Operands& operands = kOperands[static_cast<size_t>(instruction.op)];
    const ImmRoles roles = imm_roles(instruction.op);
    return check_operand(operands, 0, instruction.a) && check_operand(operands, 1, instruction.b) &&
           check_operand(operands, 2, instruction.c) && check_list(operands.list, instruction) &&
           check_imm(roles.imm, instruction.imm) && check_imm(roles.imm2, instruction.imm2) &&
           check_special(instruction) && check_results(instruction);
  }

  bool check_operand(const Operands& operands, int number, Reg reg) {
    const char letter = static_cast<char>('a' + number);
    if (reg == kNoReg) return (operands.required >> number & 1) != 0 ? fail_operand(letter, "is missing") : true;
    const bool allowed = (operands.allowed >> number & 1) != 0;
    return allowed ? check_use(letter, reg) : fail_operand(letter, "is not used by this op");
  }

  // `which`: a, b, c, or a digit for the place in the operand list.
  bool fail_operand(char which, const char* what) {
    const bool listed = which >= '0' && which <= '9';
    return fail_here((listed ? "list operand " : "operand ") + std::string(1, which) + ' ' + what);
  }

  bool check_use(char which, Reg reg) {
    if (reg >= code_.registers.size()) return fail_operand(which, "is no register");
    if (code_.registers[reg].kind == RegKind::uniform && definition_[reg] == kUndefined)
      return fail_operand(which, "is a uniform that nothing computes");
    if (code_.registers[reg].kind != RegKind::value) return true;
    if (definition_[reg] == kUndefined) return fail_operand(which, "is used before its definition");
    // Lanes that left the loop earlier would see what later iterations computed.
    const uint32_t loop = innermost_[definition_[reg]];
    if (loop == kNoLoop || at_ <= loops_[loop].last) return true;
    return fail_operand(which, "was defined in a loop that has ended; it needs a masked copy");
  }

  bool check_list(bool has_list, const Instruction& instruction) {
    if (!has_list) return instruction.list_count == 0 ? true : fail_here("takes no operand list");
    if (uint64_t{instruction.list_first} + instruction.list_count > code_.operand_list.size()) {
      return fail_here("list outside the operand list");
    }
    if (instruction.op == Opcode::atomic) return check_atomic(instruction, 2);
    if (instruction.op == Opcode::atomic_2d && !check_atomic(instruction, 4)) return false;
    const bool color = writes_color(instruction.op);
    const ImageList image = image_list(instruction.op);
    const uint32_t count = color ? 4 : image.count;
    if (instruction.list_count != count) return fail_here("wrong length of the operand list");
    for (uint32_t i = 0; i < count; ++i) {
      const Reg reg = code_.operand_list[instruction.list_first + i];
      const bool optional = color ? (instruction.imm2 >> i & 1) == 0 : i < 2 || i >= 2 + image.required;
      const char which = static_cast<char>('0' + i);
      if (reg == kNoReg && !optional) return fail_operand(which, "is missing");
      if (reg != kNoReg && !check_use(which, reg)) return false;
    }
    return true;
  }

  // The list of `atomic`: address, descriptor; of `atomic_2d`: two descriptors, x, y; of both: value, comparator.
  bool check_atomic(const Instruction& instruction, uint32_t value) {
    if (instruction.list_count != value + 2) return fail_here("wrong length of the operand list");
    if (instruction.imm2 >= static_cast<uint32_t>(AtomicOp::kCount)) return fail_here("unknown atomic operation");
    const auto op = static_cast<AtomicOp>(instruction.imm2);
    for (uint32_t i = 0; i < instruction.list_count; ++i) {
      const bool needed = i == value       ? op != AtomicOp::load
                          : i == value + 1 ? op == AtomicOp::compare_exchange
                                           : value == 2 && i == 0;
      const Reg reg = code_.operand_list[instruction.list_first + i];
      const char which = static_cast<char>('0' + i);
      if (reg == kNoReg && needed) return fail_operand(which, "is missing");
      if (reg != kNoReg && !check_use(which, reg)) return false;
    }
    return true;
  }

  bool check_imm(ImmRole role, uint32_t imm) {
    switch (role) {
      case ImmRole::none:
        return imm == 0 ? true : fail_here("has an immediate that is not used");
      case ImmRole::mask:
        return check_below(imm, code_.mask_count, "mask register");
      case ImmRole::array:
        return check_below(imm, code_.arrays.size(), "array");
      case ImmRole::resource:
        return check_below(imm, code_.resources.size(), "resource");
      case ImmRole::attribute:
        return check_below(imm, code_.attributes.size(), "attribute");
      case ImmRole::color:
        return check_below(imm, code_.color_formats.size(), "colour attachment");
      case ImmRole::built_in:
        return check_below(imm, static_cast<size_t>(BuiltIn::kCount), "built-in");
      case ImmRole::slot:
        return check_below(imm, code_.output_slots, "output slot");
      case ImmRole::varying:
        return check_below(imm, kMaxVaryingComponents, "varying");
      case ImmRole::forward:
        return check_forward(imm);
      case ImmRole::backward:  // find_loops()
      case ImmRole::bytes:
      case ImmRole::number:
        return true;
    }
    return true;
  }

  bool check_below(uint32_t imm, size_t limit, const char* what) {
    return imm < limit ? true : fail_here(std::string("no such ") + what);
  }

  // A jump may not enter a loop but at its header, nor leave one past the end that takes lanes back.
  bool check_forward(uint32_t label) {
    if (label >= code_.labels.size() || code_.labels[label] == kNoLabelPosition) return fail_here("no such label");
    const uint32_t target = code_.labels[label];
    if (target <= at_) return fail_here("the label is not further down");
    uint32_t to = innermost_[target];
    while (to != kNoLoop && loops_[to].header == target) to = loops_[to].parent;
    if (to != kNoLoop && at_ < loops_[to].header) return fail_here("jumps into a loop");
    // The header of a loop is entered with an empty mask only if no lane came: nobody can be waiting at its end.
    uint32_t from = innermost_[at_];
    while (from != kNoLoop && loops_[from].header == at_) from = loops_[from].parent;
    if (from != kNoLoop && target > loops_[from].last) return fail_here("jumps out of a loop");
    return true;
  }

  bool check_special(const Instruction& instruction) {
    switch (instruction.op) {
      case Opcode::load_push:
      case Opcode::load_push_indexed:
        return instruction.imm2 % 4 == 0 && instruction.imm2 < kMaxPushConstantBytes
                   ? true
                   : fail_here("offset outside the push constants");
      case Opcode::fetch:
        return instruction.results <= 4 ? true : fail_here("wrong number of results");
      case Opcode::interpolate:
      case Opcode::interpolate_perspective:
      case Opcode::interpolate_flat:
        return instruction.imm + instruction.results <= kMaxVaryingComponents ? true : fail_here("no such varying");
      case Opcode::depth_test:
        return instruction.imm < 16 ? true : fail_here("unknown depth flags");
      case Opcode::blend_color:
        return is_blend_word(instruction.imm2) ? true : fail_here("unknown blend equation");
      case Opcode::store_color:
        return instruction.imm2 < 16 ? true : fail_here("unknown colour component");
      default:
        return true;
    }
  }

  bool check_results(const Instruction& instruction) {
    if (instruction.results == 0)
      return instruction.dst == kNoReg ? true : fail_here("has a destination but no result");
    if (uint64_t{instruction.dst} + instruction.results > code_.registers.size())
      return fail_here("the result is no register");
    for (Reg reg = instruction.dst; reg < instruction.dst + instruction.results; ++reg) {
      const RegKind kind = code_.registers[reg].kind;
      if (kind == RegKind::constant || kind == RegKind::uniform) return fail_here("writes a constant");
      if (kind == RegKind::variable && instruction.results > 1) return fail_here("writes several variables");
      if (kind == RegKind::value) {
        if (instruction.op == Opcode::set) return fail_here("sets a register that is no variable");
        if (definition_[reg] != kUndefined) return fail_here("writes a value a second time");
        definition_[reg] = at_;
      }
    }
    return true;
  }

  const Code& code_;
  std::string error_;
  uint32_t at_ = 0;
  std::vector<Loop> loops_;  // by their ends
  std::vector<uint32_t> innermost_;
  std::vector<uint32_t> definition_;  // instruction that defines a value
};

}  // namespace

std::string verify(const Code& code) { return Verifier(code).run(); }

}  // namespace lapilli
