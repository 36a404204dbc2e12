// Lowering: interpolateAtCentroid, AtSample and AtOffset, and the fragment shader's built-ins that tell of samples. A
// pixel has one sample, in its centre: centroid and sample are what is interpolated anyway.
// Specification: "Shaders", Interpolation Decorations.
#include <spirv/unified1/GLSL.std.450.h>

#include <algorithm>

#include "shader/spirv/lowering.h"

namespace lapilli::spirv {

// An `interpolate` that is lowered here names the input's register instead of its slot, until the stages are linked.
void Lowering::lower_interpolation(const SpirvInst& inst) {
  constexpr uint32_t kInterpolant = 5, kOffset = 6;
  const Pointer* const from = pointer(inst[kInterpolant]);
  if (from == nullptr) return;
  if (which_ != VK_SHADER_STAGE_FRAGMENT_BIT || from->space != Space::registers || !from->variable->input)
    return fail("its interpolant is no input of a fragment shader");
  if (inst[1] != from->type) return fail("its type is not what the pointer points to");
  if (inst[4] != GLSLstd450InterpolateAtOffset) return bind(inst[2], load(*from));
  const std::span<const Reg> offset = data(inst[kOffset], 2);
  const bool dynamic = from->dynamic != kNoReg;
  const Variable& input = *from->variable;
  const uint32_t first = dynamic ? 0 : from->offset;
  const uint64_t count = dynamic ? input.count : type(from->type).components;
  if (first + count > input.count) return fail("its interpolant leaves the variable");
  const Reg linear = code_.emit_n(Opcode::frag_linear_at, 2, offset[0], offset[1]);
  const Reg perspective = code_.emit_n(Opcode::frag_perspective, 3, linear, linear + 1);
  std::vector<Reg> regs;
  for (Reg reg = input.first + first; reg < input.first + first + count; ++reg) {
    const auto at = std::ranges::find(out_.inputs, reg, &InterfaceComponent::reg);
    if (at == out_.inputs.end() || at->interpolation == Interpolation::flat) {
      regs.push_back(reg);
      continue;
    }
    const Reg lambda = at->interpolation == Interpolation::linear ? linear : perspective;
    regs.push_back(code_.emit_n(Opcode::interpolate, 1, lambda, lambda + 1, kNoReg, reg));
  }
  if (!dynamic) return bind(inst[2], regs);
  Pointer element = *from;
  element.variable = new_variable(count);
  for (uint32_t i = 0; i < count; ++i) code_.emit_to(Opcode::mov, element.variable->first + i, regs[i]);
  if (!failed()) bind(inst[2], load(element));
}

// True if it was one of them. Its registers are the variable's.
bool Lowering::declare_sample_input(spv::BuiltIn which, Reg first, uint64_t count) {
  switch (which) {
    case spv::BuiltIn::SampleId:
    case spv::BuiltIn::PointCoord:  // of triangles: undefined
      for (uint32_t i = 0; i < count; ++i) code_.emit_to(Opcode::mov, first + i, constant(0));
      return true;
    case spv::BuiltIn::SamplePosition:
      for (uint32_t i = 0; i < count; ++i) code_.emit_to(Opcode::mov, first + i, constant_f(0.5f));
      return true;
    default:
      return false;
  }
}

}  // namespace lapilli::spirv
