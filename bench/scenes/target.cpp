// Attachments, render pass and readback. Specification: Render Pass.
#include "scenes/target.h"

#include <cstring>
#include <vector>

namespace lapilli::bench {
namespace {

VkAttachmentDescription attachment(VkFormat format, VkSampleCountFlagBits count, bool cleared, bool kept,
                                   VkImageLayout final_layout) {
  return samples::describe_attachment(
      format, count, cleared ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_DONT_CARE,
      kept ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE, final_layout);
}

}  // namespace

Target::Target(const samples::Context& context, VkExtent2D extent, const TargetShape& shape)
    : picture_(context, extent, kColorFormat, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT) {
  const bool resolves = shape.samples != VK_SAMPLE_COUNT_1_BIT;
  std::vector<VkImageView> views;
  if (resolves) {
    many_samples_ =
        samples::Image(context, extent, kColorFormat, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, {1, shape.samples});
    views.push_back(many_samples_.view());
  }
  views.push_back(picture_.view());
  if (shape.depth) {
    depth_ =
        samples::Image(context, extent, kDepthFormat, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, {1, shape.samples});
    views.push_back(depth_.view());
  }
  attachments_ = static_cast<uint32_t>(views.size());
  create_render_pass(context, shape);
  framebuffer_ = samples::create_framebuffer(context, render_pass_, views, extent);
}

void Target::create_render_pass(const samples::Context& context, const TargetShape& shape) {
  const bool resolves = shape.samples != VK_SAMPLE_COUNT_1_BIT;
  std::vector<VkAttachmentDescription> attachments;
  const VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  const VkAttachmentReference resolved = {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  if (resolves) {
    attachments.push_back(
        attachment(kColorFormat, shape.samples, true, false, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL));
  }
  attachments.push_back(
      attachment(kColorFormat, VK_SAMPLE_COUNT_1_BIT, !resolves, true, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL));
  const VkAttachmentReference depth = {static_cast<uint32_t>(attachments.size()),
                                       VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
  if (shape.depth) {
    attachments.push_back(
        attachment(kDepthFormat, shape.samples, true, false, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL));
  }
  VkSubpassDescription subpass = {};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = 1;
  subpass.pColorAttachments = &color;
  subpass.pResolveAttachments = resolves ? &resolved : nullptr;
  subpass.pDepthStencilAttachment = shape.depth ? &depth : nullptr;
  render_pass_ = samples::create_render_pass(context, attachments, subpass);
}

void Target::begin(VkCommandBuffer commands, const std::array<float, 4>& clear_color) const {
  std::array<VkClearValue, 3> clear = {};
  std::memcpy(clear[0].color.float32, clear_color.data(), sizeof(clear_color));
  clear[attachments_ - 1 == 0 ? 2 : attachments_ - 1].depthStencil = {1.0f, 0};
  VkRenderPassBeginInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
  info.renderPass = render_pass_.get();
  info.framebuffer = framebuffer_.get();
  info.renderArea = {{0, 0}, extent()};
  info.clearValueCount = attachments_;
  info.pClearValues = clear.data();
  vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
}

samples::Frame Target::read_back(const samples::Context& context) const {
  const size_t bytes = size_t{extent().width} * extent().height * 4;
  const samples::Buffer buffer(context, bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  VkCommandBuffer commands = context.begin_commands();
  VkBufferImageCopy region = {};
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.imageExtent = {extent().width, extent().height, 1};
  vkCmdCopyImageToBuffer(commands, picture_.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer.get(), 1, &region);
  VkMemoryBarrier for_host = {};
  for_host.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  for_host.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  for_host.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &for_host, 0,
                       nullptr, 0, nullptr);
  context.submit_and_wait(commands);
  samples::Frame frame = {extent().width, extent().height, std::vector<uint8_t>(bytes), {}};
  std::memcpy(frame.color.data(), buffer.data(), bytes);
  return frame;
}

bool offers_samples(const samples::Context& context, VkSampleCountFlagBits samples) {
  const VkPhysicalDeviceLimits& limits = context.properties().limits;
  return (limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts &
          static_cast<VkSampleCountFlags>(samples)) != 0;
}

bool offers_format(const samples::Context& context, VkFormat format, VkFormatFeatureFlags features) {
  VkFormatProperties properties = {};
  vkGetPhysicalDeviceFormatProperties(context.physical_device(), format, &properties);
  return (properties.optimalTilingFeatures & features) == features;
}

}  // namespace lapilli::bench
