// The order of the passes, and what they share.
#include <atomic>
#include <cstdio>

#include "base/removals.h"
#include "shader/passes/passes.h"

namespace lapilli {
namespace {

std::atomic<bool> dumps{false};

void dump(const char* when, const Code& code) {
  if (dumps_passes()) std::fprintf(stderr, "--- %s\n%s", when, disassemble(code).c_str());
}

}  // namespace

bool dumps_passes() { return dumps.load(std::memory_order_relaxed); }
void set_dump_passes(bool on) { dumps.store(on, std::memory_order_relaxed); }

void optimize(Code& code, SimdTarget target) {
  dump("lowered", code);
  flatten(code);
  dump("flatten", code);
  simplify(code, target);
  dump("simplify", code);
  remove_dead_code(code);
  dump("dead code", code);
  if (!keeps(Removal::uniforms)) split_once(code);
  dump("once", code);
  schedule(code);
  dump("schedule", code);
}

bool is_pure(const Instruction& instruction) {
  constexpr uint32_t kImpure = kReadsMemory | kWritesMemory | kControl | kMasked | kBatchInput;
  return instruction.results == 1 && (op_info(instruction.op).effects & kImpure) == 0;
}

size_t hash_of(const Instruction& i) {
  uint64_t h = static_cast<uint64_t>(i.op) + (uint64_t{i.results} << 16);
  for (uint32_t word : {i.a, i.b, i.c, i.imm, i.imm2}) h = (h ^ word) * 0x9E3779B97F4A7C15;
  return static_cast<size_t>(h >> 32);
}

bool computes_the_same(const Instruction& x, const Instruction& y) {
  return x.op == y.op && x.results == y.results && x.a == y.a && x.b == y.b && x.c == y.c && x.imm == y.imm &&
         x.imm2 == y.imm2;
}

std::vector<uint8_t> block_starts(const Code& code) {
  std::vector<uint8_t> starts(code.instructions.size() + 1, 0);
  starts[0] = 1;
  for (uint32_t position : code.labels) {
    if (position != kNoLabelPosition) starts[position] = 1;
  }
  for (size_t i = 0; i < code.instructions.size(); ++i) {
    if ((op_info(code.instructions[i].op).effects & kControl) != 0) starts[i + 1] = 1;
  }
  return starts;
}

void keep_marked(Code& code, const std::vector<uint8_t>& marks) {
  std::vector<uint32_t> moved(code.instructions.size() + 1);
  uint32_t kept = 0;
  for (uint32_t i = 0; i < code.instructions.size(); ++i) {
    moved[i] = kept;
    if (marks[i] != 0) code.instructions[kept++] = code.instructions[i];
  }
  moved[code.instructions.size()] = kept;
  code.instructions.resize(kept);
  for (uint32_t& position : code.labels) {
    if (position != kNoLabelPosition) position = moved[position];
  }
}

}  // namespace lapilli
