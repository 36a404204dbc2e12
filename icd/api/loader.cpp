// The symbols that the loader looks up in the driver's library; all else is reached through them.
// See the loader's LoaderDriverInterface.md.
#include <vulkan/vk_icd.h>

#include <algorithm>

#include "api/command_table.h"
#include "object/instance.h"

// Version 5: the loader passes on the version that the application asked for. 7 is the newest whose rules are kept.
constexpr uint32_t kOldestInterface = 5;
constexpr uint32_t kNewestInterface = 7;

extern "C" {

[[gnu::visibility("default")]] VKAPI_ATTR VkResult VKAPI_CALL
vk_icdNegotiateLoaderICDInterfaceVersion(uint32_t* version) {
  if (*version < kOldestInterface) return VK_ERROR_INCOMPATIBLE_DRIVER;
  *version = std::min(*version, kNewestInterface);
  return VK_SUCCESS;
}

[[gnu::visibility("default")]] VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vk_icdGetInstanceProcAddr(VkInstance instance,
                                                                                                  const char* name) {
  // From version 7 on the loader may ask here for the interface itself.
  const std::string_view wanted = name;
  if (wanted == "vk_icdNegotiateLoaderICDInterfaceVersion") {
    return reinterpret_cast<PFN_vkVoidFunction>(&vk_icdNegotiateLoaderICDInterfaceVersion);
  }
  if (wanted == "vk_icdGetPhysicalDeviceProcAddr") {
    return reinterpret_cast<PFN_vkVoidFunction>(&vk_icdGetPhysicalDeviceProcAddr);
  }
  return lapilli::instance_command(lapilli::Instance::from(instance), wanted);
}

[[gnu::visibility("default")]] VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL
vk_icdGetPhysicalDeviceProcAddr(VkInstance instance, const char* name) {
  return lapilli::physical_device_command(lapilli::Instance::from(instance), name);
}

}  // extern "C"
