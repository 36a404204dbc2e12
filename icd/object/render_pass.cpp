// Render passes and framebuffers: checked once, here, so that drawing can rely on them.
#include "object/render_pass.h"

#include <algorithm>

#include "object/limits.h"
#include "shader/batch.h"

namespace lapilli {
namespace {

VkResult refuse(const char* what) {
  log_error("vkCreateRenderPass: %s", what);
  return VK_ERROR_UNKNOWN;
}

bool valid_reference(const VkRenderPassCreateInfo& info, uint32_t attachment) {
  return attachment == kUnusedAttachment || attachment < info.attachmentCount;
}

VkResult check_attachment(const VkAttachmentDescription& attachment) {
  const FormatInfo* format = find_format(attachment.format);
  if (format == nullptr || !(format->has(kColorTarget) || format->has(kDepthTarget) || format->has(kSampled))) {
    log_error("vkCreateRenderPass: format %d cannot be an attachment", attachment.format);
    return VK_ERROR_UNKNOWN;
  }
  if (attachment.samples != VK_SAMPLE_COUNT_1_BIT) return refuse("multisampling is not supported");
  return VK_SUCCESS;
}

VkResult add_subpass(RenderPass& pass, const VkRenderPassCreateInfo& info, const VkSubpassDescription& description) {
  Subpass subpass(pass.host);
  if (description.pipelineBindPoint != VK_PIPELINE_BIND_POINT_GRAPHICS) return refuse("a subpass draws");
  if (description.colorAttachmentCount > kMaxColorAttachments) return refuse("too many colour attachments");
  for (uint32_t i = 0; i < description.colorAttachmentCount; ++i) {
    const uint32_t attachment = description.pColorAttachments[i].attachment;
    if (!valid_reference(info, attachment)) return refuse("a colour attachment that does not exist");
    const FormatInfo* format = find_format(pass.format_of(attachment));
    if (format != nullptr && !format->has(kColorTarget)) return refuse("a colour attachment without a colour format");
    const bool resolves = description.pResolveAttachments != nullptr &&
                          description.pResolveAttachments[i].attachment != kUnusedAttachment;
    if (resolves) return refuse("resolve attachments need multisampling, which is not supported");
    subpass.color.push_back(attachment);
  }
  for (uint32_t i = 0; i < description.inputAttachmentCount; ++i) {
    const uint32_t attachment = description.pInputAttachments[i].attachment;
    if (!valid_reference(info, attachment)) return refuse("an input attachment that does not exist");
    subpass.input.push_back(attachment);
  }
  if (description.pDepthStencilAttachment != nullptr) {
    subpass.depth = description.pDepthStencilAttachment->attachment;
    if (!valid_reference(info, subpass.depth)) return refuse("a depth attachment that does not exist");
    const FormatInfo* format = find_format(pass.format_of(subpass.depth));
    if (format != nullptr && !format->has(kDepthTarget)) return refuse("a depth attachment without a depth format");
  }
  pass.subpasses.push_back(std::move(subpass));
  return VK_SUCCESS;
}

}  // namespace

VkFormat RenderPass::format_of(uint32_t attachment) const {
  return attachment == kUnusedAttachment ? VK_FORMAT_UNDEFINED : attachments[attachment].format;
}

VkResult create_render_pass(DeviceContext& device, const VkRenderPassCreateInfo& info,
                            const VkAllocationCallbacks* callbacks, VkRenderPass* handle) {
  auto pass = make_object<RenderPass>(device.object_memory(callbacks), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  if (info.attachmentCount > kMaxFramebufferAttachments) return refuse("too many attachments");
  if (info.subpassCount == 0) return refuse("there is no subpass");
  for (uint32_t i = 0; i < info.attachmentCount; ++i) {
    if (const VkResult bad = check_attachment(info.pAttachments[i]); bad != VK_SUCCESS) return bad;
    pass->attachments.push_back(info.pAttachments[i]);
  }
  pass->subpasses.reserve(info.subpassCount);
  for (uint32_t i = 0; i < info.subpassCount; ++i) {
    if (const VkResult bad = add_subpass(*pass, info, info.pSubpasses[i]); bad != VK_SUCCESS) return bad;
  }
  return publish(std::move(pass), handle);
}

VkResult create_framebuffer(DeviceContext& device, const VkFramebufferCreateInfo& info,
                            const VkAllocationCallbacks* callbacks, VkFramebuffer* handle) {
  const RenderPass& pass = *RenderPass::from(info.renderPass);
  auto framebuffer = make_object<Framebuffer>(device.object_memory(callbacks), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  const bool size_fits = info.width >= 1 && info.width <= kMaxImageDimension2D && info.height >= 1 &&
                         info.height <= kMaxImageDimension2D && info.layers >= 1 && info.layers <= kMaxImageLayers;
  if (!size_fits || info.attachmentCount != pass.attachments.size()) {
    log_error("vkCreateFramebuffer: %u x %u pixels, %u layers, %u attachments do not fit the limits or the render pass",
              info.width, info.height, info.layers, info.attachmentCount);
    return VK_ERROR_UNKNOWN;
  }
  framebuffer->width = info.width;
  framebuffer->height = info.height;
  framebuffer->layers = info.layers;
  for (uint32_t i = 0; i < info.attachmentCount; ++i) {
    ImageView* view = ImageView::from(info.pAttachments[i]);
    const TextureLevel& level = view->texture.levels[0];
    const bool covers = static_cast<uint32_t>(level.width) >= info.width &&
                        static_cast<uint32_t>(level.height) >= info.height && view->range.layerCount >= info.layers;
    if (!covers || view->format->format != pass.attachments[i].format) {
      log_error("vkCreateFramebuffer: attachment %u has another format than the render pass or is too small", i);
      return VK_ERROR_UNKNOWN;
    }
    framebuffer->attachments.push_back(view);
  }
  return publish(std::move(framebuffer), handle);
}

}  // namespace lapilli
