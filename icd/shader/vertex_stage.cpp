// The vertex program: attributes are fetched, the lowered shader runs, what the fragment program reads is stored.
#include <algorithm>

#include "shader/stage_parts.h"

namespace lapilli {
namespace {

// A fetch gives components from the first on; those that nobody reads cost nothing to speak of. An attribute that the
// pipeline does not have reads as 0 0 0 1.
void emit_fetches(LoweredShader& shader, const GraphicsState& state, const std::vector<bool>& live) {
  Code& code = shader.code;
  code.attributes.assign(state.attributes.begin(), state.attributes.end());
  const std::vector<InterfaceComponent>& inputs = shader.inputs;
  for (size_t first = 0; first < inputs.size();) {
    size_t end = first + 1;
    while (end < inputs.size() && inputs[end].location == inputs[first].location &&
           inputs[end].component == inputs[end - 1].component + 1 && inputs[end].reg == inputs[end - 1].reg + 1)
      ++end;
    size_t used = end;
    while (used > first && !live[inputs[used - 1].reg]) --used;
    const auto at = std::find_if(state.attributes.begin(), state.attributes.end(),
                                 [&](const VertexAttribute& each) { return each.location == inputs[first].location; });
    const uint32_t attribute = static_cast<uint32_t>(at - state.attributes.begin());
    const uint32_t offset = inputs[first].component;
    if (used == first) {
      // Not read.
    } else if (at == state.attributes.end()) {
      for (size_t i = first; i < used; ++i) {
        const bool last = inputs[i].component == 3;
        const Reg one = inputs[i].integer ? code.constant(1) : code.constant_f(1.0f);
        code.emit_to(Opcode::mov, inputs[i].reg, last ? one : code.constant(0));
      }
    } else if (offset == 0) {
      append_to(code, Opcode::fetch, inputs[first].reg, static_cast<uint32_t>(used - first)).imm = attribute;
    } else {
      const uint32_t count = offset + static_cast<uint32_t>(used - first);
      const Reg fetched = code.emit_n(Opcode::fetch, count, kNoReg, kNoReg, kNoReg, attribute);
      for (size_t i = first; i < used; ++i) code.emit_to(Opcode::mov, inputs[i].reg, fetched + inputs[i].component);
    }
    first = end;
  }
}

void emit_outputs(LoweredShader& shader, const Varyings& varyings) {
  Code& code = shader.code;
  const uint32_t distances = kSlotVaryings + static_cast<uint32_t>(varyings.size());
  code.output_slots = distances + static_cast<uint32_t>(shader.distances.size());
  const auto store = [&](uint32_t slot, Reg reg) { code.emit_void(Opcode::store_output, reg, kNoReg, kNoReg, slot); };
  const InterfaceBuiltIn* position = find_built_in(shader.built_in_outputs, spv::BuiltIn::Position);
  for (uint32_t i = 0; i < 4; ++i) store(kSlotPosition + i, position != nullptr ? position->regs[i] : code.constant(0));
  const InterfaceBuiltIn* size = find_built_in(shader.built_in_outputs, spv::BuiltIn::PointSize);
  store(kSlotPointSize, size != nullptr ? size->regs[0] : code.constant_f(1.0f));
  for (uint32_t slot = 0; slot < varyings.size(); ++slot) {
    const bool distance = varyings[slot].location >= kClipDistanceLocation;
    const std::vector<InterfaceComponent>& outputs = distance ? shader.distances : shader.outputs;
    const auto at = std::find_if(outputs.begin(), outputs.end(), [&](const InterfaceComponent& output) {
      return output.location == varyings[slot].location && output.component == varyings[slot].component;
    });
    store(kSlotVaryings + slot, at != outputs.end() ? at->reg : code.constant(0));
  }
  for (uint32_t i = 0; i < shader.distances.size(); ++i) store(distances + i, shader.distances[i].reg);
}

}  // namespace

Result<Code> make_vertex_code(const ShaderStage& stage, const GraphicsState& state, const ResourceLayout& layout,
                              const Varyings& varyings, GraphicsCode& out) {
  Result<LoweredShader> shader = lower_shader(stage, VK_SHADER_STAGE_VERTEX_BIT, layout);
  if (!shader) return shader.error();
  if (shader->distances.size() > kMaxDistances)
    return Error{VK_ERROR_UNKNOWN,
                 "the vertex shader writes more than " + std::to_string(kMaxDistances) + " clip and cull distances"};
  out.clip_distances = static_cast<uint32_t>(
      std::ranges::count_if(shader->distances, [](const auto& each) { return each.location < kCullDistanceLocation; }));
  out.cull_distances = static_cast<uint32_t>(shader->distances.size()) - out.clip_distances;
  emit_outputs(*shader, varyings);
  RemovedWork& removed = out.removed;
  removed.vertex_cost = removed_work(*shader, state, Removal::varyings).cost;
  for (const InterfaceComponent& output : shader->outputs) {
    removed.vertex_values += std::none_of(varyings.begin(), varyings.end(), [&](const InterfaceComponent& read) {
      return read.location == output.location && read.component == output.component;
    });
  }
  const std::vector<bool> live = finish(*shader);
  const size_t first = shader->code.instructions.size();
  emit_built_ins(*shader, live);
  emit_fetches(*shader, state, live);
  move_to_front(shader->code, first);
  return std::move(shader->code);
}

}  // namespace lapilli
