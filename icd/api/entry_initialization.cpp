// Entry points of chapters "Initialization", "Devices and Queues" (physical devices) and "Layers and Extensions".
#include "api/command_table.h"
#include "api/entry.h"
#include "object/enumerate.h"
#include "object/instance.h"

namespace lapilli::entry {

VKAPI_ATTR VkResult VKAPI_CALL vkCreateInstance(const VkInstanceCreateInfo* info,
                                                const VkAllocationCallbacks* callbacks, VkInstance* instance) {
  return create_instance(*info, callbacks, instance);
}

VKAPI_ATTR void VKAPI_CALL vkDestroyInstance(VkInstance instance, const VkAllocationCallbacks*) {
  destroy_instance(Instance::from(instance));
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vkGetInstanceProcAddr(VkInstance instance, const char* name) {
  return instance_command(Instance::from(instance), name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vkGetDeviceProcAddr(VkDevice device, const char* name) {
  return device_command(*Device::from(device), name);
}

VKAPI_ATTR VkResult VKAPI_CALL vkEnumerateInstanceExtensionProperties(const char* layer, uint32_t* count,
                                                                      VkExtensionProperties* properties) {
  return enumerate_extensions(ExtensionLevel::instance, layer, count, properties);
}

VKAPI_ATTR VkResult VKAPI_CALL vkEnumerateDeviceExtensionProperties(VkPhysicalDevice, const char* layer,
                                                                    uint32_t* count,
                                                                    VkExtensionProperties* properties) {
  return enumerate_extensions(ExtensionLevel::device, layer, count, properties);
}

VKAPI_ATTR VkResult VKAPI_CALL vkEnumerateInstanceLayerProperties(uint32_t* count, VkLayerProperties* properties) {
  return enumerate(std::span<const VkLayerProperties>(), count, properties);
}

VKAPI_ATTR VkResult VKAPI_CALL vkEnumerateDeviceLayerProperties(VkPhysicalDevice, uint32_t* count,
                                                                VkLayerProperties* properties) {
  return enumerate(std::span<const VkLayerProperties>(), count, properties);
}

VKAPI_ATTR VkResult VKAPI_CALL vkEnumeratePhysicalDevices(VkInstance instance, uint32_t* count,
                                                          VkPhysicalDevice* devices) {
  return enumerate_physical_devices(*Instance::from(instance), count, devices);
}

}  // namespace lapilli::entry
