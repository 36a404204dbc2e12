// Lowering: functions, blocks and branches over masks.
// A block that is branched to has a mask register; `enter` makes it the lanes that execute. The blocks' order
// (order.cpp) makes sure that all lanes of a block have arrived when it is entered. Phis are variables, written on the
// way into their block.
#include <algorithm>

#include "shader/spirv/lowering.h"

namespace lapilli::spirv {
namespace {
// SPIR-V that is only looked at, in words for each instruction that counts for kMaxInstructions.
constexpr uint32_t kWordsPerStep = 16, kPhiWordsPerStep = 512;
constexpr int kMostLinks = 64;
constexpr size_t kMaxKnownWaiting = 1 << 20;  // in blocks that are not entered yet
}  // namespace

void Lowering::lower_call(const SpirvInst& inst) {
  const SpirvFunction* callee = m_.function(inst[3]);
  if (callee == nullptr) return fail("calls what is no function");
  if (callee->parameters.size() != inst.count - 4) return fail("has another number of arguments than the function");
  for (uint32_t i = 0; i < callee->parameters.size(); ++i) {
    const uint32_t parameter = callee->parameters[i], argument = inst[i + 4];
    if (m_.ids[argument].type != m_.ids[parameter].type) return fail("an argument has another type than its parameter");
    if (const Value* value = find_value(argument); value != nullptr && value->shape != Value::Shape::data) {
      bind(parameter, *value);
    } else {
      bind(parameter, data(argument));
    }
    if (failed()) return;
  }
  Frame* const caller = frame_;
  const uint32_t line = line_;
  const std::span<const Reg> returned = lower_function(*callee);
  frame_ = caller;
  line_ = line;
  word_ = inst.word;
  if (type(inst[1]).has_value() && !failed()) bind(inst[2], returned);
}

std::span<const Reg> Lowering::lower_function(const SpirvFunction& function) {
  Frame frame;
  frame.function = &function;
  frame.blocks.resize(function.blocks.size());
  frame.loops.resize(function.loops.size());
  frame_ = &frame;
  steps_ += static_cast<uint32_t>(function.blocks.size());
  const uint32_t result_type = m_.definition(function.id)[1];
  const uint64_t result_components = type(result_type).components;
  if (result_components > kMaxValueComponents) fail("its result is too large");
  const SpirvBlock& last = function.blocks[function.order.back()];
  const spv::Op last_op = m_.at(last.terminator).op;
  frame.direct_exit = function.return_count == 1 && last.loop == kNoLoop &&
                      (last_op == spv::Op::OpReturn || last_op == spv::Op::OpReturnValue);
  frame.fallthrough = 0;  // the first block goes on with the caller's lanes
  uint32_t loop = kNoLoop;
  for (uint32_t position = 0; position < function.order.size() && !failed(); ++position) {
    while (loop != kNoLoop && function.loops[loop].end == position) {
      const uint32_t header = function.order[function.loops[loop].header];
      if (!frame.loops[loop].open && (frame.fallthrough == header || frame.blocks[header].reached)) {
        position = function.loops[loop].header;  // the next round of one that is unrolled
        break;
      }
      close_loop(loop);
      loop = function.loops[loop].parent;
    }
    const uint32_t index = function.order[position];
    const SpirvBlock& block = function.blocks[index];
    loop = block.loop;
    if (!begin_block(index)) continue;  // nothing leads here
    for (uint32_t word = block.first; word < block.end && within_limits();) {
      const SpirvInst inst = m_.at(word);
      if (word == block.terminator) {
        const size_t first = code_.instructions.size();
        word_ = word;
        lower_terminator(inst);
        for (size_t i = first; i < code_.instructions.size(); ++i) {
          code_.instructions[i].spirv_word = word;
          code_.instructions[i].line = line_;
        }
      } else {
        lower_instruction(inst);
      }
      word += inst.count;
    }
    line_ = 0;
  }
  if (failed()) return {};
  for (; loop != kNoLoop; loop = function.loops[loop].parent) close_loop(loop);
  if (!frame.returned_directly) {
    if (!frame.exit.reached) frame.exit.mask = code_.new_mask();  // nobody returns
    enter(frame.exit);
  }
  if (frame.returned.size() != result_components) {  // nobody returned a value
    const std::span<Reg> zeros = allocate(static_cast<size_t>(result_components));
    std::fill(zeros.begin(), zeros.end(), constant(0));
    return zeros;
  }
  return frame.returned;
}

void Lowering::place_skip_label() {
  if (skip_label_ != kNoReg) code_.place_label(skip_label_);
  skip_label_ = kNoReg;
}

void Lowering::enter(BlockState& state) {
  place_skip_label();
  skip_label_ = code_.new_label();
  code_.emit_void(Opcode::enter, kNoReg, kNoReg, kNoReg, state.mask, skip_label_);
  if (state.pending) --pending_;
  state.pending = false;
  known_waiting_ -= state.known.size();
  known_ = std::move(state.known);
  uniform_ = pending_ == 0 && open_loops_ == 0;
}

bool Lowering::begin_block(uint32_t index) {
  const SpirvFunction& function = *frame_->function;
  const SpirvBlock& block = function.blocks[index];
  BlockState& state = frame_->blocks[index];
  frame_->block = index;
  const bool falls_through = frame_->fallthrough == index;
  frame_->fallthrough = kNoBlock;
  if (!falls_through && !state.reached) return false;
  if (!function.is_header(block)) {
    if (!falls_through) enter(state);
    // The other ways here turned out not to be taken: no variables are needed, but for what a loop hands out.
    if (state.edges == 1) {
      for (const auto& [id, values] : state.phis) {
        if (!escapes(id)) bind(id, values);
      }
    }
    return true;
  }
  LoopState& loop = frame_->loops[block.loop];
  for (uint32_t position = block.position + 1; position < function.loops[block.loop].end; ++position)
    frame_->blocks[function.order[position]] = {};  // of the round before
  if (falls_through || unrolls(block.loop, state.known)) {
    if (!falls_through) enter(state);
    state = {};
    --loop.rounds_left;
    return true;
  }
  loop.open = true;
  loop.label = code_.new_label();
  loop.first_register = static_cast<Reg>(code_.registers.size());
  ++open_loops_;
  place_skip_label();
  code_.place_label(loop.label);
  enter(state);
  forget_stored_in_loop(block.loop);
  return true;
}

void Lowering::close_loop(uint32_t index) {
  LoopState& loop = frame_->loops[index];
  if (!loop.open) return;
  const SpirvFunction& function = *frame_->function;
  place_skip_label();
  const uint32_t header = function.order[function.loops[index].header];
  BlockState& state = frame_->blocks[header];
  if (state.pending) --pending_;
  state.pending = false;
  code_.emit_void(Opcode::loop, kNoReg, kNoReg, kNoReg, state.mask, loop.label);
  --open_loops_;
  loop.open = false;
  for (const auto& [id, value] : loop.exports) bind(id, value);
}

uint32_t Lowering::mark_pending(BlockState& state) {
  if (state.mask == kNoReg) state.mask = code_.new_mask();
  if (!state.pending) ++pending_;
  state.pending = state.reached = true;
  return state.mask;
}

void Lowering::lower_terminator(const SpirvInst& inst) {
  const SpirvFunction& function = *frame_->function;
  switch (inst.op) {
    case spv::Op::OpBranch:
      return go_to(function.block_of(inst[1]));
    case spv::Op::OpBranchConditional: {
      Reg condition = scalar(inst[1]);
      const uint32_t yes = destination(function.block_of(inst[2])), no = destination(function.block_of(inst[3]));
      if (type_of(inst[1]).kind != Kind::boolean) return fail("its condition is no boolean");
      if (const auto bits = constant_bits(condition)) return go_to(*bits != 0 ? yes : no);
      if (yes == no) return go_to(yes);
      if (!failed() && code_.registers[condition].kind == RegKind::variable) condition = emit(Opcode::mov, condition);
      make_edge(yes, condition, false, false);
      make_edge(no, condition, true, true);
      const uint32_t yes_mask = mark_pending(frame_->blocks[yes]);
      const uint32_t no_mask = mark_pending(frame_->blocks[no]);
      return code_.emit_void(Opcode::branch_if, condition, kNoReg, kNoReg, yes_mask, no_mask);
    }
    case spv::Op::OpSwitch:
      return lower_switch(inst);
    case spv::Op::OpReturn:
    case spv::Op::OpReturnValue:
      return lower_return(inst);
    case spv::Op::OpKill:
      if (which_ != VK_SHADER_STAGE_FRAGMENT_BIT) return fail("is for fragment shaders");
      out_.kills = true;
      return code_.emit_void(Opcode::kill);
    case spv::Op::OpUnreachable:
      return;
    default:
      return fail("is not supported");
  }
}

// The block to which a jump to `target` leads, past blocks that only jump on.
uint32_t Lowering::destination(uint32_t target) const {
  const SpirvFunction& function = *frame_->function;
  constexpr int kMostHops = 16;
  for (int hop = 0; hop < kMostHops; ++hop) {
    const SpirvBlock& block = function.blocks[target];
    if (function.is_header(block) || block.successors.size() != 1 || first_op(block) != spv::Op::OpBranch) break;
    const SpirvBlock& next = function.blocks[block.successors[0]];
    if (first_op(next) == spv::Op::OpPhi) break;
    target = block.successors[0];
  }
  return target;
}

// Opcode of a block's first instruction that is no OpLine.
spv::Op Lowering::first_op(const SpirvBlock& block) const {
  SpirvInst inst = m_.at(block.first);
  while (inst.op == spv::Op::OpLine || inst.op == spv::Op::OpNoLine) inst = m_.at(inst.word + inst.count);
  return inst.op;
}

// A jump to the block that is next anyway, and to which nothing else leads, leaves the lanes as they are.
void Lowering::go_to(uint32_t target) {
  const SpirvFunction& function = *frame_->function;
  const SpirvBlock& from = function.blocks[frame_->block];
  const SpirvBlock& to = function.blocks[target];
  const bool same_loop = from.loop == to.loop;
  if (to.position == from.position + 1 && to.predecessors.size() == 1 && same_loop && !function.is_header(to)) {
    copy_to_phis(target, kNoReg, false);
    frame_->fallthrough = target;
    return;
  }
  // As does the way around of a loop that is unrolled.
  if (same_loop && function.is_header(to) && from.position + 1 == function.loops[to.loop].end &&
      !frame_->loops[to.loop].open && !frame_->blocks[target].reached && unrolls(to.loop, known_)) {
    frame_->fallthrough = target;
    return;
  }
  target = destination(target);
  make_edge(target, kNoReg, false, true);
  code_.emit_void(Opcode::branch, kNoReg, kNoReg, kNoReg, mark_pending(frame_->blocks[target]));
}

void Lowering::lower_switch(const SpirvInst& inst) {
  const SpirvFunction& function = *frame_->function;
  if (!type_of(inst[1]).is_integer()) return fail("its selector is no integer");
  const Reg selector = scalar(inst[1]);
  const uint32_t fallback = destination(function.block_of(inst[2]));
  if (const auto bits = constant_bits(selector)) {
    for (uint32_t i = 3; i + 1 < inst.count; i += 2) {
      if (inst[i] == *bits) return go_to(function.block_of(inst[i + 1]));
    }
    return go_to(fallback);
  }
  std::vector<std::pair<uint32_t, uint32_t>> cases;  // target, literal
  for (uint32_t i = 3; i + 1 < inst.count; i += 2) {
    const uint32_t target = destination(function.block_of(inst[i + 1]));
    if (target != fallback) cases.emplace_back(target, inst[i]);
  }
  if (cases.empty()) return go_to(fallback);
  std::stable_sort(cases.begin(), cases.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  Reg any = kNoReg;
  std::vector<std::pair<uint32_t, Reg>> targets;
  for (const auto& [target, literal] : cases) {
    const Reg equal = emit(Opcode::ieq, selector, constant(literal));
    if (!targets.empty() && targets.back().first == target) {
      targets.back().second = emit(Opcode::ior, targets.back().second, equal);
    } else {
      targets.emplace_back(target, equal);
    }
  }
  for (const auto& [target, condition] : targets) {
    any = any == kNoReg ? condition : emit(Opcode::ior, any, condition);
    make_edge(target, condition, false, false);
  }
  make_edge(fallback, any, true, true);
  for (const auto& [target, condition] : targets)
    code_.emit_void(Opcode::branch_where, condition, kNoReg, kNoReg, mark_pending(frame_->blocks[target]));
  const Reg none = emit(Opcode::inot, any);
  code_.emit_void(Opcode::branch_where, none, kNoReg, kNoReg, mark_pending(frame_->blocks[fallback]));
}

void Lowering::lower_return(const SpirvInst& inst) {
  const SpirvInst function = m_.definition(frame_->function->id);
  const Type& result = type(function[1]);
  const bool with_value = inst.op == spv::Op::OpReturnValue;
  if (with_value != result.has_value()) return fail("does not fit the function's result");
  const std::span<const Reg> value = with_value ? data(inst[1], result.components) : std::span<const Reg>{};
  if (frame_->direct_exit) {
    frame_->returned = value;
    frame_->returned_directly = true;
    return;
  }
  if (with_value && frame_->returned.empty()) {
    const std::span<Reg> variables = allocate(value.size());
    for (Reg& reg : variables) reg = code_.new_variable();
    frame_->returned = variables;
  }
  for (size_t i = 0; i < value.size(); ++i) assign(frame_->returned[i], value[i]);
  join_known(frame_->exit, first_inner_register(kNoBlock), true);
  code_.emit_void(Opcode::branch, kNoReg, kNoReg, kNoReg, mark_pending(frame_->exit));
}

// `last`: no other edge leaves the block.
void Lowering::make_edge(uint32_t target, Reg condition, bool negate, bool last) {
  copy_to_phis(target, condition, negate);
  join_known(frame_->blocks[target], first_inner_register(frame_->function->blocks[target].position), last);
}

// All phis of the target at once: what one of them overwrites is saved first if another one reads it. Lanes that go
// elsewhere get the values too; nobody reads them there but where a loop is left from the end of its body, hence the
// condition.
void Lowering::copy_to_phis(uint32_t target, Reg condition, bool negate) {
  const SpirvFunction& function = *frame_->function;
  const SpirvBlock& to = function.blocks[target];
  BlockState& state = frame_->blocks[target];
  const Reg first_inner = first_inner_register(to.position);
  std::vector<std::pair<Reg, Reg>> moves;  // variable, value
  uint32_t parent = 3;                     // word of the phi
  for (uint32_t word = to.first; word < to.end; word += m_.at(word).count) {
    const SpirvInst inst = m_.at(word);
    if (inst.op == spv::Op::OpLine || inst.op == spv::Op::OpNoLine) continue;
    if (inst.op != spv::Op::OpPhi) break;
    const uint64_t count = type(inst[1]).components;
    if (!type(inst[1]).has_value() || count > kMaxValueComponents)
      return fail("leads to a phi of a type that is not supported");
    if (state.edges == 0) {
      const Reg first = code_.new_variable(static_cast<uint32_t>(count));
      const std::span<Reg> regs = allocate(static_cast<size_t>(count));
      for (uint32_t i = 0; i < count; ++i) regs[i] = first + i;
      bind(inst[2], regs);
    }
    const std::span<const Reg> variables = data(inst[2], count);
    const uint32_t from = function.blocks[frame_->block].label;
    // Most compilers name the blocks in the same order in each phi.
    if (parent + 1 >= inst.count || inst[parent + 1] != from) parent = 3;
    const uint32_t start = parent;
    while (parent + 1 < inst.count && inst[parent + 1] != from) parent += 2;
    steps_ += (parent - start) / kPhiWordsPerStep;
    if (parent + 1 < inst.count) {
      const std::span<const Reg> values = data(inst[parent], count);
      // What was made in a loop that is left here goes on changing after lanes have left.
      const bool changes = std::any_of(values.begin(), values.end(), [&](Reg value) {
        return value >= first_inner && code_.registers[value].kind != RegKind::constant;
      });
      if (state.edges == 0 && !changes) state.phis.emplace_back(inst[2], values);
      for (size_t c = 0; c < count; ++c) {
        if (variables[c] != values[c]) moves.emplace_back(variables[c], values[c]);
      }
    }
  }
  ++state.edges;
  if (failed()) return;
  std::vector<Reg> written;
  for (const auto& move : moves) written.push_back(move.first);
  std::sort(written.begin(), written.end());
  const bool backwards = to.position <= function.blocks[frame_->block].position;
  for (auto& [variable, value] : moves) {
    if (std::binary_search(written.begin(), written.end(), value)) value = emit(Opcode::mov, value);
    if (backwards && condition != kNoReg)
      value =
          negate ? emit(Opcode::select, condition, variable, value) : emit(Opcode::select, condition, value, variable);
  }
  for (const auto& [variable, value] : moves) assign(variable, value);
}

bool Lowering::escapes(uint32_t id) const {
  return std::binary_search(frame_->function->escaping.begin(), frame_->function->escaping.end(), id);
}

// A value that later code outside the loop reads: lanes that leave the loop keep what they had.
void Lowering::export_from_loop(uint32_t id) {
  const uint32_t loop = frame_->function->blocks[frame_->block].loop;
  const Value* found = find_value(id);
  if (loop == kNoLoop || found == nullptr) return;
  Value value = *found;
  const auto keep = [&](Reg reg) {
    if (reg == kNoReg || code_.registers[reg].kind == RegKind::constant) return reg;
    const Reg copy = code_.new_variable();
    code_.emit_set(copy, reg);
    return copy;
  };
  const std::span<Reg> copies = allocate(value.regs.size());
  for (size_t i = 0; i < copies.size(); ++i) copies[i] = keep(value.regs[i]);
  value.regs = copies;
  value.pointer.dynamic = keep(value.pointer.dynamic);
  value.pointer.descriptor = keep(value.pointer.descriptor);
  for (Reg& reg : value.pointer.texel) reg = keep(reg);
  frame_->loops[loop].exports.emplace_back(id, value);
}

// First register made inside the outermost loop that a jump to the position leaves; kNoReg: it leaves none.
Reg Lowering::first_inner_register(uint32_t target_position) const {
  const SpirvFunction& function = *frame_->function;
  Reg first = kNoReg;
  for (uint32_t loop = function.blocks[frame_->block].loop; loop != kNoLoop; loop = function.loops[loop].parent) {
    if (target_position < function.loops[loop].end) break;
    if (frame_->loops[loop].open) first = frame_->loops[loop].first_register;
  }
  return first;
}

// What is known of variables where several ways meet is what is the same on all of them.
void Lowering::join_known(BlockState& state, Reg first_inner, bool last) {
  const auto stays_inside = [&](const auto& entry) {
    return entry.second >= first_inner && code_.registers[entry.second].kind != RegKind::constant;
  };
  const bool first = !state.reached;
  state.reached = true;
  if (first) {
    if (known_waiting_ + known_.size() > kMaxKnownWaiting) {
      state.known.clear();
    } else if (last) {
      state.known = std::move(known_);
    } else {
      state.known = known_;
    }
    if (first_inner != kNoReg) std::erase_if(state.known, stays_inside);
    known_waiting_ += state.known.size();
    return;
  }
  auto other = known_.begin();
  known_waiting_ -= std::erase_if(state.known, [&](const auto& entry) {
    while (other != known_.end() && other->first < entry.first) ++other;
    return other == known_.end() || *other != entry || stays_inside(entry);
  });
}

uint32_t Lowering::root_of_pointer(uint32_t id) const {
  for (int link = 0; link < kMostLinks; ++link) {
    const SpirvInst inst = m_.definition(id);
    if (inst.op != spv::Op::OpAccessChain && inst.op != spv::Op::OpInBoundsAccessChain &&
        inst.op != spv::Op::OpCopyObject)
      return id;
    if (m_.ids[inst[3]].word >= inst.word) return id;  // not a valid chain
    id = inst[3];
  }
  return 0;
}

void Lowering::forget_stored_in_loop(uint32_t loop) {
  const SpirvFunction& function = *frame_->function;
  const auto forget_root = [&](uint32_t id) {
    const uint32_t root_id = root_of_pointer(id);
    if (root_id == 0) return known_.clear();
    const Value* root = find_value(root_id);
    if (root != nullptr && root->shape == Value::Shape::pointer && root->pointer.variable != nullptr)
      forget(root->pointer.variable->first, root->pointer.variable->count);
  };
  for (uint32_t position = function.loops[loop].header; position < function.loops[loop].end; ++position) {
    const SpirvBlock& block = function.blocks[function.order[position]];
    steps_ += (block.end - block.first) / kWordsPerStep;
    for (uint32_t word = block.first; word < block.end && !known_.empty(); word += m_.at(word).count) {
      const SpirvInst inst = m_.at(word);
      if (inst.op == spv::Op::OpStore || inst.op == spv::Op::OpCopyMemory) forget_root(inst[1]);
      if (inst.op == spv::Op::OpExtInst && inst.count > 6) forget_root(inst[6]);  // Modf, Frexp
      if (inst.op == spv::Op::OpFunctionCall) known_.clear();
    }
  }
}

}  // namespace lapilli::spirv
