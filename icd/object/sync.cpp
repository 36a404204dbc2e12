// Waiting for fences, and the state of events.
#include "object/sync.h"

#include <algorithm>

namespace lapilli {

VkResult create_fence(DeviceContext& device, const VkFenceCreateInfo& info, const VkAllocationCallbacks* callbacks,
                      VkFence* handle) {
  auto fence = make_object<Fence>(device.object_memory(callbacks), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  fence->signaled = (info.flags & VK_FENCE_CREATE_SIGNALED_BIT) != 0;
  return publish(std::move(fence), handle);
}

VkResult create_semaphore(DeviceContext& device, const VkAllocationCallbacks* callbacks, VkSemaphore* handle) {
  return publish(make_object<Semaphore>(device.object_memory(callbacks), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT), handle);
}

VkResult create_event(DeviceContext& device, const VkAllocationCallbacks* callbacks, VkEvent* handle) {
  return publish(make_object<Event>(device.object_memory(callbacks), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT), handle);
}

VkResult fence_status(DeviceContext& device, const Fence& fence) {
  if (device.lost) return VK_ERROR_DEVICE_LOST;
  const std::scoped_lock lock(device.sync.mutex);
  return fence.signaled ? VK_SUCCESS : VK_NOT_READY;
}

VkResult reset_fences(DeviceContext& device, std::span<const VkFence> fences) {
  const std::scoped_lock lock(device.sync.mutex);
  for (VkFence fence : fences) Fence::from(fence)->signaled = false;
  return VK_SUCCESS;
}

VkResult wait_for_fences(DeviceContext& device, std::span<const VkFence> fences, bool all, uint64_t nanoseconds) {
  const auto deadline = deadline_after(nanoseconds);
  const auto signaled = [](VkFence fence) { return Fence::from(fence)->signaled; };
  const auto done = [&] {
    if (device.lost) return true;
    return all ? std::all_of(fences.begin(), fences.end(), signaled)
               : std::any_of(fences.begin(), fences.end(), signaled);
  };
  std::unique_lock lock(device.sync.mutex);
  if (deadline == std::chrono::steady_clock::time_point::max()) {
    device.sync.changed.wait(lock, done);
  } else if (!device.sync.changed.wait_until(lock, deadline, done)) {
    return VK_TIMEOUT;
  }
  return device.lost ? VK_ERROR_DEVICE_LOST : VK_SUCCESS;
}

VkResult event_status(DeviceContext& device, const Event& event) {
  if (device.lost) return VK_ERROR_DEVICE_LOST;
  const std::scoped_lock lock(device.sync.mutex);
  return event.signaled ? VK_EVENT_SET : VK_EVENT_RESET;
}

std::chrono::steady_clock::time_point deadline_after(uint64_t nanoseconds) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point now = Clock::now();
  const auto left = static_cast<uint64_t>((Clock::time_point::max() - now).count());
  if (nanoseconds >= left) return Clock::time_point::max();
  return now + std::chrono::nanoseconds(static_cast<int64_t>(nanoseconds));
}

}  // namespace lapilli
