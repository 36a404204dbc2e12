// Entry points of chapters "Copy Commands" and "Clear Commands".
#include "api/entry.h"

namespace lapilli::entry {

VKAPI_ATTR void VKAPI_CALL vkCmdCopyBuffer(VkCommandBuffer commands, VkBuffer source, VkBuffer target, uint32_t count,
                                           const VkBufferCopy* regions) {
  record_copy_buffer(*CommandBuffer::from(commands), Buffer::from(source), Buffer::from(target), list(regions, count));
}

VKAPI_ATTR void VKAPI_CALL vkCmdCopyImage(VkCommandBuffer commands, VkImage source, VkImageLayout, VkImage target,
                                          VkImageLayout, uint32_t count, const VkImageCopy* regions) {
  record_copy_image(*CommandBuffer::from(commands), Image::from(source), Image::from(target), list(regions, count));
}

VKAPI_ATTR void VKAPI_CALL vkCmdCopyBufferToImage(VkCommandBuffer commands, VkBuffer source, VkImage target,
                                                  VkImageLayout, uint32_t count, const VkBufferImageCopy* regions) {
  record_copy_buffer_to_image(*CommandBuffer::from(commands), Buffer::from(source), Image::from(target),
                              list(regions, count));
}

VKAPI_ATTR void VKAPI_CALL vkCmdCopyImageToBuffer(VkCommandBuffer commands, VkImage source, VkImageLayout,
                                                  VkBuffer target, uint32_t count, const VkBufferImageCopy* regions) {
  record_copy_image_to_buffer(*CommandBuffer::from(commands), Image::from(source), Buffer::from(target),
                              list(regions, count));
}

VKAPI_ATTR void VKAPI_CALL vkCmdBlitImage(VkCommandBuffer commands, VkImage source, VkImageLayout, VkImage target,
                                          VkImageLayout, uint32_t count, const VkImageBlit* regions, VkFilter filter) {
  record_blit_image(*CommandBuffer::from(commands), Image::from(source), Image::from(target), list(regions, count),
                    filter);
}

// There are no multisampled images, so that there is nothing to resolve.
VKAPI_ATTR void VKAPI_CALL vkCmdResolveImage(VkCommandBuffer, VkImage, VkImageLayout, VkImage, VkImageLayout, uint32_t,
                                             const VkImageResolve*) {}

VKAPI_ATTR void VKAPI_CALL vkCmdUpdateBuffer(VkCommandBuffer commands, VkBuffer target, VkDeviceSize offset,
                                             VkDeviceSize size, const void* data) {
  record_update_buffer(*CommandBuffer::from(commands), Buffer::from(target), offset,
                       {static_cast<const std::byte*>(data), size});
}

VKAPI_ATTR void VKAPI_CALL vkCmdFillBuffer(VkCommandBuffer commands, VkBuffer target, VkDeviceSize offset,
                                           VkDeviceSize size, uint32_t word) {
  record_fill_buffer(*CommandBuffer::from(commands), Buffer::from(target), offset, size, word);
}

VKAPI_ATTR void VKAPI_CALL vkCmdClearColorImage(VkCommandBuffer commands, VkImage image, VkImageLayout,
                                                const VkClearColorValue* color, uint32_t count,
                                                const VkImageSubresourceRange* ranges) {
  record_clear_image(*CommandBuffer::from(commands), Image::from(image), {.color = *color}, list(ranges, count));
}

VKAPI_ATTR void VKAPI_CALL vkCmdClearDepthStencilImage(VkCommandBuffer commands, VkImage image, VkImageLayout,
                                                       const VkClearDepthStencilValue* value, uint32_t count,
                                                       const VkImageSubresourceRange* ranges) {
  record_clear_image(*CommandBuffer::from(commands), Image::from(image), {.depthStencil = *value}, list(ranges, count));
}

VKAPI_ATTR void VKAPI_CALL vkCmdClearAttachments(VkCommandBuffer commands, uint32_t count,
                                                 const VkClearAttachment* attachments, uint32_t rectangle_count,
                                                 const VkClearRect* rectangles) {
  record_clear_attachments(*CommandBuffer::from(commands), list(attachments, count), list(rectangles, rectangle_count));
}

}  // namespace lapilli::entry
