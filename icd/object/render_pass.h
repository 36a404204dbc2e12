// VkRenderPass and VkFramebuffer. Specification: chapter "Render Pass".
#pragma once

#include "object/image.h"

namespace lapilli {

inline constexpr uint32_t kUnusedAttachment = VK_ATTACHMENT_UNUSED;

// The attachments of a subpass, as indices into those of the render pass.
struct Subpass {
  explicit Subpass(const HostMemory& host) : color(host), input(host) {}

  HostVector<uint32_t> color;
  HostVector<uint32_t> input;
  uint32_t depth = kUnusedAttachment;
};

struct RenderPass : Handle<RenderPass, VkRenderPass> {
  explicit RenderPass(const HostMemory& memory) : Handle(memory), attachments(host), subpasses(host) {}

  HostVector<VkAttachmentDescription> attachments;
  HostVector<Subpass> subpasses;

  // VK_FORMAT_UNDEFINED for an unused attachment.
  VkFormat format_of(uint32_t attachment) const;
};

VkResult create_render_pass(DeviceContext& device, const VkRenderPassCreateInfo& info,
                            const VkAllocationCallbacks* callbacks, VkRenderPass* handle);

struct Framebuffer : Handle<Framebuffer, VkFramebuffer> {
  explicit Framebuffer(const HostMemory& memory) : Handle(memory), attachments(host) {}

  HostVector<ImageView*> attachments;
  uint32_t width = 0;  // pixels
  uint32_t height = 0;
  uint32_t layers = 1;
};

VkResult create_framebuffer(DeviceContext& device, const VkFramebufferCreateInfo& info,
                            const VkAllocationCallbacks* callbacks, VkFramebuffer* handle);

}  // namespace lapilli
