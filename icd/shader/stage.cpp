// Puts the fixed-function parts around the lowered shaders: prologues that feed inputs, epilogues that take outputs;
// and links the stages. Prologues are made last, for the inputs that turn out to be read, and moved to the front.
#include "shader/stage.h"

#include <algorithm>
#include <array>

#include "base/removals.h"
#include "image/format.h"
#include "shader/fixed_function.h"
#include "shader/passes/passes.h"
#include "shader/spirv/lower.h"
#include "shader/stage_code.h"

namespace lapilli {
namespace {

constexpr uint32_t kMostResults = 16;

// Ends the program; tells which registers it reads once what has no effect is gone.
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

// What would have to be done in addition for all outputs to be computed, by a program that is not finished yet. With
// LAPILLI_KEEP it will be.
LiveWork removed_work(LoweredShader& shader, const GraphicsState& state, Removal removal) {
  if (!state.counts_removals && !keeps(removal)) return {};
  Code& code = shader.code;
  const LiveWork less = live_work(code);
  for (const InterfaceComponent& output : shader.outputs) code.kept.push_back(output.reg);
  const LiveWork all = live_work(code);
  if (!keeps(removal)) code.kept.clear();
  return {all.ops - less.ops, all.cost - less.cost};
}

// Instructions from `first` on come before all others.
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

// --- built-in inputs
// ---------------------------------------------------------------------------------------------------

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

// --- vertex
// ------------------------------------------------------------------------------------------------------------

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

// The fragment program's inputs in the order of their slots.
using Varyings = std::vector<InterfaceComponent>;

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

// --- fragment
// ----------------------------------------------------------------------------------------------------------

void plan_depth(FragmentPlan& plan, const LoweredShader& shader, const GraphicsState& state) {
  plan.depth_test = state.depth_test && (state.depth_write || state.depth_compare != VK_COMPARE_OP_ALWAYS);
  plan.depth_write = plan.depth_test && state.depth_write;
  plan.depth_compare = plan.depth_test ? state.depth_compare : VK_COMPARE_OP_ALWAYS;
  const bool replaces = find_built_in(shader.built_in_outputs, spv::BuiltIn::FragDepth) != nullptr;
  const bool late = !shader.early_fragment_tests && (replaces || shader.stores || (shader.kills && state.depth_write));
  plan.early_depth = plan.depth_test && !late;
}

void emit_depth_test(Code& code, const FragmentPlan& plan, Reg z, uint32_t end_label) {
  constexpr uint32_t kWrites = 8;
  const uint32_t flags = static_cast<uint32_t>(plan.depth_compare) | (plan.depth_write ? kWrites : 0);
  code.emit_void(Opcode::depth_test, z, kNoReg, kNoReg, flags, end_label);
}

bool blends_or_masks(const VkPipelineColorBlendAttachmentState& state, VkFormat format) {
  const FormatInfo* const info = find_format(format);
  uint32_t components = 0;
  for (uint32_t i = 0; info != nullptr && i < 4; ++i) components |= uint32_t{info->components[i].bits != 0} << i;
  return state.blendEnable == VK_TRUE || (state.colorWriteMask & components) != components;
}

// DESIGN.md, "Deferred shading of opaque draws".
void plan_shading(FragmentPlan& plan, const LoweredShader& shader, const GraphicsState& state) {
  size_t targets = 0, stores = 0;
  bool whole = true;
  for (size_t i = 0; i < state.color_formats.size() && i < state.blend.size(); ++i) {
    if (state.color_formats[i] == VK_FORMAT_UNDEFINED) continue;
    ++targets;
    whole = whole && !blends_or_masks(state.blend[i], state.color_formats[i]);
  }
  for (const Instruction& instruction : shader.code.instructions) stores += writes_color(instruction.op);
  plan.writes_color = stores > 0;
  const bool reads_helpers = find_built_in(shader.built_in_inputs, spv::BuiltIn::HelperInvocation) != nullptr;
  plan.deferrable = plan.writes_color && stores == targets && whole && !shader.kills && !shader.stores &&
                    !reads_helpers && plan.early_depth == plan.depth_test;
}

// There is one sample: a fragment whose mask leaves it out is gone before late depth.
void emit_sample_mask(LoweredShader& shader) {
  const InterfaceBuiltIn* mask = find_built_in(shader.built_in_outputs, spv::BuiltIn::SampleMask);
  if (mask == nullptr) return;
  Code& code = shader.code;
  const Reg sample = code.emit(Opcode::iand, mask->regs[0], code.constant(1));
  code.emit_void(Opcode::demote, code.emit(Opcode::ieq, sample, code.constant(0)));
}

// Behind the shader: the sample mask, late depth, the count of samples that passed (unless the shader asks for early
// tests), colours.
Result<void> emit_fragment_epilogue(LoweredShader& shader, const GraphicsState& state, const FragmentPlan& plan,
                                    Reg depth_reg) {
  Code& code = shader.code;
  emit_sample_mask(shader);
  if (plan.depth_test && !plan.early_depth) {
    Reg z = depth_reg;
    if (const InterfaceBuiltIn* replaced = find_built_in(shader.built_in_outputs, spv::BuiltIn::FragDepth)) {
      const Reg above = code.emit(Opcode::fmax, code.constant(0), replaced->regs[0]);
      z = code.emit(Opcode::fmin, code.constant_f(1.0f), above);
    }
    emit_depth_test(code, plan, z, shader.end_label);
  }
  if (!shader.early_fragment_tests) code.append(Opcode::count_samples);
  for (uint32_t i = 0; i < state.color_formats.size() && i < state.blend.size(); ++i) {
    if (state.color_formats[i] == VK_FORMAT_UNDEFINED) continue;
    std::array<Reg, 4> color{code.constant(0), code.constant(0), code.constant(0), code.constant_f(1.0f)};
    bool written = false;
    for (const InterfaceComponent& output : shader.outputs) {
      if (output.location != i) continue;
      color[output.component] = output.reg;
      written = true;
    }
    if (!written) continue;
    if (Result<void> r = emit_color(code, i, state.blend[i], color); !r) return r;
  }
  return {};
}

// The inputs that are read, and their slots in order of Location and Component.
Varyings link_varyings(LoweredShader& shader, const std::vector<bool>& live, RemovedWork& removed) {
  const bool everything = keeps(Removal::varyings) && shader.inputs.size() <= kMaxVaryingComponents;
  Varyings varyings;
  for (const InterfaceComponent& input : shader.inputs) {
    if (live[input.reg] || everything) varyings.push_back(input);
  }
  std::stable_sort(varyings.begin(), varyings.end(), [](const InterfaceComponent& a, const InterfaceComponent& b) {
    return a.location != b.location ? a.location < b.location : a.component < b.component;
  });
  removed.input_values = static_cast<uint32_t>(
      std::count_if(shader.inputs.begin(), shader.inputs.end(), [&](const auto& input) { return !live[input.reg]; }));
  removed.input_cost = removed.input_values * op_info(Opcode::interpolate).cost / 4;  // of four components
  if (everything) {
    for (const InterfaceComponent& input : varyings) shader.code.kept.push_back(input.reg);
  }
  return varyings;
}

// Before the shader: the count of early tests, interpolation. An early depth test is raster's work.
void emit_fragment_prologue(LoweredShader& shader, Reg depth_reg, const Varyings& varyings,
                            const std::vector<bool>& live) {
  Code& code = shader.code;
  for (Instruction& instruction : code.instructions) {
    if (instruction.op != Opcode::interpolate) continue;
    const auto at = std::ranges::find(varyings, instruction.imm, &InterfaceComponent::reg);
    instruction.imm = static_cast<uint32_t>(at - varyings.begin());
  }
  if (shader.early_fragment_tests) code.append(Opcode::count_samples);
  const InterfaceBuiltIn* position = find_built_in(shader.built_in_inputs, spv::BuiltIn::FragCoord);
  const bool reads_z = position != nullptr && live[position->regs[2]];
  const bool reads_w = position != nullptr && live[position->regs[3]];
  if (reads_z || live[depth_reg]) append_to(code, Opcode::frag_depth, depth_reg, 1);
  if (reads_z) code.emit_to(Opcode::mov, position->regs[2], depth_reg);
  emit_built_ins(shader, live);
  const auto uses = [&](Interpolation how) {
    return std::any_of(varyings.begin(), varyings.end(),
                       [&](const InterfaceComponent& each) { return each.interpolation == how; });
  };
  // Varyings in a row of slots and of registers are interpolated by one op.
  const auto run_at = [&](uint32_t slot) {
    const InterfaceComponent& first = varyings[slot];
    uint32_t run = 1;
    while (slot + run < varyings.size() && run < kMostResults && varyings[slot + run].reg == first.reg + run &&
           varyings[slot + run].interpolation == first.interpolation)
      ++run;
    return run;
  };
  uint32_t perspective_runs = 0;
  for (uint32_t slot = 0; slot < varyings.size(); slot += run_at(slot))
    perspective_runs += varyings[slot].interpolation == Interpolation::perspective;
  const bool fused = perspective_runs == 1 && !reads_w;
  const bool perspective = reads_w || perspective_runs > 1;
  Reg linear = kNoReg, corrected = kNoReg;
  if (perspective || uses(Interpolation::linear)) linear = code.emit_n(Opcode::frag_linear, 2);
  if (perspective) corrected = code.emit_n(Opcode::frag_perspective, 3, linear, linear + 1);
  if (reads_w) code.emit_to(Opcode::mov, position->regs[3], corrected + 2);
  for (uint32_t slot = 0, run; slot < varyings.size(); slot += run) {
    run = run_at(slot);
    const InterfaceComponent& first = varyings[slot];
    const bool is_perspective = first.interpolation == Interpolation::perspective;
    const Opcode op = first.interpolation == Interpolation::flat ? Opcode::interpolate_flat
                      : fused && is_perspective                  ? Opcode::interpolate_perspective
                                                                 : Opcode::interpolate;
    Instruction& instruction = append_to(code, op, first.reg, run);
    instruction.imm = slot;
    if (op == Opcode::interpolate) {
      const Reg lambda = is_perspective ? corrected : linear;
      instruction.a = lambda;
      instruction.b = lambda + 1;
    }
  }
}

// What the fragment program does beside depth and counting.
bool has_effects(const LoweredShader& shader) {
  if (shader.kills || shader.stores) return true;
  return std::any_of(shader.code.instructions.begin(), shader.code.instructions.end(),
                     [](const Instruction& instruction) { return writes_color(instruction.op); });
}

}  // namespace

Result<GraphicsCode> make_graphics_code(const ShaderStage& vertex, const ShaderStage* fragment,
                                        const GraphicsState& state, const ResourceLayout& layout) {
  GraphicsCode out;
  LoweredShader shader;
  Varyings varyings;
  Reg depth_reg = kNoReg;
  const auto build = [&](bool with_shader) -> Result<void> {
    shader = LoweredShader{};
    shader.code.stage = VK_SHADER_STAGE_FRAGMENT_BIT;
    if (with_shader) {
      Result<LoweredShader> lowered = lower_shader(*fragment, VK_SHADER_STAGE_FRAGMENT_BIT, layout);
      if (!lowered) return lowered.error();
      shader = std::move(*lowered);
    } else {
      shader.end_label = shader.code.new_label();
    }
    shader.code.color_formats.assign(state.color_formats.begin(), state.color_formats.end());
    plan_depth(out, shader, state);
    depth_reg = shader.code.new_value();
    return emit_fragment_epilogue(shader, state, out, depth_reg);
  };
  if (Result<void> r = build(fragment != nullptr); !r) return r.error();
  const bool late_depth = out.depth_test && !out.early_depth;
  const bool replaces_depth = late_depth && find_built_in(shader.built_in_outputs, spv::BuiltIn::FragDepth) != nullptr;
  const LiveWork work = removed_work(shader, state, Removal::outputs);
  out.removed.output_ops = work.ops;
  out.removed.output_cost = work.cost;
  out.fragment_reads_nothing = !has_effects(shader) && !replaces_depth && !keeps(Removal::outputs);
  if (out.fragment_reads_nothing && fragment != nullptr) {  // nobody sees what the shader computes
    if (Result<void> r = build(false); !r) return r.error();
  }
  plan_shading(out, shader, state);
  const std::vector<bool> live = finish(shader);
  varyings = link_varyings(shader, live, out.removed);
  if (varyings.size() > kMaxVaryingComponents)
    return Error{VK_ERROR_UNKNOWN, "the fragment shader reads more than " + std::to_string(kMaxVaryingComponents) +
                                       " components of inputs"};
  const size_t first = shader.code.instructions.size();
  emit_fragment_prologue(shader, depth_reg, varyings, live);
  move_to_front(shader.code, first);
  out.pixels_alone = out.deferrable && std::none_of(shader.code.instructions.begin(), shader.code.instructions.end(),
                                                    [](const Instruction& instruction) {
                                                      return instruction.op == Opcode::frag_depth ||
                                                             (op_info(instruction.op).effects & kCrossLane) != 0;
                                                    });
  Result<Code> vertex_code = make_vertex_code(vertex, state, layout, varyings, out);
  if (!vertex_code) return vertex_code.error();
  out.vertex = std::move(*vertex_code);
  out.fragment = std::move(shader.code);
  for (const InterfaceComponent& each : varyings) out.varyings.push_back(each.interpolation);
  out.output_slots = out.vertex.output_slots;
  return out;
}

Result<Code> make_compute_code(const ShaderStage& stage, const ResourceLayout& layout) {
  Result<LoweredShader> shader = lower_shader(stage, VK_SHADER_STAGE_COMPUTE_BIT, layout);
  if (!shader) return shader.error();
  const std::vector<bool> live = finish(*shader);
  const size_t first = shader->code.instructions.size();
  emit_built_ins(*shader, live);
  move_to_front(shader->code, first);
  return std::move(shader->code);
}

namespace {

// Descriptors or push constants.
bool read_resources(std::span<const Instruction> instructions) {
  return std::ranges::any_of(instructions, [](const Instruction& instruction) {
    return imm_roles(instruction.op).imm == ImmRole::resource || instruction.op == Opcode::load_push ||
           instruction.op == Opcode::load_push_indexed;
  });
}

bool reads_draw(const Instruction& instruction) {
  return instruction.op == Opcode::builtin && instruction.imm >= static_cast<uint32_t>(BuiltIn::base_vertex) &&
         instruction.imm <= static_cast<uint32_t>(BuiltIn::draw_index);
}

bool store(std::span<const Instruction> instructions) { return std::ranges::any_of(instructions, writes_resource); }

}  // namespace

Result<GraphicsPrograms> build_graphics(const ShaderStage& vertex, const ShaderStage* fragment,
                                        const GraphicsState& state, const ResourceLayout& layout) {
  Result<GraphicsCode> code = make_graphics_code(vertex, fragment, state, layout);
  if (!code) return code.error();
  GraphicsPrograms out;
  static_cast<FragmentPlan&>(out) = *code;
  out.removed = code->removed;
  Result<ProgramPtr> program = assemble(std::move(code->vertex));
  if (!program) return program.error();
  out.vertex = std::move(*program);
  program = assemble(std::move(code->fragment));
  if (!program) return program.error();
  out.fragment = std::move(*program);
  out.varyings = std::move(code->varyings);
  out.output_slots = code->output_slots;
  out.clip_distances = code->clip_distances;
  out.cull_distances = code->cull_distances;
  out.fragment_reads_nothing = code->fragment_reads_nothing;
  out.vertices_read_resources = read_resources(source(*out.vertex).instructions);
  out.vertices_read_draw = std::ranges::any_of(source(*out.vertex).instructions, reads_draw);
  out.vertices_store = store(source(*out.vertex).instructions);
  const Code& fragment_code = source(*out.fragment);
  out.fragment_reads_resources = read_resources(fragment_code.once) || read_resources(fragment_code.instructions);
  return out;
}

Result<ProgramPtr> build_compute(const ShaderStage& stage, const ResourceLayout& layout) {
  Result<Code> code = make_compute_code(stage, layout);
  if (!code) return code.error();
  return assemble(std::move(*code));
}

}  // namespace lapilli
