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
//   16               R G B of the source are the same in all lanes; a pass says so (split_once)
enum class BlendTerm : uint32_t { zero, one, source_alpha, one_minus_source_alpha };
constexpr uint32_t kBlendSameColor = 1u << 16;
constexpr bool is_blend_word(uint32_t word) { return word >> 17 == 0 && (word >> 12 & 3) < 3 && (word >> 14 & 3) < 3; }
inline BlendEquation blend_equation(uint32_t word) {
  // By BlendTerm; the other half has the opposite sign.
  static constexpr BlendEquation::Factor kFactors[2][4] = {{{0, 0}, {0, 1}, {1, 0}, {-1, 1}},
                                                           {{-0.0f, -0.0f}, {-0.0f, -1}, {-1, -0.0f}, {1, -1}}};
  const bool from_source[] = {(word >> 12 & 3) == VK_BLEND_OP_SUBTRACT, (word >> 14 & 3) == VK_BLEND_OP_SUBTRACT};
  const bool from_destination[] = {(word >> 12 & 3) == VK_BLEND_OP_REVERSE_SUBTRACT,
                                   (word >> 14 & 3) == VK_BLEND_OP_REVERSE_SUBTRACT};
  return {{kFactors[from_destination[0]][word >> 4 & 3], kFactors[from_destination[1]][word >> 8 & 3]},
          {kFactors[from_source[0]][word >> 6 & 3], kFactors[from_source[1]][word >> 10 & 3]},
          word & 15,
          (word & kBlendSameColor) != 0,
          (word & 0xFFF0) == 0xDE0};
}

constexpr bool writes_color(Opcode op) { return op == Opcode::store_color || op == Opcode::blend_color; }

}  // namespace lapilli
