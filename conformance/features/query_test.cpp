// Occlusion queries and timestamps. Specification: "Queries".
#include <gtest/gtest.h>

#include "features/drawing_fixture.h"
#include "shaders/discard_checker.frag.h"
#include "shaders/early_discard.frag.h"

namespace lapilli::conformance {
namespace {

using samples::check;

// The handle of a query pool is owned here: samples have no use for one.
using QueryPool = samples::Owned<VkQueryPool, vkDestroyQueryPool>;

QueryPool make_pool(VkQueryType type, uint32_t count) {
  VkQueryPoolCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
  info.queryType = type;
  info.queryCount = count;
  VkQueryPool raw = VK_NULL_HANDLE;
  check(vkCreateQueryPool(subject().device(), &info, nullptr, &raw), "vkCreateQueryPool");
  return {subject().device(), raw};
}

// Zero or not zero is all that an imprecise query promises; the feature occlusionQueryPrecise is not used.
TEST(Queries, OcclusionTellsWhatPassedTheDepthTest) {
  const Canvas canvas(subject(), {.width = 100, .height = 80, .depth = true});
  const FlatPipeline flat(canvas, true);
  std::vector<ColoredVertex> vertices;
  add_rectangle(vertices, canvas, {{10, 10}, {60, 50}}, 0.25f, {1, 0, 0, 1});
  add_rectangle(vertices, canvas, {{20, 20}, {30, 30}}, 0.5f, {0, 1, 0, 1});  // behind the first
  add_rectangle(vertices, canvas, {{60, 20}, {30, 30}}, 0.5f, {0, 0, 1, 1});  // partly behind
  const samples::Buffer buffer(subject(), std::span<const ColoredVertex>(vertices), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  const QueryPool pool = make_pool(VK_QUERY_TYPE_OCCLUSION, 4);
  VkCommandBuffer commands = subject().begin_commands();
  vkCmdResetQueryPool(commands, pool.get(), 0, 4);
  canvas.begin(commands, {}, 1);
  flat.bind(commands, buffer);
  for (uint32_t i = 0; i < 3; ++i) {
    vkCmdBeginQuery(commands, pool.get(), i, 0);
    vkCmdDraw(commands, 6, 1, i * 6, 0);
    vkCmdEndQuery(commands, pool.get(), i);
  }
  vkCmdBeginQuery(commands, pool.get(), 3, 0);
  vkCmdEndQuery(commands, pool.get(), 3);
  Canvas::end(commands);
  subject().submit_and_wait(commands);
  uint64_t results[4] = {};
  ASSERT_EQ(vkGetQueryPoolResults(subject().device(), pool.get(), 0, 4, sizeof(results), results, 8,
                                  VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
            VK_SUCCESS);
  EXPECT_GT(results[0], 0u);
  EXPECT_EQ(results[1], 0u);
  EXPECT_GT(results[2], 0u);
  EXPECT_EQ(results[3], 0u);
  if (!subject_is_lapilli()) return;
  EXPECT_EQ(results[0], 60u * 50);
  EXPECT_EQ(results[2], 20u * 30);
}

// Half of the fragments are discarded. With EarlyFragmentTests that is after the samples were counted (Fragment
// Operations: "Early Fragment Test Mode").
TEST(Queries, EarlyTestsCountWhatIsDiscarded) {
  const Canvas canvas(subject(), {.width = 32, .height = 16});
  const samples::PipelineLayout layout = create_layout(subject());
  const QueryPool pool = make_pool(VK_QUERY_TYPE_OCCLUSION, 2);
  std::vector<ColoredVertex> vertices;
  add_rectangle(vertices, canvas, {{0, 0}, {32, 16}}, 0, {1, 0, 0, 1});
  const samples::Buffer buffer(subject(), std::span<const ColoredVertex>(vertices), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  PipelineState state;
  state.vertex_shader = shaders::kPositionColorVert;
  state.layout = layout.get();
  state.render_pass = canvas.render_pass();
  state.fragment_shader = shaders::kDiscardCheckerFrag;
  const samples::Pipeline late = create_pipeline(subject(), state);
  state.fragment_shader = shaders::kEarlyDiscardFrag;
  const samples::Pipeline early = create_pipeline(subject(), state);
  const VkPipeline pipelines[] = {late.get(), early.get()};
  VkCommandBuffer commands = subject().begin_commands();
  vkCmdResetQueryPool(commands, pool.get(), 0, 2);
  canvas.begin(commands, {});
  const VkBuffer vertex_buffer = buffer.get();
  const VkDeviceSize offset = 0;
  vkCmdBindVertexBuffers(commands, 0, 1, &vertex_buffer, &offset);
  for (uint32_t i = 0; i < 2; ++i) {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines[i]);
    vkCmdBeginQuery(commands, pool.get(), i, 0);
    vkCmdDraw(commands, 6, 1, 0, 0);
    vkCmdEndQuery(commands, pool.get(), i);
  }
  Canvas::end(commands);
  subject().submit_and_wait(commands);
  uint64_t results[2] = {};
  ASSERT_EQ(vkGetQueryPoolResults(subject().device(), pool.get(), 0, 2, sizeof(results), results, 8,
                                  VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
            VK_SUCCESS);
  EXPECT_GT(results[0], 0u);
  EXPECT_GT(results[1], 0u);
  if (!subject_is_lapilli()) return;
  EXPECT_EQ(results[0], 32u * 16 / 2);
  EXPECT_EQ(results[1], 32u * 16);
}

TEST(Queries, ResetMakesUnavailable) {
  const QueryPool pool = make_pool(VK_QUERY_TYPE_OCCLUSION, 1);
  VkCommandBuffer commands = subject().begin_commands();
  vkCmdResetQueryPool(commands, pool.get(), 0, 1);
  subject().submit_and_wait(commands);
  uint32_t result[2] = {5, 5};
  EXPECT_EQ(vkGetQueryPoolResults(subject().device(), pool.get(), 0, 1, sizeof(result), result, sizeof(result),
                                  VK_QUERY_RESULT_WITH_AVAILABILITY_BIT),
            VK_NOT_READY);
  EXPECT_EQ(result[0], 5u);
  EXPECT_EQ(result[1], 0u);
}

TEST(Queries, TimestampsDoNotGoBackAndCanBeCopied) {
  if (subject().properties().limits.timestampComputeAndGraphics == VK_FALSE) GTEST_SKIP();
  const Canvas canvas(subject(), {.width = 64, .height = 64});
  const QueryPool pool = make_pool(VK_QUERY_TYPE_TIMESTAMP, 3);
  const samples::Buffer copies(subject(), 24, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  VkCommandBuffer commands = subject().begin_commands();
  vkCmdResetQueryPool(commands, pool.get(), 0, 3);
  vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, pool.get(), 0);
  canvas.begin(commands, {});
  Canvas::end(commands);
  vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, pool.get(), 1);
  vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, pool.get(), 2);
  vkCmdCopyQueryPoolResults(commands, pool.get(), 0, 3, copies.get(), 0, 8,
                            VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
  subject().submit_and_wait(commands);
  uint64_t results[3] = {}, copied[3] = {};
  ASSERT_EQ(
      vkGetQueryPoolResults(subject().device(), pool.get(), 0, 3, sizeof(results), results, 8, VK_QUERY_RESULT_64_BIT),
      VK_SUCCESS);
  std::memcpy(copied, copies.data(), sizeof(copied));
  EXPECT_LE(results[0], results[1]);
  EXPECT_LE(results[1], results[2]);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(copied[i], results[i]);
}

}  // namespace
}  // namespace lapilli::conformance
