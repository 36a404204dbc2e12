// What the driver can do, as numbers. Specification: chapter "Limits", table "Required Limits".
#pragma once

#include <vulkan/vulkan_core.h>

namespace lapilli {

inline constexpr uint32_t kMaxMemoryAllocations = 32768;  // below the kernel's default of 65530 mappings a process
inline constexpr uint32_t kMaxSamplers = 1u << 20;
inline constexpr uint32_t kMaxWorkgroupCount = 65535;  // in each direction
inline constexpr uint32_t kMaxVertexStride = 2048;     // bytes
inline constexpr uint32_t kMaxFramebufferAttachments = 64;

VkPhysicalDeviceLimits device_limits();

}  // namespace lapilli
