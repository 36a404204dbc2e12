// VkDevice: the thread pool and the one queue. Specification: chapter "Devices and Queues".
#pragma once

#include <memory>

#include "queue/queue.h"

namespace lapilli {

struct Device : Handle<Device, VkDevice>, DeviceContext {
  Device(const HostMemory& memory, PhysicalDevice& physical);

  ThreadPool pool;
  ObjectPtr<Queue> queue;  // after the pool that it uses
};

VkResult create_device(PhysicalDevice& physical, const VkDeviceCreateInfo& info, const VkAllocationCallbacks* callbacks,
                       VkDevice* handle);
// Null if there is no such queue.
VkQueue get_queue(Device& device, uint32_t family, uint32_t index);

}  // namespace lapilli
