// A driver that does nothing: what an instance and a device cost at the least with this loader. One physical device
// that offers nothing, a device, its queue, and the pool and fence that the measuring program makes with them.
#include <vulkan/vk_icd.h>

#include <cstring>

namespace {

// Dispatchable handles start with a word that the loader overwrites.
VK_LOADER_DATA instance_object, physical_device_object, device_object, queue_object;

template <typename Handle>
Handle handle_of(VK_LOADER_DATA& object) {
  set_loader_magic_value(&object);
  return reinterpret_cast<Handle>(&object);
}

VkResult create_instance(const VkInstanceCreateInfo*, const VkAllocationCallbacks*, VkInstance* instance) {
  *instance = handle_of<VkInstance>(instance_object);
  return VK_SUCCESS;
}
void destroy_instance(VkInstance, const VkAllocationCallbacks*) {}

// No layers, no extensions.
VkResult no_instance_extensions(const char*, uint32_t* count, VkExtensionProperties*) {
  *count = 0;
  return VK_SUCCESS;
}
VkResult no_device_extensions(VkPhysicalDevice, const char*, uint32_t* count, VkExtensionProperties*) {
  *count = 0;
  return VK_SUCCESS;
}

VkResult enumerate_physical_devices(VkInstance, uint32_t* count, VkPhysicalDevice* devices) {
  if (devices != nullptr && *count > 0) devices[0] = handle_of<VkPhysicalDevice>(physical_device_object);
  *count = 1;
  return VK_SUCCESS;
}
void get_properties(VkPhysicalDevice, VkPhysicalDeviceProperties* properties) {
  *properties = {};
  properties->apiVersion = VK_API_VERSION_1_0;
  properties->deviceType = VK_PHYSICAL_DEVICE_TYPE_CPU;
  std::strcpy(properties->deviceName, "nothing");
}
void get_features(VkPhysicalDevice, VkPhysicalDeviceFeatures* features) { *features = {}; }
void get_format_properties(VkPhysicalDevice, VkFormat, VkFormatProperties* properties) { *properties = {}; }
VkResult get_image_format_properties(VkPhysicalDevice, VkFormat, VkImageType, VkImageTiling, VkImageUsageFlags,
                                     VkImageCreateFlags, VkImageFormatProperties*) {
  return VK_ERROR_FORMAT_NOT_SUPPORTED;
}
void get_sparse_format_properties(VkPhysicalDevice, VkFormat, VkImageType, VkSampleCountFlagBits, VkImageUsageFlags,
                                  VkImageTiling, uint32_t* count, VkSparseImageFormatProperties*) {
  *count = 0;
}
void get_queue_families(VkPhysicalDevice, uint32_t* count, VkQueueFamilyProperties* families) {
  if (families != nullptr && *count > 0) {
    families[0] = {VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT | VK_QUEUE_TRANSFER_BIT, 1, 0, {1, 1, 1}};
  }
  *count = 1;
}
void get_memory_properties(VkPhysicalDevice, VkPhysicalDeviceMemoryProperties* properties) { *properties = {}; }

VkResult create_device(VkPhysicalDevice, const VkDeviceCreateInfo*, const VkAllocationCallbacks*, VkDevice* device) {
  *device = handle_of<VkDevice>(device_object);
  return VK_SUCCESS;
}
void destroy_device(VkDevice, const VkAllocationCallbacks*) {}
void get_device_queue(VkDevice, uint32_t, uint32_t, VkQueue* queue) { *queue = handle_of<VkQueue>(queue_object); }

VkResult create_command_pool(VkDevice, const VkCommandPoolCreateInfo*, const VkAllocationCallbacks*,
                             VkCommandPool* pool) {
  *pool = VK_NULL_HANDLE;
  return VK_SUCCESS;
}
void destroy_command_pool(VkDevice, VkCommandPool, const VkAllocationCallbacks*) {}
VkResult create_fence(VkDevice, const VkFenceCreateInfo*, const VkAllocationCallbacks*, VkFence* fence) {
  *fence = VK_NULL_HANDLE;
  return VK_SUCCESS;
}
void destroy_fence(VkDevice, VkFence, const VkAllocationCallbacks*) {}

struct EntryPoint {
  const char* name;
  PFN_vkVoidFunction function;
};
template <typename Function>
PFN_vkVoidFunction erased(Function* function) {
  return reinterpret_cast<PFN_vkVoidFunction>(function);
}

PFN_vkVoidFunction find(const char* name);
PFN_vkVoidFunction get_device_proc_addr(VkDevice, const char* name) { return find(name); }

PFN_vkVoidFunction find(const char* name) {
  static const EntryPoint kEntryPoints[] = {
      {"vkCreateInstance", erased(create_instance)},
      {"vkDestroyInstance", erased(destroy_instance)},
      {"vkEnumerateInstanceExtensionProperties", erased(no_instance_extensions)},
      {"vkEnumerateDeviceExtensionProperties", erased(no_device_extensions)},
      {"vkEnumeratePhysicalDevices", erased(enumerate_physical_devices)},
      {"vkGetPhysicalDeviceProperties", erased(get_properties)},
      {"vkGetPhysicalDeviceFeatures", erased(get_features)},
      {"vkGetPhysicalDeviceFormatProperties", erased(get_format_properties)},
      {"vkGetPhysicalDeviceImageFormatProperties", erased(get_image_format_properties)},
      {"vkGetPhysicalDeviceSparseImageFormatProperties", erased(get_sparse_format_properties)},
      {"vkGetPhysicalDeviceQueueFamilyProperties", erased(get_queue_families)},
      {"vkGetPhysicalDeviceMemoryProperties", erased(get_memory_properties)},
      {"vkGetDeviceProcAddr", erased(get_device_proc_addr)},
      {"vkCreateDevice", erased(create_device)},
      {"vkDestroyDevice", erased(destroy_device)},
      {"vkGetDeviceQueue", erased(get_device_queue)},
      {"vkCreateCommandPool", erased(create_command_pool)},
      {"vkDestroyCommandPool", erased(destroy_command_pool)},
      {"vkCreateFence", erased(create_fence)},
      {"vkDestroyFence", erased(destroy_fence)},
  };
  for (const EntryPoint& entry : kEntryPoints) {
    if (std::strcmp(entry.name, name) == 0) return entry.function;
  }
  return nullptr;
}

}  // namespace

#define LAPILLI_EXPORT extern "C" __attribute__((visibility("default")))

LAPILLI_EXPORT VkResult vk_icdNegotiateLoaderICDInterfaceVersion(uint32_t* version) {
  *version = *version < 5 ? *version : 5;
  return VK_SUCCESS;
}
LAPILLI_EXPORT PFN_vkVoidFunction vk_icdGetInstanceProcAddr(VkInstance, const char* name) { return find(name); }
