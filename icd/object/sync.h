// Fences, semaphores and events: flags guarded by the device's SyncDomain.
// Specification: chapter "Synchronization and Cache Control".
#pragma once

#include <chrono>
#include <span>

#include "object/device_context.h"

namespace lapilli {

struct Fence : Handle<Fence, VkFence> {
  using Handle::Handle;
  bool signaled = false;
};
struct Semaphore : Handle<Semaphore, VkSemaphore> {
  using Handle::Handle;
  bool signaled = false;
};
struct Event : Handle<Event, VkEvent> {
  using Handle::Handle;
  bool signaled = false;
};

VkResult create_fence(DeviceContext& device, const VkFenceCreateInfo& info, const VkAllocationCallbacks* callbacks,
                      VkFence* handle);
VkResult create_semaphore(DeviceContext& device, const VkAllocationCallbacks* callbacks, VkSemaphore* handle);
VkResult create_event(DeviceContext& device, const VkAllocationCallbacks* callbacks, VkEvent* handle);

template <class T>
void set_signaled(DeviceContext& device, T& object, bool signaled) {
  const std::scoped_lock lock(device.sync.mutex);
  object.signaled = signaled;
  if (signaled) device.sync.changed.notify_all();
}

// VK_SUCCESS or VK_NOT_READY; VK_ERROR_DEVICE_LOST if it is.
VkResult fence_status(DeviceContext& device, const Fence& fence);
VkResult reset_fences(DeviceContext& device, std::span<const VkFence> fences);
// VK_TIMEOUT after `nanoseconds`; UINT64_MAX means no limit.
VkResult wait_for_fences(DeviceContext& device, std::span<const VkFence> fences, bool all, uint64_t nanoseconds);
// VK_EVENT_SET or VK_EVENT_RESET.
VkResult event_status(DeviceContext& device, const Event& event);

// The moment `nanoseconds` from now, or the end of time if the clock cannot count that far.
std::chrono::steady_clock::time_point deadline_after(uint64_t nanoseconds);

}  // namespace lapilli
