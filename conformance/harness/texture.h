// Sampled images and samplers of any kind the tests need.
#pragma once

#include <span>

#include "common/resources.h"

namespace lapilli::conformance {

// An image filled from `texels` (rows top down, tightly packed), in SHADER_READ_ONLY_OPTIMAL.
samples::Image upload(const samples::Context& context, VkExtent2D extent, VkFormat format,
                      std::span<const std::byte> texels);

struct SamplerState {
  VkFilter mag = VK_FILTER_NEAREST, min = VK_FILTER_NEAREST;
  VkSamplerAddressMode u = VK_SAMPLER_ADDRESS_MODE_REPEAT, v = VK_SAMPLER_ADDRESS_MODE_REPEAT;
  VkBorderColor border = VK_BORDER_COLOR_FLOAT_TRANSPARENT_BLACK;
  bool unnormalized = false;
};
samples::Sampler make_sampler(const samples::Context& context, const SamplerState& state);

}  // namespace lapilli::conformance
