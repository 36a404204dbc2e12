// Lowering: loops with few rounds, whose number is known, are lowered once for each round, so that what depends on the
// counter is folded. The forecast made here need not be right: the loop ends when its test does, and where the
// counter turns out not to be known, or the code gets too long, a loop over masks does the rounds that are left.
#include <algorithm>

#include "shader/spirv/grammar.h"
#include "shader/spirv/lowering.h"

namespace lapilli::spirv {
namespace {

constexpr uint32_t kMostRounds = 8;
constexpr uint32_t kMostLoopWords = 1024;          // SPIR-V of one round
constexpr size_t kMostLoopInstructions = 1024;     // of all rounds
constexpr size_t kMostProgramInstructions = 8192;  // no more unrolling in longer programs
constexpr uint32_t kDontUnroll = 2;                // LoopControl

}  // namespace

// Nothing but the counter's variable goes from round to round or out of the loop by id.
bool Lowering::may_unroll(uint32_t loop) const {
  const SpirvFunction& function = *frame_->function;
  const SpirvBlock& header = function.blocks[function.order[function.loops[loop].header]];
  uint32_t words = 0;
  for (uint32_t position = function.loops[loop].header; position < function.loops[loop].end; ++position) {
    const SpirvBlock& block = function.blocks[function.order[position]];
    words += block.end - block.first;
    if (block.loop != loop || words > kMostLoopWords) return false;
    for (uint32_t word = block.first; word < block.end; word += m_.at(word).count) {
      const SpirvInst inst = m_.at(word);
      if (inst.op == spv::Op::OpPhi && &block == &header) return false;
      if (inst.op == spv::Op::OpLoopMerge && (inst[3] & kDontUnroll) != 0) return false;
      const char* signature = find_spirv_op(static_cast<uint32_t>(inst.op))->signature;
      if (signature[0] == 't' && signature[1] == 'r' && escapes(inst[2])) return false;
    }
  }
  return true;
}

// How often `for (i = a; i < b; i += c)` with constants a, b, c gets to its test; 0 if it is not of this form.
uint32_t Lowering::count_rounds(uint32_t loop, const Known& known) {
  const SpirvFunction& function = *frame_->function;
  const uint32_t end = function.loops[loop].end;
  const SpirvBlock& header = function.blocks[function.order[function.loops[loop].header]];
  const SpirvBlock* test = &header;
  if (header.successors.size() == 1) test = &function.blocks[header.successors[0]];
  const SpirvInst branch = m_.at(test->terminator);
  if (branch.op != spv::Op::OpBranchConditional) return 0;
  const uint32_t yes = function.blocks[function.block_of(branch[2])].position;
  const uint32_t no = function.blocks[function.block_of(branch[3])].position;
  if (yes >= end || no < end) return 0;

  const SpirvInst compare = m_.definition(branch[1]);
  const ComparedIntegers row = compared_integers(compare.op);
  if (row.op == Opcode::kCount) return 0;
  const SpirvInst counter_load = m_.definition(compare[3]);
  const std::vector<uint32_t>* bound = constant_data(compare[4]);
  if (counter_load.op != spv::Op::OpLoad || bound == nullptr || bound->size() != 1) return 0;
  const uint32_t counter = counter_load[3];
  const Value* place = find_value(counter);
  if (place == nullptr || place->shape != Value::Shape::pointer || place->pointer.variable == nullptr) return 0;
  if (place->pointer.variable->count != 1) return 0;
  const Reg reg = place->pointer.variable->first;
  const auto at = std::lower_bound(known.begin(), known.end(), std::pair<Reg, Reg>{reg, 0});
  if (at == known.end() || at->first != reg || !constant_bits(at->second)) return 0;

  uint32_t step = 0;
  const SpirvBlock& last = function.blocks[header.continue_target];
  for (uint32_t word = last.first; word < last.end; word += m_.at(word).count) {
    const SpirvInst store = m_.at(word);
    if (store.op != spv::Op::OpStore || store[1] != counter) continue;
    const SpirvInst add = m_.definition(store[2]);
    if (add.op != spv::Op::OpIAdd && add.op != spv::Op::OpISub) return 0;
    const std::vector<uint32_t>* by = constant_data(add[4]);
    if (by == nullptr || by->size() != 1) return 0;
    step = add.op == spv::Op::OpIAdd ? (*by)[0] : 0 - (*by)[0];
  }
  uint32_t i = *constant_bits(at->second);
  for (uint32_t rounds = 0; rounds <= kMostRounds; ++rounds, i += step) {
    const uint32_t a = row.swapped ? (*bound)[0] : i, b = row.swapped ? i : (*bound)[0];
    if (fold_integers(row.op, a, b) == 0u) return rounds + 1;
  }
  return 0;
}

// Whether the round of a loop that begins with these known values is lowered for itself.
bool Lowering::unrolls(uint32_t index, const Known& known) {
  LoopState& loop = frame_->loops[index];
  const size_t length = code_.instructions.size();
  if (!loop.forecast) {
    loop.forecast = true;
    loop.rounds = length < kMostProgramInstructions && may_unroll(index) ? count_rounds(index, known) : 0;
    loop.rounds_left = loop.rounds;
    loop.first_instruction = length;
  } else if (loop.rounds_left + 1 == loop.rounds &&
             (length - loop.first_instruction) * loop.rounds > kMostLoopInstructions) {
    loop.rounds_left = 0;
  }
  return loop.rounds_left != 0;
}

// What an integer op makes of two constants, for those that counters and their tests are made of.
std::optional<uint32_t> fold_integers(Opcode op, uint32_t a, uint32_t b) {
  const auto mask = [](bool value) { return value ? 0xFFFFFFFFu : 0u; };
  switch (op) {
    case Opcode::iadd:
      return a + b;
    case Opcode::isub:
      return a - b;
    case Opcode::ieq:
      return mask(a == b);
    case Opcode::ine:
      return mask(a != b);
    case Opcode::ult:
      return mask(a < b);
    case Opcode::ule:
      return mask(a <= b);
    case Opcode::slt:
      return mask(static_cast<int32_t>(a) < static_cast<int32_t>(b));
    case Opcode::sle:
      return mask(static_cast<int32_t>(a) <= static_cast<int32_t>(b));
    default:
      return std::nullopt;
  }
}

ComparedIntegers compared_integers(spv::Op op) {
  switch (op) {
    case spv::Op::OpINotEqual:
      return {Opcode::ine, false};
    case spv::Op::OpULessThan:
      return {Opcode::ult, false};
    case spv::Op::OpULessThanEqual:
      return {Opcode::ule, false};
    case spv::Op::OpSLessThan:
      return {Opcode::slt, false};
    case spv::Op::OpSLessThanEqual:
      return {Opcode::sle, false};
    case spv::Op::OpUGreaterThan:
      return {Opcode::ult, true};
    case spv::Op::OpUGreaterThanEqual:
      return {Opcode::ule, true};
    case spv::Op::OpSGreaterThan:
      return {Opcode::slt, true};
    case spv::Op::OpSGreaterThanEqual:
      return {Opcode::sle, true};
    default:
      return {};
  }
}

}  // namespace lapilli::spirv
