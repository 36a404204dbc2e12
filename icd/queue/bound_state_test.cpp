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
  DrawCall draw;
  ASSERT_TRUE(flatten_draw(state, arena, draw));
  EXPECT_EQ(draw.bindings[0].data, nullptr);
  EXPECT_EQ(draw.bindings[1].data, bytes + 24);
  EXPECT_EQ(draw.bindings[1].size, 40u);
  EXPECT_EQ(draw.bindings[1].stride, 12u);
  EXPECT_TRUE(draw.bindings[1].per_instance);
  EXPECT_EQ(draw.bindings[2].size, 0u);
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
  DrawCall fixed;
  ASSERT_TRUE(flatten_draw(state, arena, fixed));
  EXPECT_EQ(fixed.viewport.x, 1);
  EXPECT_EQ(fixed.scissor.offset.x, 1);
  EXPECT_EQ(fixed.blend_constants[0], 0.25f);
  EXPECT_EQ(fixed.raster.depth_bias_slope, 7);
  part.dynamic = kDynamicViewport | kDynamicBlendConstants;
  DrawCall mixed;
  ASSERT_TRUE(flatten_draw(state, arena, mixed));
  EXPECT_EQ(mixed.viewport.x, 5);
  EXPECT_EQ(mixed.scissor.offset.x, 1);
  EXPECT_EQ(mixed.blend_constants[0], 0.75f);
  EXPECT_EQ(mixed.raster.depth_bias_slope, 7);
}

}  // namespace
}  // namespace lapilli
