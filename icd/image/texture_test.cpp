// Memory layouts: every texel has its own bytes inside the image; limits, views and samplers.
#include "image/texture.h"

#include <gtest/gtest.h>

#include <bit>
#include <vector>

namespace lapilli {
namespace {

constexpr VkComponentMapping kIdentity = {};

VkImageSubresourceRange range_of(uint32_t level, uint32_t levels, uint32_t layer, uint32_t layers) {
  return {VK_IMAGE_ASPECT_COLOR_BIT, level, levels, layer, layers};
}

TEST(Layout, MipSidesAreHalvedDownToOne) {
  const auto layout = make_layout(VK_FORMAT_R8G8B8A8_UNORM, {.width = 13, .height = 5, .mip_levels = 4});
  ASSERT_TRUE(layout.ok());
  const uint32_t widths[] = {13, 6, 3, 1};
  const uint32_t heights[] = {5, 2, 1, 1};
  for (uint32_t i = 0; i < 4; ++i) {
    EXPECT_EQ(layout->levels[i].width, widths[i]);
    EXPECT_EQ(layout->levels[i].height, heights[i]);
    EXPECT_EQ(layout->levels[i].depth, 1u);
  }
}

// Marks every byte of every texel: no byte twice, none outside.
void expect_disjoint(VkFormat format, const ImageExtent& extent) {
  const auto layout = make_layout(format, extent);
  ASSERT_TRUE(layout.ok());
  std::vector<uint8_t> marks(layout->size);
  for (uint32_t sample = 0; sample < extent.samples; ++sample) {
    for (uint32_t layer = 0; layer < extent.layers; ++layer) {
      for (uint32_t i = 0; i < extent.mip_levels; ++i) {
        const LevelLayout& level = layout->levels[i];
        for (uint32_t z = 0; z < level.depth; ++z) {
          const uint64_t slice = texel_offset(*layout, i, layer, z, sample);
          EXPECT_EQ(slice % kImageAlignment, 0u);
          for (uint32_t y = 0; y < level.height; ++y) {
            const uint64_t row = slice + y * level.row_pitch;
            for (uint64_t byte = row; byte < row + level.width * layout->format->texel_size; ++byte) {
              ASSERT_LT(byte, layout->size);
              ASSERT_EQ(marks[byte]++, 0);
            }
          }
        }
      }
    }
  }
}

TEST(Layout, TexelsAreDisjoint) {
  expect_disjoint(VK_FORMAT_R8G8B8A8_UNORM, {.width = 13, .height = 5, .mip_levels = 4, .layers = 3});
  expect_disjoint(VK_FORMAT_R32G32B32A32_SFLOAT, {.width = 9, .height = 7, .depth = 5, .mip_levels = 3});
  expect_disjoint(VK_FORMAT_D32_SFLOAT, {.width = 17, .height = 3, .layers = 2, .samples = 4});
}

TEST(Layout, RefusesWhatIsAbsurd) {
  const auto code = [](VkFormat format, const ImageExtent& extent) { return make_layout(format, extent).error().code; };
  constexpr VkFormat rgba8 = VK_FORMAT_R8G8B8A8_UNORM;
  EXPECT_EQ(code(VK_FORMAT_UNDEFINED, {.width = 1, .height = 1}), VK_ERROR_FORMAT_NOT_SUPPORTED);
  EXPECT_EQ(code(rgba8, {.width = 0, .height = 1}), VK_ERROR_UNKNOWN);
  EXPECT_EQ(code(rgba8, {.width = 1, .height = 0}), VK_ERROR_UNKNOWN);
  EXPECT_EQ(code(rgba8, {.width = 1, .height = 1, .depth = 0}), VK_ERROR_UNKNOWN);
  EXPECT_EQ(code(rgba8, {.width = 1, .height = 1, .mip_levels = 0}), VK_ERROR_UNKNOWN);
  EXPECT_EQ(code(rgba8, {.width = 1, .height = 1, .layers = 0}), VK_ERROR_UNKNOWN);
  EXPECT_EQ(code(rgba8, {.width = 1, .height = 1, .samples = 3}), VK_ERROR_UNKNOWN);
  EXPECT_EQ(code(rgba8, {.width = 8193, .height = 1}), VK_ERROR_UNKNOWN);
  EXPECT_EQ(code(rgba8, {.width = ~0u, .height = ~0u, .depth = ~0u, .mip_levels = ~0u, .layers = ~0u}),
            VK_ERROR_UNKNOWN);
  EXPECT_EQ(code(rgba8, {.width = 8, .height = 4, .mip_levels = 5}), VK_ERROR_UNKNOWN);
  EXPECT_TRUE(make_layout(rgba8, {.width = 8, .height = 4, .mip_levels = 4}).ok());
  EXPECT_EQ(code(VK_FORMAT_R32G32B32A32_SFLOAT, {.width = 8192, .height = 8192, .layers = 2048, .samples = 8}),
            VK_ERROR_OUT_OF_DEVICE_MEMORY);
}

TEST(Layout, LargestImageKnowsItsSize) {
  const auto layout = make_layout(VK_FORMAT_R32G32B32A32_SFLOAT, {.width = 8192, .height = 8192, .mip_levels = 14});
  ASSERT_TRUE(layout.ok());
  // 2^30 bytes for level 0; rows below 4 texels are padded to 64 bytes, so the two last levels have 2 * 64 and 64
  // bytes.
  uint64_t expected = 0;
  for (uint64_t side = 8192; side >= 4; side /= 2) expected += side * side * 16;
  EXPECT_EQ(layout->size, expected + 3 * 64);
}

TEST(View, StartsAtItsBaseLevelAndLayer) {
  const auto layout = make_layout(VK_FORMAT_R8G8B8A8_UNORM, {.width = 32, .height = 16, .mip_levels = 5, .layers = 4});
  ASSERT_TRUE(layout.ok());
  std::vector<std::byte> memory(layout->size);
  const auto view = make_view(*layout, memory.data(), VK_FORMAT_B8G8R8A8_UNORM, kIdentity,
                              range_of(2, VK_REMAINING_MIP_LEVELS, 1, VK_REMAINING_ARRAY_LAYERS));
  ASSERT_TRUE(view.ok());
  EXPECT_EQ(view->level_count, 3u);
  EXPECT_EQ(view->layer_count, 3u);
  EXPECT_EQ(view->format->format, VK_FORMAT_B8G8R8A8_UNORM);
  EXPECT_EQ(view->levels[0].width, 8);
  EXPECT_EQ(view->levels[0].height, 4);
  EXPECT_EQ(view->levels[1].data, memory.data() + texel_offset(*layout, 3, 1));
  EXPECT_TRUE(view->identity_swizzle);
}

TEST(View, RefusesRangesOutside) {
  const auto layout = make_layout(VK_FORMAT_R8G8B8A8_UNORM, {.width = 32, .height = 16, .mip_levels = 5, .layers = 4});
  ASSERT_TRUE(layout.ok());
  const auto accepted = [&](VkFormat format, const VkImageSubresourceRange& range) {
    return make_view(*layout, nullptr, format, kIdentity, range).ok();
  };
  EXPECT_TRUE(accepted(VK_FORMAT_R8G8B8A8_UNORM, range_of(4, 1, 3, 1)));
  EXPECT_FALSE(accepted(VK_FORMAT_R8G8B8A8_UNORM, range_of(5, 1, 0, 1)));
  EXPECT_FALSE(accepted(VK_FORMAT_R8G8B8A8_UNORM, range_of(4, 2, 0, 1)));
  EXPECT_FALSE(accepted(VK_FORMAT_R8G8B8A8_UNORM, range_of(0, 0, 0, 1)));
  EXPECT_FALSE(accepted(VK_FORMAT_R8G8B8A8_UNORM, range_of(0, 1, 4, VK_REMAINING_ARRAY_LAYERS)));
  EXPECT_FALSE(accepted(VK_FORMAT_R8G8B8A8_UNORM, range_of(0, 1, 1, 4)));
  EXPECT_FALSE(accepted(VK_FORMAT_R32G32B32A32_SFLOAT, range_of(0, 1, 0, 1)));
}

TEST(View, SwizzleIsResolved) {
  const auto layout = make_layout(VK_FORMAT_R8G8B8A8_UNORM, {.width = 1, .height = 1});
  ASSERT_TRUE(layout.ok());
  const VkComponentMapping mapping = {VK_COMPONENT_SWIZZLE_B, VK_COMPONENT_SWIZZLE_IDENTITY, VK_COMPONENT_SWIZZLE_ONE,
                                      VK_COMPONENT_SWIZZLE_ZERO};
  const auto view = make_view(*layout, nullptr, VK_FORMAT_R8G8B8A8_UNORM, mapping, range_of(0, 1, 0, 1));
  ASSERT_TRUE(view.ok());
  EXPECT_EQ(view->swizzle, (std::array{Swizzle::b, Swizzle::g, Swizzle::one, Swizzle::zero}));
  EXPECT_FALSE(view->identity_swizzle);
}

TEST(Sampler, TakesWhatIsOfferedAndRefusesTheRest) {
  VkSamplerCreateInfo info = {};
  info.magFilter = VK_FILTER_LINEAR;
  info.addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER;
  info.borderColor = VK_BORDER_COLOR_FLOAT_OPAQUE_BLACK;
  info.mipLodBias = 0.5f;
  const auto sampler = make_sampler(info);
  ASSERT_TRUE(sampler.ok());
  EXPECT_EQ(sampler->mag_filter, VK_FILTER_LINEAR);
  EXPECT_EQ(sampler->min_filter, VK_FILTER_NEAREST);
  EXPECT_EQ(sampler->address_v, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER);
  EXPECT_EQ(sampler->border, (std::array<uint32_t, 4>{0, 0, 0, std::bit_cast<uint32_t>(1.0f)}));
  EXPECT_EQ(sampler->lod_bias, 0.5f);
  info.anisotropyEnable = VK_TRUE;
  EXPECT_FALSE(make_sampler(info).ok());
  info.anisotropyEnable = VK_FALSE;
  info.minFilter = VK_FILTER_CUBIC_EXT;
  EXPECT_FALSE(make_sampler(info).ok());
}

}  // namespace
}  // namespace lapilli
