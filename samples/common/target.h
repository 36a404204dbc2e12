// What the samples draw into: a colour and a depth attachment, their render pass, and the way back to the host.
#pragma once

#include <array>
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
  void create_render_pass(const Context& context);

  Image color_;
  Image depth_;
  RenderPass render_pass_;
  Framebuffer framebuffer_;
};

}  // namespace lapilli::samples
