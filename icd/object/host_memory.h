// Host memory of the driver's objects, taken from the application's callbacks where it gave some.
// Specification: chapter "Memory Allocation", section "Host Memory".
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <new>
#include <string>
#include <vector>

namespace lapilli {

// A copy of the callbacks: the application's structure need not live on.
class HostMemory {
 public:
  HostMemory();  // the C library's
  // The application's callbacks for this call, or else the parent's.
  HostMemory(const VkAllocationCallbacks* application, const HostMemory& parent)
      : callbacks_(application != nullptr ? *application : parent.callbacks_) {}

  // Throws std::bad_alloc.
  void* allocate(size_t size, size_t alignment, VkSystemAllocationScope scope) const;
  void free(void* memory) const noexcept;

 private:
  VkAllocationCallbacks callbacks_;
};

// For containers inside an object. The HostMemory must outlive the container.
template <class T>
class HostAllocator {
 public:
  using value_type = T;

  HostAllocator(const HostMemory& host, VkSystemAllocationScope scope = VK_SYSTEM_ALLOCATION_SCOPE_OBJECT)
      : host_(&host), scope_(scope) {}
  template <class U>
  HostAllocator(const HostAllocator<U>& other) : host_(other.host()), scope_(other.scope()) {}

  T* allocate(size_t count) {
    if (count > SIZE_MAX / sizeof(T)) throw std::bad_alloc();
    return static_cast<T*>(host_->allocate(count * sizeof(T), alignof(T), scope_));
  }
  void deallocate(T* memory, size_t) noexcept { host_->free(memory); }

  const HostMemory* host() const { return host_; }
  VkSystemAllocationScope scope() const { return scope_; }
  template <class U>
  bool operator==(const HostAllocator<U>& other) const {
    return host_ == other.host();
  }

 private:
  const HostMemory* host_;
  VkSystemAllocationScope scope_;
};

template <class T>
using HostVector = std::vector<T, HostAllocator<T>>;
using HostString = std::basic_string<char, std::char_traits<char>, HostAllocator<char>>;

}  // namespace lapilli
