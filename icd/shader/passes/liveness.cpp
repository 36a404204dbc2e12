// Live intervals in linear order, extended over loops.
//
// A value lives from its definition to its last use; if that use is in a loop that the definition is outside of, to the
// end of the loop, because the next iteration reads it again. A variable lives in all of the outermost loop that
// touches it: lanes that are not executing keep what they have.
#include <algorithm>

#include "shader/passes/passes.h"

namespace lapilli {
namespace {

constexpr uint32_t kNoLoop = 0xFFFFFFFF;

struct Loop {
  uint32_t header;
  uint32_t last;
  uint32_t parent;
};

class Liveness {
 public:
  explicit Liveness(const Code& code) : code_(code), intervals_(code.registers.size()) {}

  std::vector<Interval> run() {
    find_loops();
    for (uint32_t i = 0; i < code_.instructions.size(); ++i) {
      const Instruction& instruction = code_.instructions[i];
      for_each_operand(code_, instruction, [&](Reg reg) { touch(reg, i); });
      for (uint32_t k = 0; k < instruction.results; ++k) touch(instruction.dst + k, i);
      if (instruction.op == Opcode::load_array || instruction.op == Opcode::store_array) {
        touch(code_.arrays[instruction.imm].first, i);
      }
    }
    for (const RegArray& array : code_.arrays) join(array);
    return std::move(intervals_);
  }

 private:
  void find_loops() {
    innermost_.assign(code_.instructions.size(), kNoLoop);
    // Ends of loops in order are inner loops first; from the back, outer ones first.
    for (uint32_t i = static_cast<uint32_t>(code_.instructions.size()); i-- > 0;) {
      if (code_.instructions[i].op != Opcode::loop) continue;
      const uint32_t header = code_.labels[code_.instructions[i].imm2];
      loops_.push_back({header, i, kNoLoop});
    }
    std::vector<uint32_t> open;
    size_t next = loops_.size();  // loops by header, see below
    std::vector<uint32_t> by_header(loops_.size());
    for (uint32_t k = 0; k < by_header.size(); ++k) by_header[k] = k;
    std::sort(by_header.begin(), by_header.end(), [this](uint32_t x, uint32_t y) {
      if (loops_[x].header != loops_[y].header) return loops_[x].header < loops_[y].header;
      return loops_[x].last > loops_[y].last;
    });
    next = 0;
    for (uint32_t i = 0; i < code_.instructions.size(); ++i) {
      while (!open.empty() && loops_[open.back()].last < i) open.pop_back();
      for (; next < by_header.size() && loops_[by_header[next]].header == i; ++next) {
        loops_[by_header[next]].parent = open.empty() ? kNoLoop : open.back();
        open.push_back(by_header[next]);
      }
      innermost_[i] = open.empty() ? kNoLoop : open.back();
    }
  }

  void touch(Reg reg, uint32_t i) {
    const RegKind kind = code_.registers[reg].kind;
    if (kind == RegKind::constant || kind == RegKind::uniform) return;
    Interval& interval = intervals_[reg];
    uint32_t first = i;
    uint32_t last = i;
    for (uint32_t loop = innermost_[i]; loop != kNoLoop; loop = loops_[loop].parent) {
      // The definition of a value was seen before its uses.
      const bool inside = interval.first == Interval::kNever || interval.first >= loops_[loop].header;
      if (kind == RegKind::value && inside) break;
      if (kind == RegKind::variable) first = loops_[loop].header;
      last = loops_[loop].last;
    }
    interval.first = std::min(interval.first, first);
    interval.last = std::max(interval.last, last);
  }

  void join(const RegArray& array) {
    Interval all;
    for (Reg reg = array.first; reg < array.first + array.count; ++reg) {
      if (intervals_[reg].first == Interval::kNever) continue;
      all.first = std::min(all.first, intervals_[reg].first);
      all.last = std::max(all.last, intervals_[reg].last);
    }
    std::fill_n(intervals_.begin() + array.first, array.count, all);
  }

  const Code& code_;
  std::vector<Interval> intervals_;
  std::vector<Loop> loops_;
  std::vector<uint32_t> innermost_;
};

}  // namespace

std::vector<Interval> live_intervals(const Code& code) { return Liveness(code).run(); }

}  // namespace lapilli
