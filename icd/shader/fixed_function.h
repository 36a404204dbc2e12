// Fixed-function state as ops at the end of a fragment program: blending and the colour write mask.
// Specification: chapter "The Framebuffer", "Blending".
#pragma once

#include <vulkan/vulkan_core.h>

#include <array>

#include "base/result.h"
#include "image/texel.h"
#include "shader/ir.h"

namespace lapilli {

// Writes the shader's colour to attachment `index` of Code::color_formats. The attachment is read only if the result
// depends on it. Fails for what is not supported (a second source colour).
Result<void> emit_color(Code& code, uint32_t index, const VkPipelineColorBlendAttachmentState& state,
                        std::array<Reg, 4> source);

// The common equations over formats of four UNORM8 components are one op, blend_color; its imm2 says which:
//   bits 0 … 3       components that are written
//   4, 6, 8, 10      two bits each: source and destination factor of the colour, then of alpha (BlendTerm)
//   12, 14           two bits each: VkBlendOp of the colour and of alpha, up to REVERSE_SUBTRACT
enum class BlendTerm : uint32_t { zero, one, source_alpha, one_minus_source_alpha };
constexpr bool is_blend_word(uint32_t word) { return word >> 16 == 0 && (word >> 12 & 3) < 3 && word >> 14 < 3; }
BlendEquation blend_equation(uint32_t word);

constexpr bool writes_color(Opcode op) { return op == Opcode::store_color || op == Opcode::blend_color; }

}  // namespace lapilli
