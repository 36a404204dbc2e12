// Sampled images and samplers of any kind the tests need.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "common/resources.h"

namespace lapilli::conformance {

// An image filled from `texels` (rows top down, tightly packed), in SHADER_READ_ONLY_OPTIMAL.
samples::Image upload(const samples::Context& context, VkExtent2D extent, VkFormat format,
                      std::span<const std::byte> texels);
// The same with all levels, one behind the other.
samples::Image upload(const samples::Context& context, VkExtent2D extent, VkFormat format,
                      std::span<const std::byte> texels, uint32_t levels, uint32_t texel_bytes);
// An image in GENERAL, to be stored to, and its texels afterwards.
samples::Image storage_image(const samples::Context& context, VkExtent2D extent, VkFormat format,
                             std::span<const std::byte> texels);
std::vector<std::byte> download(const samples::Context& context, const samples::Image& image, uint32_t texel_bytes);

struct SamplerState {
  VkFilter mag = VK_FILTER_NEAREST, min = VK_FILTER_NEAREST;
  VkSamplerAddressMode u = VK_SAMPLER_ADDRESS_MODE_REPEAT, v = VK_SAMPLER_ADDRESS_MODE_REPEAT;
  VkBorderColor border = VK_BORDER_COLOR_FLOAT_TRANSPARENT_BLACK;
  bool unnormalized = false;
  VkSamplerMipmapMode mipmap = VK_SAMPLER_MIPMAP_MODE_NEAREST;
  float lod_bias = 0, max_lod = 0;
  std::optional<VkCompareOp> compare = std::nullopt;
};
samples::Sampler make_sampler(const samples::Context& context, const SamplerState& state);

}  // namespace lapilli::conformance
