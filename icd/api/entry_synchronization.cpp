// Entry points of chapter "Synchronization and Cache Control".
#include "api/entry.h"

namespace lapilli::entry {

VKAPI_ATTR VkResult VKAPI_CALL vkCreateFence(VkDevice device, const VkFenceCreateInfo* info,
                                             const VkAllocationCallbacks* callbacks, VkFence* fence) {
  return create_fence(*Device::from(device), *info, callbacks, fence);
}

VKAPI_ATTR void VKAPI_CALL vkDestroyFence(VkDevice, VkFence fence, const VkAllocationCallbacks*) {
  destroy(Fence::from(fence));
}

VKAPI_ATTR VkResult VKAPI_CALL vkGetFenceStatus(VkDevice device, VkFence fence) {
  return fence_status(*Device::from(device), *Fence::from(fence));
}

VKAPI_ATTR VkResult VKAPI_CALL vkResetFences(VkDevice device, uint32_t count, const VkFence* fences) {
  return reset_fences(*Device::from(device), list(fences, count));
}

VKAPI_ATTR VkResult VKAPI_CALL vkWaitForFences(VkDevice device, uint32_t count, const VkFence* fences, VkBool32 all,
                                               uint64_t nanoseconds) {
  return wait_for_fences(*Device::from(device), list(fences, count), all != VK_FALSE, nanoseconds);
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateSemaphore(VkDevice device, const VkSemaphoreCreateInfo*,
                                                 const VkAllocationCallbacks* callbacks, VkSemaphore* semaphore) {
  return create_semaphore(*Device::from(device), callbacks, semaphore);
}

VKAPI_ATTR void VKAPI_CALL vkDestroySemaphore(VkDevice, VkSemaphore semaphore, const VkAllocationCallbacks*) {
  destroy(Semaphore::from(semaphore));
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateEvent(VkDevice device, const VkEventCreateInfo*,
                                             const VkAllocationCallbacks* callbacks, VkEvent* event) {
  return create_event(*Device::from(device), callbacks, event);
}

VKAPI_ATTR void VKAPI_CALL vkDestroyEvent(VkDevice, VkEvent event, const VkAllocationCallbacks*) {
  destroy(Event::from(event));
}

VKAPI_ATTR VkResult VKAPI_CALL vkGetEventStatus(VkDevice device, VkEvent event) {
  return event_status(*Device::from(device), *Event::from(event));
}

VKAPI_ATTR VkResult VKAPI_CALL vkSetEvent(VkDevice device, VkEvent event) {
  set_signaled(*Device::from(device), *Event::from(event), true);
  return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL vkResetEvent(VkDevice device, VkEvent event) {
  set_signaled(*Device::from(device), *Event::from(event), false);
  return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL vkCmdSetEvent(VkCommandBuffer commands, VkEvent event, VkPipelineStageFlags) {
  record_set_event(*CommandBuffer::from(commands), Event::from(event), true);
}

VKAPI_ATTR void VKAPI_CALL vkCmdResetEvent(VkCommandBuffer commands, VkEvent event, VkPipelineStageFlags) {
  record_set_event(*CommandBuffer::from(commands), Event::from(event), false);
}

VKAPI_ATTR void VKAPI_CALL vkCmdWaitEvents(VkCommandBuffer commands, uint32_t count, const VkEvent* events,
                                           VkPipelineStageFlags, VkPipelineStageFlags, uint32_t, const VkMemoryBarrier*,
                                           uint32_t, const VkBufferMemoryBarrier*, uint32_t,
                                           const VkImageMemoryBarrier*) {
  record_wait_events(*CommandBuffer::from(commands), list(events, count));
}

VKAPI_ATTR void VKAPI_CALL vkCmdPipelineBarrier(VkCommandBuffer commands, VkPipelineStageFlags from,
                                                VkPipelineStageFlags to, VkDependencyFlags, uint32_t,
                                                const VkMemoryBarrier*, uint32_t, const VkBufferMemoryBarrier*,
                                                uint32_t, const VkImageMemoryBarrier*) {
  record_barrier(*CommandBuffer::from(commands), from, to);
}

}  // namespace lapilli::entry
