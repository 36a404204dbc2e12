// The base of everything the application has a handle to, and the casts between handles and objects.
// Specification: chapter "Fundamentals", section "Object Model"; the loader's magic: vulkan/vk_icd.h.
#pragma once

#include <vulkan/vk_icd.h>

#include <cstdint>
#include <cstring>
#include <memory>
#include <type_traits>
#include <utility>

#include "object/host_memory.h"

namespace lapilli {

// A handle is the address of this base. The loader writes its dispatch table over the first word of dispatchable
// objects.
struct Object {
  VK_LOADER_DATA loader;
  HostMemory host;             // where the object itself and what it owns lie
  char* debug_name = nullptr;  // given by vkSetDebugUtilsObjectNameEXT

  explicit Object(const HostMemory& memory) : loader{ICD_LOADER_MAGIC}, host(memory) {}
  ~Object() { host.free(debug_name); }
  Object(const Object&) = delete;
  Object& operator=(const Object&) = delete;

  // Throws std::bad_alloc. Null takes the name away.
  void set_name(const char* text) {
    char* copy = nullptr;
    if (text != nullptr && *text != 0) {
      const size_t size = std::strlen(text) + 1;
      copy = static_cast<char*>(host.allocate(size, 1, VK_SYSTEM_ALLOCATION_SCOPE_OBJECT));
      std::memcpy(copy, text, size);
    }
    host.free(debug_name);
    debug_name = copy;
  }
};

// Where non-dispatchable handles are integers they hold the same address.
template <class H>
Object* object_of(H handle) {
  if constexpr (std::is_pointer_v<H>) {
    return reinterpret_cast<Object*>(handle);
  } else {
    return reinterpret_cast<Object*>(static_cast<uintptr_t>(handle));
  }
}

// Base of the struct T behind handles of type H.
template <class T, class H>
struct Handle : Object {
  using HandleType = H;
  using Object::Object;

  static T* from(H handle) { return static_cast<T*>(object_of(handle)); }
  H handle() {
    Object* object = this;
    if constexpr (std::is_pointer_v<H>) {
      return reinterpret_cast<H>(object);
    } else {
      return static_cast<H>(reinterpret_cast<uintptr_t>(object));
    }
  }
};

struct ObjectDeleter {
  template <class T>
  void operator()(T* object) const {
    const HostMemory host = object->host;
    object->~T();
    host.free(object);
  }
};
// An object that nobody outside knows yet.
template <class T>
using ObjectPtr = std::unique_ptr<T, ObjectDeleter>;

// T's constructor gets its HostMemory first. Throws std::bad_alloc.
template <class T, class... Arguments>
ObjectPtr<T> make_object(const HostMemory& host, VkSystemAllocationScope scope, Arguments&&... arguments) {
  void* memory = host.allocate(sizeof(T), alignof(T), scope);
  try {
    return ObjectPtr<T>(new (memory) T(host, std::forward<Arguments>(arguments)...));
  } catch (...) {
    host.free(memory);
    throw;
  }
}

template <class T>
VkResult publish(ObjectPtr<T> object, typename T::HandleType* handle) {
  *handle = object.release()->handle();
  return VK_SUCCESS;
}

// What vkDestroy… does; a null handle is allowed.
template <class T>
void destroy(T* object) {
  if (object != nullptr) ObjectDeleter()(object);
}

}  // namespace lapilli
