// What the stages share when fixed-function parts are put around a lowered shader. Prologues are made last, for the
// inputs that turn out to be read, and moved to the front.
#pragma once

#include <vector>

#include "base/removals.h"
#include "shader/passes/passes.h"
#include "shader/spirv/lower.h"
#include "shader/stage_code.h"

namespace lapilli {

// The fragment program's inputs in the order of their slots.
using Varyings = std::vector<InterfaceComponent>;

// Ends the program; tells which registers it reads once what has no effect is gone.
std::vector<bool> finish(LoweredShader& shader);

// What would have to be done in addition for all outputs to be computed, by a program that is not finished yet. With
// LAPILLI_KEEP it will be.
LiveWork removed_work(LoweredShader& shader, const GraphicsState& state, Removal removal);

// Instructions from `first` on come before all others.
void move_to_front(Code& code, size_t first);

Instruction& append_to(Code& code, Opcode op, Reg dst, uint32_t results);

// Reads the built-in inputs that are `live`, all but z and w of FragCoord.
void emit_built_ins(LoweredShader& shader, const std::vector<bool>& live);

// Null if it is not there.
const InterfaceBuiltIn* find_built_in(const std::vector<InterfaceBuiltIn>& all, spv::BuiltIn which);

Result<Code> make_vertex_code(const ShaderStage& stage, const GraphicsState& state, const ResourceLayout& layout,
                              const Varyings& varyings, GraphicsCode& out);

}  // namespace lapilli
