// VkBuffer and VkBufferView. Specification: chapter "Resource Creation", section "Buffers".
#pragma once

#include "image/copy.h"
#include "object/memory.h"

namespace lapilli {

struct Buffer : Handle<Buffer, VkBuffer> {
  using Handle::Handle;

  uint64_t size = 0;          // bytes
  std::byte* data = nullptr;  // null until memory is bound

  BufferMemory bytes() { return {data, data != nullptr ? size : 0}; }
  // The bytes from `offset` on, at most `range`; none where nothing is bound or the offset lies outside.
  BufferMemory bytes(uint64_t offset, uint64_t range = VK_WHOLE_SIZE);
};

VkResult create_buffer(DeviceContext& device, const VkBufferCreateInfo& info, const VkAllocationCallbacks* callbacks,
                       VkBuffer* handle);
VkMemoryRequirements memory_requirements(const Buffer& buffer);
VkResult bind_memory(Buffer& buffer, DeviceMemory& memory, uint64_t offset);

// Texels in a buffer.
struct BufferView : Handle<BufferView, VkBufferView> {
  using Handle::Handle;

  TextureView texture;
};
VkResult create_buffer_view(DeviceContext& device, const VkBufferViewCreateInfo& info,
                            const VkAllocationCallbacks* callbacks, VkBufferView* handle);

}  // namespace lapilli
