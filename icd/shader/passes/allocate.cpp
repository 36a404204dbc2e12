// Register allocation: linear scan over the live intervals. Registers that have to be consecutive are given out
// together.
#include <algorithm>
#include <bit>

#include "shader/interpreter/op.h"
#include "shader/passes/passes.h"

namespace lapilli {
namespace {

constexpr uint32_t kNone = 0xFFFFFFFF;

// Physical registers that are free, lowest first.
class FreeRegisters {
 public:
  uint32_t take(uint32_t count) {
    const uint32_t first = count == 1 ? find_one() : find_run(count);
    while (first + count > 64 * words_.size()) words_.push_back(~uint64_t{0});
    for (uint32_t i = first; i < first + count; ++i) words_[i / 64] &= ~(uint64_t{1} << (i % 64));
    highest_ = std::max(highest_, first + count);
    return first;
  }
  void give_back(uint32_t reg) {
    words_[reg / 64] |= uint64_t{1} << (reg % 64);
    hint_ = std::min<size_t>(hint_, reg / 64);
  }
  uint32_t highest() const { return highest_; }

 private:
  uint32_t find_one() {
    while (hint_ < words_.size() && words_[hint_] == 0) ++hint_;
    const uint32_t base = static_cast<uint32_t>(64 * hint_);
    return hint_ == words_.size() ? base : base + static_cast<uint32_t>(std::countr_zero(words_[hint_]));
  }
  // Word by word: there may be tens of thousands, and every other one taken.
  uint32_t find_run(uint32_t count) const {
    uint32_t run = 0;  // free ones before the word
    for (size_t i = hint_; i < words_.size(); ++i) {
      const uint64_t word = words_[i];
      const uint32_t base = static_cast<uint32_t>(64 * i), lowest = static_cast<uint32_t>(std::countr_one(word));
      if (run + lowest >= count) return base - run;
      if (lowest == 64) {
        run += 64;
        continue;
      }
      uint64_t starts = count <= 64 ? word : 0;  // of runs of `length` within the word
      for (uint32_t length = 1; length < count && starts != 0;) {
        const uint32_t more = std::min(length, count - length);
        starts &= starts >> more;
        length += more;
      }
      if (starts != 0) return base + static_cast<uint32_t>(std::countr_zero(starts));
      run = static_cast<uint32_t>(std::countl_one(word));
    }
    return static_cast<uint32_t>(64 * words_.size()) - run;
  }

  std::vector<uint64_t> words_;  // 1: free
  size_t hint_ = 0;              // all words before it are 0
  uint32_t highest_ = 0;
};

class Allocator {
 public:
  Allocator(const Code& code, const FormChoice& choice)
      : code_(code), choice_(choice), intervals_(live_intervals(code)), physical_(code.registers.size(), kNone) {}

  Allocation run() {
    for (Reg reg = 0; reg < code_.registers.size(); ++reg) {
      if (is_fixed(reg) && choice_.in_memory[reg] != 0) physical_[reg] = free_.take(1);
    }
    sort_intervals();
    for (uint32_t i = 0; i < code_.instructions.size() && free_.highest() <= kMaxRegisters; ++i) {
      // Pure ops read an element of their operands before they write that of the result: these may share a register.
      const bool shares = is_pure(code_.instructions[i]);
      if (shares) end_intervals(i);
      begin_intervals(i);
      if (!shares) end_intervals(i);
    }
    Allocation allocation;
    allocation.count = free_.highest();
    allocation.physical.resize(physical_.size());
    for (size_t reg = 0; reg < physical_.size(); ++reg) {
      allocation.physical[reg] = physical_[reg] == kNone ? kNoOperand : static_cast<uint16_t>(physical_[reg]);
    }
    return allocation;
  }

 private:
  // Holds its value for the whole program.
  bool is_fixed(Reg reg) const {
    return code_.registers[reg].kind == RegKind::constant || code_.registers[reg].kind == RegKind::uniform;
  }
  bool is_placed(Reg reg) const {
    return choice_.in_memory[reg] != 0 && !is_fixed(reg) && intervals_[reg].first != Interval::kNever;
  }

  // Registers by the instruction at which their interval begins and ends.
  void sort_intervals() {
    const size_t count = code_.instructions.size();
    begins_.assign(count + 1, 0);
    ends_.assign(count + 1, 0);
    for (Reg reg = 0; reg < code_.registers.size(); ++reg) {
      if (!is_placed(reg)) continue;
      ++begins_[intervals_[reg].first + 1];
      ++ends_[intervals_[reg].last + 1];
    }
    for (size_t i = 0; i < count; ++i) {
      begins_[i + 1] += begins_[i];
      ends_[i + 1] += ends_[i];
    }
    beginning_.resize(begins_[count]);
    ending_.resize(ends_[count]);
    std::vector<uint32_t> next_begin(begins_.begin(), begins_.end());
    std::vector<uint32_t> next_end(ends_.begin(), ends_.end());
    for (Reg reg = 0; reg < code_.registers.size(); ++reg) {
      if (!is_placed(reg)) continue;
      beginning_[next_begin[intervals_[reg].first]++] = reg;
      ending_[next_end[intervals_[reg].last]++] = reg;
    }
  }

  void begin_intervals(uint32_t i) {
    const Instruction& instruction = code_.instructions[i];
    const uint32_t results = instruction.results;
    // The results of one instruction; where they are variables, their interval may have begun before.
    if (results > 1 && physical_[instruction.dst] == kNone) take(instruction.dst, results);
    for (uint32_t k = begins_[i]; k < begins_[i + 1]; ++k) {
      const Reg reg = beginning_[k];
      if (physical_[reg] != kNone) continue;
      const uint32_t array = code_.registers[reg].array;
      if (array != kNoReg) {
        take(code_.arrays[array].first, code_.arrays[array].count);
      } else {
        take(reg, 1);
      }
    }
  }

  void take(Reg first, uint32_t count) {
    const uint32_t place = free_.take(count);
    for (uint32_t k = 0; k < count; ++k) physical_[first + k] = place + k;
  }

  void end_intervals(uint32_t i) {
    for (uint32_t k = ends_[i]; k < ends_[i + 1]; ++k) {
      // A value that ends where it begins is given back after it has been taken.
      if (physical_[ending_[k]] != kNone) free_.give_back(physical_[ending_[k]]);
    }
  }

  const Code& code_;
  const FormChoice& choice_;
  const std::vector<Interval> intervals_;
  std::vector<uint32_t> physical_;
  FreeRegisters free_;
  std::vector<uint32_t> begins_, ends_;  // by instruction: first place in beginning_, ending_
  std::vector<Reg> beginning_, ending_;
};

}  // namespace

Allocation allocate_registers(const Code& code, const FormChoice& choice) { return Allocator(code, choice).run(); }

}  // namespace lapilli
