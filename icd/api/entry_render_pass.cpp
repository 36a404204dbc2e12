// Entry points of chapter "Render Pass".
#include "api/entry.h"

namespace lapilli::entry {

VKAPI_ATTR VkResult VKAPI_CALL vkCreateRenderPass(VkDevice device, const VkRenderPassCreateInfo* info,
                                                  const VkAllocationCallbacks* callbacks, VkRenderPass* pass) {
  return create_render_pass(*Device::from(device), *info, callbacks, pass);
}

VKAPI_ATTR void VKAPI_CALL vkDestroyRenderPass(VkDevice, VkRenderPass pass, const VkAllocationCallbacks*) {
  destroy(RenderPass::from(pass));
}

// No area is better than another.
VKAPI_ATTR void VKAPI_CALL vkGetRenderAreaGranularity(VkDevice, VkRenderPass, VkExtent2D* granularity) {
  *granularity = {1, 1};
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateFramebuffer(VkDevice device, const VkFramebufferCreateInfo* info,
                                                   const VkAllocationCallbacks* callbacks, VkFramebuffer* framebuffer) {
  return create_framebuffer(*Device::from(device), *info, callbacks, framebuffer);
}

VKAPI_ATTR void VKAPI_CALL vkDestroyFramebuffer(VkDevice, VkFramebuffer framebuffer, const VkAllocationCallbacks*) {
  destroy(Framebuffer::from(framebuffer));
}

VKAPI_ATTR void VKAPI_CALL vkCmdBeginRenderPass(VkCommandBuffer commands, const VkRenderPassBeginInfo* info,
                                                VkSubpassContents) {
  record_begin_render_pass(*CommandBuffer::from(commands), *info);
}

VKAPI_ATTR void VKAPI_CALL vkCmdNextSubpass(VkCommandBuffer commands, VkSubpassContents) {
  record_next_subpass(*CommandBuffer::from(commands));
}

VKAPI_ATTR void VKAPI_CALL vkCmdEndRenderPass(VkCommandBuffer commands) {
  record_end_render_pass(*CommandBuffer::from(commands));
}

}  // namespace lapilli::entry
