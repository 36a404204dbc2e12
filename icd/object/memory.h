// VkDeviceMemory: anonymous mappings of the process, always mapped. Specification: chapter "Memory Allocation".
#pragma once

#include "object/device_context.h"

namespace lapilli {

struct DeviceMemory : Handle<DeviceMemory, VkDeviceMemory> {
  DeviceMemory(const HostMemory& memory, DeviceContext& owner) : Handle(memory), device(owner) {}
  ~DeviceMemory();

  DeviceContext& device;
  std::byte* data = nullptr;
  uint64_t mapped = 0;  // bytes, at least size
  uint64_t size = 0;    // bytes
};

VkResult allocate_memory(DeviceContext& device, const VkMemoryAllocateInfo& info,
                         const VkAllocationCallbacks* callbacks, VkDeviceMemory* handle);
// Has the kernel give these bytes their pages now, which it does when they are first touched otherwise.
void populate(const DeviceMemory& memory, uint64_t offset, uint64_t size);
VkResult map_memory(DeviceMemory& memory, uint64_t offset, uint64_t size, void** data);

}  // namespace lapilli
