// Copies, fills and clears outside of render passes, with regions, offsets and row lengths. Specification: "Copy
// Commands", "Clear Commands".
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "common/barriers.h"
#include "harness/compute.h"
#include "harness/devices.h"

namespace lapilli::conformance {
namespace {

constexpr VkBufferUsageFlags kBothWays = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
// SAMPLED, because samples::Image makes a view of everything.
constexpr VkImageUsageFlags kImageBothWays =
    VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;

std::vector<uint32_t> random_words(std::mt19937& random, size_t count) {
  std::vector<uint32_t> out(count);
  for (uint32_t& w : out) w = uint32_t(random());
  return out;
}

std::vector<uint32_t> words_of(const samples::Buffer& buffer) {
  std::vector<uint32_t> out(buffer.size() / 4);
  std::memcpy(out.data(), buffer.data(), out.size() * 4);
  return out;
}

samples::Buffer buffer_of(const std::vector<uint32_t>& words) {
  return {subject(), std::span<const uint32_t>(words), kBothWays};
}

void to_layout(VkCommandBuffer commands, VkImage image, VkImageLayout from, VkImageLayout to,
               VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT) {
  constexpr VkAccessFlags kAll = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
  samples::change_layout(commands, image, aspect, {from, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, kAll},
                         {to, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, kAll});
}

void barrier(VkCommandBuffer commands) {
  VkMemoryBarrier b = {};
  b.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  b.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
  b.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 1, &b, 0,
                       nullptr, 0, nullptr);
}

TEST(Copies, BetweenBuffersInRegions) {
  std::mt19937 random(1);
  const std::vector<uint32_t> source = random_words(random, 256), before = random_words(random, 256);
  const samples::Buffer from = buffer_of(source), to = buffer_of(before);
  const VkBufferCopy regions[] = {{0, 512, 64}, {100, 4, 60}, {1020, 1020, 4}, {3, 205, 13}};
  VkCommandBuffer commands = subject().begin_commands();
  vkCmdCopyBuffer(commands, from.get(), to.get(), 4, regions);
  subject().submit_and_wait(commands);
  Bytes want = to_bytes(before);
  const Bytes bytes = to_bytes(source);
  for (const VkBufferCopy& r : regions) std::memcpy(&want[r.dstOffset], &bytes[r.srcOffset], r.size);
  EXPECT_EQ(words_of(to), from_bytes<uint32_t>(want));
}

TEST(Copies, FillAndUpdateBuffer) {
  std::mt19937 random(2);
  std::vector<uint32_t> want = random_words(random, 64);
  const samples::Buffer buffer = buffer_of(want);
  const std::vector<uint32_t> data = random_words(random, 5);
  VkCommandBuffer commands = subject().begin_commands();
  vkCmdFillBuffer(commands, buffer.get(), 16, 40, 0xDEADBEEF);
  vkCmdFillBuffer(commands, buffer.get(), 240, VK_WHOLE_SIZE, 7);
  barrier(commands);
  vkCmdUpdateBuffer(commands, buffer.get(), 32, 20, data.data());
  subject().submit_and_wait(commands);
  for (size_t i = 4; i < 14; ++i) want[i] = 0xDEADBEEF;
  for (size_t i = 60; i < 64; ++i) want[i] = 7;
  for (size_t i = 0; i < 5; ++i) want[8 + i] = data[i];
  EXPECT_EQ(words_of(buffer), want);
}

struct Region {
  uint32_t buffer_word, row_length, image_height;  // 0: tight
  int32_t x, y;
  uint32_t width, height;
};

VkBufferImageCopy vk_region(const Region& r, VkDeviceSize texel) {
  VkBufferImageCopy out = {};
  out.bufferOffset = r.buffer_word * texel;
  out.bufferRowLength = r.row_length;
  out.bufferImageHeight = r.image_height;
  out.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  out.imageOffset = {r.x, r.y, 0};
  out.imageExtent = {r.width, r.height, 1};
  return out;
}

TEST(Copies, BuffersToImagesAndBackInRegions) {
  constexpr uint32_t kWidth = 45, kHeight = 23;
  std::mt19937 random(3);
  for (const VkFormat format : {VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R32G32B32A32_SFLOAT}) {
    const size_t texel = format == VK_FORMAT_R32G32B32A32_SFLOAT ? 16 : 4;
    std::vector<uint32_t> source = random_words(random, 4096 * texel / 4);
    // Floats: only finite, normal ones.
    if (texel == 16) {
      for (uint32_t& w : source) w = (w & 0x807FFFFFu) | 0x3F000000u;
    }
    const samples::Buffer from = buffer_of(source),
                          all = buffer_of(std::vector<uint32_t>(kWidth * kHeight * texel / 4)),
                          parts = buffer_of(std::vector<uint32_t>(4096 * texel / 4, 5));
    const samples::Image image(subject(), {kWidth, kHeight}, format, kImageBothWays);
    const Region whole = {0, 0, 0, 0, 0, kWidth, kHeight};
    const Region in[] = {{3000, 0, 0, 1, 2, 9, 7}, {2000, 31, 0, 20, 0, 25, 3}, {1500, 64, 40, 44, 22, 1, 1}};
    const Region out[] = {{0, 0, 0, 0, 20, 45, 3}, {500, 50, 0, 17, 1, 28, 11}, {2500, 8, 8, 3, 3, 8, 8}};
    VkCommandBuffer commands = subject().begin_commands();
    to_layout(commands, image.get(), VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    const VkBufferImageCopy first = vk_region(whole, texel);
    vkCmdCopyBufferToImage(commands, from.get(), image.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &first);
    barrier(commands);
    VkBufferImageCopy regions[3];
    for (size_t i = 0; i < 3; ++i) regions[i] = vk_region(in[i], texel);
    vkCmdCopyBufferToImage(commands, from.get(), image.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 3, regions);
    to_layout(commands, image.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    vkCmdCopyImageToBuffer(commands, image.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, all.get(), 1, &first);
    for (size_t i = 0; i < 3; ++i) regions[i] = vk_region(out[i], texel);
    vkCmdCopyImageToBuffer(commands, image.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, parts.get(), 3, regions);
    subject().submit_and_wait(commands);

    const Bytes source_bytes = to_bytes(source);
    Bytes want(kWidth * kHeight * texel), want_parts = to_bytes(std::vector<uint32_t>(4096 * texel / 4, 5));
    std::memcpy(want.data(), source_bytes.data(), want.size());
    for (const Region& r : in) {
      const uint32_t stride = r.row_length != 0 ? r.row_length : r.width;
      for (uint32_t y = 0; y < r.height; ++y) {
        std::memcpy(&want[((uint32_t(r.y) + y) * kWidth + uint32_t(r.x)) * texel],
                    &source_bytes[(r.buffer_word + y * stride) * texel], r.width * texel);
      }
    }
    for (const Region& r : out) {
      const uint32_t stride = r.row_length != 0 ? r.row_length : r.width;
      for (uint32_t y = 0; y < r.height; ++y) {
        std::memcpy(&want_parts[(r.buffer_word + y * stride) * texel],
                    &want[((uint32_t(r.y) + y) * kWidth + uint32_t(r.x)) * texel], r.width * texel);
      }
    }
    EXPECT_EQ(words_of(all), from_bytes<uint32_t>(want)) << format;
    EXPECT_EQ(words_of(parts), from_bytes<uint32_t>(want_parts)) << format;
  }
}

TEST(Copies, BetweenImages) {
  std::mt19937 random(4);
  const std::vector<uint32_t> source = random_words(random, 20 * 10);
  const samples::Buffer from = buffer_of(source), result = buffer_of(std::vector<uint32_t>(30 * 16));
  const samples::Image a(subject(), {20, 10}, VK_FORMAT_R8G8B8A8_UNORM, kImageBothWays);
  // Another format of the same texel size: bits are copied.
  const samples::Image b(subject(), {30, 16}, VK_FORMAT_B8G8R8A8_UNORM, kImageBothWays);
  VkCommandBuffer commands = subject().begin_commands();
  to_layout(commands, a.get(), VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  to_layout(commands, b.get(), VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  const VkBufferImageCopy whole_a = vk_region({0, 0, 0, 0, 0, 20, 10}, 4),
                          whole_b = vk_region({0, 0, 0, 0, 0, 30, 16}, 4);
  vkCmdCopyBufferToImage(commands, from.get(), a.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &whole_a);
  const VkClearColorValue clear = {{0, 0, 0, 0}};
  const VkImageSubresourceRange range = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  vkCmdClearColorImage(commands, b.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &clear, 1, &range);
  to_layout(commands, a.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
  barrier(commands);
  const VkImageSubresourceLayers layers = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  const VkImageCopy region = {layers, {5, 2, 0}, layers, {11, 6, 0}, {13, 7, 1}};
  vkCmdCopyImage(commands, a.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, b.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                 1, &region);
  to_layout(commands, b.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
  vkCmdCopyImageToBuffer(commands, b.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, result.get(), 1, &whole_b);
  subject().submit_and_wait(commands);
  std::vector<uint32_t> want(30 * 16, 0);
  for (size_t y = 0; y < 7; ++y) {
    for (size_t x = 0; x < 13; ++x) want[(y + 6) * 30 + x + 11] = source[(y + 2) * 20 + x + 5];
  }
  EXPECT_EQ(words_of(result), want);
}

TEST(Copies, ClearColorAndDepthImages) {
  const samples::Image color(subject(), {9, 5}, VK_FORMAT_B8G8R8A8_UNORM, kImageBothWays);
  const samples::Image depth(subject(), {9, 5}, VK_FORMAT_D32_SFLOAT,
                             kImageBothWays | VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
  const samples::Buffer result = buffer_of(std::vector<uint32_t>(45 * 2));
  VkCommandBuffer commands = subject().begin_commands();
  to_layout(commands, color.get(), VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
  to_layout(commands, depth.get(), VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_ASPECT_DEPTH_BIT);
  const VkClearColorValue clear = {{0.2f, 0.4f, 1.0f, 0.0f}};
  const VkClearDepthStencilValue clear_depth = {0.375f, 0};
  VkImageSubresourceRange range = {VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS};
  vkCmdClearColorImage(commands, color.get(), VK_IMAGE_LAYOUT_GENERAL, &clear, 1, &range);
  range.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT;
  vkCmdClearDepthStencilImage(commands, depth.get(), VK_IMAGE_LAYOUT_GENERAL, &clear_depth, 1, &range);
  barrier(commands);
  VkBufferImageCopy region = vk_region({0, 0, 0, 0, 0, 9, 5}, 4);
  vkCmdCopyImageToBuffer(commands, color.get(), VK_IMAGE_LAYOUT_GENERAL, result.get(), 1, &region);
  region.imageSubresource.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT;
  region.bufferOffset = 45 * 4;
  vkCmdCopyImageToBuffer(commands, depth.get(), VK_IMAGE_LAYOUT_GENERAL, result.get(), 1, &region);
  subject().submit_and_wait(commands);
  const std::vector<uint32_t> words = words_of(result);
  for (size_t i = 0; i < 45; ++i) {
    ASSERT_EQ(words[i], 0x003366FFu);  // B8G8R8A8: blue in the lowest byte
    float d;
    std::memcpy(&d, &words[45 + i], 4);
    ASSERT_EQ(d, 0.375f);
  }
}

}  // namespace
}  // namespace lapilli::conformance
