// Submissions: order, semaphores, fences, and commands that need no shader.
#include "queue/queue.h"

#include <gtest/gtest.h>

#include <array>
#include <thread>

#include "object/test_context.h"
#include "queue/device.h"

namespace lapilli {
namespace {

class Submitting : public testing::Test {
 protected:
  TestContext context;
  ObjectPtr<Device> device =
      make_object<Device>(HostMemory(), VK_SYSTEM_ALLOCATION_SCOPE_DEVICE, context.instance->physical_device);
  ObjectPtr<CommandPool> pool = make_object<CommandPool>(HostMemory(), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  ObjectPtr<Buffer> buffer = make_object<Buffer>(HostMemory(), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  ObjectPtr<Fence> fence = make_object<Fence>(HostMemory(), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  alignas(64) std::array<uint32_t, 16> words{};

  void SetUp() override {
    buffer->data = reinterpret_cast<std::byte*>(words.data());
    buffer->size = sizeof(words);
  }
  CommandBuffer& allocate() {
    VkCommandBufferAllocateInfo info = {};
    info.commandPool = pool->handle();
    info.commandBufferCount = 1;
    VkCommandBuffer handle = VK_NULL_HANDLE;
    EXPECT_EQ(allocate_command_buffers(info, &handle), VK_SUCCESS);
    return *CommandBuffer::from(handle);
  }
  void submit(CommandBuffer& commands, Semaphore* wait = nullptr, Semaphore* signal = nullptr, Fence* done = nullptr) {
    const VkCommandBuffer handle = commands.handle();
    const VkSemaphore wait_handle = wait != nullptr ? wait->handle() : VkSemaphore{VK_NULL_HANDLE};
    const VkSemaphore signal_handle = signal != nullptr ? signal->handle() : VkSemaphore{VK_NULL_HANDLE};
    VkSubmitInfo info = {};
    info.commandBufferCount = 1;
    info.pCommandBuffers = &handle;
    info.waitSemaphoreCount = wait != nullptr ? 1 : 0;
    info.pWaitSemaphores = &wait_handle;
    info.signalSemaphoreCount = signal != nullptr ? 1 : 0;
    info.pSignalSemaphores = &signal_handle;
    ASSERT_EQ(device->queue->submit({&info, 1}, done), VK_SUCCESS);
  }
};

TEST_F(Submitting, FillsUpdatesAndCopies) {
  CommandBuffer& commands = allocate();
  record_fill_buffer(commands, buffer.get(), 8, VK_WHOLE_SIZE, 7);
  const uint32_t update[2] = {1, 2};
  record_update_buffer(commands, buffer.get(), 16, std::as_bytes(std::span(update)));
  const VkBufferCopy regions[] = {{16, 0, 8}, {0, 60, 8}};  // the second does not fit and is skipped
  record_copy_buffer(commands, buffer.get(), buffer.get(), regions);
  submit(commands);
  ASSERT_EQ(device->queue->wait_idle(), VK_SUCCESS);
  EXPECT_EQ(words, (std::array<uint32_t, 16>{1, 2, 7, 7, 1, 2, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7}));
}

TEST_F(Submitting, FillsOfASizeThatIsNoWholeNumberOfWords) {
  buffer->size = 63;
  CommandBuffer& commands = allocate();
  record_fill_buffer(commands, buffer.get(), 0, VK_WHOLE_SIZE, 9);
  record_fill_buffer(commands, buffer.get(), 128, 4, 1);
  submit(commands);
  ASSERT_EQ(device->queue->wait_idle(), VK_SUCCESS);
  EXPECT_EQ(words[14], 9u);
  EXPECT_EQ(words[15], 0u);
}

TEST_F(Submitting, FencesFollowTheWork) {
  CommandBuffer& commands = allocate();
  record_fill_buffer(commands, buffer.get(), 0, 4, 3);
  submit(commands, nullptr, nullptr, fence.get());
  const VkFence handle = fence->handle();
  ASSERT_EQ(wait_for_fences(*device, {&handle, 1}, true, UINT64_MAX), VK_SUCCESS);
  EXPECT_EQ(words[0], 3u);
  ASSERT_EQ(reset_fences(*device, {&handle, 1}), VK_SUCCESS);
  ASSERT_EQ(device->queue->submit({}, fence.get()), VK_SUCCESS);  // no batch: the fence alone
  EXPECT_EQ(wait_for_fences(*device, {&handle, 1}, true, UINT64_MAX), VK_SUCCESS);
}

TEST_F(Submitting, SemaphoresAreTakenBackByTheWait) {
  auto semaphore = make_object<Semaphore>(HostMemory(), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  CommandBuffer& first = allocate();
  CommandBuffer& second = allocate();
  record_fill_buffer(first, buffer.get(), 0, 4, 1);
  record_fill_buffer(second, buffer.get(), 0, 4, 2);
  submit(first, nullptr, semaphore.get());
  submit(second, semaphore.get());
  ASSERT_EQ(device->queue->wait_idle(), VK_SUCCESS);
  EXPECT_EQ(words[0], 2u);
  EXPECT_FALSE(semaphore->signaled);
}

TEST_F(Submitting, TheQueueWaitsForAnEventOfTheHost) {
  auto event = make_object<Event>(HostMemory(), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  CommandBuffer& commands = allocate();
  const VkEvent handle = event->handle();
  record_wait_events(commands, {&handle, 1});
  record_set_event(commands, event.get(), false);
  record_fill_buffer(commands, buffer.get(), 0, 4, 5);
  submit(commands, nullptr, nullptr, fence.get());
  EXPECT_EQ(fence_status(*device, *fence), VK_NOT_READY);
  set_signaled(*device, *event, true);
  ASSERT_EQ(device->queue->wait_idle(), VK_SUCCESS);
  EXPECT_EQ(words[0], 5u);
  EXPECT_EQ(event_status(*device, *event), VK_EVENT_RESET);
}

TEST_F(Submitting, TimestampsRiseAndQueriesAreCopied) {
  auto queries = make_object<QueryPool>(HostMemory(), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT, *device, 2u);
  queries->type = VK_QUERY_TYPE_TIMESTAMP;
  CommandBuffer& commands = allocate();
  record_reset_query_pool(commands, queries.get(), 0, 2);
  record_write_timestamp(commands, queries.get(), 0);
  record_write_timestamp(commands, queries.get(), 1);
  record_copy_query_pool_results(commands, queries.get(), 0, 2, buffer.get(),
                                 {16, 8, VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT});
  submit(commands);
  ASSERT_EQ(device->queue->wait_idle(), VK_SUCCESS);
  EXPECT_GT(queries->queries[0].value, 0u);
  EXPECT_GE(queries->queries[1].value, queries->queries[0].value);
  uint64_t copied[2];
  std::memcpy(copied, &words[4], sizeof(copied));
  EXPECT_EQ(copied[0], queries->queries[0].value);
  EXPECT_EQ(copied[1], queries->queries[1].value);
}

TEST_F(Submitting, ALostDeviceTakesNothingMore) {
  device->lost = true;
  EXPECT_EQ(device->queue->submit({}, fence.get()), VK_ERROR_DEVICE_LOST);
  EXPECT_EQ(device->queue->wait_idle(), VK_ERROR_DEVICE_LOST);
}

}  // namespace
}  // namespace lapilli
