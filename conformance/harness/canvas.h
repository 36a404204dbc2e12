// A render target for the tests: one colour attachment of any format, depth if asked for, and the way back to the host.
#pragma once

#include <cstring>
#include <optional>
#include <vector>

#include "common/resources.h"

namespace lapilli::conformance {

struct CanvasOptions {
  uint32_t width = 64, height = 64;
  VkFormat color_format = VK_FORMAT_R8G8B8A8_UNORM;
  bool color = true;
  bool depth = false;  // D32_SFLOAT
  VkAttachmentLoadOp load = VK_ATTACHMENT_LOAD_OP_CLEAR;
  VkAttachmentStoreOp store = VK_ATTACHMENT_STORE_OP_STORE;
  VkImageUsageFlags extra_usage = 0;  // of the colour image
};

class Canvas {
 public:
  Canvas(const samples::Context& context, const CanvasOptions& options);

  const samples::Context& context() const { return context_; }
  uint32_t width() const { return options_.width; }
  uint32_t height() const { return options_.height; }
  VkRenderPass render_pass() const { return render_pass_.get(); }
  VkFramebuffer framebuffer() const { return framebuffer_.get(); }
  const samples::Image& color() const { return color_; }
  const samples::Image& depth() const { return depth_; }

  // Begins the render pass over `area` (default: everything) and sets viewport and scissor to the whole canvas.
  void begin(VkCommandBuffer commands, const VkClearColorValue& clear, float clear_depth = 1.0f,
             std::optional<VkRect2D> area = std::nullopt) const;
  static void end(VkCommandBuffer commands) { vkCmdEndRenderPass(commands); }

  // Raw texels of the attachment, rows top down, tightly packed. Submits and waits.
  std::vector<std::byte> read_color_bytes() const;
  std::vector<float> read_depth() const;
  template <typename T>
  std::vector<T> read_color() const {
    const std::vector<std::byte> bytes = read_color_bytes();
    std::vector<T> out(bytes.size() / sizeof(T));
    std::memcpy(out.data(), bytes.data(), out.size() * sizeof(T));
    return out;
  }

 private:
  void create_render_pass();
  std::vector<std::byte> read(const samples::Image& image, VkImageAspectFlags aspect, uint32_t texel_bytes) const;

  const samples::Context& context_;
  CanvasOptions options_;
  samples::Image color_, depth_;
  samples::RenderPass render_pass_;
  samples::Framebuffer framebuffer_;
};

uint32_t texel_bytes(VkFormat format);

// A framebuffer pixel as R8G8B8A8_UNORM bytes: r + g * 256 ...
inline uint32_t rgba(uint32_t r, uint32_t g, uint32_t b, uint32_t a) { return r | g << 8 | b << 16 | a << 24; }

}  // namespace lapilli::conformance
