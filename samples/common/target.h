// What the samples draw into: a colour and a depth attachment, their render pass, and the way back to the host.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "common/resources.h"

namespace lapilli::samples {

// Pixels, rows top down.
struct Frame {
  uint32_t width = 0;
  uint32_t height = 0;
  std::vector<uint8_t> color;  // red, green, blue, alpha, a byte each
  std::vector<float> depth;    // as the D32_SFLOAT attachment holds it
};

// An attachment whose contents before the pass are cleared or of no interest; stencil is ignored.
VkAttachmentDescription describe_attachment(VkFormat format, VkSampleCountFlagBits samples, VkAttachmentLoadOp load_op,
                                            VkAttachmentStoreOp store_op, VkImageLayout final_layout);
// A pass of one subpass, whose attachments the frame before and copies may still be using, and copies read afterwards.
RenderPass create_render_pass(const Context& context, std::span<const VkAttachmentDescription> attachments,
                              const VkSubpassDescription& subpass);
Framebuffer create_framebuffer(const Context& context, const RenderPass& render_pass,
                               std::span<const VkImageView> views, VkExtent2D extent);

class RenderTarget {
 public:
  static constexpr VkFormat kColorFormat = VK_FORMAT_R8G8B8A8_UNORM;
  static constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;

  RenderTarget(const Context& context, VkExtent2D extent);

  VkExtent2D extent() const { return color_.extent(); }
  VkRenderPass render_pass() const { return render_pass_.get(); }

  // The render pass clears both attachments and leaves them as sources of copies.
  void begin(VkCommandBuffer commands, const std::array<float, 4>& clear_color, float clear_depth) const;
  void end(VkCommandBuffer commands) const;

  // Submits the copies and waits for them.
  Frame read_back(const Context& context) const;

 private:
  Image color_;
  Image depth_;
  RenderPass render_pass_;
  Framebuffer framebuffer_;
};

}  // namespace lapilli::samples
