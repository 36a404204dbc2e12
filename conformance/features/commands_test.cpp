// Command buffers, fences and semaphores. Specification: "Command Buffers", "Synchronization and Cache Control".
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <span>
#include <thread>

#include "common/resources.h"
#include "harness/devices.h"

namespace lapilli::conformance {
namespace {

using samples::check;

class Commands : public testing::Test {
 protected:
  const samples::Context& c = subject();
  samples::CommandPool pool = make_pool();
  samples::Buffer buffer{subject(), 1024, VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT};

  samples::CommandPool make_pool() const {
    VkCommandPoolCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    info.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    info.queueFamilyIndex = c.queue_family();
    VkCommandPool raw = VK_NULL_HANDLE;
    check(vkCreateCommandPool(c.device(), &info, nullptr, &raw), "vkCreateCommandPool");
    return {c.device(), raw};
  }
  VkCommandBuffer allocate(VkCommandBufferLevel level = VK_COMMAND_BUFFER_LEVEL_PRIMARY) const {
    VkCommandBufferAllocateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    info.commandPool = pool.get();
    info.level = level;
    info.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    check(vkAllocateCommandBuffers(c.device(), &info, &commands), "vkAllocateCommandBuffers");
    return commands;
  }
  static void begin(VkCommandBuffer commands, VkCommandBufferUsageFlags flags = 0) {
    VkCommandBufferInheritanceInfo inheritance = {};
    inheritance.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_INHERITANCE_INFO;
    VkCommandBufferBeginInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    info.flags = flags;
    info.pInheritanceInfo = &inheritance;  // ignored for primary ones
    check(vkBeginCommandBuffer(commands, &info), "vkBeginCommandBuffer");
  }
  // Records: words [first, first + count) := value.
  void fill(VkCommandBuffer commands, uint32_t first, uint32_t count, uint32_t value) const {
    vkCmdFillBuffer(commands, buffer.get(), first * 4, count * 4, value);
  }
  samples::Fence make_fence(VkFenceCreateFlags flags = 0) const {
    VkFenceCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    info.flags = flags;
    VkFence raw = VK_NULL_HANDLE;
    check(vkCreateFence(c.device(), &info, nullptr, &raw), "vkCreateFence");
    return {c.device(), raw};
  }
  VkResult submit(std::span<const VkCommandBuffer> commands, VkFence fence, VkSemaphore wait = VK_NULL_HANDLE,
                  VkSemaphore signal = VK_NULL_HANDLE) const {
    const VkPipelineStageFlags stage = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
    VkSubmitInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    info.waitSemaphoreCount = wait != VK_NULL_HANDLE ? 1 : 0;
    info.pWaitSemaphores = &wait;
    info.pWaitDstStageMask = &stage;
    info.commandBufferCount = uint32_t(commands.size());
    info.pCommandBuffers = commands.data();
    info.signalSemaphoreCount = signal != VK_NULL_HANDLE ? 1 : 0;
    info.pSignalSemaphores = &signal;
    return vkQueueSubmit(c.queue(), 1, &info, fence);
  }
  void run(VkCommandBuffer commands) const {
    ASSERT_EQ(submit({&commands, 1}, VK_NULL_HANDLE), VK_SUCCESS);
    ASSERT_EQ(vkQueueWaitIdle(c.queue()), VK_SUCCESS);
  }
  uint32_t word(size_t i) const {
    uint32_t out;
    std::memcpy(&out, static_cast<const std::byte*>(buffer.data()) + i * 4, 4);
    return out;
  }
};

TEST_F(Commands, ABufferCanBeSubmittedAgain) {
  const VkCommandBuffer commands = allocate();
  begin(commands);
  fill(commands, 0, 4, 11);
  ASSERT_EQ(vkEndCommandBuffer(commands), VK_SUCCESS);
  for (int i = 0; i < 3; ++i) {
    std::memset(buffer.data(), 0, 1024);
    run(commands);
    EXPECT_EQ(word(3), 11u);
  }
}

TEST_F(Commands, ResetAndRecordAgain) {
  const VkCommandBuffer commands = allocate();
  begin(commands);
  fill(commands, 0, 4, 1);
  ASSERT_EQ(vkEndCommandBuffer(commands), VK_SUCCESS);
  ASSERT_EQ(vkResetCommandBuffer(commands, 0), VK_SUCCESS);
  begin(commands);
  fill(commands, 8, 4, 2);
  ASSERT_EQ(vkEndCommandBuffer(commands), VK_SUCCESS);
  std::memset(buffer.data(), 0, 1024);
  run(commands);
  EXPECT_EQ(word(0), 0u);
  EXPECT_EQ(word(8), 2u);
  begin(commands);  // an implicit reset
  fill(commands, 16, 1, 3);
  ASSERT_EQ(vkEndCommandBuffer(commands), VK_SUCCESS);
  std::memset(buffer.data(), 0, 1024);
  run(commands);
  EXPECT_EQ(word(8), 0u);
  EXPECT_EQ(word(16), 3u);
  ASSERT_EQ(vkResetCommandPool(c.device(), pool.get(), VK_COMMAND_POOL_RESET_RELEASE_RESOURCES_BIT), VK_SUCCESS);
  begin(commands, VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT);
  fill(commands, 20, 1, 4);
  ASSERT_EQ(vkEndCommandBuffer(commands), VK_SUCCESS);
  run(commands);
  EXPECT_EQ(word(20), 4u);
}

TEST_F(Commands, SecondaryBuffersExecuteInOrder) {
  const VkCommandBuffer primary = allocate(), first = allocate(VK_COMMAND_BUFFER_LEVEL_SECONDARY),
                        second = allocate(VK_COMMAND_BUFFER_LEVEL_SECONDARY);
  begin(first, VK_COMMAND_BUFFER_USAGE_SIMULTANEOUS_USE_BIT);
  fill(first, 0, 8, 1);
  ASSERT_EQ(vkEndCommandBuffer(first), VK_SUCCESS);
  begin(second);
  fill(second, 4, 8, 2);
  ASSERT_EQ(vkEndCommandBuffer(second), VK_SUCCESS);
  begin(primary);
  const VkCommandBuffer both[] = {first, second};
  vkCmdExecuteCommands(primary, 2, both);
  ASSERT_EQ(vkEndCommandBuffer(primary), VK_SUCCESS);
  run(primary);
  EXPECT_EQ(word(3), 1u);
  EXPECT_EQ(word(4), 2u);
  EXPECT_EQ(word(11), 2u);
}

TEST_F(Commands, SubmissionsAreDoneInOrder) {
  std::vector<VkCommandBuffer> all;
  for (uint32_t i = 0; i < 50; ++i) {
    all.push_back(allocate());
    begin(all.back());
    fill(all.back(), i % 7, 10, i);
    ASSERT_EQ(vkEndCommandBuffer(all.back()), VK_SUCCESS);
  }
  std::memset(buffer.data(), 0xFF, 1024);
  for (size_t i = 0; i < 50; i += 5) {
    ASSERT_EQ(submit({&all[i], 5}, VK_NULL_HANDLE), VK_SUCCESS);
  }
  ASSERT_EQ(vkDeviceWaitIdle(c.device()), VK_SUCCESS);
  uint32_t want[17];
  std::memset(want, 0xFF, sizeof(want));
  for (uint32_t i = 0; i < 50; ++i) {
    for (uint32_t k = 0; k < 10; ++k) want[i % 7 + k] = i;
  }
  for (size_t i = 0; i < 17; ++i) EXPECT_EQ(word(i), want[i]) << i;
}

TEST_F(Commands, FencesSignalAndReset) {
  const samples::Fence created_signaled = make_fence(VK_FENCE_CREATE_SIGNALED_BIT), fence = make_fence();
  EXPECT_EQ(vkGetFenceStatus(c.device(), created_signaled.get()), VK_SUCCESS);
  EXPECT_EQ(vkGetFenceStatus(c.device(), fence.get()), VK_NOT_READY);
  EXPECT_EQ(vkWaitForFences(c.device(), 1, fence.address(), VK_TRUE, 0), VK_TIMEOUT);
  EXPECT_EQ(vkWaitForFences(c.device(), 1, fence.address(), VK_TRUE, 1000000), VK_TIMEOUT);
  const VkCommandBuffer commands = allocate();
  begin(commands);
  fill(commands, 0, 4, 5);
  ASSERT_EQ(vkEndCommandBuffer(commands), VK_SUCCESS);
  ASSERT_EQ(submit({&commands, 1}, fence.get()), VK_SUCCESS);
  EXPECT_EQ(vkWaitForFences(c.device(), 1, fence.address(), VK_TRUE, UINT64_MAX), VK_SUCCESS);
  EXPECT_EQ(vkGetFenceStatus(c.device(), fence.get()), VK_SUCCESS);
  EXPECT_EQ(word(0), 5u);
  EXPECT_EQ(vkResetFences(c.device(), 1, fence.address()), VK_SUCCESS);
  EXPECT_EQ(vkGetFenceStatus(c.device(), fence.get()), VK_NOT_READY);
  // One of two, and both.
  const VkFence two[] = {fence.get(), created_signaled.get()};
  EXPECT_EQ(vkWaitForFences(c.device(), 2, two, VK_FALSE, UINT64_MAX), VK_SUCCESS);
  EXPECT_EQ(vkWaitForFences(c.device(), 2, two, VK_TRUE, 1000), VK_TIMEOUT);
  // A submission of nothing signals too.
  ASSERT_EQ(vkQueueSubmit(c.queue(), 0, nullptr, fence.get()), VK_SUCCESS);
  EXPECT_EQ(vkWaitForFences(c.device(), 2, two, VK_TRUE, UINT64_MAX), VK_SUCCESS);
}

TEST_F(Commands, AnotherThreadMayWait) {
  const samples::Fence fence = make_fence();
  const VkCommandBuffer commands = allocate();
  begin(commands);
  for (int i = 0; i < 20000; ++i) fill(commands, 0, 256, 6);  // long enough to wait for
  ASSERT_EQ(vkEndCommandBuffer(commands), VK_SUCCESS);
  VkResult waited = VK_NOT_READY;
  ASSERT_EQ(submit({&commands, 1}, fence.get()), VK_SUCCESS);
  std::thread waiter([&] { waited = vkWaitForFences(c.device(), 1, fence.address(), VK_TRUE, 20'000'000'000); });
  waiter.join();
  EXPECT_EQ(waited, VK_SUCCESS);
}

TEST_F(Commands, SemaphoresOrderSubmissions) {
  VkSemaphoreCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
  VkSemaphore semaphore = VK_NULL_HANDLE;
  ASSERT_EQ(vkCreateSemaphore(c.device(), &info, nullptr, &semaphore), VK_SUCCESS);
  const VkCommandBuffer first = allocate(), second = allocate();
  begin(first);
  fill(first, 0, 8, 1);
  ASSERT_EQ(vkEndCommandBuffer(first), VK_SUCCESS);
  begin(second);
  const VkBufferCopy region = {0, 512, 32};
  vkCmdCopyBuffer(second, buffer.get(), buffer.get(), 1, &region);
  ASSERT_EQ(vkEndCommandBuffer(second), VK_SUCCESS);
  for (int round = 0; round < 3; ++round) {  // a binary semaphore is unsignaled by the wait: used again
    std::memset(buffer.data(), 0, 1024);
    ASSERT_EQ(submit({&first, 1}, VK_NULL_HANDLE, VK_NULL_HANDLE, semaphore), VK_SUCCESS);
    ASSERT_EQ(submit({&second, 1}, VK_NULL_HANDLE, semaphore), VK_SUCCESS);
    ASSERT_EQ(vkQueueWaitIdle(c.queue()), VK_SUCCESS);
    EXPECT_EQ(word(128), 1u);
    EXPECT_EQ(word(135), 1u);
  }
  vkDestroySemaphore(c.device(), semaphore, nullptr);
}

TEST_F(Commands, EventsBetweenHostAndDevice) {
  VkEventCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_EVENT_CREATE_INFO;
  VkEvent event = VK_NULL_HANDLE;
  ASSERT_EQ(vkCreateEvent(c.device(), &info, nullptr, &event), VK_SUCCESS);
  EXPECT_EQ(vkGetEventStatus(c.device(), event), VK_EVENT_RESET);
  ASSERT_EQ(vkSetEvent(c.device(), event), VK_SUCCESS);
  EXPECT_EQ(vkGetEventStatus(c.device(), event), VK_EVENT_SET);
  ASSERT_EQ(vkResetEvent(c.device(), event), VK_SUCCESS);
  const VkCommandBuffer commands = allocate();
  begin(commands);
  vkCmdSetEvent(commands, event, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT);
  ASSERT_EQ(vkEndCommandBuffer(commands), VK_SUCCESS);
  run(commands);
  EXPECT_EQ(vkGetEventStatus(c.device(), event), VK_EVENT_SET);
  vkDestroyEvent(c.device(), event, nullptr);
}

}  // namespace
}  // namespace lapilli::conformance
