// VkCommandPool and VkCommandBuffer. Specification: chapter "Command Buffers".
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <type_traits>

#include "base/arena.h"
#include "command/command.h"
#include "object/device_context.h"

namespace lapilli {

struct CommandPool;

// The pool's host memory as a source of an arena's chunks.
class HostMemorySource final : public MemorySource {
 public:
  explicit HostMemorySource(const HostMemory& host) : host_(host) {}
  void* allocate(size_t bytes, size_t alignment) override {
    return host_.allocate(bytes, alignment, VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  }
  void release(void* memory, size_t) override { host_.free(memory); }

 private:
  const HostMemory& host_;
};

struct CommandBuffer : Handle<CommandBuffer, VkCommandBuffer> {
  CommandBuffer(const HostMemory& memory, CommandPool& owner, VkCommandBufferLevel command_level)
      : Handle(memory),
        pool(owner),
        level(command_level),
        source(host),
        arena(std::numeric_limits<size_t>::max(), kChunkBytes, source) {}

  static constexpr size_t kChunkBytes = 16 * 1024;

  CommandPool& pool;
  const VkCommandBufferLevel level;
  HostMemorySource source;
  Arena arena;
  const Command* first = nullptr;
  Command* last = nullptr;
  VkResult error = VK_SUCCESS;    // of recording; vkEndCommandBuffer returns it
  CommandBuffer* next = nullptr;  // list of the pool
  CommandBuffer* previous = nullptr;

  // Appends an empty command. Throws std::bad_alloc.
  template <class C>
  C& record() {
    auto* command = new (allocate(sizeof(C), alignof(C))) C();
    (last != nullptr ? last->next : first) = command;
    last = command;
    return *command;
  }
  // A copy of what the application passes by pointer.
  template <class T>
  std::span<const T> copy(std::span<const T> source_values) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::span<T> target = array<T>(source_values.size());
    std::copy(source_values.begin(), source_values.end(), target.begin());
    return target;
  }
  template <class T>
  std::span<T> array(size_t count) {
    if (count == 0) return {};
    T* data = arena.allocate_array<T>(count);
    if (data == nullptr) throw std::bad_alloc();
    return {data, count};
  }
  void reset(bool release_memory);

 private:
  void* allocate(size_t size, size_t alignment) {
    void* memory = arena.allocate(size, alignment);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
  }
};

struct CommandPool : Handle<CommandPool, VkCommandPool> {
  using Handle::Handle;
  ~CommandPool();

  CommandBuffer* first = nullptr;

  void free(CommandBuffer& buffer);
};

VkResult create_command_pool(DeviceContext& device, const VkAllocationCallbacks* callbacks, VkCommandPool* handle);
VkResult reset_command_pool(CommandPool& pool, VkCommandPoolResetFlags flags);
void trim_command_pool(CommandPool& pool);
// Either all or, with an error, none; then all handles are null.
VkResult allocate_command_buffers(const VkCommandBufferAllocateInfo& info, VkCommandBuffer* handles);

VkResult begin_command_buffer(CommandBuffer& buffer);
VkResult end_command_buffer(CommandBuffer& buffer);

}  // namespace lapilli
