// Device memory: what is given and what goes back.
#include "object/memory.h"

#include <gtest/gtest.h>

#include "object/test_context.h"

namespace lapilli {
namespace {

class Allocating : public testing::Test {
 protected:
  ObjectPtr<DeviceMemory> allocate(uint64_t size) {
    VkMemoryAllocateInfo info = {};
    info.allocationSize = size;
    VkDeviceMemory handle = VK_NULL_HANDLE;
    const VkResult result = allocate_memory(*context.device, info, nullptr, &handle);
    EXPECT_EQ(result, handle != VK_NULL_HANDLE ? VK_SUCCESS : VK_ERROR_OUT_OF_DEVICE_MEMORY);
    return ObjectPtr<DeviceMemory>(DeviceMemory::from(handle));
  }
  TestContext context;
};

TEST_F(Allocating, IsZeroFromFirstToLastByteAndGoesBack) {
  const uint64_t mb = 1 << 20;
  for (const uint64_t size : {uint64_t{1}, uint64_t{4097}, mb, 1280 * 720 * uint64_t{4}, 2 * mb, 5 * mb + 1}) {
    {
      const ObjectPtr<DeviceMemory> memory = allocate(size);
      ASSERT_NE(memory, nullptr);
      EXPECT_EQ(memory->size, size);
      EXPECT_EQ(context.device->allocated_bytes, size);
      // Large ones lie so that huge pages fit.
      EXPECT_EQ(reinterpret_cast<uintptr_t>(memory->data) % (size >= 2 * mb ? 2 * mb : 4096), 0u);
      for (const uint64_t at : {uint64_t{0}, size / 2, size - 1}) EXPECT_EQ(memory->data[at], std::byte{0});
      memory->data[0] = memory->data[size - 1] = std::byte{1};
    }
    EXPECT_EQ(context.device->allocated_bytes, 0u);
    EXPECT_EQ(context.device->allocation_count, 0u);
  }
}

// Pages that are there read as 0 and those around them stay as they are.
TEST_F(Allocating, PopulatedBytesAreZeroToo) {
  const uint64_t mb = 1 << 20;
  const ObjectPtr<DeviceMemory> memory = allocate(5 * mb);
  memory->data[100] = memory->data[3 * mb] = std::byte{7};
  populate(*memory, 256, 3 * mb);
  EXPECT_EQ(memory->data[100], std::byte{7});
  EXPECT_EQ(memory->data[3 * mb], std::byte{7});
  for (uint64_t at = 4096; at < 3 * mb; at += 4096) ASSERT_EQ(memory->data[at], std::byte{0});
}

TEST_F(Allocating, MoreThanTheHeapIsRefused) {
  const uint64_t heap = context.instance->physical_device.heap_size;
  for (const uint64_t size : {heap + 1, UINT64_MAX, UINT64_MAX - (1 << 20), uint64_t{0}}) {
    EXPECT_EQ(allocate(size), nullptr);
    EXPECT_EQ(context.device->allocated_bytes, 0u);
  }
}

}  // namespace
}  // namespace lapilli
