// Vertex and fragment shaders that change buffers: fragmentStoresAndAtomics, vertexPipelineStoresAndAtomics.
#include <gtest/gtest.h>

#include "features/drawing_fixture.h"
#include "harness/descriptors.h"
#include "shaders/stores.frag.h"
#include "shaders/stores.vert.h"
#include "shaders/stores_chained.vert.h"

namespace lapilli::conformance {
namespace {

constexpr uint32_t kSize = 64;
constexpr uint32_t kVertices = 6000;  // more than one chunk of triangles takes

struct StoreRun {
  bool discard = false;  // rasterizerDiscardEnable
  bool depth = false;
  uint32_t draws = 1, instances = 1;
  std::optional<VkRect2D> scissor = std::nullopt;
  bool chained = false;  // stores_chained.vert, with barriers between the draws
};
struct Counts {
  uint32_t vertices, fragments, helpers;
  std::vector<uint32_t> vertex, pixel;
};

class Stores : public testing::Test {
 protected:
  void SetUp() override {
    VkPhysicalDeviceFeatures features;
    vkGetPhysicalDeviceFeatures(subject().physical_device(), &features);
    if (features.fragmentStoresAndAtomics != VK_TRUE || features.vertexPipelineStoresAndAtomics != VK_TRUE)
      GTEST_SKIP() << "the features are not offered";
  }

  static Counts draw(const StoreRun& run, std::span<const ColoredVertex> vertices) {
    const Context& c = subject();
    const Canvas canvas(c, {.width = kSize, .height = kSize, .depth = run.depth});
    const std::vector<uint32_t> zeros(3 + 2 * kVertices), no_pixels(2 * kSize * kSize);
    const samples::Buffer counts(c, std::span<const uint32_t>(zeros), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    const samples::Buffer pixels(c, std::span<const uint32_t>(no_pixels), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    const samples::Buffer buffer(c, vertices, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    const DescriptorSlot slots[] = {{0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, {counts.get(), 0, VK_WHOLE_SIZE}},
                                    {1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, {pixels.get(), 0, VK_WHOLE_SIZE}}};
    const Descriptors descriptors(c, slots);
    const VkDescriptorSetLayout set_layout = descriptors.layout();
    const samples::PipelineLayout layout = create_layout(c, {&set_layout, 1});
    PipelineState state;
    if (run.chained) {
      state.vertex_shader = shaders::kStoresChainedVert;
    } else {
      state.vertex_shader = shaders::kStoresVert;
    }
    state.fragment_shader = shaders::kStoresFrag;
    state.rasterizer_discard = run.discard;
    state.depth_test = state.depth_write = run.depth;
    state.layout = layout.get();
    state.render_pass = canvas.render_pass();
    const samples::Pipeline pipeline = create_pipeline(c, state);
    VkCommandBuffer commands = c.begin_commands();
    canvas.begin(commands, {});
    if (run.scissor) vkCmdSetScissor(commands, 0, 1, &*run.scissor);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
    const VkDescriptorSet set = descriptors.get();
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout.get(), 0, 1, &set, 0, nullptr);
    const VkBuffer vertex_buffer = buffer.get();
    const VkDeviceSize offset = 0;
    vkCmdBindVertexBuffers(commands, 0, 1, &vertex_buffer, &offset);
    for (uint32_t i = 0; i < run.draws; ++i) {
      if (run.chained && i > 0) order_vertices(commands);
      vkCmdDraw(commands, uint32_t(vertices.size()), run.instances, 0, run.chained ? i : 0);
    }
    Canvas::end(commands);
    c.submit_and_wait(commands);
    const auto* words = static_cast<const uint32_t*>(counts.data());
    const auto* of_pixels = static_cast<const uint32_t*>(pixels.data());
    return {words[0],
            words[1],
            words[2],
            {words + 3, words + 3 + vertices.size()},
            {of_pixels, of_pixels + 2 * kSize * kSize}};
  }

  // By the self-dependency of Canvas.
  static void order_vertices(VkCommandBuffer commands) {
    constexpr VkAccessFlags kStores = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT;
    constexpr VkPipelineStageFlags kVertexShader = VK_PIPELINE_STAGE_VERTEX_SHADER_BIT;
    const VkMemoryBarrier barrier = {VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, kStores, kStores};
    vkCmdPipelineBarrier(commands, kVertexShader, kVertexShader, 0, 1, &barrier, 0, nullptr, 0, nullptr);
  }

  // Rectangles of 7 x 5 pixels, which share edges and cut quads.
  static std::vector<ColoredVertex> rectangles(uint32_t count, float depth) {
    const Canvas canvas(subject(), {.width = kSize, .height = kSize});
    std::vector<ColoredVertex> vertices;
    for (uint32_t i = 0; i < count; ++i)
      add_rectangle(vertices, canvas, {{int32_t(i % 9 * 7), int32_t(i / 9 % 12 * 5)}, {7, 5}}, depth, {1, 1, 1, 1});
    return vertices;
  }

  static void expect_pixels(const Counts& counts, uint32_t each, uint32_t width, uint32_t height) {
    for (uint32_t y = 0; y < kSize; ++y) {
      for (uint32_t x = 0; x < kSize; ++x) {
        const uint32_t want = x < width && y < height ? each : 0;
        ASSERT_EQ(counts.pixel[y * kSize + x], want) << x << ' ' << y;
        ASSERT_EQ(counts.pixel[(kSize + y) * kSize + x], x % 3 == 0 ? 0 : want) << x << ' ' << y;
      }
    }
    EXPECT_EQ(counts.fragments, each * width * height);
    EXPECT_EQ(counts.helpers, 0u);
  }
};

TEST_F(Stores, EachVertexAndEachFragmentOnce) {
  const std::vector<ColoredVertex> vertices = rectangles(108, 0.5f);
  for (const uint32_t draws : {1u, 3u}) {
    const Counts counts = draw({.draws = draws, .instances = 2}, vertices);
    EXPECT_EQ(counts.vertices, 2 * draws * vertices.size());
    for (const uint32_t count : counts.vertex) EXPECT_EQ(count, 2 * draws);
    expect_pixels(counts, 2 * draws, 63, 60);
  }
}

// Depth is tested after a fragment shader that stores, so that hidden fragments count, too.
TEST_F(Stores, HiddenFragmentsCount) {
  std::vector<ColoredVertex> vertices = rectangles(108, 0.25f);
  const std::vector<ColoredVertex> behind = rectangles(108, 0.5f);
  vertices.insert(vertices.end(), behind.begin(), behind.end());
  expect_pixels(draw({.depth = true}, vertices), 2, 63, 60);
}

// What draws nothing still runs its vertex shader.
TEST_F(Stores, VerticesOfWhatDrawsNothing) {
  const std::vector<ColoredVertex> vertices = rectangles(kVertices / 6, 0.5f);
  for (const StoreRun& run : {StoreRun{.discard = true}, StoreRun{.scissor = VkRect2D{{0, 0}, {0, 0}}}}) {
    const Counts counts = draw(run, vertices);
    EXPECT_EQ(counts.vertices, vertices.size());
    for (const uint32_t count : counts.vertex) EXPECT_EQ(count, 1u);
    expect_pixels(counts, 0, 0, 0);
  }
}

// A barrier within the render pass: each draw's vertices read what those of the draw before have stored.
TEST_F(Stores, VerticesAfterABarrier) {
  constexpr uint32_t kDraws = 21;
  const Counts counts = draw({.draws = kDraws, .chained = true}, rectangles(kVertices / 6, 0.5f));
  std::vector<uint32_t> want(kVertices), before(kVertices);
  for (uint32_t i = 0; i < kVertices; ++i) want[i] = i * 3 + 1;
  for (uint32_t d = 1; d < kDraws; ++d) {
    std::swap(want, before);
    for (uint32_t i = 0; i < kVertices; ++i) want[i] = before[kVertices - 1 - i] * 3 + 1;
  }
  EXPECT_EQ(counts.vertex, want);
  EXPECT_EQ(counts.fragments, kDraws * kVertices / 6 * 35);
}

}  // namespace
}  // namespace lapilli::conformance
