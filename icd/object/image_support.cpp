// Which images there can be. Specification: chapter "Additional Capabilities", section "Additional Image Capabilities".
#include "image/texture.h"
#include "object/physical_device.h"

namespace lapilli {
namespace {

VkFormatFeatureFlags features_of(VkFormat format, VkImageTiling tiling) {
  const VkFormatProperties properties = format_properties(format);
  switch (tiling) {
    case VK_IMAGE_TILING_OPTIMAL:
      return properties.optimalTilingFeatures;
    case VK_IMAGE_TILING_LINEAR:
      return properties.linearTilingFeatures;
    default:
      return 0;
  }
}

bool usage_supported(const FormatInfo& format, VkImageUsageFlags usage) {
  struct Rule {
    VkImageUsageFlags usage;
    FormatFeature feature;
  };
  constexpr Rule kRules[] = {
      {VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT, kTransfer},
      {VK_IMAGE_USAGE_SAMPLED_BIT, kSampled},
      {VK_IMAGE_USAGE_STORAGE_BIT, kStorage},
      {VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, kColorTarget},
      {VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, kDepthTarget},
  };
  VkImageUsageFlags possible = 0;
  for (const Rule& rule : kRules) {
    if (format.has(rule.feature)) possible |= rule.usage;
  }
  if (format.has(kColorTarget) || format.has(kDepthTarget)) {
    // An image may be an input attachment; a shader that reads one is refused at pipeline creation.
    possible |= VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT | VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT;
  }
  return (usage & ~possible) == 0;
}

}  // namespace

VkResult image_format_properties(const ImageParameters& image, VkImageFormatProperties* out) {
  *out = {};
  const FormatInfo* format = find_format(image.format);
  constexpr VkImageCreateFlags kFlags = VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT;
  if (format == nullptr || features_of(image.format, image.tiling) == 0 || image.type != VK_IMAGE_TYPE_2D ||
      (image.flags & ~kFlags) != 0 || !usage_supported(*format, image.usage)) {
    return VK_ERROR_FORMAT_NOT_SUPPORTED;
  }
  out->maxExtent = {kMaxImageDimension2D, kMaxImageDimension2D, 1};
  out->maxMipLevels = kMaxMipLevels;
  out->maxArrayLayers = kMaxImageLayers;
  out->sampleCounts = VK_SAMPLE_COUNT_1_BIT;
  out->maxResourceSize = kMaxImageBytes;
  return VK_SUCCESS;
}

}  // namespace lapilli
