// Order within a render pass: clears between draws, and subpasses that hand attachments on. Specification: "Render
// Pass", "Clear Commands".
#include <gtest/gtest.h>

#include "common/barriers.h"
#include "features/drawing_fixture.h"

namespace lapilli::conformance {
namespace {

constexpr uint32_t kWidth = 90, kHeight = 70;
constexpr uint32_t kRed = 0xFF0000FF, kGreen = 0xFF00FF00, kBlue = 0xFFFF0000;

samples::Buffer rectangles(const Canvas& canvas, std::span<const VkRect2D> areas,
                           std::span<const std::array<float, 4>> colors) {
  std::vector<ColoredVertex> vertices;
  for (size_t i = 0; i < areas.size(); ++i) add_rectangle(vertices, canvas, areas[i], 0, colors[i]);
  return {subject(), std::span<const ColoredVertex>(vertices), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT};
}

bool inside(const VkRect2D& r, uint32_t x, uint32_t y) {
  return int(x) >= r.offset.x && int(y) >= r.offset.y && x < uint32_t(r.offset.x) + r.extent.width &&
         y < uint32_t(r.offset.y) + r.extent.height;
}

TEST(PassOrder, AClearComesAfterTheDrawsBeforeIt) {
  const Canvas canvas(subject(), {.width = kWidth, .height = kHeight});
  const FlatPipeline flat(canvas);
  const VkRect2D areas[] = {{{5, 5}, {60, 60}}, {{30, 30}, {20, 20}}};
  const std::array<float, 4> colors[] = {{1, 0, 0, 1}, {0, 0, 1, 1}};
  const samples::Buffer vertices = rectangles(canvas, areas, colors);
  const VkClearRect cleared = {{{20, 0}, {50, 70}}, 0, 1};
  VkCommandBuffer commands = subject().begin_commands();
  canvas.begin(commands, {});
  flat.bind(commands, vertices);
  vkCmdDraw(commands, 6, 1, 0, 0);
  VkClearAttachment clear = {};
  clear.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT;
  clear.clearValue.color = {{0, 1, 0, 1}};
  vkCmdClearAttachments(commands, 1, &clear, 1, &cleared);
  vkCmdDraw(commands, 6, 1, 6, 0);
  Canvas::end(commands);
  subject().submit_and_wait(commands);
  const auto image = canvas.read_color<uint32_t>();
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      const uint32_t want = inside(areas[1], x, y)       ? kBlue
                            : inside(cleared.rect, x, y) ? kGreen
                            : inside(areas[0], x, y)     ? kRed
                                                         : 0;
      ASSERT_EQ(image[y * kWidth + x], want) << x << "," << y;
    }
  }
}

// Two subpasses draw to one attachment: the second finds what the first left.
class Subpasses : public testing::Test {
 protected:
  Canvas canvas{subject(), {.width = kWidth, .height = kHeight}};
  samples::RenderPass pass = make_pass();
  samples::Framebuffer framebuffer = make_framebuffer();

  static samples::RenderPass make_pass() {
    VkAttachmentDescription attachment = {};
    attachment.format = VK_FORMAT_R8G8B8A8_UNORM;
    attachment.samples = VK_SAMPLE_COUNT_1_BIT;
    attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachment.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    attachment.finalLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    const VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    const VkSubpassDescription subpasses[] = {subpass, subpass};
    constexpr VkPipelineStageFlags kOutput = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    constexpr VkAccessFlags kWrite = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
    const VkSubpassDependency dependencies[] = {
        {0, 1, kOutput, kOutput, kWrite, kWrite, 0},
        {1, VK_SUBPASS_EXTERNAL, kOutput, VK_PIPELINE_STAGE_TRANSFER_BIT, kWrite, VK_ACCESS_TRANSFER_READ_BIT, 0}};
    VkRenderPassCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = 1;
    info.pAttachments = &attachment;
    info.subpassCount = 2;
    info.pSubpasses = subpasses;
    info.dependencyCount = 2;
    info.pDependencies = dependencies;
    VkRenderPass raw = VK_NULL_HANDLE;
    samples::check(vkCreateRenderPass(subject().device(), &info, nullptr, &raw), "vkCreateRenderPass");
    return {subject().device(), raw};
  }
  samples::Framebuffer make_framebuffer() const {
    const VkImageView view = canvas.color().view();
    VkFramebufferCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    info.renderPass = pass.get();
    info.attachmentCount = 1;
    info.pAttachments = &view;
    info.width = kWidth;
    info.height = kHeight;
    info.layers = 1;
    VkFramebuffer raw = VK_NULL_HANDLE;
    samples::check(vkCreateFramebuffer(subject().device(), &info, nullptr, &raw), "vkCreateFramebuffer");
    return {subject().device(), raw};
  }
  samples::Pipeline make_pipeline(VkPipelineLayout layout, uint32_t subpass) const {
    PipelineState state;
    state.vertex_shader = shaders::kPositionColorVert;
    state.fragment_shader = shaders::kFlatColorFrag;
    state.layout = layout;
    state.render_pass = pass.get();
    state.subpass = subpass;
    return create_pipeline(subject(), state);
  }
};

TEST_F(Subpasses, TheSecondLoadsWhatTheFirstDrew) {
  const samples::PipelineLayout layout = create_layout(subject());
  const samples::Pipeline pipelines[] = {make_pipeline(layout.get(), 0), make_pipeline(layout.get(), 1)};
  const VkRect2D areas[] = {{{5, 5}, {60, 60}}, {{30, 30}, {60, 20}}};
  const std::array<float, 4> colors[] = {{1, 0, 0, 1}, {0, 0, 1, 1}};
  const samples::Buffer vertices = rectangles(canvas, areas, colors);
  const VkBuffer buffer = vertices.get();
  const VkDeviceSize offset = 0;
  const VkClearValue clear = {.color = {{0, 1, 0, 1}}};
  VkRenderPassBeginInfo begin = {};
  begin.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
  begin.renderPass = pass.get();
  begin.framebuffer = framebuffer.get();
  begin.renderArea = {{0, 0}, {kWidth, kHeight}};
  begin.clearValueCount = 1;
  begin.pClearValues = &clear;
  const VkViewport viewport = {0, 0, kWidth, kHeight, 0, 1};
  VkCommandBuffer commands = subject().begin_commands();
  vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
  vkCmdSetViewport(commands, 0, 1, &viewport);
  vkCmdSetScissor(commands, 0, 1, &begin.renderArea);
  vkCmdBindVertexBuffers(commands, 0, 1, &buffer, &offset);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines[0].get());
  vkCmdDraw(commands, 6, 1, 0, 0);
  vkCmdNextSubpass(commands, VK_SUBPASS_CONTENTS_INLINE);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines[1].get());
  vkCmdDraw(commands, 6, 1, 6, 0);
  vkCmdEndRenderPass(commands);
  subject().submit_and_wait(commands);
  const auto image = canvas.read_color<uint32_t>();
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      const uint32_t want = inside(areas[1], x, y) ? kBlue : inside(areas[0], x, y) ? kRed : kGreen;
      ASSERT_EQ(image[y * kWidth + x], want) << x << "," << y;
    }
  }
}

}  // namespace
}  // namespace lapilli::conformance
