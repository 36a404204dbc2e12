// Entry points that ask a physical device: chapters "Devices and Queues", "Features", "Limits", "Additional
// Capabilities".
#include "api/entry.h"
#include "object/enumerate.h"

namespace lapilli::entry {

VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceProperties(VkPhysicalDevice device,
                                                         VkPhysicalDeviceProperties* properties) {
  *properties = device_properties(*PhysicalDevice::from(device));
}

VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceFeatures(VkPhysicalDevice, VkPhysicalDeviceFeatures* features) {
  *features = device_features();
}

VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceMemoryProperties(VkPhysicalDevice device,
                                                               VkPhysicalDeviceMemoryProperties* properties) {
  *properties = memory_properties(*PhysicalDevice::from(device));
}

VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceQueueFamilyProperties(VkPhysicalDevice, uint32_t* count,
                                                                    VkQueueFamilyProperties* properties) {
  const VkQueueFamilyProperties families[] = {queue_family_properties()};
  enumerate(std::span<const VkQueueFamilyProperties>(families), count, properties);
}

VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceFormatProperties(VkPhysicalDevice, VkFormat format,
                                                               VkFormatProperties* properties) {
  *properties = format_properties(format);
}

VKAPI_ATTR VkResult VKAPI_CALL vkGetPhysicalDeviceImageFormatProperties(VkPhysicalDevice, VkFormat format,
                                                                        VkImageType type, VkImageTiling tiling,
                                                                        VkImageUsageFlags usage,
                                                                        VkImageCreateFlags flags,
                                                                        VkImageFormatProperties* properties) {
  return image_format_properties({format, type, tiling, usage, flags}, properties);
}

// No sparse images: there is nothing to list.
VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceSparseImageFormatProperties(VkPhysicalDevice, VkFormat, VkImageType,
                                                                          VkSampleCountFlagBits, VkImageUsageFlags,
                                                                          VkImageTiling, uint32_t* count,
                                                                          VkSparseImageFormatProperties*) {
  *count = 0;
}

// VK_KHR_get_physical_device_properties2. No structure that extends these is known, so that chains are left alone.
VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceProperties2KHR(VkPhysicalDevice device,
                                                             VkPhysicalDeviceProperties2* properties) {
  properties->properties = device_properties(*PhysicalDevice::from(device));
}

VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceFeatures2KHR(VkPhysicalDevice, VkPhysicalDeviceFeatures2* features) {
  features->features = device_features();
}

VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceMemoryProperties2KHR(VkPhysicalDevice device,
                                                                   VkPhysicalDeviceMemoryProperties2* properties) {
  properties->memoryProperties = memory_properties(*PhysicalDevice::from(device));
}

VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceQueueFamilyProperties2KHR(VkPhysicalDevice, uint32_t* count,
                                                                        VkQueueFamilyProperties2* properties) {
  const VkQueueFamilyProperties families[] = {queue_family_properties()};
  enumerate(std::span<const VkQueueFamilyProperties>(families), count, properties,
            [](VkQueueFamilyProperties2& target, const VkQueueFamilyProperties& source) {
              target.queueFamilyProperties = source;
            });
}

VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceFormatProperties2KHR(VkPhysicalDevice, VkFormat format,
                                                                   VkFormatProperties2* properties) {
  properties->formatProperties = format_properties(format);
}

VKAPI_ATTR VkResult VKAPI_CALL vkGetPhysicalDeviceImageFormatProperties2KHR(
    VkPhysicalDevice, const VkPhysicalDeviceImageFormatInfo2* info, VkImageFormatProperties2* properties) {
  return image_format_properties({info->format, info->type, info->tiling, info->usage, info->flags},
                                 &properties->imageFormatProperties);
}

VKAPI_ATTR void VKAPI_CALL vkGetPhysicalDeviceSparseImageFormatProperties2KHR(
    VkPhysicalDevice, const VkPhysicalDeviceSparseImageFormatInfo2*, uint32_t* count, VkSparseImageFormatProperties2*) {
  *count = 0;
}

}  // namespace lapilli::entry
