// VkPhysicalDevice: what the driver says about itself. Specification: chapters "Devices and Queues", "Features",
// "Formats".
#pragma once

#include "image/format.h"
#include "object/environment.h"
#include "object/handle.h"

namespace lapilli {

struct Instance;

struct PhysicalDevice : Handle<PhysicalDevice, VkPhysicalDevice> {
  PhysicalDevice(const HostMemory& memory, Instance& owner, const Environment& settings);

  Instance& instance;
  const Environment environment;
  uint64_t heap_size;  // bytes
};

VkPhysicalDeviceProperties device_properties(const PhysicalDevice& device);
VkPhysicalDeviceFeatures device_features();
VkQueueFamilyProperties queue_family_properties();
VkPhysicalDeviceMemoryProperties memory_properties(const PhysicalDevice& device);

// Of an image with these parameters; VK_ERROR_FORMAT_NOT_SUPPORTED if there can be none.
struct ImageParameters {
  VkFormat format;
  VkImageType type;
  VkImageTiling tiling;
  VkImageUsageFlags usage;
  VkImageCreateFlags flags;
};
VkResult image_format_properties(const ImageParameters& image, VkImageFormatProperties* out);

// The bytes that identify this build: for pipeline caches.
void write_uuid(uint8_t (&uuid)[VK_UUID_SIZE]);

}  // namespace lapilli
