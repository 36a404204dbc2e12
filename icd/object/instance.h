// VkInstance: where an application begins. Specification: chapter "Initialization".
#pragma once

#include "object/debug_utils.h"
#include "object/extensions.h"
#include "object/handle.h"
#include "object/physical_device.h"

namespace lapilli {

struct Instance : Handle<Instance, VkInstance> {
  Instance(const HostMemory& memory, const VkInstanceCreateInfo& info);

  ExtensionSet extensions;
  MessengerList messengers;
  PhysicalDevice physical_device;  // the only one
  // The structures of VkInstanceCreateInfo::pNext that listen again in vkDestroyInstance.
  HostVector<VkDebugUtilsMessengerCreateInfoEXT> messengers_at_end;
};

VkResult create_instance(const VkInstanceCreateInfo& info, const VkAllocationCallbacks* callbacks, VkInstance* handle);
void destroy_instance(Instance* instance);
VkResult enumerate_physical_devices(Instance& instance, uint32_t* count, VkPhysicalDevice* handles);

}  // namespace lapilli
