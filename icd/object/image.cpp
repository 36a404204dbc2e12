// Images, the memory bound to them, and their views.
#include "object/image.h"

namespace lapilli {
namespace {

constexpr uint64_t kMostPopulated = uint64_t{64} << 20;  // bytes of an image

// A colour attachment that is kept will be written in full: its first frame need not wait for the kernel, which clears
// 5 to 10 GB a second.
bool is_worth_populating(const Image& image) {
  constexpr VkImageUsageFlags kAsked = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
  return (image.usage & kAsked) == VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT && image.layout.extent.samples == 1 &&
         image.layout.size <= kMostPopulated;
}

}  // namespace

VkResult create_image(DeviceContext& device, const VkImageCreateInfo& info, const VkAllocationCallbacks* callbacks,
                      VkImage* handle) {
  VkImageFormatProperties properties = {};
  const VkResult supported =
      image_format_properties({info.format, info.imageType, info.tiling, info.usage, info.flags}, &properties);
  if (supported != VK_SUCCESS || (properties.sampleCounts & static_cast<VkSampleCountFlags>(info.samples)) == 0) {
    log_error("vkCreateImage: format %d is not supported with type %d, tiling %d, usage 0x%x, flags 0x%x, %d samples",
              info.format, info.imageType, info.tiling, info.usage, info.flags, info.samples);
    return VK_ERROR_FORMAT_NOT_SUPPORTED;
  }
  Result<ImageLayout> layout =
      make_layout(info.format, {info.extent.width, info.extent.height, info.extent.depth, info.mipLevels,
                                info.arrayLayers, static_cast<uint32_t>(info.samples)});
  if (!layout) {
    log_error("vkCreateImage: %s", layout.error().message.c_str());
    return layout.error().code;
  }
  auto image = make_object<Image>(device.object_memory(callbacks), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  image->layout = *layout;
  image->usage = info.usage;
  return publish(std::move(image), handle);
}

VkMemoryRequirements memory_requirements(const Image& image) { return {image.layout.size, image.layout.alignment, 1}; }

VkResult bind_memory(Image& image, DeviceMemory& memory, uint64_t offset) {
  if (offset > memory.size || image.layout.size > memory.size - offset || offset % image.layout.alignment != 0) {
    log_error("vkBindImageMemory: the image does not lie aligned in the memory");
    return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  }
  image.data = memory.data + offset;
  if (is_worth_populating(image)) populate(memory, offset, image.layout.size);
  return VK_SUCCESS;
}

VkSubresourceLayout subresource_layout(const Image& image, const VkImageSubresource& subresource) {
  const ImageLayout& layout = image.layout;
  if (subresource.mipLevel >= layout.extent.mip_levels || subresource.arrayLayer >= layout.extent.layers) return {};
  const LevelLayout& level = layout.levels[subresource.mipLevel];
  return {texel_offset(layout, subresource.mipLevel, subresource.arrayLayer), level.size, level.row_pitch,
          layout.layer_pitch, level.slice_pitch};
}

VkResult create_image_view(DeviceContext& device, const VkImageViewCreateInfo& info,
                           const VkAllocationCallbacks* callbacks, VkImageView* handle) {
  Image& image = *Image::from(info.image);
  if (info.viewType != VK_IMAGE_VIEW_TYPE_2D && info.viewType != VK_IMAGE_VIEW_TYPE_2D_ARRAY) {
    log_error("vkCreateImageView: only views of type 2D and 2D array are supported");
    return VK_ERROR_UNKNOWN;
  }
  if (image.data == nullptr) {
    log_error("vkCreateImageView: no memory is bound to the image");
    return VK_ERROR_UNKNOWN;
  }
  const VkFormatProperties features = format_properties(info.format);
  if ((features.optimalTilingFeatures | features.linearTilingFeatures) == 0) {
    log_error("vkCreateImageView: format %d is not supported for images", info.format);
    return VK_ERROR_UNKNOWN;
  }
  Result<TextureView> texture =
      make_view(image.layout, image.data, info.format, info.components, info.subresourceRange);
  if (!texture) {
    log_error("vkCreateImageView: %s", texture.error().message.c_str());
    return texture.error().code;
  }
  auto view = make_object<ImageView>(device.object_memory(callbacks), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  view->image = &image;
  view->format = texture->format;
  view->texture = *texture;
  view->range = info.subresourceRange;
  view->range.levelCount = texture->level_count;
  view->range.layerCount = texture->layer_count;
  return publish(std::move(view), handle);
}

}  // namespace lapilli
