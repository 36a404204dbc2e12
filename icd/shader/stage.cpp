// The programs of a pipeline, and what a draw has to know of them.
#include "shader/stage.h"

#include <algorithm>

#include "shader/stage_parts.h"

namespace lapilli {

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
