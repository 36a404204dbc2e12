// VkImage and VkImageView. Specification: chapter "Resource Creation", sections "Images" and "Image Views".
#pragma once

#include "image/copy.h"
#include "object/memory.h"

namespace lapilli {

struct Image : Handle<Image, VkImage> {
  using Handle::Handle;

  ImageLayout layout;
  VkImageUsageFlags usage = 0;
  std::byte* data = nullptr;  // null until memory is bound

  ImageMemory texels() { return {&layout, data}; }
};

VkResult create_image(DeviceContext& device, const VkImageCreateInfo& info, const VkAllocationCallbacks* callbacks,
                      VkImage* handle);
VkMemoryRequirements memory_requirements(const Image& image);
VkResult bind_memory(Image& image, DeviceMemory& memory, uint64_t offset);
VkSubresourceLayout subresource_layout(const Image& image, const VkImageSubresource& subresource);

struct ImageView : Handle<ImageView, VkImageView> {
  using Handle::Handle;

  Image* image = nullptr;
  const FormatInfo* format = nullptr;
  VkImageSubresourceRange range = {};  // without VK_REMAINING_…
  TextureView texture;
};

VkResult create_image_view(DeviceContext& device, const VkImageViewCreateInfo& info,
                           const VkAllocationCallbacks* callbacks, VkImageView* handle);

}  // namespace lapilli
