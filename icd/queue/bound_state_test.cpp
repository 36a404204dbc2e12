// Flattening of bound objects and dynamic state.
#include "queue/bound_state.h"

#include <gtest/gtest.h>

#include "object/test_context.h"

namespace lapilli {
namespace {

class Flattening : public testing::Test {
 protected:
  TestContext context;
  ObjectPtr<Pipeline> pipeline = make_object<Pipeline>(HostMemory(), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  ObjectPtr<DescriptorPool> pool = make_object<DescriptorPool>(HostMemory(), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  ObjectPtr<DescriptorSet> set = make_set(3);
  BoundState state;
  Arena arena{1 << 20};

  ObjectPtr<DescriptorSet> make_set(uint32_t descriptors) {
    auto layout = make_object<DescriptorSetLayout>(HostMemory(), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
    layout->descriptor_count = descriptors;
    return make_object<DescriptorSet>(HostMemory(), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT, *pool, *layout);
  }
  void SetUp() override {
    state.graphics.pipeline = pipeline.get();
    PipelineResources& resources = pipeline->resources;
    resources.set_count = 2;
    resources.descriptor_count[0] = 1;
    resources.descriptor_count[1] = 3;
    resources.dynamic_count[0] = 1;
    resources.dynamic_count[1] = 2;
    resources.first_dynamic[1] = 1;
    resources.dynamic_total = 3;
  }
};

TEST_F(Flattening, DynamicOffsetsOfAllSetsInARow) {
  const uint32_t first[] = {16}, second[] = {32, 48};
  state.graphics.sets[0] = {set.get(), first};
  state.graphics.sets[1] = {set.get(), second};
  ResourceTable table;
  ASSERT_TRUE(flatten_resources(state, state.graphics, arena, table));
  EXPECT_EQ(table.sets[0], set->descriptors.data());
  EXPECT_EQ(table.sets[1], set->descriptors.data());
  EXPECT_EQ(table.sets[2], nullptr);
  EXPECT_EQ(std::vector<uint32_t>(table.dynamic_offsets, table.dynamic_offsets + 3),
            (std::vector<uint32_t>{16, 32, 48}));
}

TEST_F(Flattening, ASetThatIsTooSmallIsNotUsed) {
  const auto small = make_set(2);
  state.graphics.sets[1] = {small.get(), {}};
  ResourceTable table;
  ASSERT_TRUE(flatten_resources(state, state.graphics, arena, table));
  EXPECT_EQ(table.sets[0], nullptr);
  EXPECT_EQ(table.sets[1], nullptr);
  EXPECT_EQ(table.dynamic_offsets[2], 0u);
}

TEST_F(Flattening, VertexBuffersEndWhereTheBufferEnds) {
  std::byte bytes[64];
  auto buffer = make_object<Buffer>(HostMemory(), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  buffer->data = bytes;
  buffer->size = sizeof(bytes);
  state.vertex_buffers[1] = {buffer.get(), 24};
  state.vertex_buffers[2] = {buffer.get(), 64};  // nothing left
  pipeline->graphics.bindings[1] = {12, true};
  pipeline->graphics.binding_count = 3;
  ASSERT_TRUE(refresh_blocks(state, arena));
  const VertexBinding* const bindings = state.blocks.bindings;
  EXPECT_EQ(bindings[0].data, nullptr);
  EXPECT_EQ(bindings[1].data, bytes + 24);
  EXPECT_EQ(bindings[1].size, 40u);
  EXPECT_EQ(bindings[1].stride, 12u);
  EXPECT_TRUE(bindings[1].per_instance);
  EXPECT_EQ(bindings[2].size, 0u);
}

TEST_F(Flattening, DynamicStateReplacesThePipelines) {
  GraphicsPart& part = pipeline->graphics;
  part.fixed.viewport = {1, 2, 3, 4, 0, 1};
  part.fixed.scissor = {{1, 1}, {2, 2}};
  part.fixed.blend_constants[0] = 0.25f;
  part.fixed.depth_bias_slope = 7;
  state.dynamic.viewport = {5, 6, 7, 8, 0, 1};
  state.dynamic.scissor = {{3, 3}, {4, 4}};
  state.dynamic.blend_constants[0] = 0.75f;
  state.dynamic.depth_bias_slope = 9;
  ASSERT_TRUE(refresh_blocks(state, arena));
  const DrawState& fixed = *state.blocks.state;
  EXPECT_EQ(fixed.viewport.x, 1);
  EXPECT_EQ(fixed.scissor.offset.x, 1);
  EXPECT_EQ(fixed.blend_constants[0], 0.25f);
  EXPECT_EQ(fixed.raster.depth_bias_slope, 7);
  part.dynamic = kDynamicViewport | kDynamicBlendConstants;
  state.stale = kStaleState;
  ASSERT_TRUE(refresh_blocks(state, arena));
  const DrawState& mixed = *state.blocks.state;
  EXPECT_EQ(mixed.viewport.x, 5);
  EXPECT_EQ(mixed.scissor.offset.x, 1);
  EXPECT_EQ(mixed.blend_constants[0], 0.75f);
  EXPECT_EQ(mixed.raster.depth_bias_slope, 7);
}

TEST_F(Flattening, OnlyBlocksThatChangedAreMadeAnew) {
  ASSERT_TRUE(refresh_blocks(state, arena));
  const DrawCall before = state.blocks;

  // The same again changes nothing.
  bind_pipeline(state, *pipeline);
  cmd::SetBinding bound_set{nullptr, {}};
  cmd::BindDescriptorSets sets;
  sets.sets = {&bound_set, 1};
  bind_sets(state, sets);
  set_dynamic(state, state.dynamic.viewport, VkViewport{});
  EXPECT_EQ(state.stale, 0u);

  const uint32_t offset[] = {64};
  bound_set = {set.get(), offset};
  bind_sets(state, sets);
  EXPECT_EQ(state.stale, kStaleResources);
  ASSERT_TRUE(refresh_blocks(state, arena));
  EXPECT_NE(state.blocks.resources, before.resources);
  EXPECT_EQ(state.blocks.resources->push_constants, before.resources->push_constants);
  EXPECT_EQ(before.resources->sets[0], nullptr);  // what an earlier draw points to stays as it was
  EXPECT_EQ(state.blocks.state, before.state);
  EXPECT_EQ(state.blocks.bindings, before.bindings);

  set_dynamic(state, state.dynamic.viewport, VkViewport{0, 0, 8, 8, 0, 1});
  EXPECT_EQ(state.stale, kStaleState);
  cmd::VertexBufferBinding buffer{nullptr, 4};
  cmd::BindVertexBuffers buffers;
  buffers.buffers = {&buffer, 1};
  bind_vertex_buffers(state, buffers);
  EXPECT_EQ(state.stale, kStaleState | kStaleVertexInput);
}

TEST_F(Flattening, PipelinesWithTheSameLayoutsKeepTheBindings) {
  ASSERT_TRUE(refresh_blocks(state, arena));
  auto other = make_object<Pipeline>(HostMemory(), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  other->resources = pipeline->resources;
  bind_pipeline(state, *other);
  EXPECT_EQ(state.stale, kStaleState);
  pipeline->graphics.binding_count = 1;
  bind_pipeline(state, *pipeline);
  EXPECT_EQ(state.stale, kStaleState | kStaleVertexInput);
  other->graphics.binding_count = 1;
  other->resources.dynamic_total = 0;
  bind_pipeline(state, *other);
  EXPECT_EQ(state.stale, kStaleState | kStaleVertexInput | kStaleResources);
}

TEST_F(Flattening, PushConstantsKeepWhatWasPushedBefore) {
  const uint32_t first[] = {1, 2}, second[] = {3};
  cmd::PushConstants push;
  push.values = std::as_bytes(std::span(first));
  push_constants(state, push);
  ASSERT_TRUE(refresh_blocks(state, arena));
  const ResourceTable& before = *state.blocks.resources;
  push_constants(state, push);
  EXPECT_EQ(state.stale, 0u);
  push.offset = 4;
  push.values = std::as_bytes(std::span(second));
  push_constants(state, push);
  ASSERT_TRUE(refresh_blocks(state, arena));
  const auto word = [](const ResourceTable& table, size_t i) {
    uint32_t value;
    std::memcpy(&value, table.push_constants + 4 * i, 4);
    return value;
  };
  ASSERT_GE(before.push_constant_bytes, 8u);
  EXPECT_EQ(word(before, 1), 2u);
  EXPECT_EQ(word(*state.blocks.resources, 0), 1u);
  EXPECT_EQ(word(*state.blocks.resources, 1), 3u);
}

}  // namespace
}  // namespace lapilli
