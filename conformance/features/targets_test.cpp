// Several colour attachments of different formats in one subpass. Specification: "Render Pass".
#include <gtest/gtest.h>

#include <array>
#include <memory>

#include "common/pipeline.h"
#include "harness/canvas.h"
#include "harness/devices.h"
#include "harness/graphics.h"
#include "shaders/position_color.vert.h"
#include "shaders/three_targets.frag.h"

namespace lapilli::conformance {
namespace {

constexpr uint32_t kWidth = 70, kHeight = 9;
using Vertices = std::vector<std::array<float, 8>>;

Vertices full_screen() {
  return {{-1, -1, 0, 1, 1, 0.2f, 0.4f, 1}, {3, -1, 0, 1, 1, 0.2f, 0.4f, 1}, {-1, 3, 0, 1, 1, 0.2f, 0.4f, 1}};
}

VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits kind, VkShaderModule module) {
  VkPipelineShaderStageCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage = kind;
  info.module = module;
  info.pName = "main";
  return info;
}

// A pipeline like harness/graphics.h makes, but with three attachments that share one blend state.
samples::Pipeline three_target_pipeline(VkPipelineLayout layout, VkRenderPass pass) {
  const samples::ShaderModule vertex = samples::create_shader_module(subject(), shaders::kPositionColorVert);
  const samples::ShaderModule fragment = samples::create_shader_module(subject(), shaders::kThreeTargetsFrag);
  const std::array<VkPipelineShaderStageCreateInfo, 2> stages = {stage(VK_SHADER_STAGE_VERTEX_BIT, vertex.get()),
                                                                 stage(VK_SHADER_STAGE_FRAGMENT_BIT, fragment.get())};
  const PipelineState defaults;
  VkPipelineVertexInputStateCreateInfo input = {};
  input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
  input.vertexBindingDescriptionCount = uint32_t(defaults.bindings.size());
  input.pVertexBindingDescriptions = defaults.bindings.data();
  input.vertexAttributeDescriptionCount = uint32_t(defaults.attributes.size());
  input.pVertexAttributeDescriptions = defaults.attributes.data();
  VkPipelineInputAssemblyStateCreateInfo assembly = {};
  assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
  assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  const VkViewport viewport = {0, 0, kWidth, kHeight, 0, 1};
  const VkRect2D scissor = {{0, 0}, {kWidth, kHeight}};
  VkPipelineViewportStateCreateInfo viewports = {};
  viewports.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
  viewports.viewportCount = viewports.scissorCount = 1;
  viewports.pViewports = &viewport;
  viewports.pScissors = &scissor;
  VkPipelineRasterizationStateCreateInfo raster = {};
  raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
  raster.lineWidth = 1;
  VkPipelineMultisampleStateCreateInfo multisample = {};
  multisample.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
  multisample.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
  const std::array<VkPipelineColorBlendAttachmentState, 3> attachments = {defaults.blend, defaults.blend,
                                                                          defaults.blend};
  VkPipelineColorBlendStateCreateInfo blend = {};
  blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
  blend.attachmentCount = 3;
  blend.pAttachments = attachments.data();
  VkGraphicsPipelineCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
  info.stageCount = 2;
  info.pStages = stages.data();
  info.pVertexInputState = &input;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &viewports;
  info.pRasterizationState = &raster;
  info.pMultisampleState = &multisample;
  info.pColorBlendState = &blend;
  info.layout = layout;
  info.renderPass = pass;
  VkPipeline pipeline = VK_NULL_HANDLE;
  samples::check(vkCreateGraphicsPipelines(subject().device(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
                 "vkCreateGraphicsPipelines");
  return {subject().device(), pipeline};
}

TEST(Targets, ThreeFormatsAtOnce) {
  constexpr VkFormat kFormats[3] = {VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R32G32B32A32_SFLOAT};
  // Canvases give the images and read them back; the pass over all three is made here.
  std::vector<std::unique_ptr<Canvas>> canvases;
  std::array<VkAttachmentDescription, 3> attachments = {};
  std::array<VkAttachmentReference, 3> references;
  std::array<VkImageView, 3> views;
  for (uint32_t i = 0; i < 3; ++i) {
    canvases.push_back(std::make_unique<Canvas>(
        subject(), CanvasOptions{.width = kWidth, .height = kHeight, .color_format = kFormats[i]}));
    views[i] = canvases[i]->color().view();
    attachments[i].format = kFormats[i];
    attachments[i].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[i].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[i].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachments[i].finalLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    references[i] = {i, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  }
  VkSubpassDescription subpass = {};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = 3;
  subpass.pColorAttachments = references.data();
  VkRenderPassCreateInfo pass_info = {};
  pass_info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
  pass_info.attachmentCount = 3;
  pass_info.pAttachments = attachments.data();
  pass_info.subpassCount = 1;
  pass_info.pSubpasses = &subpass;
  VkRenderPass raw_pass = VK_NULL_HANDLE;
  samples::check(vkCreateRenderPass(subject().device(), &pass_info, nullptr, &raw_pass), "vkCreateRenderPass");
  const samples::RenderPass pass(subject().device(), raw_pass);
  VkFramebufferCreateInfo framebuffer_info = {};
  framebuffer_info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
  framebuffer_info.renderPass = raw_pass;
  framebuffer_info.attachmentCount = 3;
  framebuffer_info.pAttachments = views.data();
  framebuffer_info.width = kWidth;
  framebuffer_info.height = kHeight;
  framebuffer_info.layers = 1;
  VkFramebuffer raw_framebuffer = VK_NULL_HANDLE;
  samples::check(vkCreateFramebuffer(subject().device(), &framebuffer_info, nullptr, &raw_framebuffer),
                 "vkCreateFramebuffer");
  const samples::Framebuffer framebuffer(subject().device(), raw_framebuffer);
  const samples::PipelineLayout layout = create_layout(subject());
  const samples::Pipeline pipeline = three_target_pipeline(layout.get(), raw_pass);
  const Vertices vertices = full_screen();
  const samples::Buffer buffer(subject(), std::span<const std::array<float, 8>>(vertices),
                               VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  const VkBuffer vertex_buffer = buffer.get();
  const VkDeviceSize offset = 0;
  const std::array<VkClearValue, 3> clears = {};
  VkRenderPassBeginInfo begin = {};
  begin.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
  begin.renderPass = raw_pass;
  begin.framebuffer = raw_framebuffer;
  begin.renderArea = {{0, 0}, {kWidth, kHeight}};
  begin.clearValueCount = 3;
  begin.pClearValues = clears.data();
  VkCommandBuffer commands = subject().begin_commands();
  vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
  vkCmdBindVertexBuffers(commands, 0, 1, &vertex_buffer, &offset);
  vkCmdDraw(commands, 3, 1, 0, 0);
  vkCmdEndRenderPass(commands);
  subject().submit_and_wait(commands);
  const auto first = canvases[0]->read_color<uint32_t>(), second = canvases[1]->read_color<uint32_t>();
  const auto third = canvases[2]->read_color<std::array<float, 4>>();
  for (uint32_t y = 0; y < kHeight; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      const size_t at = y * kWidth + x;
      ASSERT_EQ(first[at], rgba(255, 51, 102, 255));
      // (0.4, 0.2, 1, 1) / 2 in red, green, blue, alpha; blue is the lowest byte, 127.5 may go either way.
      ASSERT_EQ(second[at] >> 16 & 0xFF, 51u);
      ASSERT_NEAR(double(second[at] >> 8 & 0xFF), 25.5, 0.51);
      ASSERT_NEAR(double(second[at] & 0xFF), 127.5, 0.51);
      ASSERT_EQ(third[at], (std::array<float, 4>{float(x) + 0.5f, float(y) + 0.5f, 1.0f, 0.2f}));
    }
  }
}

}  // namespace
}  // namespace lapilli::conformance
