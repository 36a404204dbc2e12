// Look-up in the table of formats and its translation to the API's feature bits.
#include "image/format.h"

namespace lapilli {
namespace {

constexpr size_t kCoreFormats = 185;  // VK_FORMAT_UNDEFINED … VK_FORMAT_ASTC_12x12_SRGB_BLOCK are 0 … 184
constexpr uint8_t kUnknown = 0xFF;

constexpr std::array<uint8_t, kCoreFormats> kCoreIndex = [] {
  std::array<uint8_t, kCoreFormats> index{};
  index.fill(kUnknown);
  for (const FormatInfo& info : kFormats) {
    if (static_cast<size_t>(info.format) < kCoreFormats) {
      index[static_cast<size_t>(info.format)] = static_cast<uint8_t>(info.index);
    }
  }
  return index;
}();

}  // namespace

const FormatInfo* find_format(VkFormat format) {
  const size_t value = static_cast<size_t>(format);
  if (value < kCoreFormats) return kCoreIndex[value] == kUnknown ? nullptr : &kFormats[kCoreIndex[value]];
  for (const FormatInfo& info : kFormats) {  // formats of extensions
    if (info.format == format) return &info;
  }
  return nullptr;
}

VkFormatProperties format_properties(VkFormat format) {
  VkFormatProperties properties = {};
  const FormatInfo* info = find_format(format);
  if (info == nullptr) return properties;
  const auto add = [info](FormatFeature feature, VkFormatFeatureFlags bit) { return info->has(feature) ? bit : 0u; };
  // Blits sample their source and pack their target; those of depth and of integers are left out.
  const bool color = info->aspects == VK_IMAGE_ASPECT_COLOR_BIT;
  const VkFormatFeatureFlags blit = color ? (info->is_integer() ? 0 : add(kSampled, VK_FORMAT_FEATURE_BLIT_SRC_BIT)) |
                                                add(kColorTarget, VK_FORMAT_FEATURE_BLIT_DST_BIT)
                                          : 0u;
  const VkFormatFeatureFlags image = blit | add(kSampled, VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT) |
                                     add(kFilterable, VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT) |
                                     add(kStorage, VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT) |
                                     add(kAtomic, VK_FORMAT_FEATURE_STORAGE_IMAGE_ATOMIC_BIT) |
                                     add(kColorTarget, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT) |
                                     add(kBlendable, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT) |
                                     add(kDepthTarget, VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT);
  properties.optimalTilingFeatures = image;
  // All images are row-major, so linear ones can do the same. Depth is left out: nobody asks for it.
  if (color) properties.linearTilingFeatures = image;
  properties.bufferFeatures = add(kVertex, VK_FORMAT_FEATURE_VERTEX_BUFFER_BIT) |
                              add(kTexelBuffer, VK_FORMAT_FEATURE_UNIFORM_TEXEL_BUFFER_BIT) |
                              add(kStorageTexelBuffer, VK_FORMAT_FEATURE_STORAGE_TEXEL_BUFFER_BIT) |
                              add(kAtomic, VK_FORMAT_FEATURE_STORAGE_TEXEL_BUFFER_ATOMIC_BIT);
  return properties;
}

}  // namespace lapilli
