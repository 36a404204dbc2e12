// What the objects of a device share. The device itself, with its queue, is in queue/.
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>

#include "base/log.h"
#include "object/extensions.h"
#include "object/physical_device.h"

namespace lapilli {

// Guards the state of all fences, semaphores, events and queries of a device, and wakes those who wait for a change.
// One for all: they change a few times a frame, and waiting for any of several needs a common signal.
struct SyncDomain {
  std::mutex mutex;
  std::condition_variable changed;
};

struct DeviceContext {
  DeviceContext(const HostMemory& memory, PhysicalDevice& physical) : host_memory(memory), physical_device(physical) {}

  const HostMemory& host_memory;  // parent of all objects' memory
  PhysicalDevice& physical_device;
  ExtensionSet extensions;
  SyncDomain sync;
  std::atomic<bool> lost{false};
  std::atomic<uint64_t> allocated_bytes{0};
  std::atomic<uint32_t> allocation_count{0};

  HostMemory object_memory(const VkAllocationCallbacks* callbacks) const { return HostMemory(callbacks, host_memory); }
};

}  // namespace lapilli
