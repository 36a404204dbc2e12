// Creation and destruction of instances.
#include "object/instance.h"

#include "object/enumerate.h"
#include "object/environment.h"
#include "object/structure_chain.h"

namespace lapilli {

Instance::Instance(const HostMemory& memory, const VkInstanceCreateInfo& info)
    : Handle(memory),
      messengers(host),
      physical_device(host, *this, read_environment()),
      messengers_at_end(HostAllocator<VkDebugUtilsMessengerCreateInfoEXT>(host, VK_SYSTEM_ALLOCATION_SCOPE_INSTANCE)) {
  for (const void* at = info.pNext; at != nullptr;) {
    const auto* found =
        find_in_chain<VkDebugUtilsMessengerCreateInfoEXT>(at, VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
    if (found == nullptr) break;
    messengers_at_end.push_back(*found);
    at = found->pNext;
  }
  for (VkDebugUtilsMessengerCreateInfoEXT& listener : messengers_at_end) {
    const bool last = &listener == &messengers_at_end.back();
    listener.pNext = last ? nullptr : &listener + 1;
  }
}

VkResult create_instance(const VkInstanceCreateInfo& info, const VkAllocationCallbacks* callbacks, VkInstance* handle) {
  const HostMemory host(callbacks, HostMemory());
  const TemporaryMessengers listening(host, info.pNext);
  if (info.enabledLayerCount != 0) {
    log_error("layer %s: the driver has no layers", info.ppEnabledLayerNames[0]);
    return VK_ERROR_LAYER_NOT_PRESENT;
  }
  const VkApplicationInfo* application = info.pApplicationInfo;
  const uint32_t version = application != nullptr ? application->apiVersion : 0;
  if (VK_API_VERSION_MAJOR(version) > 1 || VK_API_VERSION_MINOR(version) > 0) {
    // What a driver of Vulkan 1.0 has to answer; the loader asks for 1.0 on the application's behalf.
    log_error("Vulkan %u.%u is not supported, only 1.0", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version));
    return VK_ERROR_INCOMPATIBLE_DRIVER;
  }
  auto instance = make_object<Instance>(host, VK_SYSTEM_ALLOCATION_SCOPE_INSTANCE, info);
  for (uint32_t i = 0; i < info.enabledExtensionCount; ++i) {
    if (instance->extensions.enable(info.ppEnabledExtensionNames[i], ExtensionLevel::instance)) continue;
    log_error("instance extension %s is not supported", info.ppEnabledExtensionNames[i]);
    return VK_ERROR_EXTENSION_NOT_PRESENT;
  }
  return publish(std::move(instance), handle);
}

void destroy_instance(Instance* instance) {
  if (instance == nullptr) return;
  const TemporaryMessengers listening(
      instance->host, instance->messengers_at_end.empty() ? nullptr : instance->messengers_at_end.data());
  destroy(instance);
}

VkResult enumerate_physical_devices(Instance& instance, uint32_t* count, VkPhysicalDevice* handles) {
  PhysicalDevice* const devices[] = {&instance.physical_device};
  return enumerate(std::span<PhysicalDevice* const>(devices), count, handles,
                   [](VkPhysicalDevice& handle, PhysicalDevice* device) { handle = device->handle(); });
}

}  // namespace lapilli
