// Copies and clears against loops over single texels, and regions that must be refused.
#include "image/copy.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

namespace lapilli {
namespace {

using Bytes = std::vector<std::byte>;

Bytes random_bytes(uint64_t size, uint32_t seed) {
  std::mt19937 random(seed);
  Bytes bytes(size);
  for (std::byte& b : bytes) b = static_cast<std::byte>(random());
  return bytes;
}

struct Image {
  ImageLayout layout;
  Bytes memory;

  Image(VkFormat format, const ImageExtent& extent, uint32_t seed) {
    layout = *make_layout(format, extent);
    memory = random_bytes(layout.size, seed);
  }
  ImageMemory target() { return {&layout, memory.data()}; }
  ConstImageMemory source() const { return {&layout, memory.data()}; }
  const std::byte* texel(uint32_t level, uint32_t layer, uint32_t x, uint32_t y, uint32_t z = 0,
                         uint32_t sample = 0) const {
    return memory.data() + texel_offset(layout, level, layer, z, sample) + y * layout.levels[level].row_pitch +
           x * layout.format->texel_size;
  }
};

VkImageSubresourceLayers layers_of(uint32_t level, uint32_t layer, uint32_t count,
                                   VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT) {
  return {aspect, level, layer, count};
}

bool inside(uint32_t value, int32_t first, uint32_t count) {
  return value >= static_cast<uint32_t>(first) && value < static_cast<uint32_t>(first) + count;
}

// The address rule of "Buffer and Image Addressing", texel by texel; texels outside of the region keep their value.
void check_buffer_to_image(const Image& before, const Image& after, const Bytes& buffer,
                           const VkBufferImageCopy& region) {
  const uint64_t size = before.layout.format->texel_size;
  const uint64_t row_length = region.bufferRowLength != 0 ? region.bufferRowLength : region.imageExtent.width;
  const uint64_t image_height = region.bufferImageHeight != 0 ? region.bufferImageHeight : region.imageExtent.height;
  for (uint32_t layer = 0; layer < before.layout.extent.layers; ++layer) {
    for (uint32_t i = 0; i < before.layout.extent.mip_levels; ++i) {
      const LevelLayout& level = before.layout.levels[i];
      for (uint32_t z = 0; z < level.depth; ++z) {
        for (uint32_t y = 0; y < level.height; ++y) {
          for (uint32_t x = 0; x < level.width; ++x) {
            const bool copied = i == region.imageSubresource.mipLevel &&
                                inside(layer, static_cast<int32_t>(region.imageSubresource.baseArrayLayer),
                                       region.imageSubresource.layerCount) &&
                                inside(x, region.imageOffset.x, region.imageExtent.width) &&
                                inside(y, region.imageOffset.y, region.imageExtent.height) &&
                                inside(z, region.imageOffset.z, region.imageExtent.depth);
            const uint64_t bx = x - static_cast<uint32_t>(region.imageOffset.x);
            const uint64_t by = y - static_cast<uint32_t>(region.imageOffset.y);
            const uint64_t bz =
                z - static_cast<uint32_t>(region.imageOffset.z) + layer - region.imageSubresource.baseArrayLayer;
            const std::byte* expected =
                copied ? buffer.data() + region.bufferOffset + (((bz * image_height) + by) * row_length + bx) * size
                       : before.texel(i, layer, x, y, z);
            ASSERT_EQ(std::memcmp(after.texel(i, layer, x, y, z), expected, size), 0)
                << "level " << i << " layer " << layer << " at " << x << ',' << y << ',' << z;
          }
        }
      }
    }
  }
}

void check_round_trip(VkFormat format, const ImageExtent& extent, const VkBufferImageCopy& region) {
  const Image before(format, extent, 1);
  const Bytes buffer = random_bytes(1 << 16, 2);
  Image image = before;
  ASSERT_TRUE(copy_buffer_to_image({buffer.data(), buffer.size()}, image.target(), region));
  check_buffer_to_image(before, image, buffer, region);

  // Back into a buffer of its own, then into a third image: equal again, and bytes between the rows untouched.
  const Bytes filler = random_bytes(buffer.size(), 3);
  Bytes read = filler;
  ASSERT_TRUE(copy_image_to_buffer(image.source(), {read.data(), read.size()}, region));
  for (size_t i = 0; i < read.size(); ++i) ASSERT_TRUE(read[i] == buffer[i] || read[i] == filler[i]) << i;
  Image again = before;
  ASSERT_TRUE(copy_buffer_to_image({read.data(), read.size()}, again.target(), region));
  EXPECT_EQ(again.memory, image.memory);
}

TEST(Copy, BufferAndImage) {
  const ImageExtent flat = {.width = 21, .height = 13, .mip_levels = 3, .layers = 4};
  check_round_trip(VK_FORMAT_R8G8B8A8_UNORM, flat, {0, 0, 0, layers_of(0, 0, 1), {0, 0, 0}, {21, 13, 1}});
  check_round_trip(VK_FORMAT_R8G8B8A8_UNORM, flat, {52, 29, 17, layers_of(0, 1, 3), {5, 2, 0}, {7, 11, 1}});
  check_round_trip(VK_FORMAT_R32G32B32A32_SFLOAT, flat, {16, 0, 9, layers_of(1, 2, 2), {1, 1, 0}, {9, 5, 1}});
  check_round_trip(VK_FORMAT_D32_SFLOAT, {.width = 5, .height = 5},
                   {4, 6, 0, layers_of(0, 0, 1, VK_IMAGE_ASPECT_DEPTH_BIT), {4, 0, 0}, {1, 5, 1}});
  check_round_trip(VK_FORMAT_R8G8B8A8_UNORM, {.width = 7, .height = 6, .depth = 5},
                   {8, 8, 10, layers_of(0, 0, 1), {1, 2, 3}, {6, 4, 2}});
}

TEST(Copy, BufferRegionsOutsideAreRefused) {
  Image image(VK_FORMAT_R8G8B8A8_UNORM, {.width = 16, .height = 8, .mip_levels = 2, .layers = 2}, 1);
  const Bytes untouched = image.memory;
  const VkBufferImageCopy good = {0, 0, 0, layers_of(0, 0, 1), {0, 0, 0}, {16, 8, 1}};
  Bytes buffer(16 * 8 * 4);
  const auto refused = [&](const VkBufferImageCopy& region, uint64_t size) {
    Bytes bytes(size);
    const bool in = copy_buffer_to_image({bytes.data(), size}, image.target(), region);
    const bool out = copy_image_to_buffer(image.source(), {bytes.data(), size}, region);
    return !in && !out && image.memory == untouched && bytes == Bytes(size);
  };
  const auto with = [&good](auto change) {
    VkBufferImageCopy region = good;
    change(region);
    return region;
  };
  EXPECT_TRUE(refused(good, 16 * 8 * 4 - 1));
  EXPECT_TRUE(refused(with([](auto& r) { r.bufferOffset = 4; }), 16 * 8 * 4));
  EXPECT_TRUE(refused(with([](auto& r) { r.bufferOffset = ~uint64_t{0} - 100; }), 16 * 8 * 4));
  EXPECT_TRUE(refused(with([](auto& r) { r.bufferRowLength = 15; }), 4096));
  EXPECT_TRUE(refused(with([](auto& r) { r.bufferImageHeight = 7; }), 4096));
  EXPECT_TRUE(refused(with([](auto& r) { r.bufferRowLength = r.bufferImageHeight = ~0u; }), 4096));
  EXPECT_TRUE(refused(with([](auto& r) {
                        r.bufferRowLength = r.bufferImageHeight = ~0u;
                        r.imageSubresource.layerCount = 2;
                      }),
                      4096));
  EXPECT_TRUE(refused(with([](auto& r) { r.imageOffset.x = 1; }), 4096));
  EXPECT_TRUE(refused(with([](auto& r) { r.imageOffset.y = -1; }), 4096));
  EXPECT_TRUE(refused(with([](auto& r) { r.imageOffset.z = 1; }), 4096));
  EXPECT_TRUE(refused(with([](auto& r) { r.imageOffset.x = INT32_MIN; }), 4096));
  EXPECT_TRUE(refused(with([](auto& r) { r.imageExtent.width = ~0u; }), 4096));
  EXPECT_TRUE(refused(with([](auto& r) { r.imageExtent.height = 0; }), 4096));
  EXPECT_TRUE(refused(with([](auto& r) { r.imageSubresource.mipLevel = 1; }), 4096));
  EXPECT_TRUE(refused(with([](auto& r) { r.imageSubresource.mipLevel = 2; }), 4096));
  EXPECT_TRUE(refused(with([](auto& r) { r.imageSubresource.baseArrayLayer = 2; }), 4096));
  EXPECT_TRUE(refused(with([](auto& r) { r.imageSubresource.layerCount = 0; }), 4096));
  EXPECT_TRUE(refused(with([](auto& r) { r.imageSubresource.layerCount = 3; }), 1 << 16));
  EXPECT_TRUE(refused(with([](auto& r) { r.imageSubresource.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT; }), 4096));
  EXPECT_TRUE(refused(with([](auto& r) { r.imageSubresource.aspectMask = 0; }), 4096));
  EXPECT_TRUE(copy_buffer_to_image({buffer.data(), buffer.size()}, image.target(), good));
}

TEST(Copy, ImageToImage) {
  const Image source(VK_FORMAT_R8G8B8A8_UNORM, {.width = 20, .height = 10, .mip_levels = 2, .layers = 3, .samples = 2},
                     1);
  const Image before(VK_FORMAT_B8G8R8A8_UNORM, {.width = 11, .height = 17, .layers = 5, .samples = 2}, 2);
  Image target = before;
  const VkImageCopy region = {layers_of(1, 1, 2), {2, 1, 0}, layers_of(0, 3, 2), {5, 6, 0}, {6, 4, 1}};
  ASSERT_TRUE(copy_image(source.source(), target.target(), region));
  for (uint32_t sample = 0; sample < 2; ++sample) {
    for (uint32_t layer = 0; layer < 5; ++layer) {
      for (uint32_t y = 0; y < 17; ++y) {
        for (uint32_t x = 0; x < 11; ++x) {
          const bool copied = layer >= 3 && inside(x, 5, 6) && inside(y, 6, 4);
          const std::byte* expected =
              copied ? source.texel(1, layer - 2, x - 3, y - 5, 0, sample) : before.texel(0, layer, x, y, 0, sample);
          ASSERT_EQ(std::memcmp(target.texel(0, layer, x, y, 0, sample), expected, 4), 0)
              << layer << ' ' << x << ' ' << y;
        }
      }
    }
  }
}

TEST(Copy, ImageRegionsOutsideAreRefused) {
  const Image source(VK_FORMAT_R8G8B8A8_UNORM, {.width = 20, .height = 10, .layers = 3}, 1);
  Image target(VK_FORMAT_B8G8R8A8_UNORM, {.width = 11, .height = 17, .layers = 2}, 2);
  Image wide(VK_FORMAT_R32G32B32A32_SFLOAT, {.width = 11, .height = 17}, 2);
  const VkImageCopy good = {layers_of(0, 0, 1), {9, 0, 0}, layers_of(0, 0, 1), {0, 0, 0}, {11, 10, 1}};
  EXPECT_TRUE(copy_image(source.source(), target.target(), good));
  EXPECT_FALSE(copy_image(source.source(), wide.target(), good));
  VkImageCopy region = good;
  region.srcOffset.x = 10;
  EXPECT_FALSE(copy_image(source.source(), target.target(), region));
  region = good;
  region.dstOffset.y = 8;
  EXPECT_FALSE(copy_image(source.source(), target.target(), region));
  region = good;
  region.srcSubresource.layerCount = 2;
  EXPECT_FALSE(copy_image(source.source(), target.target(), region));
}

VkClearValue clear_color(float r, float g, float b, float a) {
  VkClearValue clear = {};
  clear.color = {.float32 = {r, g, b, a}};
  return clear;
}

uint32_t word_of(const PackedTexel& texel, size_t word) {
  uint32_t value = 0;
  std::memcpy(&value, texel.data() + word * 4, 4);
  return value;
}

TEST(Clear, UnormIsRoundedToTheNearestEven) {
  const FormatInfo& rgba = *find_format(VK_FORMAT_R8G8B8A8_UNORM);
  const FormatInfo& bgra = *find_format(VK_FORMAT_B8G8R8A8_UNORM);
  const VkClearValue clear = clear_color(1.0f, 0.0f, 0.25f, 0.75f);  // 63.75 and 191.25
  EXPECT_EQ(word_of(pack_clear_value(rgba, clear), 0), 0xBF4000FFu);
  EXPECT_EQ(word_of(pack_clear_value(bgra, clear), 0), 0xBFFF0040u);
  // 0.5 is 127.5: to 128. Out of range, infinite and NaN.
  const VkClearValue odd = clear_color(0.5f, 2.0f, -1.0f, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(word_of(pack_clear_value(rgba, odd), 0), 0x0000FF80u);
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(word_of(pack_clear_value(rgba, clear_color(infinity, -infinity, 1e-30f, 0.999f)), 0), 0xFF0000FFu);
  for (uint32_t code = 0; code < 256; ++code) {
    const float value = static_cast<float>(code) / 255.0f;
    EXPECT_EQ(word_of(pack_clear_value(rgba, clear_color(value, 0, 0, 0)), 0), code);
  }
}

TEST(Clear, FloatsIntegersAndDepthKeepTheirBits) {
  const PackedTexel floats =
      pack_clear_value(*find_format(VK_FORMAT_R32G32B32A32_SFLOAT),
                       clear_color(-0.0f, 1e30f, -std::numeric_limits<float>::quiet_NaN(), 1e-42f));
  EXPECT_EQ(word_of(floats, 0), 0x80000000u);
  EXPECT_EQ(word_of(floats, 1), std::bit_cast<uint32_t>(1e30f));
  EXPECT_EQ(word_of(floats, 2), 0x7FC00000u);
  EXPECT_EQ(word_of(floats, 3), std::bit_cast<uint32_t>(1e-42f));
  VkClearValue clear = {};
  clear.color = {.int32 = {-1, 2, -3, 4}};
  EXPECT_EQ(word_of(pack_clear_value(*find_format(VK_FORMAT_R32G32B32A32_SINT), clear), 2), 0xFFFFFFFDu);
  clear.depthStencil = {0.625f, 7};
  EXPECT_EQ(word_of(pack_clear_value(*find_format(VK_FORMAT_D32_SFLOAT), clear), 0), std::bit_cast<uint32_t>(0.625f));
}

TEST(Clear, WritesTheRangeAndNothingElse) {
  for (VkFormat format : {VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_R32G32B32A32_SFLOAT}) {
    const ImageExtent extent = {.width = 301, .height = 7, .mip_levels = 3, .layers = 4};
    const Image before(format, extent, 1);
    Image image = before;
    const PackedTexel texel = pack_clear_value(*image.layout.format, clear_color(0.1f, 0.2f, 0.3f, 0.4f));
    ASSERT_TRUE(clear_image(image.target(), {VK_IMAGE_ASPECT_COLOR_BIT, 1, VK_REMAINING_MIP_LEVELS, 1, 2}, texel));
    for (uint32_t layer = 0; layer < 4; ++layer) {
      for (uint32_t level = 0; level < 3; ++level) {
        for (uint32_t y = 0; y < image.layout.levels[level].height; ++y) {
          for (uint32_t x = 0; x < image.layout.levels[level].width; ++x) {
            const bool cleared = level >= 1 && (layer == 1 || layer == 2);
            const std::byte* expected = cleared ? texel.data() : before.texel(level, layer, x, y);
            ASSERT_EQ(std::memcmp(image.texel(level, layer, x, y), expected, image.layout.format->texel_size), 0);
          }
        }
      }
    }
    EXPECT_FALSE(clear_image(image.target(), {VK_IMAGE_ASPECT_COLOR_BIT, 3, 1, 0, 1}, texel));
    EXPECT_FALSE(clear_image(image.target(), {VK_IMAGE_ASPECT_COLOR_BIT, 0, 4, 0, 1}, texel));
    EXPECT_FALSE(clear_image(image.target(), {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 2, 3}, texel));
    EXPECT_FALSE(clear_image(image.target(), {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, 1}, texel));
  }
}

TEST(Clear, FillRepeatsTexelsOfAnySize) {
  PackedTexel texel;
  for (size_t i = 0; i < texel.size(); ++i) texel[i] = static_cast<std::byte>(i + 1);
  for (uint32_t texel_size : {1u, 2u, 4u, 8u, 12u, 16u}) {
    for (uint64_t count : {0u, 1u, 3u, 1000u, 4097u}) {
      Bytes bytes(count * texel_size + 1);
      fill_texels(bytes.data(), count, texel_size, texel);
      for (uint64_t i = 0; i < count * texel_size; ++i)
        ASSERT_EQ(bytes[i], texel[i % texel_size]) << texel_size << ' ' << i;
      EXPECT_EQ(bytes.back(), std::byte{0});
    }
  }
}

}  // namespace
}  // namespace lapilli
