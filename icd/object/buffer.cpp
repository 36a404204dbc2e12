// Buffers and the memory bound to them.
#include "object/buffer.h"

#include <algorithm>

namespace lapilli {
namespace {

constexpr uint64_t kBufferAlignment = 64;  // bytes: a cache line, and any vector's alignment

}  // namespace

BufferMemory Buffer::bytes(uint64_t offset, uint64_t range) {
  if (data == nullptr || offset >= size) return {};
  return {data + offset, std::min(range, size - offset)};
}

VkResult create_buffer(DeviceContext& device, const VkBufferCreateInfo& info, const VkAllocationCallbacks* callbacks,
                       VkBuffer* handle) {
  if (info.flags != 0) {
    log_error("vkCreateBuffer: sparse and protected buffers are not supported");
    return VK_ERROR_UNKNOWN;
  }
  if (info.size == 0 || info.size > device.physical_device.heap_size) {
    log_error("vkCreateBuffer: a size of %llu bytes", static_cast<unsigned long long>(info.size));
    return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  }
  auto buffer = make_object<Buffer>(device.object_memory(callbacks), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  buffer->size = info.size;
  return publish(std::move(buffer), handle);
}

VkMemoryRequirements memory_requirements(const Buffer& buffer) {
  return {(buffer.size + kBufferAlignment - 1) / kBufferAlignment * kBufferAlignment, kBufferAlignment, 1};
}

VkResult bind_memory(Buffer& buffer, DeviceMemory& memory, uint64_t offset) {
  if (offset > memory.size || buffer.size > memory.size - offset || offset % kBufferAlignment != 0) {
    log_error("vkBindBufferMemory: the buffer does not lie aligned in the memory");
    return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  }
  buffer.data = memory.data + offset;
  return VK_SUCCESS;
}

VkResult create_buffer_view(DeviceContext& device, const VkBufferViewCreateInfo& info,
                            const VkAllocationCallbacks* callbacks, VkBufferView* handle) {
  const FormatInfo* format = find_format(info.format);
  if (format == nullptr || !format->has(kTexelBuffer)) {
    log_error("vkCreateBufferView: format %d has no texel buffers", info.format);
    return VK_ERROR_UNKNOWN;
  }
  const BufferMemory bytes = Buffer::from(info.buffer)->bytes(info.offset, info.range);
  auto view = make_object<BufferView>(device.object_memory(callbacks), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  view->texture = make_texel_buffer(*format, bytes.data, bytes.size);
  return publish(std::move(view), handle);
}

}  // namespace lapilli
