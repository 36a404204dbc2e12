// vkCmdBlitImage: scaling, mirroring, filtering, change of format. Specification: "Copy Commands", Image Copies With
// Scaling.
#include <gtest/gtest.h>

#include <algorithm>

#include "common/barriers.h"
#include "harness/canvas.h"
#include "harness/devices.h"

namespace lapilli::conformance {
namespace {

constexpr samples::ImageUse kSource = {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT,
                                       VK_ACCESS_TRANSFER_READ_BIT};
constexpr samples::ImageUse kTarget = {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT,
                                       VK_ACCESS_TRANSFER_WRITE_BIT};
constexpr samples::ImageUse kFresh = {VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, 0};
constexpr VkImageUsageFlags kBoth = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;

struct Size {
  uint32_t width, height;
};
using Texels = std::vector<uint32_t>;  // R8G8B8A8

VkImageBlit region_of(VkOffset3D from0, VkOffset3D from1, VkOffset3D to0, VkOffset3D to1) {
  const VkImageSubresourceLayers layers = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  from1.z = to1.z = 1;
  return {layers, {from0, from1}, layers, {to0, to1}};
}

// Uploads `texels`, blits `region` into an image of zeros, and reads that back.
Texels blit(Size from, const Texels& texels, Size to, const VkImageBlit& region, VkFilter filter,
            VkFormat target_format = VK_FORMAT_R8G8B8A8_UNORM) {
  const samples::Context& c = subject();
  const samples::Image source(c, {from.width, from.height}, VK_FORMAT_R8G8B8A8_UNORM, kBoth);
  const samples::Image target(c, {to.width, to.height}, target_format, kBoth);
  const samples::Buffer upload(c, std::span<const uint32_t>(texels), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
  const samples::Buffer download(c, uint64_t{to.width} * to.height * 4, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  constexpr VkImageAspectFlags kColor = VK_IMAGE_ASPECT_COLOR_BIT;
  VkCommandBuffer commands = c.begin_commands();
  samples::change_layout(commands, source.get(), kColor, kFresh, kTarget);
  samples::change_layout(commands, target.get(), kColor, kFresh, kTarget);
  VkBufferImageCopy copy = {};
  copy.imageSubresource = {kColor, 0, 0, 1};
  copy.imageExtent = {from.width, from.height, 1};
  vkCmdCopyBufferToImage(commands, upload.get(), source.get(), kTarget.layout, 1, &copy);
  const VkClearColorValue zero = {};
  const VkImageSubresourceRange all = {kColor, 0, 1, 0, 1};
  vkCmdClearColorImage(commands, target.get(), kTarget.layout, &zero, 1, &all);
  samples::change_layout(commands, source.get(), kColor, kTarget, kSource);
  samples::change_layout(commands, target.get(), kColor, kTarget, kTarget);
  vkCmdBlitImage(commands, source.get(), kSource.layout, target.get(), kTarget.layout, 1, &region, filter);
  samples::change_layout(commands, target.get(), kColor, kTarget, kSource);
  copy.imageExtent = {to.width, to.height, 1};
  vkCmdCopyImageToBuffer(commands, target.get(), kSource.layout, download.get(), 1, &copy);
  VkMemoryBarrier for_host = {};
  for_host.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  for_host.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  for_host.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &for_host, 0,
                       nullptr, 0, nullptr);
  c.submit_and_wait(commands);
  Texels out(size_t{to.width} * to.height);
  std::memcpy(out.data(), download.data(), out.size() * 4);
  return out;
}

Texels pattern(Size size) {
  Texels texels(size_t{size.width} * size.height);
  for (size_t i = 0; i < texels.size(); ++i) texels[i] = static_cast<uint32_t>(i) * 0x01030507u + 0x40302010u;
  return texels;
}

TEST(Blits, OfTheSameSizeCopy) {
  const Size size = {150, 3};
  const Texels texels = pattern(size);
  const VkImageBlit region = region_of({}, {150, 3, 1}, {}, {150, 3, 1});
  for (const VkFilter filter : {VK_FILTER_NEAREST, VK_FILTER_LINEAR}) {
    EXPECT_EQ(blit(size, texels, size, region, filter), texels);
  }
}

TEST(Blits, EnlargeByWholeNumbers) {
  const Texels texels = pattern({2, 2});
  const Texels out = blit({2, 2}, texels, {6, 4}, region_of({}, {2, 2, 1}, {}, {6, 4, 1}), VK_FILTER_NEAREST);
  for (uint32_t y = 0; y < 4; ++y) {
    for (uint32_t x = 0; x < 6; ++x) EXPECT_EQ(out[y * 6 + x], texels[y / 2 * 2 + x / 3]) << x << "," << y;
  }
}

TEST(Blits, MirrorInBothDirections) {
  const Texels texels = pattern({70, 5});
  const Texels out =
      blit({70, 5}, texels, {70, 5}, region_of({}, {70, 5, 1}, {70, 5, 0}, {0, 0, 1}), VK_FILTER_NEAREST);
  Texels reversed = texels;
  std::reverse(reversed.begin(), reversed.end());
  EXPECT_EQ(out, reversed);
}

TEST(Blits, WriteTheirRectangleOnly) {
  const Texels texels = pattern({4, 4});
  const Texels out =
      blit({4, 4}, texels, {8, 8}, region_of({1, 2, 0}, {3, 4, 1}, {5, 1, 0}, {7, 3, 1}), VK_FILTER_NEAREST);
  for (uint32_t y = 0; y < 8; ++y) {
    for (uint32_t x = 0; x < 8; ++x) {
      const bool inside = x >= 5 && x < 7 && y >= 1 && y < 3;
      EXPECT_EQ(out[y * 8 + x], inside ? texels[(y + 1) * 4 + x - 4] : 0u) << x << "," << y;
    }
  }
}

// Halving with a linear filter reads exactly between two texels.
TEST(Blits, LinearFilterAveragesAndClampsAtTheEdge) {
  const Texels texels = {rgba(0, 10, 0, 255), rgba(100, 30, 0, 255), rgba(200, 0, 0, 255), rgba(100, 0, 8, 255)};
  const Texels half = blit({4, 1}, texels, {2, 1}, region_of({}, {4, 1, 1}, {}, {2, 1, 1}), VK_FILTER_LINEAR);
  EXPECT_EQ(half[0], rgba(50, 20, 0, 255));
  EXPECT_EQ(half[1], rgba(150, 0, 4, 255));
  // Twice as large: the outermost texels lie beyond the centre of the first and the last.
  const Texels twice = blit({4, 1}, texels, {8, 1}, region_of({}, {4, 1, 1}, {}, {8, 1, 1}), VK_FILTER_LINEAR);
  EXPECT_EQ(twice[0], texels[0]);
  EXPECT_EQ(twice[1], rgba(25, 15, 0, 255));
  EXPECT_EQ(twice[7], texels[3]);
}

TEST(Blits, ConvertBetweenFormats) {
  const Texels texels = {rgba(1, 2, 3, 4), rgba(250, 251, 252, 253)};
  const Texels out = blit({2, 1}, texels, {2, 1}, region_of({}, {2, 1, 1}, {}, {2, 1, 1}), VK_FILTER_NEAREST,
                          VK_FORMAT_B8G8R8A8_UNORM);
  EXPECT_EQ(out[0], rgba(3, 2, 1, 4));
  EXPECT_EQ(out[1], rgba(252, 251, 250, 253));
}

}  // namespace
}  // namespace lapilli::conformance
