// What scenes draw into: a colour attachment and, where asked for, depth and more samples. Depth is not kept.
#pragma once

#include <array>

#include "common/target.h"

namespace lapilli::bench {

struct TargetShape {
  bool depth = false;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;  // resolved into the picture if more than 1
};

class Target {
 public:
  static constexpr VkFormat kColorFormat = VK_FORMAT_R8G8B8A8_UNORM;
  static constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;

  Target() = default;
  Target(const samples::Context& context, VkExtent2D extent, const TargetShape& shape);

  VkExtent2D extent() const { return picture_.extent(); }
  VkRenderPass render_pass() const { return render_pass_.get(); }
  void begin(VkCommandBuffer commands, const std::array<float, 4>& clear_color) const;
  samples::Frame read_back(const samples::Context& context) const;

 private:
  void create_render_pass(const samples::Context& context, const TargetShape& shape);

  samples::Image picture_;
  samples::Image many_samples_;
  samples::Image depth_;
  uint32_t attachments_ = 0;
  samples::RenderPass render_pass_;
  samples::Framebuffer framebuffer_;
};

// Whether the device draws with this many samples into colour and depth.
bool offers_samples(const samples::Context& context, VkSampleCountFlagBits samples);
// Whether optimally tiled images of `format` have all `features`.
bool offers_format(const samples::Context& context, VkFormat format, VkFormatFeatureFlags features);

}  // namespace lapilli::bench
