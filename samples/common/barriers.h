// Image layout transitions of a whole image. Specification: Synchronization and Cache Control, Pipeline Barriers.
#pragma once

#include <vulkan/vulkan_core.h>

namespace lapilli::samples {

// A layout and who uses the image in it.
struct ImageUse {
  VkImageLayout layout;
  VkPipelineStageFlags stages;
  VkAccessFlags access;
};

inline void change_layout(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect, const ImageUse& before,
                          const ImageUse& after) {
  VkImageMemoryBarrier barrier = {};
  barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
  barrier.srcAccessMask = before.access;
  barrier.dstAccessMask = after.access;
  barrier.oldLayout = before.layout;
  barrier.newLayout = after.layout;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = {aspect, 0, VK_REMAINING_MIP_LEVELS, 0, 1};
  vkCmdPipelineBarrier(commands, before.stages, after.stages, 0, 0, nullptr, 0, nullptr, 1, &barrier);
}

}  // namespace lapilli::samples
