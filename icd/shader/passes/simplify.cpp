// One walk over the program that knows, at each place, what registers are known to hold.
#include <optional>

#include "shader/passes/fold.h"
#include "shader/passes/passes.h"

namespace lapilli {
namespace {

constexpr uint32_t kNone = 0xFFFFFFFF;
constexpr uint32_t kEntryBlock = 0;  // it runs before all others, so what it computes holds everywhere
constexpr uint32_t kOne = 0x3F800000, kMinusZero = 0x80000000, kAllOnes = 0xFFFFFFFF;

class Simplifier {
 public:
  Simplifier(Code& code, SimdTarget target)
      : code_(code),
        target_(target),
        values_(code.registers.size()),
        variables_(code.registers.size()),
        keep_(code.instructions.size(), 1) {
    size_t size = 16;
    while (size < 2 * code.instructions.size()) size *= 2;
    table_.assign(size, kNone);
    block_of_.assign(code.instructions.size(), kNone);
    epoch_of_.assign(code.instructions.size(), 0);
  }

  void run() {
    const std::vector<uint8_t> starts = block_starts(code_);
    for (at_ = 0; at_ < code_.instructions.size(); ++at_) {
      if (at_ > 0 && starts[at_] != 0) ++block_;
      Instruction& instruction = code_.instructions[at_];
      for_each_operand(code_, instruction, [this](Reg& reg) { reg = resolve(reg); });
      for_each_operand(code_, instruction, [this](Reg& reg) { variable(reg).last_write = kNone; });
      if (simplify_control(instruction) || simplify_pure(instruction) || reuse(instruction)) {
        keep_[at_] = 0;
        continue;
      }
      note_writes(instruction);
    }
    for (Reg& reg : code_.kept) reg = resolve(reg);
    keep_marked(code_, keep_);
  }

 private:
  // What a value of the program is the same as.
  struct Value {
    Reg same_as = kNoReg;  // a value or a constant
    // A variable, while it is not written again in this block.
    Reg copy_of = kNoReg;
    uint32_t block = kNone;
    uint32_t version = 0;
  };
  struct Variable {
    uint32_t version = 0;         // changes with each write
    uint32_t last_write = kNone;  // instruction in block `block`, if nobody has read it since
    uint32_t block = kNone;
  };

  RegKind kind(Reg reg) const { return code_.registers[reg].kind; }
  bool is_constant(Reg reg) const { return kind(reg) == RegKind::constant; }
  uint32_t bits(Reg reg) const { return code_.registers[reg].bits; }
  bool is_constant(Reg reg, uint32_t value) const { return reg != kNoReg && is_constant(reg) && bits(reg) == value; }
  // Constants that this pass makes lie behind the registers it started with.
  Variable& variable(Reg reg) { return reg < variables_.size() ? variables_[reg] : unused_variable_; }

  Reg resolve(Reg reg) const {
    if (reg >= values_.size() || kind(reg) != RegKind::value) return reg;
    const Value& value = values_[reg];
    if (value.same_as != kNoReg) return value.same_as;
    if (value.copy_of == kNoReg || value.block != block_) return reg;
    return variables_[value.copy_of].version == value.version ? value.copy_of : reg;
  }

  bool simplify_control(Instruction& instruction) {
    if (instruction.op != Opcode::branch_if && instruction.op != Opcode::branch_where) return false;
    if (!is_constant(instruction.a)) return false;
    const bool taken = bits(instruction.a) != 0;
    if (!taken && instruction.op == Opcode::branch_where) return true;
    instruction.op = Opcode::branch;
    if (!taken) instruction.imm = instruction.imm2;
    instruction.imm2 = 0;
    instruction.a = kNoReg;
    return false;
  }

  // True: the instruction is not needed, its result is known.
  bool simplify_pure(Instruction& instruction) {
    if (!is_pure(instruction)) return false;
    std::optional<Reg> known = instruction.op == Opcode::mov ? instruction.a : fold(instruction);
    if (!known) known = simpler(instruction);
    if (!known) return false;
    const bool to_value = kind(instruction.dst) == RegKind::value;
    if (to_value && kind(*known) != RegKind::variable) {
      values_[instruction.dst].same_as = *known;
      return true;
    }
    if (to_value && code_.registers[*known].array == kNoReg) {
      values_[instruction.dst] = {kNoReg, *known, block_, variables_[*known].version};
    }
    instruction.op = Opcode::mov;
    instruction.a = *known;
    instruction.b = instruction.c = kNoReg;
    return false;
  }

  std::optional<Reg> fold(const Instruction& instruction) {
    uint32_t operands[3] = {};
    const Reg regs[3] = {instruction.a, instruction.b, instruction.c};
    for (int i = 0; i < 3; ++i) {
      if (regs[i] == kNoReg) continue;
      if (!is_constant(regs[i])) return {};
      operands[i] = bits(regs[i]);
    }
    if (!folder_) folder_.emplace(target_);
    return code_.constant(folder_->run(instruction.op, operands[0], operands[1], operands[2]));
  }

  // An operand that is the result already, to the bit (a quiet NaN included; signalling ones are not kept apart).
  std::optional<Reg> simpler(const Instruction& instruction) const {
    const Reg a = instruction.a;
    const Reg b = instruction.b;
    switch (instruction.op) {
      case Opcode::select:
        if (is_constant(a)) return bits(a) != 0 ? b : instruction.c;
        if (b == instruction.c) return b;
        return {};
      case Opcode::fmul:
        return neutral(a, b, kOne);
      case Opcode::fadd:
        return neutral(a, b, kMinusZero);
      case Opcode::fsub:
        return is_constant(b, 0) ? std::optional(a) : std::nullopt;
      case Opcode::fdiv:
        return is_constant(b, kOne) ? std::optional(a) : std::nullopt;
      case Opcode::imul:
        return neutral(a, b, 1);
      case Opcode::iadd:
      case Opcode::ior:
      case Opcode::ixor:
        return neutral(a, b, 0);
      case Opcode::iand:
        return neutral(a, b, kAllOnes);
      case Opcode::isub:
      case Opcode::shl:
      case Opcode::shr:
      case Opcode::sar:
        return is_constant(b, 0) ? std::optional(a) : std::nullopt;
      default:
        return {};
    }
  }
  std::optional<Reg> neutral(Reg a, Reg b, uint32_t element) const {
    if (is_constant(b, element)) return a;
    if (is_constant(a, element)) return b;
    return {};
  }

  // True: an earlier instruction of this block or of the entry block has the same results.
  bool reuse(Instruction& instruction) {
    const OpInfo& info = op_info(instruction.op);
    if (instruction.results == 0 || instruction.list_count > 0 || instruction.op == Opcode::load_array) return false;
    if ((info.effects & (kWritesMemory | kControl | kMasked)) != 0 || instruction.op == Opcode::mov) return false;
    for (uint32_t i = 0; i < instruction.results; ++i) {
      if (kind(instruction.dst + i) != RegKind::value) return false;
    }
    bool reads_variable = false;
    for_each_operand(code_, instruction, [&](Reg reg) { reads_variable |= kind(reg) == RegKind::variable; });
    if (reads_variable) return false;
    if ((info.effects & kCommutes) != 0 && instruction.a > instruction.b) std::swap(instruction.a, instruction.b);

    const bool from_memory = (info.effects & kReadsMemory) != 0;
    const size_t mask = table_.size() - 1;
    size_t slot = hash_of(instruction) & mask;
    for (; table_[slot] != kNone; slot = (slot + 1) & mask) {
      const uint32_t other = table_[slot];
      const Instruction& earlier = code_.instructions[other];
      if (!computes_the_same(earlier, instruction)) continue;
      const bool entry = block_of_[other] == kEntryBlock && !from_memory;
      // This one takes its place, so that what many blocks compute is in the table once.
      if ((block_of_[other] != block_ && !entry) || (from_memory && epoch_of_[other] != epoch_)) break;
      for (uint32_t i = 0; i < instruction.results; ++i) values_[instruction.dst + i].same_as = earlier.dst + i;
      return true;
    }
    table_[slot] = at_;
    block_of_[at_] = block_;
    epoch_of_[at_] = epoch_;
    return false;
  }

  void note_writes(const Instruction& instruction) {
    const OpInfo& info = op_info(instruction.op);
    if ((info.effects & kWritesMemory) != 0) ++epoch_;
    const bool masked = (info.effects & kMasked) != 0;
    for (Reg reg = instruction.dst; reg < instruction.dst + instruction.results; ++reg) {
      if (kind(reg) != RegKind::variable) continue;
      Variable& written = variable(reg);
      ++written.version;
      if (instruction.results > 1 || code_.registers[reg].array != kNoReg) continue;
      // Two writes with no read between them; a masked one covers only masked ones.
      const bool known = written.last_write != kNone && written.block == block_;
      if (known && (!masked || code_.instructions[written.last_write].op == Opcode::set)) keep_[written.last_write] = 0;
      written.last_write = at_;
      written.block = block_;
    }
  }

  Code& code_;
  const SimdTarget target_;
  std::vector<Value> values_;
  std::vector<Variable> variables_;
  Variable unused_variable_;
  std::vector<uint8_t> keep_;
  std::vector<uint32_t> table_;  // open addressing: instructions by their hash
  std::vector<uint32_t> block_of_;
  std::vector<uint32_t> epoch_of_;
  std::optional<ConstantFolder> folder_;
  uint32_t at_ = 0;
  uint32_t block_ = kEntryBlock;
  uint32_t epoch_ = 0;  // of memory: counts instructions that write it
};

}  // namespace

void simplify(Code& code, SimdTarget target) { Simplifier(code, target).run(); }

}  // namespace lapilli
