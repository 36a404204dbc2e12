// Fixed-function state as ops at the end of a fragment program: blending and the colour write mask.
// Specification: chapter "The Framebuffer", "Blending".
#pragma once

#include <vulkan/vulkan_core.h>

#include <array>

#include "base/result.h"
#include "shader/ir.h"

namespace lapilli {

// Writes the shader's colour to attachment `index` of Code::color_formats. The attachment is read only if the result
// depends on it. Fails for what is not supported (a second source colour).
Result<void> emit_color(Code& code, uint32_t index, const VkPipelineColorBlendAttachmentState& state,
                        std::array<Reg, 4> source);

}  // namespace lapilli
