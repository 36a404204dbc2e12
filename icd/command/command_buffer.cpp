// Command pools, and the life of command buffers.
#include "command/command_buffer.h"

#include <algorithm>

namespace lapilli {

void CommandBuffer::reset(bool release_memory) {
  first = nullptr;
  last = nullptr;
  error = VK_SUCCESS;
  if (release_memory) {
    arena.release();
  } else {
    arena.reset();
  }
}

CommandPool::~CommandPool() {
  for (CommandBuffer* buffer = first; buffer != nullptr;) {
    CommandBuffer* const next = buffer->next;
    destroy(buffer);
    buffer = next;
  }
}

void CommandPool::free(CommandBuffer& buffer) {
  if (buffer.next != nullptr) buffer.next->previous = buffer.previous;
  (buffer.previous != nullptr ? buffer.previous->next : first) = buffer.next;
  destroy(&buffer);
}

VkResult create_command_pool(DeviceContext& device, const VkAllocationCallbacks* callbacks, VkCommandPool* handle) {
  return publish(make_object<CommandPool>(device.object_memory(callbacks), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT), handle);
}

VkResult reset_command_pool(CommandPool& pool, VkCommandPoolResetFlags flags) {
  for (CommandBuffer* buffer = pool.first; buffer != nullptr; buffer = buffer->next) {
    buffer->reset((flags & VK_COMMAND_POOL_RESET_RELEASE_RESOURCES_BIT) != 0);
  }
  return VK_SUCCESS;
}

void trim_command_pool(CommandPool& pool) {
  for (CommandBuffer* buffer = pool.first; buffer != nullptr; buffer = buffer->next) {
    if (buffer->first == nullptr) buffer->arena.release();
  }
}

VkResult allocate_command_buffers(const VkCommandBufferAllocateInfo& info, VkCommandBuffer* handles) {
  CommandPool& pool = *CommandPool::from(info.commandPool);
  std::fill_n(handles, info.commandBufferCount, VkCommandBuffer{VK_NULL_HANDLE});
  try {
    for (uint32_t i = 0; i < info.commandBufferCount; ++i) {
      auto buffer = make_object<CommandBuffer>(pool.host, VK_SYSTEM_ALLOCATION_SCOPE_OBJECT, pool, info.level);
      buffer->next = pool.first;
      if (pool.first != nullptr) pool.first->previous = buffer.get();
      pool.first = buffer.get();
      handles[i] = buffer.release()->handle();
    }
  } catch (const std::bad_alloc&) {
    for (uint32_t i = 0; i < info.commandBufferCount; ++i) {
      if (CommandBuffer* buffer = CommandBuffer::from(handles[i])) pool.free(*buffer);
      handles[i] = VK_NULL_HANDLE;
    }
    return VK_ERROR_OUT_OF_HOST_MEMORY;
  }
  return VK_SUCCESS;
}

VkResult begin_command_buffer(CommandBuffer& buffer) {
  buffer.reset(false);
  return VK_SUCCESS;
}

VkResult end_command_buffer(CommandBuffer& buffer) { return buffer.error; }

}  // namespace lapilli
