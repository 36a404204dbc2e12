// The extensions that are offered: the one list. Specification: chapter "Extending Vulkan".
#pragma once

#include <vulkan/vulkan_core.h>

#include <array>
#include <cstdint>
#include <string_view>

namespace lapilli {

enum class ExtensionLevel { instance, device };

struct ExtensionInfo {
  const char* name;
  uint32_t spec_version;
  ExtensionLevel level;
};

inline constexpr std::array kExtensions = {
    ExtensionInfo{VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_DEBUG_UTILS_SPEC_VERSION, ExtensionLevel::instance},
    ExtensionInfo{VK_KHR_GET_PHYSICAL_DEVICE_PROPERTIES_2_EXTENSION_NAME,
                  VK_KHR_GET_PHYSICAL_DEVICE_PROPERTIES_2_SPEC_VERSION, ExtensionLevel::instance},
    // What the reader takes anyway: a storage class, offsets of vectors that are aligned to their components.
    ExtensionInfo{VK_KHR_RELAXED_BLOCK_LAYOUT_EXTENSION_NAME, VK_KHR_RELAXED_BLOCK_LAYOUT_SPEC_VERSION,
                  ExtensionLevel::device},
    ExtensionInfo{VK_KHR_STORAGE_BUFFER_STORAGE_CLASS_EXTENSION_NAME, VK_KHR_STORAGE_BUFFER_STORAGE_CLASS_SPEC_VERSION,
                  ExtensionLevel::device},
    ExtensionInfo{VK_KHR_SHADER_DRAW_PARAMETERS_EXTENSION_NAME, VK_KHR_SHADER_DRAW_PARAMETERS_SPEC_VERSION,
                  ExtensionLevel::device},
    ExtensionInfo{VK_KHR_SAMPLER_MIRROR_CLAMP_TO_EDGE_EXTENSION_NAME, VK_KHR_SAMPLER_MIRROR_CLAMP_TO_EDGE_SPEC_VERSION,
                  ExtensionLevel::device},
};

// Those that an application enabled.
class ExtensionSet {
 public:
  // False if there is no such extension at this level.
  bool enable(std::string_view name, ExtensionLevel level) {
    for (size_t i = 0; i < kExtensions.size(); ++i) {
      if (kExtensions[i].level != level || name != kExtensions[i].name) continue;
      enabled_ |= uint64_t{1} << i;
      return true;
    }
    return false;
  }
  bool has(std::string_view name) const {
    for (size_t i = 0; i < kExtensions.size(); ++i) {
      if (name == kExtensions[i].name) return (enabled_ >> i & 1) != 0;
    }
    return false;
  }

 private:
  uint64_t enabled_ = 0;
};

// vkEnumerateInstanceExtensionProperties and vkEnumerateDeviceExtensionProperties.
VkResult enumerate_extensions(ExtensionLevel level, const char* layer, uint32_t* count, VkExtensionProperties* out);

}  // namespace lapilli
