// Creation of devices: what was asked for is checked against what is offered.
#include "queue/device.h"

#include <cstring>

#include "base/log.h"
#include "object/instance.h"
#include "object/structure_chain.h"

namespace lapilli {
namespace {

// VkPhysicalDeviceFeatures is a row of VkBool32.
bool features_offered(const VkPhysicalDeviceFeatures& wanted) {
  constexpr size_t kCount = sizeof(VkPhysicalDeviceFeatures) / sizeof(VkBool32);
  const VkPhysicalDeviceFeatures offered = device_features();
  VkBool32 want[kCount], have[kCount];
  std::memcpy(want, &wanted, sizeof(want));
  std::memcpy(have, &offered, sizeof(have));
  for (size_t i = 0; i < kCount; ++i) {
    if (want[i] != VK_FALSE && have[i] == VK_FALSE) {
      log_error("vkCreateDevice: feature number %zu of VkPhysicalDeviceFeatures is not offered", i);
      return false;
    }
  }
  return true;
}

VkResult check_features(const VkDeviceCreateInfo& info) {
  if (info.pEnabledFeatures != nullptr && !features_offered(*info.pEnabledFeatures)) {
    return VK_ERROR_FEATURE_NOT_PRESENT;
  }
  const auto* features2 =
      find_in_chain<VkPhysicalDeviceFeatures2>(info.pNext, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
  if (features2 != nullptr && !features_offered(features2->features)) return VK_ERROR_FEATURE_NOT_PRESENT;
  return VK_SUCCESS;
}

VkResult check_queues(const VkDeviceCreateInfo& info) {
  for (uint32_t i = 0; i < info.queueCreateInfoCount; ++i) {
    const VkDeviceQueueCreateInfo& queue = info.pQueueCreateInfos[i];
    if (queue.queueFamilyIndex == 0 && queue.queueCount <= 1) continue;
    log_error("vkCreateDevice: there is one queue in family 0 and no other");
    return VK_ERROR_INITIALIZATION_FAILED;
  }
  return VK_SUCCESS;
}

}  // namespace

Device::Device(const HostMemory& memory, PhysicalDevice& physical)
    : Handle(memory),
      DeviceContext(host, physical),
      pool(physical.environment.threads, physical.environment.spin),
      queue(make_object<Queue>(host, VK_SYSTEM_ALLOCATION_SCOPE_DEVICE, *this, pool)) {}

VkResult create_device(PhysicalDevice& physical, const VkDeviceCreateInfo& info, const VkAllocationCallbacks* callbacks,
                       VkDevice* handle) {
  if (const VkResult bad = check_features(info); bad != VK_SUCCESS) return bad;
  if (const VkResult bad = check_queues(info); bad != VK_SUCCESS) return bad;
  ExtensionSet extensions;
  for (uint32_t i = 0; i < info.enabledExtensionCount; ++i) {
    if (extensions.enable(info.ppEnabledExtensionNames[i], ExtensionLevel::device)) continue;
    log_error("device extension %s is not supported", info.ppEnabledExtensionNames[i]);
    return VK_ERROR_EXTENSION_NOT_PRESENT;
  }
  const HostMemory host(callbacks, physical.instance.host);
  auto device = make_object<Device>(host, VK_SYSTEM_ALLOCATION_SCOPE_DEVICE, physical);
  device->extensions = extensions;
  return publish(std::move(device), handle);
}

VkQueue get_queue(Device& device, uint32_t family, uint32_t index) {
  return family == 0 && index == 0 ? device.queue->handle() : nullptr;
}

}  // namespace lapilli
