// Entry points that set dynamic state: chapters "Fixed-Function Vertex Post-Processing", "Rasterization", "Fragment
// Operations", "The Framebuffer".
#include "api/entry.h"

namespace lapilli::entry {

VKAPI_ATTR void VKAPI_CALL vkCmdSetViewport(VkCommandBuffer commands, uint32_t first, uint32_t count,
                                            const VkViewport* viewports) {
  record_set_viewport(*CommandBuffer::from(commands), first, list(viewports, count));
}

VKAPI_ATTR void VKAPI_CALL vkCmdSetScissor(VkCommandBuffer commands, uint32_t first, uint32_t count,
                                           const VkRect2D* scissors) {
  record_set_scissor(*CommandBuffer::from(commands), first, list(scissors, count));
}

VKAPI_ATTR void VKAPI_CALL vkCmdSetLineWidth(VkCommandBuffer commands, float width) {
  record_set_line_width(*CommandBuffer::from(commands), width);
}

VKAPI_ATTR void VKAPI_CALL vkCmdSetDepthBias(VkCommandBuffer commands, float constant, float clamp, float slope) {
  record_set_depth_bias(*CommandBuffer::from(commands), constant, clamp, slope);
}

VKAPI_ATTR void VKAPI_CALL vkCmdSetBlendConstants(VkCommandBuffer commands, const float values[4]) {
  record_set_blend_constants(*CommandBuffer::from(commands), values);
}

// The feature depthBounds is not offered, and no format has stencil: nothing reads these.
VKAPI_ATTR void VKAPI_CALL vkCmdSetDepthBounds(VkCommandBuffer, float, float) {}
VKAPI_ATTR void VKAPI_CALL vkCmdSetStencilCompareMask(VkCommandBuffer, VkStencilFaceFlags, uint32_t) {}
VKAPI_ATTR void VKAPI_CALL vkCmdSetStencilWriteMask(VkCommandBuffer, VkStencilFaceFlags, uint32_t) {}
VKAPI_ATTR void VKAPI_CALL vkCmdSetStencilReference(VkCommandBuffer, VkStencilFaceFlags, uint32_t) {}

}  // namespace lapilli::entry
