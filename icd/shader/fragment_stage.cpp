// The fragment program: interpolation, the lowered shader, sample mask, late depth, colours; and its link with the
// vertex program.
#include <algorithm>
#include <array>

#include "image/format.h"
#include "shader/fixed_function.h"
#include "shader/stage_parts.h"

namespace lapilli {
namespace {

constexpr uint32_t kMostResults = 16;  // of one op

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

}  // namespace lapilli
