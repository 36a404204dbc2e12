// Entry points of chapters "Resource Creation" and "Samplers".
#include "api/entry.h"

namespace lapilli::entry {

VKAPI_ATTR VkResult VKAPI_CALL vkCreateBuffer(VkDevice device, const VkBufferCreateInfo* info,
                                              const VkAllocationCallbacks* callbacks, VkBuffer* buffer) {
  return create_buffer(*Device::from(device), *info, callbacks, buffer);
}

VKAPI_ATTR void VKAPI_CALL vkDestroyBuffer(VkDevice, VkBuffer buffer, const VkAllocationCallbacks*) {
  destroy(Buffer::from(buffer));
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateBufferView(VkDevice device, const VkBufferViewCreateInfo* info,
                                                  const VkAllocationCallbacks* callbacks, VkBufferView* view) {
  return create_buffer_view(*Device::from(device), *info, callbacks, view);
}

VKAPI_ATTR void VKAPI_CALL vkDestroyBufferView(VkDevice, VkBufferView view, const VkAllocationCallbacks*) {
  destroy(BufferView::from(view));
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateImage(VkDevice device, const VkImageCreateInfo* info,
                                             const VkAllocationCallbacks* callbacks, VkImage* image) {
  return create_image(*Device::from(device), *info, callbacks, image);
}

VKAPI_ATTR void VKAPI_CALL vkDestroyImage(VkDevice, VkImage image, const VkAllocationCallbacks*) {
  destroy(Image::from(image));
}

VKAPI_ATTR void VKAPI_CALL vkGetImageSubresourceLayout(VkDevice, VkImage image, const VkImageSubresource* subresource,
                                                       VkSubresourceLayout* layout) {
  *layout = subresource_layout(*Image::from(image), *subresource);
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateImageView(VkDevice device, const VkImageViewCreateInfo* info,
                                                 const VkAllocationCallbacks* callbacks, VkImageView* view) {
  return create_image_view(*Device::from(device), *info, callbacks, view);
}

VKAPI_ATTR void VKAPI_CALL vkDestroyImageView(VkDevice, VkImageView view, const VkAllocationCallbacks*) {
  destroy(ImageView::from(view));
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateSampler(VkDevice device, const VkSamplerCreateInfo* info,
                                               const VkAllocationCallbacks* callbacks, VkSampler* sampler) {
  return create_sampler(*Device::from(device), *info, callbacks, sampler);
}

VKAPI_ATTR void VKAPI_CALL vkDestroySampler(VkDevice, VkSampler sampler, const VkAllocationCallbacks*) {
  destroy(Sampler::from(sampler));
}

}  // namespace lapilli::entry
