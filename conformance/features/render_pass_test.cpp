// Load and store operations, render areas, clears within a pass, and passes after each other. Specification: "Render
// Pass", "Clear Commands".
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "harness/canvas.h"
#include "harness/devices.h"
#include "harness/graphics.h"
#include "shaders/flat_color.frag.h"
#include "shaders/position_color.vert.h"

namespace lapilli::conformance {
namespace {

constexpr uint32_t kWidth = 150, kHeight = 70;  // several tiles, none of them full at the border
constexpr VkClearColorValue kRed = {{1, 0, 0, 1}}, kGreen = {{0, 1, 0, 1}};
constexpr uint32_t kRedWord = 0xFF0000FF, kGreenWord = 0xFF00FF00;

bool inside(const VkRect2D& r, uint32_t x, uint32_t y) {
  return int(x) >= r.offset.x && int(y) >= r.offset.y && x < uint32_t(r.offset.x) + r.extent.width &&
         y < uint32_t(r.offset.y) + r.extent.height;
}

// A canvas that shares nothing; a second pass object over the same image is made by a Canvas with load = LOAD.
TEST(RenderPasses, ClearFillsTheRenderAreaOnly) {
  const Canvas canvas(subject(), {.width = kWidth, .height = kHeight, .depth = true});
  const VkRect2D areas[] = {{{0, 0}, {kWidth, kHeight}}, {{3, 5}, {100, 50}}, {{149, 69}, {1, 1}}, {{64, 0}, {64, 64}}};
  VkCommandBuffer commands = subject().begin_commands();
  canvas.begin(commands, kGreen, 0.25f);
  Canvas::end(commands);
  subject().submit_and_wait(commands);
  for (const uint32_t p : canvas.read_color<uint32_t>()) ASSERT_EQ(p, kGreenWord);
  for (const float d : canvas.read_depth()) ASSERT_EQ(d, 0.25f);

  for (const VkRect2D& area : areas) {
    // Outside of the render area the contents are undefined only because the initial layout is UNDEFINED: a fresh
    // image, so only the inside is checked.
    const Canvas fresh(subject(), {.width = kWidth, .height = kHeight, .depth = true});
    commands = subject().begin_commands();
    fresh.begin(commands, kRed, 0.5f, area);
    Canvas::end(commands);
    subject().submit_and_wait(commands);
    const auto image = fresh.read_color<uint32_t>();
    const auto depth = fresh.read_depth();
    for (uint32_t y = 0; y < kHeight; ++y) {
      for (uint32_t x = 0; x < kWidth; ++x) {
        if (!inside(area, x, y)) continue;
        ASSERT_EQ(image[y * kWidth + x], kRedWord);
        ASSERT_EQ(depth[y * kWidth + x], 0.5f);
      }
    }
  }
}

// Two render passes over one image: the first clears and stores, the second loads, restricted to an area. Both are
// compatible, so one framebuffer serves both.
class LoadAndStore : public testing::Test {
 protected:
  Canvas canvas{subject(), {.width = kWidth, .height = kHeight, .depth = true}};
  Canvas loader{subject(), {.width = kWidth, .height = kHeight, .depth = true, .load = VK_ATTACHMENT_LOAD_OP_LOAD}};

  // Begins a pass with the loader's render pass on the canvas's images.
  void begin_loading(VkCommandBuffer commands, const VkRect2D& area) const {
    VkRenderPassBeginInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    info.renderPass = loader.render_pass();
    info.framebuffer = canvas.framebuffer();
    info.renderArea = area;
    vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
    const VkViewport viewport = {0, 0, kWidth, kHeight, 0, 1};
    const VkRect2D everything = {{0, 0}, {kWidth, kHeight}};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &everything);
  }
};

TEST_F(LoadAndStore, LoadKeepsWhatWasStored) {
  const samples::PipelineLayout layout = create_layout(subject());
  PipelineState state;
  state.vertex_shader = shaders::kPositionColorVert;
  state.fragment_shader = shaders::kFlatColorFrag;
  state.depth_test = state.depth_write = true;
  state.layout = layout.get();
  state.render_pass = canvas.render_pass();
  const samples::Pipeline pipeline = create_pipeline(subject(), state);
  // A big triangle over everything at depth 0.5, green.
  const std::vector<std::array<float, 8>> vertices = {
      {-1, -1, 0.5f, 1, 0, 1, 0, 1}, {3, -1, 0.5f, 1, 0, 1, 0, 1}, {-1, 3, 0.5f, 1, 0, 1, 0, 1}};
  const samples::Buffer buffer(subject(), std::span<const std::array<float, 8>>(vertices),
                               VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  const VkBuffer vertex_buffer = buffer.get();
  const VkDeviceSize offset = 0;
  const VkRect2D area = {{13, 7}, {77, 41}};
  VkCommandBuffer commands = subject().begin_commands();
  canvas.begin(commands, kRed, 0.75f);
  Canvas::end(commands);
  begin_loading(commands, area);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
  vkCmdBindVertexBuffers(commands, 0, 1, &vertex_buffer, &offset);
  const VkRect2D scissor = {{20, 0}, {200, 200}};
  vkCmdSetScissor(commands, 0, 1, &scissor);
  vkCmdDraw(commands, 3, 1, 0, 0);
  Canvas::end(commands);
  // A third pass: what the second wrote to depth is tested against.
  begin_loading(commands, {{0, 0}, {kWidth, kHeight}});
  Canvas::end(commands);
  subject().submit_and_wait(commands);
  const auto image = canvas.read_color<uint32_t>();
  const auto depth = canvas.read_depth();
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      // Drawing is limited to the scissor; the application keeps it within the render area, a driver may clip to both.
      const bool in_area = inside(area, x, y), in_scissor = inside(scissor, x, y);
      if (in_area != in_scissor && !in_area) continue;
      const bool drawn = in_area && in_scissor;
      ASSERT_EQ(image[y * kWidth + x], drawn ? kGreenWord : kRedWord) << x << "," << y;
      ASSERT_EQ(depth[y * kWidth + x], drawn ? 0.5f : 0.75f) << x << "," << y;
    }
  }
}

TEST_F(LoadAndStore, ClearAttachmentsInRectangles) {
  VkCommandBuffer commands = subject().begin_commands();
  canvas.begin(commands, kRed, 0.75f);
  VkClearAttachment color = {};
  color.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT;
  color.clearValue.color = kGreen;
  VkClearAttachment depth = {};
  depth.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT;
  depth.clearValue.depthStencil = {0.125f, 0};
  const VkClearRect rects[] = {{{{1, 1}, {10, 10}}, 0, 1}, {{{60, 3}, {70, 66}}, 0, 1}};
  const VkClearRect depth_rect = {{{5, 5}, {100, 20}}, 0, 1};
  vkCmdClearAttachments(commands, 1, &color, 2, rects);
  vkCmdClearAttachments(commands, 1, &depth, 1, &depth_rect);
  Canvas::end(commands);
  subject().submit_and_wait(commands);
  const auto image = canvas.read_color<uint32_t>();
  const auto depths = canvas.read_depth();
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      const bool green = inside(rects[0].rect, x, y) || inside(rects[1].rect, x, y);
      ASSERT_EQ(image[y * kWidth + x], green ? kGreenWord : kRedWord) << x << "," << y;
      ASSERT_EQ(depths[y * kWidth + x], inside(depth_rect.rect, x, y) ? 0.125f : 0.75f) << x << "," << y;
    }
  }
}

TEST(RenderPasses, ClearValuesAreRoundedToNearest) {
  for (const VkFormat format : {VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_B8G8R8A8_UNORM}) {
    const Canvas canvas(subject(), {.width = 4, .height = 4, .color_format = format});
    VkCommandBuffer commands = subject().begin_commands();
    canvas.begin(commands, {{0.1f, -3.0f, 0.9981f, 7.0f}});  // 25.5, 0, 254.5155, 255
    Canvas::end(commands);
    subject().submit_and_wait(commands);
    const auto texel = canvas.read_color<std::array<uint8_t, 4>>()[5];
    const bool swapped = format == VK_FORMAT_B8G8R8A8_UNORM;
    EXPECT_TRUE(texel[swapped ? 2 : 0] == 25 || texel[swapped ? 2 : 0] == 26);
    EXPECT_EQ(texel[1], 0);
    EXPECT_EQ(texel[swapped ? 0 : 2], 255);
    EXPECT_EQ(texel[3], 255);
  }
}

TEST(RenderPasses, FloatAttachmentKeepsBits) {
  const Canvas canvas(subject(), {.width = 70, .height = 3, .color_format = VK_FORMAT_R32G32B32A32_SFLOAT});
  VkCommandBuffer commands = subject().begin_commands();
  canvas.begin(commands, {{-1.5f, 3.0e38f, 1e-30f, -0.0f}});
  Canvas::end(commands);
  subject().submit_and_wait(commands);
  for (const auto& t : canvas.read_color<std::array<float, 4>>()) {
    ASSERT_EQ(t[0], -1.5f);
    ASSERT_EQ(t[1], 3.0e38f);
    ASSERT_EQ(t[2], 1e-30f);
    ASSERT_TRUE(t[3] == 0 && std::signbit(t[3]));
  }
}

TEST(RenderPasses, DepthOnlyWithoutFragmentShader) {
  const Canvas canvas(subject(), {.width = 40, .height = 40, .color = false, .depth = true});
  const samples::PipelineLayout layout = create_layout(subject());
  PipelineState state;
  state.vertex_shader = shaders::kPositionColorVert;
  state.has_color = false;
  state.depth_test = state.depth_write = true;
  state.layout = layout.get();
  state.render_pass = canvas.render_pass();
  const samples::Pipeline pipeline = create_pipeline(subject(), state);
  const std::vector<std::array<float, 8>> vertices = {{-1, -1, 0.25f, 1}, {1, -1, 0.25f, 1}, {-1, 1, 0.25f, 1}};
  draw_vertices(canvas, pipeline, std::as_bytes(std::span(vertices)));
  const auto depth = canvas.read_depth();
  for (uint32_t y = 0; y < 40; ++y) {
    for (uint32_t x = 0; x < 40; ++x) ASSERT_EQ(depth[y * 40 + x], x + y < 39 ? 0.25f : 1.0f) << x << "," << y;
  }
}

}  // namespace
}  // namespace lapilli::conformance
