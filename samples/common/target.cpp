// Attachments, render pass, framebuffer and readback. Specification: Render Pass; Copy Commands.
#include "common/target.h"

#include <cstring>

namespace lapilli::samples {
namespace {

void copy_to_buffer(VkCommandBuffer commands, const Image& image, VkImageAspectFlags aspect, const Buffer& buffer) {
  VkBufferImageCopy region = {};
  region.imageSubresource = {aspect, 0, 0, 1};
  region.imageExtent = {image.extent().width, image.extent().height, 1};
  vkCmdCopyImageToBuffer(commands, image.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer.get(), 1, &region);
}

}  // namespace

VkAttachmentDescription describe_attachment(VkFormat format, VkSampleCountFlagBits samples, VkAttachmentLoadOp load_op,
                                            VkAttachmentStoreOp store_op, VkImageLayout final_layout) {
  VkAttachmentDescription attachment = {};
  attachment.format = format;
  attachment.samples = samples;
  attachment.loadOp = load_op;
  attachment.storeOp = store_op;
  attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  attachment.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  attachment.finalLayout = final_layout;
  return attachment;
}

RenderPass create_render_pass(const Context& context, std::span<const VkAttachmentDescription> attachments,
                              const VkSubpassDescription& subpass) {
  constexpr VkPipelineStageFlags kAttachmentStages = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT |
                                                     VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT |
                                                     VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
  constexpr VkAccessFlags kAttachmentWrites =
      VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
  constexpr VkAccessFlags kAttachmentReads =
      VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT;
  // Before: the frame drawn last and the copy of it. After: the copy of this one.
  const std::array<VkSubpassDependency, 2> dependencies = {{
      {VK_SUBPASS_EXTERNAL, 0, kAttachmentStages | VK_PIPELINE_STAGE_TRANSFER_BIT, kAttachmentStages, kAttachmentWrites,
       kAttachmentReads | kAttachmentWrites, 0},
      {0, VK_SUBPASS_EXTERNAL, kAttachmentStages, VK_PIPELINE_STAGE_TRANSFER_BIT, kAttachmentWrites,
       VK_ACCESS_TRANSFER_READ_BIT, 0},
  }};
  VkRenderPassCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
  info.attachmentCount = static_cast<uint32_t>(attachments.size());
  info.pAttachments = attachments.data();
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  info.dependencyCount = static_cast<uint32_t>(dependencies.size());
  info.pDependencies = dependencies.data();
  VkRenderPass render_pass = VK_NULL_HANDLE;
  check(vkCreateRenderPass(context.device(), &info, nullptr, &render_pass), "vkCreateRenderPass");
  return RenderPass(context.device(), render_pass);
}

Framebuffer create_framebuffer(const Context& context, const RenderPass& render_pass,
                               std::span<const VkImageView> views, VkExtent2D extent) {
  VkFramebufferCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
  info.renderPass = render_pass.get();
  info.attachmentCount = static_cast<uint32_t>(views.size());
  info.pAttachments = views.data();
  info.width = extent.width;
  info.height = extent.height;
  info.layers = 1;
  VkFramebuffer framebuffer = VK_NULL_HANDLE;
  check(vkCreateFramebuffer(context.device(), &info, nullptr, &framebuffer), "vkCreateFramebuffer");
  return Framebuffer(context.device(), framebuffer);
}

RenderTarget::RenderTarget(const Context& context, VkExtent2D extent)
    : color_(context, extent, kColorFormat, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT),
      depth_(context, extent, kDepthFormat,
             VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT) {
  const auto cleared = [](VkFormat format) {
    return describe_attachment(format, VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_STORE_OP_STORE,
                               VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
  };
  const std::array<VkAttachmentDescription, 2> attachments = {cleared(kColorFormat), cleared(kDepthFormat)};
  const VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  const VkAttachmentReference depth = {1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
  VkSubpassDescription subpass = {};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = 1;
  subpass.pColorAttachments = &color;
  subpass.pDepthStencilAttachment = &depth;
  render_pass_ = create_render_pass(context, attachments, subpass);
  framebuffer_ = create_framebuffer(context, render_pass_, std::array{color_.view(), depth_.view()}, extent);
}

void RenderTarget::begin(VkCommandBuffer commands, const std::array<float, 4>& clear_color, float clear_depth) const {
  std::array<VkClearValue, 2> clear = {};
  std::memcpy(clear[0].color.float32, clear_color.data(), sizeof(clear_color));
  clear[1].depthStencil = {clear_depth, 0};
  VkRenderPassBeginInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
  info.renderPass = render_pass_.get();
  info.framebuffer = framebuffer_.get();
  info.renderArea = {{0, 0}, extent()};
  info.clearValueCount = static_cast<uint32_t>(clear.size());
  info.pClearValues = clear.data();
  vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
}

void RenderTarget::end(VkCommandBuffer commands) const { vkCmdEndRenderPass(commands); }

Frame RenderTarget::read_back(const Context& context) const {
  const VkDeviceSize pixels = VkDeviceSize{extent().width} * extent().height;
  const Buffer color(context, pixels * 4, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  const Buffer depth(context, pixels * 4, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  VkCommandBuffer commands = context.begin_commands();
  copy_to_buffer(commands, color_, VK_IMAGE_ASPECT_COLOR_BIT, color);
  copy_to_buffer(commands, depth_, VK_IMAGE_ASPECT_DEPTH_BIT, depth);
  VkMemoryBarrier for_host = {};
  for_host.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  for_host.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  for_host.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &for_host, 0,
                       nullptr, 0, nullptr);
  context.submit_and_wait(commands);

  Frame frame = {extent().width, extent().height, std::vector<uint8_t>(pixels * 4), std::vector<float>(pixels)};
  std::memcpy(frame.color.data(), color.data(), frame.color.size());
  std::memcpy(frame.depth.data(), depth.data(), frame.depth.size() * sizeof(float));
  return frame;
}

}  // namespace lapilli::samples
