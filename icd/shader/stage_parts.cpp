// See stage_parts.h.
#include "shader/stage_parts.h"

#include <algorithm>

namespace lapilli {
namespace {

BuiltIn input_of(spv::BuiltIn built_in) {
  switch (built_in) {
    case spv::BuiltIn::VertexIndex:
      return BuiltIn::vertex_index;
    case spv::BuiltIn::InstanceIndex:
      return BuiltIn::instance_index;
    case spv::BuiltIn::BaseVertex:
      return BuiltIn::base_vertex;
    case spv::BuiltIn::BaseInstance:
      return BuiltIn::base_instance;
    case spv::BuiltIn::DrawIndex:
      return BuiltIn::draw_index;
    case spv::BuiltIn::FragCoord:
      return BuiltIn::frag_coord_x;
    case spv::BuiltIn::FrontFacing:
      return BuiltIn::front_facing;
    case spv::BuiltIn::HelperInvocation:
      return BuiltIn::helper_invocation;
    case spv::BuiltIn::NumWorkgroups:
      return BuiltIn::num_workgroups_x;
    case spv::BuiltIn::WorkgroupId:
      return BuiltIn::workgroup_x;
    case spv::BuiltIn::LocalInvocationId:
      return BuiltIn::local_invocation_x;
    case spv::BuiltIn::GlobalInvocationId:
      return BuiltIn::global_invocation_x;
    default:
      return BuiltIn::local_invocation_index;
  }
}

}  // namespace

std::vector<bool> finish(LoweredShader& shader) {
  Code& code = shader.code;
  code.place_label(shader.end_label);
  code.append(Opcode::end);
  remove_dead_code(code);
  std::vector<bool> live(code.registers.size());
  for (const Instruction& instruction : code.instructions)
    for_each_operand(code, instruction, [&](Reg reg) { live[reg] = true; });
  for (const Instruction& instruction : code.instructions) {  // at another place than the centre
    if (instruction.op == Opcode::interpolate) live[instruction.imm] = true;
  }
  for (Reg reg : code.kept) live[reg] = true;
  return live;
}

LiveWork removed_work(LoweredShader& shader, const GraphicsState& state, Removal removal) {
  if (!state.counts_removals && !keeps(removal)) return {};
  Code& code = shader.code;
  const LiveWork less = live_work(code);
  for (const InterfaceComponent& output : shader.outputs) code.kept.push_back(output.reg);
  const LiveWork all = live_work(code);
  if (!keeps(removal)) code.kept.clear();
  return {all.ops - less.ops, all.cost - less.cost};
}

void move_to_front(Code& code, size_t first) {
  const uint32_t count = static_cast<uint32_t>(code.instructions.size() - first);
  const auto begin = code.instructions.begin();
  std::rotate(begin, begin + static_cast<std::ptrdiff_t>(first), code.instructions.end());
  for (uint32_t& label : code.labels) {
    if (label != kNoLabelPosition) label += count;
  }
}

Instruction& append_to(Code& code, Opcode op, Reg dst, uint32_t results) {
  Instruction& instruction = code.append(op);
  instruction.dst = dst;
  instruction.results = static_cast<uint8_t>(results);
  return instruction;
}

void emit_built_ins(LoweredShader& shader, const std::vector<bool>& live) {
  for (const InterfaceBuiltIn& input : shader.built_in_inputs) {
    if (input.built_in == spv::BuiltIn::SampleMask) {  // of one sample, which is covered
      shader.code.emit_to(Opcode::mov, input.regs[0], shader.code.constant(1));
      continue;
    }
    const bool position = input.built_in == spv::BuiltIn::FragCoord;  // z and w: emit_fragment_prologue
    const size_t count = position ? 2 : input.regs.size();
    for (uint32_t i = 0; i < count; ++i) {
      if (live[input.regs[i]])
        append_to(shader.code, Opcode::builtin, input.regs[i], 1).imm =
            static_cast<uint32_t>(input_of(input.built_in)) + i;
    }
  }
}

const InterfaceBuiltIn* find_built_in(const std::vector<InterfaceBuiltIn>& all, spv::BuiltIn which) {
  const auto at = std::find_if(all.begin(), all.end(), [&](const InterfaceBuiltIn& b) { return b.built_in == which; });
  return at == all.end() ? nullptr : &*at;
}

}  // namespace lapilli
