// What recording leaves behind: commands in order, copies of the application's arrays, offsets with the sets they
// belong to.
#include "command/record.h"

#include <gtest/gtest.h>

#include "object/test_context.h"

namespace lapilli {
namespace {

class Recording : public testing::Test {
 protected:
  TestContext context;
  ObjectPtr<CommandPool> pool = make_object<CommandPool>(HostMemory(), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  CommandBuffer& commands = allocate();

  CommandBuffer& allocate() {
    VkCommandBufferAllocateInfo info = {};
    info.commandPool = pool->handle();
    info.commandBufferCount = 1;
    VkCommandBuffer handle = VK_NULL_HANDLE;
    EXPECT_EQ(allocate_command_buffers(info, &handle), VK_SUCCESS);
    return *CommandBuffer::from(handle);
  }
};

TEST_F(Recording, KeepsTheOrder) {
  record_draw(commands, {3, 1, 0, 0});
  record_dispatch(commands, 1, 2, 3);
  record_draw(commands, {6, 2, 1, 4});
  const Command* first = commands.first;
  ASSERT_EQ(first->kind, CommandKind::kDraw);
  ASSERT_EQ(first->next->kind, CommandKind::kDispatch);
  const Command* third = first->next->next;
  ASSERT_EQ(third->kind, CommandKind::kDraw);
  EXPECT_EQ(static_cast<const cmd::Draw*>(third)->draw.vertexCount, 6u);
  EXPECT_EQ(static_cast<const cmd::Draw*>(third)->draw.firstInstance, 4u);
  EXPECT_EQ(third->next, nullptr);
}

TEST_F(Recording, CopiesWhatThePointersPointTo) {
  std::byte values[8];
  std::fill_n(values, 8, std::byte{5});
  record_push_constants(commands, 4, values);
  std::fill_n(values, 8, std::byte{6});
  const auto& command = *static_cast<const cmd::PushConstants*>(commands.first);
  EXPECT_EQ(command.offset, 4u);
  ASSERT_EQ(command.values.size(), 8u);
  EXPECT_EQ(command.values[7], std::byte{5});
}

TEST_F(Recording, ResetForgetsAndBeginAgainReusesTheMemory) {
  for (int i = 0; i < 5000; ++i) record_dispatch(commands, 1, 1, 1);
  const size_t reserved = commands.arena.reserved_bytes();
  ASSERT_EQ(begin_command_buffer(commands), VK_SUCCESS);
  EXPECT_EQ(commands.first, nullptr);
  for (int i = 0; i < 5000; ++i) record_dispatch(commands, 1, 1, 1);
  EXPECT_EQ(commands.arena.reserved_bytes(), reserved);
  commands.reset(true);
  EXPECT_EQ(commands.arena.reserved_bytes(), 0u);
}

TEST_F(Recording, EachSetGetsItsOwnDynamicOffsets) {
  auto layout = make_object<PipelineLayout>(HostMemory(), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  layout->set_count = 3;
  layout->dynamic_count[0] = 2;
  layout->dynamic_count[2] = 1;
  const VkDescriptorSet sets[3] = {};
  const uint32_t offsets[] = {16, 32, 48};
  record_bind_descriptor_sets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, *layout, 0, sets, offsets);
  const auto& command = *static_cast<const cmd::BindDescriptorSets*>(commands.first);
  ASSERT_EQ(command.sets.size(), 3u);
  ASSERT_EQ(command.sets[0].dynamic_offsets.size(), 2u);
  EXPECT_EQ(command.sets[0].dynamic_offsets[1], 32u);
  EXPECT_TRUE(command.sets[1].dynamic_offsets.empty());
  ASSERT_EQ(command.sets[2].dynamic_offsets.size(), 1u);
  EXPECT_EQ(command.sets[2].dynamic_offsets[0], 48u);
}

TEST_F(Recording, WhatIsOutsideTheLimitsIsLeftOut) {
  const std::byte values[8] = {};
  record_push_constants(commands, kMaxPushConstantBytes - 4, values);
  const VkBuffer buffers[2] = {};
  const VkDeviceSize offsets[2] = {};
  record_bind_vertex_buffers(commands, kMaxVertexBindings - 1, buffers, offsets);
  record_bind_vertex_buffers(commands, UINT32_MAX, buffers, offsets);
  const VkViewport viewport = {};
  record_set_viewport(commands, 1, {&viewport, 1});
  EXPECT_EQ(commands.first, nullptr);
}

TEST_F(Recording, APoolFreesItsBuffersInAnyOrder) {
  CommandBuffer& second = allocate();
  CommandBuffer& third = allocate();
  EXPECT_EQ(pool->first, &third);
  pool->free(second);
  EXPECT_EQ(third.next, &commands);
  EXPECT_EQ(commands.previous, &third);
  pool->free(third);
  EXPECT_EQ(pool->first, &commands);
  EXPECT_EQ(commands.previous, nullptr);
}

}  // namespace
}  // namespace lapilli
