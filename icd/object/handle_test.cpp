// Handles, the loader's magic, names, and where objects get their memory.
#include "object/handle.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

namespace lapilli {
namespace {

struct Thing : Handle<Thing, VkBuffer> {
  explicit Thing(const HostMemory& memory, int number) : Handle(memory), value(number), words(host) {}
  int value;
  HostVector<uint64_t> words;
};
struct Dispatched : Handle<Dispatched, VkQueue> {
  using Handle::Handle;
};

// Application callbacks that count, and that refuse the allocation number `fail_at`.
struct Counter {
  std::map<void*, size_t> live;
  int allocations = 0;
  int fail_at = -1;
  bool misused = false;

  VkAllocationCallbacks callbacks() {
    VkAllocationCallbacks result = {};
    result.pUserData = this;
    result.pfnAllocation = [](void* user, size_t size, size_t alignment, VkSystemAllocationScope) -> void* {
      auto* self = static_cast<Counter*>(user);
      if (self->allocations++ == self->fail_at) return nullptr;
      self->misused |= size == 0 || (alignment & (alignment - 1)) != 0;
      void* memory = std::aligned_alloc(64, (size + 63) / 64 * 64);
      self->live[memory] = size;
      return memory;
    };
    result.pfnFree = [](void* user, void* memory) {
      auto* self = static_cast<Counter*>(user);
      self->misused |= self->live.erase(memory) != 1;
      std::free(memory);
    };
    return result;
  }
};

TEST(Handle, GoesThereAndBack) {
  auto thing = make_object<Thing>(HostMemory(), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT, 7);
  const VkBuffer handle = thing->handle();
  EXPECT_NE(handle, VkBuffer{VK_NULL_HANDLE});
  EXPECT_EQ(Thing::from(handle), thing.get());
  EXPECT_EQ(Thing::from(handle)->value, 7);
}

TEST(Handle, NullStaysNull) { EXPECT_EQ(Thing::from(VK_NULL_HANDLE), nullptr); }

TEST(Handle, LoaderFindsItsMagicWhereTheHandlePoints) {
  auto object = make_object<Dispatched>(HostMemory(), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  EXPECT_TRUE(valid_loader_magic_value(object->handle()));
}

TEST(Handle, ObjectAndContentsComeFromTheApplication) {
  Counter counter;
  const VkAllocationCallbacks callbacks = counter.callbacks();
  {
    auto thing = make_object<Thing>(HostMemory(&callbacks, HostMemory()), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT, 1);
    EXPECT_EQ(counter.live.size(), 1u);
    thing->words.resize(100);
    EXPECT_EQ(counter.live.size(), 2u);
    thing->set_name("a thing");
    EXPECT_EQ(counter.live.size(), 3u);
    EXPECT_STREQ(thing->debug_name, "a thing");
    thing->set_name(nullptr);
    EXPECT_EQ(thing->debug_name, nullptr);
    EXPECT_EQ(counter.live.size(), 2u);
    thing->set_name("again");
  }
  EXPECT_TRUE(counter.live.empty());
  EXPECT_FALSE(counter.misused);
}

TEST(Handle, ParentsCallbacksServeWhereTheCallGivesNone) {
  Counter counter;
  const VkAllocationCallbacks callbacks = counter.callbacks();
  const HostMemory parent(&callbacks, HostMemory());
  auto thing = make_object<Thing>(HostMemory(nullptr, parent), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT, 1);
  EXPECT_EQ(counter.live.size(), 1u);
}

TEST(Handle, RefusedMemoryLeavesNothingBehind) {
  for (int fail_at = 0; fail_at < 2; ++fail_at) {
    Counter counter;
    counter.fail_at = fail_at;
    const VkAllocationCallbacks callbacks = counter.callbacks();
    EXPECT_THROW(
        {
          auto thing = make_object<Thing>(HostMemory(&callbacks, HostMemory()), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT, 1);
          thing->words.resize(10);
        },
        std::bad_alloc);
    EXPECT_TRUE(counter.live.empty());
    EXPECT_FALSE(counter.misused);
  }
}

}  // namespace
}  // namespace lapilli
