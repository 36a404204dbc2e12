// See texture.h.
#include "harness/texture.h"

#include "common/barriers.h"

namespace lapilli::conformance {

samples::Image upload(const samples::Context& context, VkExtent2D extent, VkFormat format,
                      std::span<const std::byte> texels) {
  samples::Image image(context, extent, format, VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
  const samples::Buffer staging(context, texels, VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
  VkCommandBuffer commands = context.begin_commands();
  const samples::ImageUse unused = {VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, 0};
  const samples::ImageUse target = {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT,
                                    VK_ACCESS_TRANSFER_WRITE_BIT};
  const samples::ImageUse sampled = {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                                     VK_ACCESS_SHADER_READ_BIT};
  samples::change_layout(commands, image.get(), VK_IMAGE_ASPECT_COLOR_BIT, unused, target);
  VkBufferImageCopy region = {};
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.imageExtent = {extent.width, extent.height, 1};
  vkCmdCopyBufferToImage(commands, staging.get(), image.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
  samples::change_layout(commands, image.get(), VK_IMAGE_ASPECT_COLOR_BIT, target, sampled);
  context.submit_and_wait(commands);
  return image;
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
  VkSampler sampler = VK_NULL_HANDLE;
  samples::check(vkCreateSampler(context.device(), &info, nullptr, &sampler), "vkCreateSampler");
  return {context.device(), sampler};
}

}  // namespace lapilli::conformance
