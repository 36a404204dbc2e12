// What the ops' immediates are, and the functions that build a Code.
#include "shader/ir.h"

#include <algorithm>
#include <bit>

namespace lapilli {
ImmRoles imm_roles(Opcode opcode) {
  switch (opcode) {
    case Opcode::load_array:
    case Opcode::store_array:
      return {ImmRole::array, ImmRole::none};
    case Opcode::load_buffer:
    case Opcode::load_uniform:
    case Opcode::store_buffer:
      return {ImmRole::resource, ImmRole::bytes};
    case Opcode::atomic:
    case Opcode::atomic_2d:
      return {ImmRole::resource, ImmRole::number};
    case Opcode::buffer_size:
      return {ImmRole::resource, ImmRole::none};
    case Opcode::load_push:
    case Opcode::load_push_indexed:
      return {ImmRole::none, ImmRole::bytes};
    case Opcode::sample_2d:
    case Opcode::sample_2d_lod:
    case Opcode::gather_2d:
    case Opcode::query_lod_2d:
    case Opcode::fetch_2d:
    case Opcode::store_2d:
    case Opcode::size_2d:
      return {ImmRole::resource, ImmRole::resource};
    case Opcode::builtin:
      return {ImmRole::built_in, ImmRole::none};
    case Opcode::fetch:
      return {ImmRole::attribute, ImmRole::none};
    case Opcode::store_output:
      return {ImmRole::slot, ImmRole::none};
    case Opcode::interpolate:
    case Opcode::interpolate_perspective:
    case Opcode::interpolate_flat:
      return {ImmRole::varying, ImmRole::none};
    case Opcode::depth_test:
      return {ImmRole::number, ImmRole::forward};
    case Opcode::load_color:
      return {ImmRole::color, ImmRole::none};
    case Opcode::store_color:
    case Opcode::blend_color:
      return {ImmRole::color, ImmRole::number};
    case Opcode::branch:
    case Opcode::branch_where:
      return {ImmRole::mask, ImmRole::none};
    case Opcode::branch_if:
      return {ImmRole::mask, ImmRole::mask};
    case Opcode::enter:
      return {ImmRole::mask, ImmRole::forward};
    case Opcode::loop:
      return {ImmRole::mask, ImmRole::backward};
    case Opcode::jump_if_none:
      return {ImmRole::forward, ImmRole::none};
    default:
      return {};
  }
}

bool writes_resource(const Instruction& instruction) {
  return (op_info(instruction.op).effects & kWritesMemory) != 0 && imm_roles(instruction.op).imm == ImmRole::resource;
}

ImageList image_list(Opcode opcode) {
  switch (opcode) {
    case Opcode::sample_2d:
    case Opcode::sample_2d_lod:
    case Opcode::gather_2d:
      return {8, 2};
    case Opcode::fetch_2d:
      return {5, 2};
    case Opcode::store_2d:
      return {8, 6};
    case Opcode::atomic_2d:
      return {6, 2};
    case Opcode::query_lod_2d:
      return {4, 2};
    case Opcode::size_2d:
      return {3, 0};
    default:
      return {};
  }
}

Reg Code::new_value(uint32_t count) {
  const Reg first = static_cast<Reg>(registers.size());
  registers.resize(registers.size() + count);
  return first;
}

Reg Code::new_variable(uint32_t count) {
  const Reg first = static_cast<Reg>(registers.size());
  registers.resize(registers.size() + count, RegInfo{RegKind::variable, 0, kNoReg});
  return first;
}

Reg Code::constant(uint32_t bits) {
  const auto at =
      std::lower_bound(constants_.begin(), constants_.end(), bits,
                       [](const std::pair<uint32_t, Reg>& entry, uint32_t key) { return entry.first < key; });
  if (at != constants_.end() && at->first == bits) return at->second;
  const Reg reg = static_cast<Reg>(registers.size());
  registers.push_back({RegKind::constant, bits, kNoReg});
  constants_.insert(at, {bits, reg});
  return reg;
}

Reg Code::constant_f(float value) { return constant(std::bit_cast<uint32_t>(value)); }

uint32_t Code::new_array(uint32_t count) {
  const uint32_t index = static_cast<uint32_t>(arrays.size());
  const Reg first = static_cast<Reg>(registers.size());
  registers.resize(registers.size() + count, RegInfo{RegKind::variable, 0, index});
  arrays.push_back({first, count});
  return index;
}

uint32_t Code::new_mask() { return mask_count++; }

uint32_t Code::new_label() {
  labels.push_back(kNoLabelPosition);
  return static_cast<uint32_t>(labels.size() - 1);
}

void Code::place_label(uint32_t label) { labels[label] = static_cast<uint32_t>(instructions.size()); }

uint32_t Code::add_resource(const ResourceRef& ref) {
  for (size_t i = 0; i < resources.size(); ++i) {
    const ResourceRef& known = resources[i];
    if (known.set == ref.set && known.first == ref.first && known.count == ref.count &&
        known.dynamic_offset == ref.dynamic_offset && known.uniform == ref.uniform) {
      return static_cast<uint32_t>(i);
    }
  }
  resources.push_back(ref);
  return static_cast<uint32_t>(resources.size() - 1);
}

Instruction& Code::append(Opcode op, uint32_t results) {
  Instruction instruction{};
  instruction.op = op;
  instruction.results = static_cast<uint8_t>(results);
  instruction.dst = results > 0 ? new_value(results) : kNoReg;
  instructions.push_back(instruction);
  return instructions.back();
}

Reg Code::emit_n(Opcode op, uint32_t results, Reg a, Reg b, Reg c, uint32_t imm, uint32_t imm2) {
  Instruction& instruction = append(op, results);
  instruction.a = a;
  instruction.b = b;
  instruction.c = c;
  instruction.imm = imm;
  instruction.imm2 = imm2;
  return instruction.dst;
}

Reg Code::emit(Opcode op, Reg a, Reg b, Reg c, uint32_t imm, uint32_t imm2) {
  return emit_n(op, 1, a, b, c, imm, imm2);
}

void Code::emit_void(Opcode op, Reg a, Reg b, Reg c, uint32_t imm, uint32_t imm2) { emit_n(op, 0, a, b, c, imm, imm2); }

void Code::emit_set(Reg variable, Reg value) { emit_to(Opcode::set, variable, value); }

void Code::emit_to(Opcode op, Reg dst, Reg a, Reg b, Reg c) {
  Instruction& instruction = append(op);
  instruction.results = 1;
  instruction.dst = dst;
  instruction.a = a;
  instruction.b = b;
  instruction.c = c;
}

void Code::set_list(Instruction& instruction, std::span<const Reg> operands) {
  instruction.list_first = static_cast<uint32_t>(operand_list.size());
  instruction.list_count = static_cast<uint16_t>(operands.size());
  operand_list.insert(operand_list.end(), operands.begin(), operands.end());
}

}  // namespace lapilli
