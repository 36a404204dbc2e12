// See texture.h.
#include "harness/texture.h"

#include <algorithm>

#include "common/barriers.h"

namespace lapilli::conformance {

namespace {

constexpr samples::ImageUse kUnused = {VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, 0};
constexpr samples::ImageUse kTarget = {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT,
                                       VK_ACCESS_TRANSFER_WRITE_BIT};
constexpr samples::ImageUse kSampled = {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                                        VK_ACCESS_SHADER_READ_BIT};
constexpr samples::ImageUse kStorage = {VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                                        VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT};

struct Levels {
  uint32_t count = 1, texel_bytes = 0;  // bytes: of one level not needed
};

samples::Image make(const samples::Context& context, VkExtent2D extent, VkFormat format,
                    std::span<const std::byte> texels, VkImageUsageFlags usage, const samples::ImageUse& use,
                    const Levels& levels) {
  const VkImageAspectFlags aspect = samples::aspect_of(format);
  samples::Image image(context, extent, format, usage | VK_IMAGE_USAGE_TRANSFER_DST_BIT, {.mip_levels = levels.count});
  const samples::Buffer staging(context, texels, VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
  VkCommandBuffer commands = context.begin_commands();
  std::vector<VkBufferImageCopy> regions;
  VkDeviceSize offset = 0;
  for (uint32_t level = 0; level < levels.count; ++level) {
    const VkExtent3D size = {std::max(extent.width >> level, 1u), std::max(extent.height >> level, 1u), 1};
    VkBufferImageCopy region = {};
    region.bufferOffset = offset;
    region.imageSubresource = {aspect, level, 0, 1};
    region.imageExtent = size;
    regions.push_back(region);
    offset += VkDeviceSize{size.width} * size.height * levels.texel_bytes;
  }
  samples::change_layout(commands, image.get(), aspect, kUnused, kTarget);
  vkCmdCopyBufferToImage(commands, staging.get(), image.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                         uint32_t(regions.size()), regions.data());
  samples::change_layout(commands, image.get(), aspect, kTarget, use);
  context.submit_and_wait(commands);
  return image;
}

}  // namespace

samples::Image upload(const samples::Context& context, VkExtent2D extent, VkFormat format,
                      std::span<const std::byte> texels) {
  return make(context, extent, format, texels, VK_IMAGE_USAGE_SAMPLED_BIT, kSampled, {});
}

samples::Image upload(const samples::Context& context, VkExtent2D extent, VkFormat format,
                      std::span<const std::byte> texels, uint32_t levels, uint32_t texel_bytes) {
  return make(context, extent, format, texels, VK_IMAGE_USAGE_SAMPLED_BIT, kSampled, {levels, texel_bytes});
}

samples::Image storage_image(const samples::Context& context, VkExtent2D extent, VkFormat format,
                             std::span<const std::byte> texels) {
  return make(context, extent, format, texels, VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT, kStorage,
              {});
}

std::vector<std::byte> download(const samples::Context& context, const samples::Image& image, uint32_t texel_bytes) {
  const VkExtent2D extent = image.extent();
  const samples::Buffer out(context, VkDeviceSize{extent.width} * extent.height * texel_bytes,
                            VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  VkCommandBuffer commands = context.begin_commands();
  const samples::ImageUse source = {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT,
                                    VK_ACCESS_TRANSFER_READ_BIT};
  samples::change_layout(commands, image.get(), VK_IMAGE_ASPECT_COLOR_BIT, kStorage, source);
  VkBufferImageCopy region = {};
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.imageExtent = {extent.width, extent.height, 1};
  vkCmdCopyImageToBuffer(commands, image.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, out.get(), 1, &region);
  context.submit_and_wait(commands);
  const auto* bytes = static_cast<const std::byte*>(out.data());
  return {bytes, bytes + out.size()};
}

samples::Sampler make_sampler(const samples::Context& context, const SamplerState& state) {
  VkSamplerCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
  info.magFilter = state.mag;
  info.minFilter = state.min;
  info.addressModeU = state.u;
  info.addressModeV = state.v;
  info.addressModeW = state.unnormalized ? state.u : VK_SAMPLER_ADDRESS_MODE_REPEAT;
  info.borderColor = state.border;
  info.unnormalizedCoordinates = state.unnormalized;
  info.mipmapMode = state.mipmap;
  info.mipLodBias = state.lod_bias;
  info.maxLod = state.max_lod;
  info.compareEnable = state.compare.has_value();
  info.compareOp = state.compare.value_or(VK_COMPARE_OP_NEVER);
  VkSampler sampler = VK_NULL_HANDLE;
  samples::check(vkCreateSampler(context.device(), &info, nullptr, &sampler), "vkCreateSampler");
  return {context.device(), sampler};
}

}  // namespace lapilli::conformance
