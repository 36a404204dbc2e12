// Lowering: entry, values, errors and the dispatch of instructions.
#include "shader/spirv/lower.h"

#include <algorithm>

#include "shader/spirv/grammar.h"
#include "shader/spirv/lowering.h"

namespace lapilli {
namespace spirv {

Lowering::Lowering(const ShaderStage& stage, VkShaderStageFlagBits which, const ResourceLayout& layout)
    : m_(*stage.module), stage_(stage), which_(which), layout_(layout), value_of_(m_.ids.size()) {
  code_.stage = which;
  values_.reserve(m_.ids.size() + 1);  // one for each id at most: they stay where they are
  values_.emplace_back();
  types_of_.resize(m_.ids.size());
  constants_of_.resize(m_.ids.size());
  const size_t some = std::clamp<size_t>(m_.words.size() / 4, 256, 1 << 15);  // about one for each instruction
  code_.instructions.reserve(some);
  code_.registers.reserve(2 * some);
}

Result<LoweredShader> Lowering::run() {
  const spv::ExecutionModel model = which_ == VK_SHADER_STAGE_VERTEX_BIT     ? spv::ExecutionModel::Vertex
                                    : which_ == VK_SHADER_STAGE_FRAGMENT_BIT ? spv::ExecutionModel::Fragment
                                                                             : spv::ExecutionModel::GLCompute;
  const auto entry = std::find_if(m_.entry_points.begin(), m_.entry_points.end(), [&](const SpirvEntryPoint& point) {
    return point.model == model && point.name == stage_.entry_point;
  });
  const SpirvFunction* function = entry == m_.entry_points.end() ? nullptr : m_.function(entry->function);
  if (function == nullptr) {
    return Error{VK_ERROR_UNKNOWN, "SPIR-V: there is no " +
                                       spirv_enum_name(SpirvEnum::ExecutionModel, static_cast<uint32_t>(model)) +
                                       " entry point \"" + std::string(stage_.entry_point.substr(0, 100)) + '"'};
  }
  word_ = function->word;
  if (!function->parameters.empty()) fail("an entry point has no parameters");
  evaluate_constants();
  if (!failed()) read_modes(*entry);
  if (!failed()) declare_globals(*entry);
  if (!failed()) lower_function(*function);
  if (failed()) return *error_;
  out_.end_label = skip_label_ != kNoReg ? skip_label_ : code_.new_label();
  for (InterfaceComponent& output : out_.outputs) {
    if (const Reg known = get_known(output.reg); known != kNoReg) output.reg = known;
  }
  for (InterfaceBuiltIn& output : out_.built_in_outputs) {
    for (Reg& reg : output.regs) {
      if (const Reg known = get_known(reg); known != kNoReg) reg = known;
    }
  }
  // Distances that nobody writes are 0, which is inside.
  std::erase_if(out_.distances, [&](InterfaceComponent& distance) {
    const Reg known = get_known(distance.reg);
    if (known != kNoReg) distance.reg = known;
    return constant_bits(distance.reg) == 0u;
  });
  std::ranges::sort(out_.distances, {}, &InterfaceComponent::location);
  return std::move(out_);
}

void Lowering::fail(const std::string& what) {
  if (!error_) error_ = m_.error(word_, what);
}

bool Lowering::within_limits() {
  if (++steps_ > kMaxInstructions || code_.instructions.size() > kMaxInstructions ||
      code_.registers.size() > kMaxRegisters || pool_size_ > kMaxOperandPool)
    fail("the program is too large");
  return !failed();
}

std::span<Reg> Lowering::allocate(size_t count) {
  constexpr size_t kChunk = 2048;
  pool_size_ += count;
  if (count > chunk_left_) {
    chunk_left_ = std::max(kChunk, count);
    chunks_.push_back(std::make_unique_for_overwrite<Reg[]>(chunk_left_));
    chunk_next_ = chunks_.back().get();
  }
  const std::span<Reg> regs(chunk_next_, count);
  chunk_next_ += count;
  chunk_left_ -= count;
  return regs;
}

void Lowering::bind(uint32_t id, Value value) {
  value.type = m_.ids[id].type;
  if (value_of_[id] != 0) {  // a function that is called again
    values_[value_of_[id]] = value;
    return;
  }
  value_of_[id] = static_cast<uint32_t>(values_.size());
  values_.push_back(value);
}

void Lowering::bind(uint32_t id, std::span<const Reg> regs) {
  const std::span<Reg> own = allocate(regs.size());
  std::copy(regs.begin(), regs.end(), own.begin());
  Value value;
  value.shape = Value::Shape::data;
  value.regs = own;
  if (type_of(id).components != regs.size()) return fail("its result has another type");
  bind(id, value);
}

const Value* Lowering::find_value(uint32_t id) const { return value_of_[id] == 0 ? nullptr : &values_[value_of_[id]]; }

std::span<const Reg> Lowering::data(uint32_t id) {
  if (const Value* value = find_value(id); value != nullptr && value->shape == Value::Shape::data) return value->regs;
  if (const std::vector<uint32_t>* bits = constant_data(id)) {
    const std::span<Reg> regs = allocate(bits->size());
    for (size_t i = 0; i < regs.size(); ++i) regs[i] = constant((*bits)[i]);
    Value value;
    value.shape = Value::Shape::data;
    value.regs = regs;
    bind(id, value);
    return regs;
  }
  fail(m_.name(id) + " has no value here");
  return {};
}

std::span<const Reg> Lowering::data(uint32_t id, uint64_t count) {
  const std::span<const Reg> regs = data(id);
  if (regs.size() == count) return regs;
  fail(m_.name(id) + " has another number of components");
  const std::span<Reg> zeros = allocate(static_cast<size_t>(std::min<uint64_t>(count, kMaxValueComponents)));
  std::fill(zeros.begin(), zeros.end(), constant(0));
  return zeros;
}

const Pointer* Lowering::pointer(uint32_t id) {
  const Value* value = find_value(id);
  if (value != nullptr && value->shape == Value::Shape::pointer) return &value->pointer;
  fail(m_.name(id) + " is no pointer that has a value here");
  return nullptr;
}

std::optional<uint32_t> Lowering::constant_bits(Reg reg) const {
  if (reg >= code_.registers.size() || code_.registers[reg].kind != RegKind::constant) return std::nullopt;
  return code_.registers[reg].bits;
}

Reg Lowering::constant(uint32_t bits) {
  const size_t before = code_.registers.size();
  const Reg reg = code_.constant(bits);
  constant_registers_ += code_.registers.size() - before;
  if (constant_registers_ > kMaxConstantRegisters) fail("the program has too many constants");
  return reg;
}

Reg Lowering::emit(Opcode op, Reg a, Reg b, Reg c) {
  const std::optional<uint32_t> x = constant_bits(a), y = constant_bits(b);
  const bool conjunction = op == Opcode::iand;
  if (conjunction || op == Opcode::ior) {
    const uint32_t neutral = conjunction ? 0xFFFFFFFF : 0;
    if (x && y) return constant(conjunction ? *x & *y : *x | *y);
    if (x && (*x == neutral || *x == ~neutral)) return *x == neutral ? b : a;
    if (y && (*y == neutral || *y == ~neutral)) return *y == neutral ? a : b;
  }
  if (op == Opcode::inot && x) return constant(~*x);
  if (x && y) {
    if (const auto folded = fold_integers(op, *x, *y)) return constant(*folded);
  }
  if (op == Opcode::select && x) return *x != 0 ? b : c;
  return code_.emit(op, a, b, c);
}

void Lowering::lower_instruction(const SpirvInst& inst) {
  const size_t first = code_.instructions.size();
  word_ = inst.word;
  lower_body_instruction(inst);
  for (size_t i = first; i < code_.instructions.size(); ++i) {
    if (code_.instructions[i].spirv_word != 0) continue;  // of a function that was called
    code_.instructions[i].spirv_word = inst.word;
    code_.instructions[i].line = line_;
  }
  if (failed() || inst.op == spv::Op::OpPhi || frame_->function->escaping.empty()) return;
  const char* signature = find_spirv_op(static_cast<uint32_t>(inst.op))->signature;
  if (signature[0] == 't' && signature[1] == 'r' && escapes(inst[2])) export_from_loop(inst[2]);
}

void Lowering::lower_body_instruction(const SpirvInst& inst) {
  switch (inst.op) {
    case spv::Op::OpNop:
    case spv::Op::OpPhi:
    case spv::Op::OpSelectionMerge:
    case spv::Op::OpLoopMerge:
      return;
    case spv::Op::OpLine:
      line_ = inst[2];
      return;
    case spv::Op::OpNoLine:
      line_ = 0;
      return;
    case spv::Op::OpUndef: {
      const Type& result = type(inst[1]);
      const uint64_t count = result.components;
      if (result.is_handle() || result.kind == Kind::pointer || result.kind == Kind::runtime_array)
        return;  // no value: who uses it is refused
      if (!result.has_value() || count > kMaxValueComponents) return fail("has no value of a sane size");
      return bind(inst[2], std::vector<Reg>(static_cast<size_t>(count), constant(0)));
    }
    case spv::Op::OpCopyObject: {
      if (const Value* value = find_value(inst[3]); value != nullptr && value->shape != Value::Shape::data)
        return bind(inst[2], *value);
      return bind(inst[2], data(inst[3]));
    }
    case spv::Op::OpVariable:
      return lower_variable(inst);
    case spv::Op::OpLoad:
      return lower_load(inst);
    case spv::Op::OpStore: {
      const Pointer* to = pointer(inst[1]);
      if (to != nullptr) store(*to, data(inst[2], type(to->type).components));
      return;
    }
    case spv::Op::OpCopyMemory: {
      const Pointer* to = pointer(inst[1]);
      const Pointer* from = pointer(inst[2]);
      if (to == nullptr || from == nullptr) return;
      if (to->type != from->type) return fail("copies between different types");
      return store(*to, load(*from));
    }
    case spv::Op::OpAccessChain:
    case spv::Op::OpInBoundsAccessChain:
      return lower_access_chain(inst);
    case spv::Op::OpArrayLength:
      return lower_array_length(inst);
    case spv::Op::OpFunctionCall:
      return lower_call(inst);
    case spv::Op::OpExtInst:
      return lower_ext_inst(inst);
    case spv::Op::OpCompositeConstruct:
    case spv::Op::OpCompositeExtract:
    case spv::Op::OpCompositeInsert:
      return lower_composite(inst);
    default:
      if (!lower_by_table(inst) && !lower_arithmetic(inst) && !lower_vector(inst) && !lower_image(inst) &&
          !lower_atomics(inst))
        fail("is not supported");
  }
}

void Lowering::lower_composite(const SpirvInst& inst) {
  if (inst.op == spv::Op::OpCompositeConstruct) {
    std::vector<Reg> regs;
    for (uint32_t i = 3; i < inst.count && !failed(); ++i) {
      const std::span<const Reg> part = data(inst[i]);
      regs.insert(regs.end(), part.begin(), part.end());
      if (regs.size() > kMaxValueComponents) return fail("is too large");
    }
    return bind(inst[2], regs);
  }
  const bool insert = inst.op == spv::Op::OpCompositeInsert;
  const uint32_t composite = insert ? inst[4] : inst[3];
  const std::span<const Reg> whole = data(composite);
  uint32_t part = m_.ids[composite].type;
  uint64_t first = 0;
  for (uint32_t i = insert ? 5 : 4; i < inst.count && !failed(); ++i) {
    const Element step = element(part, inst[i]);
    part = step.type;
    first += step.first;
  }
  if (failed()) return;
  const uint64_t count = type(part).components;
  if (first + count > whole.size()) return fail("takes a part that does not exist");
  if (!insert) return bind(inst[2], whole.subspan(static_cast<size_t>(first), static_cast<size_t>(count)));
  std::vector<Reg> regs(whole.begin(), whole.end());
  const std::span<const Reg> object = data(inst[3], count);
  std::copy(object.begin(), object.end(), regs.begin() + static_cast<std::ptrdiff_t>(first));
  bind(inst[2], regs);
}

}  // namespace spirv

Result<LoweredShader> lower_shader(const ShaderStage& stage, VkShaderStageFlagBits which,
                                   const ResourceLayout& layout) {
  return spirv::Lowering(stage, which, layout).run();
}

}  // namespace lapilli
