// Patterns, their mip levels and the upload. Specification: Resource Creation; Copy Commands.
#include "scenes/textures.h"

#include <algorithm>
#include <bit>

namespace lapilli::bench {
namespace {

using Texels = std::vector<uint8_t>;

// Bricks with grain, in colours that depend on `seed`.
Texels pattern(uint32_t size, uint32_t seed) {
  Texels texels(size_t{size} * size * 4);
  const uint32_t brick = std::max(size / 8, 2u);
  for (uint32_t y = 0; y < size; ++y) {
    for (uint32_t x = 0; x < size; ++x) {
      const uint32_t row = y / brick;
      const uint32_t shifted = x + row % 2 * brick;
      const bool mortar = y % brick == 0 || shifted % (2 * brick) == 0;
      uint32_t hash = (x * 0x9E3779B1u) ^ (y * 0x85EBCA77u) ^ (seed * 0xC2B2AE3Du);
      hash = (hash ^ hash >> 15) * 0x2C1B3C6Du;
      const uint32_t grain = hash >> 27;
      uint8_t* texel = &texels[(size_t{y} * size + x) * 4];
      texel[0] = static_cast<uint8_t>(mortar ? 200 : 120 + grain + seed * 37 % 100);
      texel[1] = static_cast<uint8_t>(mortar ? 195 : 50 + grain + seed * 61 % 120);
      texel[2] = static_cast<uint8_t>(mortar ? 185 : 30 + grain + row * 7 + seed * 17 % 100);
      texel[3] = 255;
    }
  }
  return texels;
}

// The next level: the mean of each 2x2 texels, rounded.
Texels halved(const Texels& above, uint32_t size) {
  const uint32_t half = size / 2;
  Texels texels(size_t{half} * half * 4);
  for (uint32_t y = 0; y < half; ++y) {
    for (uint32_t x = 0; x < half; ++x) {
      for (uint32_t c = 0; c < 4; ++c) {
        const auto at = [&](uint32_t dx, uint32_t dy) {
          return above[(size_t{2 * y + dy} * size + 2 * x + dx) * 4 + c];
        };
        texels[(size_t{y} * half + x) * 4 + c] =
            static_cast<uint8_t>((at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1) + 2) / 4);
      }
    }
  }
  return texels;
}

VkImageMemoryBarrier barrier(VkImage image, uint32_t levels, VkAccessFlags before, VkAccessFlags after,
                             VkImageLayout old_layout, VkImageLayout new_layout) {
  VkImageMemoryBarrier change = {};
  change.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
  change.srcAccessMask = before;
  change.dstAccessMask = after;
  change.oldLayout = old_layout;
  change.newLayout = new_layout;
  change.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  change.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  change.image = image;
  change.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, levels, 0, 1};
  return change;
}

}  // namespace

std::vector<samples::Image> upload_patterns(const samples::Context& context, uint32_t count, uint32_t size,
                                            bool mip_levels) {
  const uint32_t levels = mip_levels ? static_cast<uint32_t>(std::bit_width(size)) : 1;
  std::vector<samples::Image> images;
  std::vector<VkImageMemoryBarrier> to_copy;
  std::vector<VkImageMemoryBarrier> to_read;
  Texels all;
  for (uint32_t i = 0; i < count; ++i) {
    images.emplace_back(context, VkExtent2D{size, size}, VK_FORMAT_R8G8B8A8_UNORM,
                        VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT, samples::ImageShape{levels});
    to_copy.push_back(barrier(images.back().get(), levels, 0, VK_ACCESS_TRANSFER_WRITE_BIT, VK_IMAGE_LAYOUT_UNDEFINED,
                              VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL));
    to_read.push_back(barrier(images.back().get(), levels, VK_ACCESS_TRANSFER_WRITE_BIT, VK_ACCESS_SHADER_READ_BIT,
                              VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL));
    Texels level = pattern(size, i);
    for (uint32_t l = 0; l < levels; ++l) {
      if (l > 0) level = halved(level, size >> (l - 1));
      all.insert(all.end(), level.begin(), level.end());
    }
  }
  const samples::Buffer staging(context, std::span<const uint8_t>(all), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);

  VkCommandBuffer commands = context.begin_commands();
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, nullptr, 0,
                       nullptr, count, to_copy.data());
  VkDeviceSize offset = 0;
  for (const samples::Image& image : images) {
    for (uint32_t l = 0; l < levels; ++l) {
      VkBufferImageCopy region = {};
      region.bufferOffset = offset;
      region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, l, 0, 1};
      region.imageExtent = {size >> l, size >> l, 1};
      vkCmdCopyBufferToImage(commands, staging.get(), image.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
      offset += VkDeviceSize{size >> l} * (size >> l) * 4;
    }
  }
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, 0, 0, nullptr,
                       0, nullptr, count, to_read.data());
  context.submit_and_wait(commands);
  return images;
}

samples::Sampler create_trilinear_sampler(const samples::Context& context) {
  VkSamplerCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
  info.magFilter = VK_FILTER_LINEAR;
  info.minFilter = VK_FILTER_LINEAR;
  info.mipmapMode = VK_SAMPLER_MIPMAP_MODE_LINEAR;
  info.maxLod = VK_LOD_CLAMP_NONE;
  VkSampler sampler = VK_NULL_HANDLE;
  samples::check(vkCreateSampler(context.device(), &info, nullptr, &sampler), "vkCreateSampler");
  return {context.device(), sampler};
}

}  // namespace lapilli::bench
