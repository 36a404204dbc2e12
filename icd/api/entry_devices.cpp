// Entry points of chapters "Devices and Queues" and "Command Buffers" (submission).
#include "api/entry.h"

namespace lapilli::entry {

VKAPI_ATTR VkResult VKAPI_CALL vkCreateDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                              const VkAllocationCallbacks* callbacks, VkDevice* device) {
  return create_device(*PhysicalDevice::from(physical), *info, callbacks, device);
}

VKAPI_ATTR void VKAPI_CALL vkDestroyDevice(VkDevice device, const VkAllocationCallbacks*) {
  destroy(Device::from(device));
}

VKAPI_ATTR void VKAPI_CALL vkGetDeviceQueue(VkDevice device, uint32_t family, uint32_t index, VkQueue* queue) {
  *queue = get_queue(*Device::from(device), family, index);
}

VKAPI_ATTR VkResult VKAPI_CALL vkDeviceWaitIdle(VkDevice device) { return Device::from(device)->queue->wait_idle(); }

VKAPI_ATTR VkResult VKAPI_CALL vkQueueWaitIdle(VkQueue queue) { return Queue::from(queue)->wait_idle(); }

VKAPI_ATTR VkResult VKAPI_CALL vkQueueSubmit(VkQueue queue, uint32_t count, const VkSubmitInfo* batches,
                                             VkFence fence) {
  return Queue::from(queue)->submit(list(batches, count), Fence::from(fence));
}

VKAPI_ATTR VkResult VKAPI_CALL vkQueueBindSparse(VkQueue queue, uint32_t count, const VkBindSparseInfo* batches,
                                                 VkFence fence) {
  return Queue::from(queue)->bind_sparse(list(batches, count), Fence::from(fence));
}

}  // namespace lapilli::entry
