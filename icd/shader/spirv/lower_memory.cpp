// Lowering: variables in registers, access chains, loads and stores.
// What a variable is known to hold is forwarded to loads; the moves into variables that nobody reads go as dead code.
#include <algorithm>

#include "shader/spirv/lowering.h"

namespace lapilli::spirv {
namespace {
constexpr size_t kMaxKnown = 4096;
}

Variable* Lowering::new_variable(uint64_t components) {
  if (components > kMaxVariableComponents) {
    fail("is a variable of a size that is not supported");
    components = 1;
  }
  variables_.emplace_back();
  Variable& variable = variables_.back();
  variable.count = static_cast<uint32_t>(components);
  variable.first = code_.new_variable(variable.count);
  return &variable;
}

// Nobody else is in the function at the time, so the initial value is written to all lanes. Without an initializer it
// is 0, so that no run differs from another.
void Lowering::lower_variable(const SpirvInst& inst) {
  const uint32_t pointee = type(inst[1]).element;
  const uint64_t count = type(pointee).components;
  const bool nothing = type(pointee).kind == Kind::none;
  if (!type(pointee).has_value() && !nothing) return fail("is a variable without a value");
  Value value;
  value.shape = Value::Shape::pointer;
  value.pointer.space = Space::registers;
  value.pointer.type = pointee;
  value.pointer.variable = new_variable(count);
  if (failed()) return;
  const std::vector<uint32_t>* initial = inst.count > 4 ? constant_data(inst[4]) : nullptr;
  if (inst.count > 4 && (initial == nullptr || initial->size() != count)) return fail("its initializer is no constant");
  for (uint32_t i = 0; i < count; ++i) {
    const Reg variable = value.pointer.variable->first + i;
    const Reg bits = constant(initial != nullptr ? (*initial)[i] : 0);
    code_.emit_to(Opcode::mov, variable, bits);
    set_known(variable, bits);
  }
  bind(inst[2], value);
}

void Lowering::assign(Reg variable, Reg value) { code_.emit_to(uniform_ ? Opcode::mov : Opcode::set, variable, value); }

void Lowering::set_known(Reg variable, Reg value) {
  const auto at = std::lower_bound(known_.begin(), known_.end(), std::pair<Reg, Reg>{variable, 0});
  if (at != known_.end() && at->first == variable) {
    at->second = value;
  } else if (known_.size() < kMaxKnown) {
    known_.insert(at, {variable, value});
  }
}

Reg Lowering::get_known(Reg variable) const {
  const auto at = std::lower_bound(known_.begin(), known_.end(), std::pair<Reg, Reg>{variable, 0});
  return at != known_.end() && at->first == variable ? at->second : kNoReg;
}

void Lowering::forget(Reg first, uint32_t count) {
  const auto from = std::lower_bound(known_.begin(), known_.end(), std::pair<Reg, Reg>{first, 0});
  const auto to = std::lower_bound(from, known_.end(), std::pair<Reg, Reg>{first + count, 0});
  known_.erase(from, to);
}

uint32_t Lowering::array_of(Variable& variable) {
  if (variable.array == kNoReg) {
    variable.array = static_cast<uint32_t>(code_.arrays.size());
    code_.arrays.push_back({variable.first, variable.count});
    for (uint32_t i = 0; i < variable.count; ++i) code_.registers[variable.first + i].array = variable.array;
  }
  return variable.array;
}

void Lowering::lower_access_chain(const SpirvInst& inst) {
  const Pointer* base = pointer(inst[3]);
  if (base == nullptr) return;
  Value value;
  value.shape = Value::Shape::pointer;
  value.pointer = *base;
  for (uint32_t i = 4; i < inst.count && !failed(); ++i) index_pointer(value.pointer, inst[i]);
  if (failed()) return;
  if (type(inst[1]).kind != Kind::pointer || type(inst[1]).element != value.pointer.type)
    return fail("its type is not what the indices lead to");
  bind(inst[2], value);
}

void Lowering::advance(Pointer& to, Reg index, uint64_t stride) {
  if (const auto bits = constant_bits(index)) {
    to.offset += static_cast<uint32_t>(*bits * stride);  // may wrap: every access is checked
    return;
  }
  const uint32_t factor = static_cast<uint32_t>(stride);
  Reg scaled = index;
  if (factor != 1) {
    const bool power_of_two = factor != 0 && (factor & (factor - 1)) == 0;
    scaled = power_of_two ? emit(Opcode::shl, index, constant(static_cast<uint32_t>(__builtin_ctz(factor))))
                          : emit(Opcode::imul, index, constant(factor));
  }
  to.dynamic = to.dynamic == kNoReg ? scaled : emit(Opcode::iadd, to.dynamic, scaled);
}

uint32_t Lowering::descriptors_in(uint32_t id) {
  uint64_t count = 1;
  while (type(id).kind == Kind::array && count < kMaxValueComponents) {
    count *= type(id).count;
    id = type(id).element;
  }
  return static_cast<uint32_t>(std::min<uint64_t>(count, UINT32_MAX));
}

void Lowering::index_pointer(Pointer& to, uint32_t index_id) {
  const Type& whole = type(to.type);
  const Reg index = scalar(index_id);
  if (!type_of(index_id).is_integer()) return fail("an index is no integer");
  const std::optional<uint32_t> bits = constant_bits(index);
  const bool memory = to.space == Space::buffer || to.space == Space::push;
  const uint32_t scalar_size = to.space == Space::shared ? 4 : 1;  // unit of offsets: bytes, or registers
  if (whole.kind == Kind::structure) {
    if (!bits || *bits >= whole.count) return fail("the index of a member is not a constant that names one");
    to.type = whole.members[*bits];
    if (!memory) {
      to.offset += static_cast<uint32_t>(whole.member_first[*bits] * scalar_size);
      return;
    }
    const auto offset = m_.decoration(whole.id, *bits, spv::Decoration::Offset);
    if (!offset) return fail("a member has no Offset");
    to.offset += *offset;
    to.in_block = true;
    to.component_stride = 4;
    to.matrix_stride = m_.decoration(whole.id, *bits, spv::Decoration::MatrixStride).value_or(0);
    to.row_major = m_.decoration(whole.id, *bits, spv::Decoration::RowMajor).has_value();
    return;
  }
  const bool array = whole.kind == Kind::array || whole.kind == Kind::runtime_array;
  if (!array && whole.kind != Kind::matrix && whole.kind != Kind::vector) return fail("indexes what has no parts");
  to.type = whole.element;
  if (to.space == Space::handle || (to.space == Space::buffer && !to.in_block)) {
    const uint32_t stride = descriptors_in(whole.element);
    if (bits) {
      if (whole.kind == Kind::array && *bits >= whole.count) return fail("there is no such descriptor in the array");
      to.descriptor_offset += *bits * stride;
      return;
    }
    const Reg scaled = stride == 1 ? index : emit(Opcode::imul, index, constant(stride));
    to.descriptor = to.descriptor == kNoReg ? scaled : emit(Opcode::iadd, to.descriptor, scaled);
    return;
  }
  if (!memory) {
    const uint64_t stride = type(whole.element).components * scalar_size;
    if (bits) {  // outside the bounds: the last element
      to.offset += static_cast<uint32_t>(std::min(*bits, whole.count - 1) * stride);
      return;
    }
    return advance(to, index, stride);
  }
  if (array) {
    const auto stride = m_.decoration(whole.id, SpirvModule::kWhole, spv::Decoration::ArrayStride);
    if (!stride) return fail("an array has no ArrayStride");
    return advance(to, index, *stride);
  }
  if (whole.kind == Kind::vector) return advance(to, index, to.component_stride);
  if (to.matrix_stride == 0) return fail("a matrix has no MatrixStride");
  if (!to.row_major) return advance(to, index, to.matrix_stride);
  to.component_stride = to.matrix_stride;
  advance(to, index, 4);
}

std::vector<Reg> Lowering::load(const Pointer& from) {
  const uint64_t components = type(from.type).components;
  if (!type(from.type).has_value() || components > kMaxValueComponents) {
    fail("loads what has no value of a sane size");
    return {};
  }
  const uint32_t count = static_cast<uint32_t>(components);
  if (from.space == Space::buffer || from.space == Space::shared || from.space == Space::push) return load_memory(from);
  std::vector<Reg> regs(count, constant(0));
  if (from.space != Space::registers || from.offset + uint64_t{count} > from.variable->count) {
    fail("loads from a pointer that cannot be read");
    return regs;
  }
  Variable* variable = from.variable;
  if (from.dynamic == kNoReg || count == 0) {
    for (uint32_t i = 0; i < count; ++i) {
      const Reg reg = variable->first + from.offset + i;
      const Reg known = variable->input ? reg : get_known(reg);
      regs[i] = known != kNoReg ? known : emit(Opcode::mov, reg);
    }
    return regs;
  }
  if (variable->input) {  // registers of a variable, so that they can be indexed
    Variable* copy = new_variable(variable->count);
    for (uint32_t i = 0; i < copy->count; ++i) code_.emit_to(Opcode::mov, copy->first + i, variable->first + i);
    variable = copy;
  }
  const uint32_t array = array_of(*variable);
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t offset = from.offset + i;
    const Reg index = offset == 0 ? from.dynamic : emit(Opcode::iadd, from.dynamic, constant(offset));
    regs[i] = code_.emit(Opcode::load_array, index, kNoReg, kNoReg, array);
  }
  return regs;
}

void Lowering::store(const Pointer& to, std::span<const Reg> values) {
  if (failed()) return;
  if (to.space == Space::buffer || to.space == Space::shared) return store_memory(to, values);
  if (to.space != Space::registers || to.variable->input) return fail("stores to what is read-only");
  Variable& variable = *to.variable;
  if (to.offset + uint64_t{values.size()} > variable.count) return fail("stores outside of a variable");
  for (uint32_t i = 0; i < values.size(); ++i) {
    const uint32_t offset = to.offset + i;
    if (to.dynamic == kNoReg) {
      const Reg reg = variable.first + offset;
      if (get_known(reg) == values[i]) continue;
      assign(reg, values[i]);
      set_known(reg, values[i]);
    } else {
      const Reg index = offset == 0 ? to.dynamic : emit(Opcode::iadd, to.dynamic, constant(offset));
      code_.emit_void(Opcode::store_array, index, values[i], kNoReg, array_of(variable));
    }
  }
  if (to.dynamic != kNoReg && !values.empty()) forget(variable.first, variable.count);
}

void Lowering::lower_load(const SpirvInst& inst) {
  const Pointer* from = pointer(inst[3]);
  if (from == nullptr) return;
  if (inst[1] != from->type) return fail("its type is not what the pointer points to");
  if (from->space != Space::handle) return bind(inst[2], load(*from));
  if (!type(from->type).is_handle()) return fail("loads an array of descriptors");
  const auto [resource, index] = resolve_descriptor(from->slot, from->descriptor_offset, from->descriptor);
  Value value;
  value.shape = Value::Shape::handle;
  value.texture = value.sampler = resource;
  const std::span<Reg> regs = allocate(2);
  regs[0] = regs[1] = index;
  value.regs = regs;
  bind(inst[2], value);
}

// NaNs that no arithmetic made keep their bits: integers travel as floats in some shaders.
Reg Lowering::canonical(Reg reg) {
  producers_.resize(code_.registers.size(), Opcode::kCount);
  for (; scanned_ < code_.instructions.size(); ++scanned_) {
    const Instruction& instruction = code_.instructions[scanned_];
    for (uint32_t i = 0; i < instruction.results; ++i) producers_[instruction.dst + i] = instruction.op;
  }
  const Opcode op = producers_[reg];
  const bool integer = op >= Opcode::feq && op <= Opcode::f_to_half;
  const bool loaded = op >= Opcode::load_buffer && op <= Opcode::load_push_indexed;
  const bool raw = integer || loaded || op == Opcode::canonical || op == Opcode::interpolate_flat ||
                   code_.registers[reg].kind == RegKind::constant;
  return raw ? reg : emit(Opcode::canonical, reg);
}

}  // namespace lapilli::spirv
