// What deferred shading would spoil: for each kind of draw that may not be deferred, or not wait for later ones, an
// image that would differ. Specification: "Rasterization Order", "Fragment Operations", "The Framebuffer".
#include <gtest/gtest.h>

#include "features/drawing_fixture.h"
#include "shaders/depth_export.frag.h"
#include "shaders/discard_checker.frag.h"
#include "shaders/early_discard.frag.h"
#include "shaders/helper_edges.frag.h"
#include "shaders/pixel_address.frag.h"

namespace lapilli::conformance {
namespace {

constexpr uint32_t kSide = 32;
constexpr std::array<float, 4> kRed = {1, 0, 0, 1}, kGreen = {0, 1, 0, 1}, kBlue = {0, 0, 1, 1};
const uint32_t kRedTexel = rgba(255, 0, 0, 255), kGreenTexel = rgba(0, 255, 0, 255), kBlueTexel = rgba(0, 0, 255, 255);

// A rectangle, and how its pipeline differs from opaque triangles of one colour with depth test and writes (less).
struct Layer {
  VkRect2D area;
  float depth;
  std::array<float, 4> color;
  PipelineState state = {};
};

constexpr VkRect2D kEverywhere = {{0, 0}, {kSide, kSide}};

Layer opaque(float depth, const std::array<float, 4>& color, const VkRect2D& area = kEverywhere) {
  Layer layer{area, depth, color};
  layer.state.depth_test = layer.state.depth_write = true;
  return layer;
}

// One draw for each layer, in one render pass that clears to black.
std::vector<uint32_t> draw(std::vector<Layer> layers) {
  const Canvas canvas(subject(), {.width = kSide, .height = kSide, .depth = true});
  const samples::PipelineLayout layout = create_layout(subject());
  std::vector<ColoredVertex> vertices;
  std::vector<samples::Pipeline> pipelines;
  for (Layer& layer : layers) {
    add_rectangle(vertices, canvas, layer.area, layer.depth, layer.color);
    layer.state.vertex_shader = shaders::kPositionColorVert;
    if (layer.state.fragment_shader.empty()) layer.state.fragment_shader = shaders::kFlatColorFrag;
    layer.state.layout = layout.get();
    layer.state.render_pass = canvas.render_pass();
    pipelines.push_back(create_pipeline(subject(), layer.state));
  }
  const samples::Buffer buffer(subject(), std::span<const ColoredVertex>(vertices), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  VkCommandBuffer commands = subject().begin_commands();
  canvas.begin(commands, {});
  const VkBuffer vertex_buffer = buffer.get();
  const VkDeviceSize offset = 0;
  vkCmdBindVertexBuffers(commands, 0, 1, &vertex_buffer, &offset);
  for (uint32_t i = 0; i < pipelines.size(); ++i) {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines[i].get());
    vkCmdDraw(commands, 6, 1, i * 6, 0);
  }
  Canvas::end(commands);
  subject().submit_and_wait(commands);
  return canvas.read_color<uint32_t>();
}

template <typename Expected>
void expect_pixels(const std::vector<uint32_t>& image, const Expected& expected) {
  for (uint32_t y = 0; y < kSide; ++y) {
    for (uint32_t x = 0; x < kSide; ++x) ASSERT_EQ(image[y * kSide + x], expected(x, y)) << x << ", " << y;
  }
}

TEST(Deferral, BlendingSeesWhatIsBelow) {
  Layer above = opaque(0.5f, kGreen);
  above.state.blend.blendEnable = VK_TRUE;
  above.state.blend.dstColorBlendFactor = VK_BLEND_FACTOR_ONE;
  expect_pixels(draw({opaque(0.75f, kRed), above}), [](uint32_t, uint32_t) { return rgba(255, 255, 0, 255); });
}

TEST(Deferral, WriteMasksLeaveWhatIsBelow) {
  Layer above = opaque(0.5f, kBlue);
  above.state.blend.colorWriteMask = VK_COLOR_COMPONENT_B_BIT;
  expect_pixels(draw({opaque(0.75f, kRed), above}), [](uint32_t, uint32_t) { return rgba(255, 0, 255, 255); });
}

TEST(Deferral, DiscardShowsWhatIsBelow) {
  for (const bool depth : {false, true}) {
    Layer above = opaque(0.5f, kGreen);
    above.state.fragment_shader = shaders::kDiscardCheckerFrag;
    above.state.depth_test = above.state.depth_write = depth;
    expect_pixels(draw({opaque(0.75f, kRed), above}),
                  [](uint32_t x, uint32_t y) { return (x + y) % 2 == 0 ? kGreenTexel : kRedTexel; });
  }
}

// The blue layer is behind the depths that discarded fragments wrote, too.
TEST(Deferral, DiscardAfterEarlyTestsShowsWhatIsBelow) {
  Layer above = opaque(0.25f, kGreen);
  above.state.fragment_shader = shaders::kEarlyDiscardFrag;
  expect_pixels(draw({opaque(0.75f, kRed), above, opaque(0.5f, kBlue)}),
                [](uint32_t x, uint32_t y) { return (x + y) % 2 == 0 ? kGreenTexel : kRedTexel; });
}

// The green layer's depth is x / 32 and not the 0.25 of its triangles.
TEST(Deferral, ExportedDepthDecides) {
  Layer above = opaque(0.25f, kGreen);
  above.state.fragment_shader = shaders::kDepthExportFrag;
  expect_pixels(draw({opaque(0.5f, kRed), above, opaque(0.75f, kBlue)}),
                [](uint32_t x, uint32_t) { return float(x) + 0.5f < 16 ? kGreenTexel : kRedTexel; });
}

// Pixels that something later hides are no helper invocations of the quads that they are in. The lower layer has them
// along the diagonal of its two triangles only, from the lower left to the upper right.
TEST(Deferral, HiddenPixelsAreNoHelpers) {
  Layer below = opaque(0.75f, kRed);
  below.state.fragment_shader = shaders::kHelperEdgesFrag;
  std::vector<Layer> layers = {below};
  for (int x = 1; x < int{kSide}; x += 2) layers.push_back(opaque(0.5f, kBlue, {{x, 0}, {1, kSide}}));
  expect_pixels(draw(layers), [](uint32_t x, uint32_t y) {
    if (x % 2 == 1) return kBlueTexel;
    return x / 2 + y / 2 == kSide / 2 - 1 ? rgba(255, 255, 255, 255) : kRedTexel;
  });
}

// Blocks that two triangles are seen in, with nothing else drawn.
TEST(Deferral, PixelsOfATornBlockKnowWhereTheyAre) {
  Layer layer = opaque(0.5f, kRed, {{8, 8}, {8, 8}});
  layer.state.fragment_shader = shaders::kPixelAddressFrag;
  expect_pixels(draw({layer}), [](uint32_t x, uint32_t y) {
    return x / 8 == 1 && y / 8 == 1 ? rgba(x, y, 0, 255) : rgba(0, 0, 0, 0);
  });
}

}  // namespace
}  // namespace lapilli::conformance
