// Accesses outside of buffers: bounded, never a crash.
#include <gtest/gtest.h>

#include <array>

#include "harness/canvas.h"
#include "harness/compute.h"
#include "harness/devices.h"
#include "harness/graphics.h"
#include "shaders/flat_color.frag.h"
#include "shaders/position_color.vert.h"
#include "shaders/robust.comp.h"
#include "shaders/robust_shared.comp.h"

namespace lapilli::conformance {
namespace {

TEST(Robustness, StorageBuffersAreBounded) {
  if (!subject_is_lapilli()) GTEST_SKIP() << "other drivers need robustBufferAccess for this";
  const std::vector<uint32_t> data(100, 77);
  // Below 2^30 the byte address fits 32 bits: what is outside reads 0 and writes nothing. Beyond, it may wrap around to
  // another place of the same buffer, which robustBufferAccess allows.
  for (const uint32_t index : {36u, 37u, 90u, 100u, 101u, 1000u, 1u << 20, 0x3FFFFF00u, 0x40000000u, 1u << 31, ~0u}) {
    for (const uint32_t store : {0u, 1u}) {
      ComputeRun run;
      run.shader = shaders::kRobustComp;
      run.buffers = {to_bytes(data), to_bytes(std::vector<uint32_t>(64, 5))};
      run.push_constants = to_bytes(std::vector<uint32_t>{index, store});
      const std::vector<Bytes> after = run_compute(subject(), run);
      const auto values = from_bytes<uint32_t>(after[0]), results = from_bytes<uint32_t>(after[1]);
      const bool wraps = index >= 0x40000000u;
      std::vector<uint32_t> want = data;
      for (uint32_t lane = 0; lane < 64; ++lane) {
        const uint32_t at = index + lane;
        const bool inside = at < want.size();
        if (inside && store != 0) want[at] = 0xBAD;
        const uint32_t written = store != 0 ? 0xBAD : 77;
        EXPECT_TRUE(results[lane] == (inside ? written : 0) || (wraps && results[lane] == written))
            << "index " << at << " store " << store << " reads " << results[lane];
      }
      for (size_t i = 0; i < want.size(); ++i) {
        EXPECT_TRUE(values[i] == want[i] || (wraps && store != 0 && values[i] == 0xBAD)) << "element " << i;
      }
      if (HasFailure()) return;
    }
  }
}

TEST(Robustness, SharedMemoryIsBounded) {
  if (!subject_is_lapilli()) GTEST_SKIP() << "the specification asks for nothing here";
  for (const uint32_t index : {0u, 1u, 63u, 64u, 100u, 1u << 20, 0x3FFFFFFFu, 0x40000000u, ~0u}) {
    for (const uint32_t store : {0u, 1u}) {
      ComputeRun run;
      run.shader = shaders::kRobustSharedComp;
      run.buffers = {Bytes(64 * 4)};
      run.push_constants = to_bytes(std::vector<uint32_t>{index, store});
      const auto results = from_bytes<uint32_t>(run_compute(subject(), run)[0]);
      for (uint32_t n = 0; n < 64; ++n) {
        const bool inside = ((index + n) & 0x3FFFFFFF) < 64;  // the address in bytes wraps around
        const uint32_t value = !inside ? 0 : store != 0 ? 0xBAD : 77;
        EXPECT_EQ(results[n], 0x20000 + value) << index << ' ' << n << ' ' << store;
      }
    }
  }
}

// Indices and vertex counts beyond the vertex buffer: nothing is read outside; what is drawn is left open.
TEST(Robustness, VertexFetchIsBounded) {
  if (!subject_is_lapilli()) GTEST_SKIP() << "other drivers need robustBufferAccess for this";
  const Canvas canvas(subject(), {.width = 16, .height = 16});
  const samples::PipelineLayout layout = create_layout(subject());
  PipelineState state;
  state.vertex_shader = shaders::kPositionColorVert;
  state.fragment_shader = shaders::kFlatColorFrag;
  state.layout = layout.get();
  state.render_pass = canvas.render_pass();
  const samples::Pipeline pipeline = create_pipeline(subject(), state);
  const std::vector<std::array<float, 8>> vertices = {
      {-1, -1, 0, 1, 1, 1, 1, 1}, {3, -1, 0, 1, 1, 1, 1, 1}, {-1, 3, 0, 1, 1, 1, 1, 1}};
  const samples::Buffer buffer(subject(), std::span<const std::array<float, 8>>(vertices),
                               VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  const std::vector<uint32_t> indices = {0, 1, 2, 3, 4, 5, 1000000, ~0u - 1, 0x80000000u, 0, 1, 2};
  const samples::Buffer index_buffer(subject(), std::span<const uint32_t>(indices), VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
  const VkBuffer vertex_buffer = buffer.get();
  const VkDeviceSize offset = 0;
  VkCommandBuffer commands = subject().begin_commands();
  canvas.begin(commands, {});
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
  vkCmdBindVertexBuffers(commands, 0, 1, &vertex_buffer, &offset);
  vkCmdBindIndexBuffer(commands, index_buffer.get(), 0, VK_INDEX_TYPE_UINT32);
  vkCmdDraw(commands, 3000, 1, 0, 0);
  vkCmdDraw(commands, 30, 1, 0xFFFFFFF0u, 0);
  vkCmdDrawIndexed(commands, 12, 1, 0, 0, 0);
  vkCmdDrawIndexed(commands, 12, 1, 0, -2000000, 0);
  vkCmdDrawIndexed(commands, 600, 1, 6, 0, 0);  // beyond the index buffer
  Canvas::end(commands);
  subject().submit_and_wait(commands);
  for (const uint32_t p : canvas.read_color<uint32_t>()) ASSERT_EQ(p, 0xFFFFFFFFu);
}

}  // namespace
}  // namespace lapilli::conformance
