// Device memory by mmap: zero at first, and given by the kernel page by page as it is touched.
#include "object/memory.h"

#include <sys/mman.h>

#include "object/limits.h"

namespace lapilli {
namespace {

// Bytes. A frame that first touches its targets takes one page fault for each of them.
constexpr uint64_t kHugePage = uint64_t{2} << 20;

// Whole huge pages where they add less than a quarter.
uint64_t mapped_bytes(uint64_t size) {
  const uint64_t whole = (size + kHugePage - 1) / kHugePage * kHugePage;
  return whole - size <= size / 4 ? whole : size;
}

// Memory of `bytes`, aligned to huge pages if it has room for one; MAP_FAILED if there is none.
void* map(uint64_t bytes) {
  const uint64_t slack = bytes >= kHugePage ? kHugePage : 0;
  void* const memory =
      mmap(nullptr, bytes + slack, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED || slack == 0) return memory;
  std::byte* const begin = static_cast<std::byte*>(memory);
  const uint64_t head = -reinterpret_cast<uintptr_t>(begin) % kHugePage;
  if (head != 0) munmap(begin, head);
  if (head != slack) munmap(begin + head + bytes, slack - head);
  madvise(begin + head, bytes, MADV_HUGEPAGE);
  return begin + head;
}

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
  munmap(data, mapped);
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
  const uint64_t mapped = mapped_bytes(info.allocationSize);
  void* const data = map(mapped);
  if (data == MAP_FAILED) {
    device.allocated_bytes -= info.allocationSize;
    --device.allocation_count;
    return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  }
  memory->data = static_cast<std::byte*>(data);
  memory->size = info.allocationSize;
  memory->mapped = mapped;
  return publish(std::move(memory), handle);
}

// Linux 5.14; older kernels refuse, and the pages come with the first touch.
void populate(const DeviceMemory& memory, uint64_t offset, uint64_t size) {
  constexpr int kPopulateWrite = 23;  // MADV_POPULATE_WRITE
  constexpr uint64_t kLargestPage = 65536;
  const uint64_t first = offset / kLargestPage * kLargestPage;
  madvise(memory.data + first, offset + size - first, kPopulateWrite);
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
