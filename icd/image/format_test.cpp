// The table of formats against the formats' own names, which say their layout (chapter "Formats", "Identification of
// Formats").
#include "image/format.h"

#include <gtest/gtest.h>

#include <cctype>
#include <string>
#include <string_view>

namespace lapilli {
namespace {

// Reads "R8G8B8A8_UNORM" or "D32_SFLOAT": components from the lowest bit on.
struct NameReader {
  std::array<ComponentLayout, 4> components = {};
  uint32_t bits = 0;
  VkImageAspectFlags aspects = 0;

  explicit NameReader(std::string_view name) {
    const size_t underscore = name.find('_');
    std::string_view suffix = name.substr(underscore + 1);
    const bool packed = suffix.ends_with("_PACK32");  // from the highest bit on
    if (packed) suffix.remove_suffix(7);
    const ComponentKind kind = suffix == "UNORM"    ? ComponentKind::unorm
                               : suffix == "SNORM"  ? ComponentKind::snorm
                               : suffix == "UFLOAT" ? ComponentKind::ufloat
                               : suffix == "SFLOAT" ? ComponentKind::sfloat
                               : suffix == "UINT"   ? ComponentKind::uint
                               : suffix == "SINT"   ? ComponentKind::sint
                                                    : ComponentKind::none;
    size_t i = 0;
    while (i < underscore) {
      const char letter = name[i++];
      uint8_t width = 0;
      while (i < underscore && std::isdigit(static_cast<unsigned char>(name[i])) != 0) {
        width = static_cast<uint8_t>(width * 10 + (name[i++] - '0'));
      }
      const size_t slot = letter == 'D' ? 0 : std::string_view("RGBA").find(letter);
      components.at(slot) = {kind, static_cast<uint8_t>(packed ? 32 - bits - width : bits), width};
      bits += width;
      aspects |= letter == 'D' ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
    }
  }
};

TEST(Format, TableMatchesTheNames) {
  for (const FormatInfo& info : kFormats) {
    const NameReader expected(info.name);
    EXPECT_EQ(info.components, expected.components) << info.name;
    EXPECT_EQ(info.texel_size * 8, expected.bits) << info.name;
    EXPECT_EQ(info.aspects, expected.aspects) << info.name;
  }
}

TEST(Format, FindReturnsTheFormatItself) {
  for (const FormatInfo& info : kFormats) {
    EXPECT_EQ(find_format(info.format), &info) << info.name;
    EXPECT_EQ(kFormats[info.index].format, info.format) << info.name;
  }
  // Values of the specification's enumeration.
  EXPECT_EQ(find_format(static_cast<VkFormat>(37))->name, std::string("R8G8B8A8_UNORM"));
  EXPECT_EQ(find_format(static_cast<VkFormat>(126))->name, std::string("D32_SFLOAT"));
}

TEST(Format, UnknownFormatsAreNull) {
  EXPECT_EQ(find_format(VK_FORMAT_UNDEFINED), nullptr);
  EXPECT_EQ(find_format(VK_FORMAT_ASTC_12x12_SRGB_BLOCK), nullptr);
  EXPECT_EQ(find_format(VK_FORMAT_A4R4G4B4_UNORM_PACK16), nullptr);
  EXPECT_EQ(find_format(static_cast<VkFormat>(0x7FFFFFFF)), nullptr);
}

TEST(Format, FeaturesFollowTheRulesOfTheApi) {
  for (const FormatInfo& info : kFormats) {
    const VkFormatProperties properties = format_properties(info.format);
    const VkFormatFeatureFlags image = properties.optimalTilingFeatures;
    if ((image & VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT) != 0) {
      EXPECT_NE(image & VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT, 0u) << info.name;
      EXPECT_FALSE(info.is_integer()) << info.name;
    }
    if ((image & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT) != 0) {
      EXPECT_NE(image & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT, 0u) << info.name;
    }
    // Vulkan 1.0 without maintenance1 has no transfer bits.
    constexpr VkFormatFeatureFlags transfer = VK_FORMAT_FEATURE_TRANSFER_SRC_BIT | VK_FORMAT_FEATURE_TRANSFER_DST_BIT;
    EXPECT_EQ((image | properties.linearTilingFeatures | properties.bufferFeatures) & transfer, 0u) << info.name;
    EXPECT_EQ(info.has(kTransfer), image != 0) << info.name;
  }
  EXPECT_EQ(format_properties(VK_FORMAT_BC1_RGB_UNORM_BLOCK).optimalTilingFeatures, 0u);
}

TEST(Format, FirstFormatsAreOffered) {
  constexpr VkFormatFeatureFlags target =
      VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT |
      VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT | VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT |
      VK_FORMAT_FEATURE_BLIT_SRC_BIT | VK_FORMAT_FEATURE_BLIT_DST_BIT;  // conformance/features/blit_test.cpp
  for (VkFormat format : {VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R32G32B32A32_SFLOAT}) {
    EXPECT_EQ(format_properties(format).optimalTilingFeatures & target, target);
    EXPECT_EQ(format_properties(format).linearTilingFeatures & target, target);
  }
  EXPECT_NE(
      format_properties(VK_FORMAT_D32_SFLOAT).optimalTilingFeatures & VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT,
      0u);
  EXPECT_EQ(format_properties(VK_FORMAT_D32_SFLOAT).optimalTilingFeatures & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT, 0u);
  for (VkFormat format :
       {VK_FORMAT_R32_SFLOAT, VK_FORMAT_R32G32_SFLOAT, VK_FORMAT_R32G32B32_SFLOAT, VK_FORMAT_R32G32B32A32_SFLOAT}) {
    EXPECT_NE(format_properties(format).bufferFeatures & VK_FORMAT_FEATURE_VERTEX_BUFFER_BIT, 0u);
  }
}

// "Required Format Support" of Vulkan 1.0 for storage images and storage texel buffers, and some of
// shaderStorageImageExtendedFormats.
TEST(Format, StorageFormatsOfTheSpecificationAreOffered) {
  constexpr VkFormat kRequired[] = {VK_FORMAT_R8_UNORM,
                                    VK_FORMAT_R16_SFLOAT,
                                    VK_FORMAT_R8G8_SINT,
                                    VK_FORMAT_R16G16_SNORM,
                                    VK_FORMAT_R16G16B16A16_UNORM,
                                    VK_FORMAT_A2B10G10R10_UINT_PACK32,
                                    VK_FORMAT_A2B10G10R10_UNORM_PACK32,
                                    VK_FORMAT_B10G11R11_UFLOAT_PACK32,

                                    VK_FORMAT_R8G8B8A8_UNORM,
                                    VK_FORMAT_R8G8B8A8_SNORM,
                                    VK_FORMAT_R8G8B8A8_UINT,
                                    VK_FORMAT_R8G8B8A8_SINT,
                                    VK_FORMAT_R16G16B16A16_UINT,
                                    VK_FORMAT_R16G16B16A16_SINT,
                                    VK_FORMAT_R16G16B16A16_SFLOAT,
                                    VK_FORMAT_R32_UINT,
                                    VK_FORMAT_R32_SINT,
                                    VK_FORMAT_R32_SFLOAT,
                                    VK_FORMAT_R32G32_UINT,
                                    VK_FORMAT_R32G32_SINT,
                                    VK_FORMAT_R32G32_SFLOAT,
                                    VK_FORMAT_R32G32B32A32_UINT,
                                    VK_FORMAT_R32G32B32A32_SINT,
                                    VK_FORMAT_R32G32B32A32_SFLOAT};
  constexpr VkFormatFeatureFlags storage = VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT;
  constexpr VkFormatFeatureFlags texels =
      VK_FORMAT_FEATURE_UNIFORM_TEXEL_BUFFER_BIT | VK_FORMAT_FEATURE_STORAGE_TEXEL_BUFFER_BIT;
  for (VkFormat format : kRequired) {
    EXPECT_EQ(format_properties(format).optimalTilingFeatures & storage, storage);
    EXPECT_EQ(format_properties(format).bufferFeatures & texels, texels);
  }
}

TEST(Format, PackedBytesAreThoseOfTheUnpackedFormat) {
  const std::pair<VkFormat, VkFormat> pairs[] = {{VK_FORMAT_A8B8G8R8_UNORM_PACK32, VK_FORMAT_R8G8B8A8_UNORM},
                                                 {VK_FORMAT_A8B8G8R8_SNORM_PACK32, VK_FORMAT_R8G8B8A8_SNORM},
                                                 {VK_FORMAT_A8B8G8R8_UINT_PACK32, VK_FORMAT_R8G8B8A8_UINT},
                                                 {VK_FORMAT_A8B8G8R8_SINT_PACK32, VK_FORMAT_R8G8B8A8_SINT}};
  for (const auto& [packed, bytes] : pairs) {
    EXPECT_EQ(find_format(packed)->components, find_format(bytes)->components);
    EXPECT_NE(format_properties(packed).bufferFeatures & VK_FORMAT_FEATURE_STORAGE_TEXEL_BUFFER_BIT, 0u);
  }
}

}  // namespace
}  // namespace lapilli
