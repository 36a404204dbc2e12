// Device memory by mmap: zero at first, and given by the kernel page by page as it is touched.
#include "object/memory.h"

#include <sys/mman.h>

#include "object/limits.h"

namespace lapilli {
namespace {

// From here on the kernel is asked for huge pages: fewer page faults when a frame first touches its targets.
constexpr uint64_t kHugePage = uint64_t{2} << 20;

// Takes `size` bytes of the heap, or none.
bool reserve(DeviceContext& device, uint64_t size) {
  uint64_t used = device.allocated_bytes.load();
  do {
    if (size > device.physical_device.heap_size - used) return false;
  } while (!device.allocated_bytes.compare_exchange_weak(used, used + size));
  return true;
}

}  // namespace

DeviceMemory::~DeviceMemory() {
  if (data == nullptr) return;
  munmap(data, size);
  device.allocated_bytes -= size;
  --device.allocation_count;
}

VkResult allocate_memory(DeviceContext& device, const VkMemoryAllocateInfo& info,
                         const VkAllocationCallbacks* callbacks, VkDeviceMemory* handle) {
  auto memory = make_object<DeviceMemory>(device.object_memory(callbacks), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT, device);
  if (info.allocationSize == 0 || info.memoryTypeIndex != 0) {
    log_error("vkAllocateMemory: %s", info.allocationSize == 0 ? "no bytes asked for" : "there is only memory type 0");
    return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  }
  if (device.allocation_count.fetch_add(1) >= kMaxMemoryAllocations) {
    --device.allocation_count;
    return VK_ERROR_TOO_MANY_OBJECTS;
  }
  if (!reserve(device, info.allocationSize)) {
    --device.allocation_count;
    log_warning("vkAllocateMemory: %llu bytes do not fit the heap",
                static_cast<unsigned long long>(info.allocationSize));
    return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  }
  void* data =
      mmap(nullptr, info.allocationSize, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (data == MAP_FAILED) {
    device.allocated_bytes -= info.allocationSize;
    --device.allocation_count;
    return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  }
  if (info.allocationSize >= kHugePage) madvise(data, info.allocationSize, MADV_HUGEPAGE);
  memory->data = static_cast<std::byte*>(data);
  memory->size = info.allocationSize;
  return publish(std::move(memory), handle);
}

VkResult map_memory(DeviceMemory& memory, uint64_t offset, uint64_t size, void** data) {
  if (offset >= memory.size || (size != VK_WHOLE_SIZE && size > memory.size - offset)) {
    log_error("vkMapMemory: the range does not lie in the memory");
    return VK_ERROR_MEMORY_MAP_FAILED;
  }
  *data = memory.data + offset;
  return VK_SUCCESS;
}

}  // namespace lapilli
