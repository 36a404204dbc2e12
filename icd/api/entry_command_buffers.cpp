// Entry points of chapter "Command Buffers": pools, recording, secondary command buffers.
#include "api/entry.h"

namespace lapilli::entry {

VKAPI_ATTR VkResult VKAPI_CALL vkCreateCommandPool(VkDevice device, const VkCommandPoolCreateInfo*,
                                                   const VkAllocationCallbacks* callbacks, VkCommandPool* pool) {
  Device& owner = *Device::from(device);
  owner.queue->start();  // who records commands will submit them
  return create_command_pool(owner, callbacks, pool);
}

VKAPI_ATTR void VKAPI_CALL vkDestroyCommandPool(VkDevice, VkCommandPool pool, const VkAllocationCallbacks*) {
  destroy(CommandPool::from(pool));
}

VKAPI_ATTR VkResult VKAPI_CALL vkResetCommandPool(VkDevice, VkCommandPool pool, VkCommandPoolResetFlags flags) {
  return reset_command_pool(*CommandPool::from(pool), flags);
}

VKAPI_ATTR VkResult VKAPI_CALL vkAllocateCommandBuffers(VkDevice, const VkCommandBufferAllocateInfo* info,
                                                        VkCommandBuffer* buffers) {
  return allocate_command_buffers(*info, buffers);
}

VKAPI_ATTR void VKAPI_CALL vkFreeCommandBuffers(VkDevice, VkCommandPool pool, uint32_t count,
                                                const VkCommandBuffer* buffers) {
  for (VkCommandBuffer buffer : list(buffers, count)) {
    if (buffer != nullptr) CommandPool::from(pool)->free(*CommandBuffer::from(buffer));
  }
}

VKAPI_ATTR VkResult VKAPI_CALL vkBeginCommandBuffer(VkCommandBuffer commands, const VkCommandBufferBeginInfo*) {
  return begin_command_buffer(*CommandBuffer::from(commands));
}

VKAPI_ATTR VkResult VKAPI_CALL vkEndCommandBuffer(VkCommandBuffer commands) {
  return end_command_buffer(*CommandBuffer::from(commands));
}

VKAPI_ATTR VkResult VKAPI_CALL vkResetCommandBuffer(VkCommandBuffer commands, VkCommandBufferResetFlags flags) {
  CommandBuffer::from(commands)->reset((flags & VK_COMMAND_BUFFER_RESET_RELEASE_RESOURCES_BIT) != 0);
  return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL vkCmdExecuteCommands(VkCommandBuffer commands, uint32_t count,
                                                const VkCommandBuffer* buffers) {
  record_execute_commands(*CommandBuffer::from(commands), list(buffers, count));
}

}  // namespace lapilli::entry
