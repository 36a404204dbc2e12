// Host memory: the C library's allocator behind the interface of the application's.
#include "object/host_memory.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace lapilli {
namespace {

void* VKAPI_PTR system_allocate(void*, size_t size, size_t alignment, VkSystemAllocationScope) {
  const size_t align = std::max(alignment, sizeof(void*));
  if (size > SIZE_MAX - align) return nullptr;
  return std::aligned_alloc(align, (size + align - 1) / align * align);
}
void VKAPI_PTR system_free(void*, void* memory) { std::free(memory); }

}  // namespace

HostMemory::HostMemory() : callbacks_{} {
  callbacks_.pfnAllocation = system_allocate;
  callbacks_.pfnFree = system_free;
}

void* HostMemory::allocate(size_t size, size_t alignment, VkSystemAllocationScope scope) const {
  void* memory = callbacks_.pfnAllocation(callbacks_.pUserData, std::max<size_t>(size, 1), alignment, scope);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void HostMemory::free(void* memory) const noexcept {
  if (memory != nullptr) callbacks_.pfnFree(callbacks_.pUserData, memory);
}

}  // namespace lapilli
