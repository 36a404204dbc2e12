// Instance, device and queue of the samples. Specification: Initialization; Devices and Queues.
#include "common/context.h"

#include <algorithm>
#include <cstring>

namespace lapilli::samples {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

bool layer_installed(const char* name) {
  uint32_t count = 0;
  check(vkEnumerateInstanceLayerProperties(&count, nullptr), "vkEnumerateInstanceLayerProperties");
  std::vector<VkLayerProperties> layers(count);
  check(vkEnumerateInstanceLayerProperties(&count, layers.data()), "vkEnumerateInstanceLayerProperties");
  return std::any_of(layers.begin(), layers.end(),
                     [&](const VkLayerProperties& layer) { return std::strcmp(layer.layerName, name) == 0; });
}

bool extension_offered(const char* layer, const char* name) {
  uint32_t count = 0;
  check(vkEnumerateInstanceExtensionProperties(layer, &count, nullptr), "vkEnumerateInstanceExtensionProperties");
  std::vector<VkExtensionProperties> extensions(count);
  check(vkEnumerateInstanceExtensionProperties(layer, &count, extensions.data()),
        "vkEnumerateInstanceExtensionProperties");
  return std::any_of(extensions.begin(), extensions.end(), [&](const VkExtensionProperties& extension) {
    return std::strcmp(extension.extensionName, name) == 0;
  });
}

VkBool32 VKAPI_PTR collect_message(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                   const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  static_cast<std::vector<std::string>*>(user)->emplace_back(data->pMessage);
  return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(std::vector<std::string>* messages) {
  VkDebugUtilsMessengerCreateInfoEXT info = {};
  info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
  info.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  // Not the general kind: the loader uses it to talk about manifests.
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  info.pfnUserCallback = collect_message;
  info.pUserData = messages;
  return info;
}

std::vector<VkPhysicalDevice> physical_devices(VkInstance instance) {
  uint32_t count = 0;
  check(vkEnumeratePhysicalDevices(instance, &count, nullptr), "vkEnumeratePhysicalDevices");
  std::vector<VkPhysicalDevice> devices(count);
  check(vkEnumeratePhysicalDevices(instance, &count, devices.data()), "vkEnumeratePhysicalDevices");
  return devices;
}

VkApplicationInfo application_info() {
  VkApplicationInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  info.pApplicationName = "lapilli samples";
  info.apiVersion = VK_API_VERSION_1_0;
  return info;
}

}  // namespace

Context::Context(const ContextOptions& options) {
  create_instance(options);
  choose_physical_device(options.device_name);
  create_device();
}

Context::~Context() {
  if (device_ != VK_NULL_HANDLE) {
    fence_ = {};
    pool_ = {};
    vkDestroyDevice(device_, nullptr);
  }
  if (messenger_ != VK_NULL_HANDLE) {
    auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
    destroy(instance_, messenger_, nullptr);
  }
  if (instance_ != VK_NULL_HANDLE) vkDestroyInstance(instance_, nullptr);
}

void Context::create_instance(const ContextOptions& options) {
  std::vector<const char*> layers;
  std::vector<const char*> extensions;
  validation_active_ = options.validation && layer_installed(kValidationLayer);
  if (validation_active_) layers.push_back(kValidationLayer);
  const bool listens = (options.messages || validation_active_) &&
                       (extension_offered(nullptr, VK_EXT_DEBUG_UTILS_EXTENSION_NAME) ||
                        (validation_active_ && extension_offered(kValidationLayer, VK_EXT_DEBUG_UTILS_EXTENSION_NAME)));
  if (listens) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);

  const VkApplicationInfo application = application_info();
  const VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_info(&messages_);
  VkInstanceCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pNext = listens ? &messenger : nullptr;  // hears vkCreateInstance and vkDestroyInstance too
  info.pApplicationInfo = &application;
  info.enabledLayerCount = static_cast<uint32_t>(layers.size());
  info.ppEnabledLayerNames = layers.data();
  info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  check(vkCreateInstance(&info, nullptr, &instance_), "vkCreateInstance");

  if (listens) {
    auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
    check(create(instance_, &messenger, nullptr, &messenger_), "vkCreateDebugUtilsMessengerEXT");
  }
}

void Context::choose_physical_device(std::string_view name) {
  for (VkPhysicalDevice candidate : physical_devices(instance_)) {
    vkGetPhysicalDeviceProperties(candidate, &properties_);
    if (std::string_view(properties_.deviceName).find(name) == std::string_view::npos) continue;
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(candidate, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(candidate, &count, families.data());
    constexpr VkQueueFlags kNeeded = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    for (uint32_t family = 0; family < count; ++family) {
      if ((families[family].queueFlags & kNeeded) != kNeeded) continue;
      physical_device_ = candidate;
      queue_family_ = family;
      vkGetPhysicalDeviceMemoryProperties(candidate, &memory_);
      return;
    }
  }
  throw std::runtime_error("no Vulkan device with graphics and compute whose name contains '" + std::string(name) +
                           "'");
}

void Context::create_device() {
  const float priority = 1.0f;
  VkDeviceQueueCreateInfo queue = {};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueFamilyIndex = queue_family_;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkDeviceCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  VkPhysicalDeviceFeatures features = {}, offered;
  vkGetPhysicalDeviceFeatures(physical_device_, &offered);
  features.fragmentStoresAndAtomics = offered.fragmentStoresAndAtomics;
  features.vertexPipelineStoresAndAtomics = offered.vertexPipelineStoresAndAtomics;
  features.drawIndirectFirstInstance = offered.drawIndirectFirstInstance;
  features.multiDrawIndirect = offered.multiDrawIndirect;
  features.sampleRateShading = offered.sampleRateShading;
  features.shaderClipDistance = offered.shaderClipDistance;
  features.shaderCullDistance = offered.shaderCullDistance;
  info.pEnabledFeatures = &features;
  std::vector<const char*> extensions;
  uint32_t count = 0;
  vkEnumerateDeviceExtensionProperties(physical_device_, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> available(count);
  vkEnumerateDeviceExtensionProperties(physical_device_, nullptr, &count, available.data());
  for (const VkExtensionProperties& each : available) {
    if (std::string_view(each.extensionName) == VK_KHR_SHADER_DRAW_PARAMETERS_EXTENSION_NAME)
      extensions.push_back(VK_KHR_SHADER_DRAW_PARAMETERS_EXTENSION_NAME);
  }
  info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  check(vkCreateDevice(physical_device_, &info, nullptr, &device_), "vkCreateDevice");
  vkGetDeviceQueue(device_, queue_family_, 0, &queue_);

  VkCommandPoolCreateInfo pool = {};
  pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
  pool.queueFamilyIndex = queue_family_;
  VkCommandPool raw_pool = VK_NULL_HANDLE;
  check(vkCreateCommandPool(device_, &pool, nullptr, &raw_pool), "vkCreateCommandPool");
  pool_ = CommandPool(device_, raw_pool);

  VkFenceCreateInfo fence = {};
  fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  VkFence raw_fence = VK_NULL_HANDLE;
  check(vkCreateFence(device_, &fence, nullptr, &raw_fence), "vkCreateFence");
  fence_ = Fence(device_, raw_fence);
}

uint32_t Context::memory_type(uint32_t type_bits, VkMemoryPropertyFlags flags) const {
  for (uint32_t type = 0; type < memory_.memoryTypeCount; ++type) {
    if ((type_bits >> type & 1u) != 0 && (memory_.memoryTypes[type].propertyFlags & flags) == flags) return type;
  }
  throw std::runtime_error("no memory type with the properties asked for");
}

VkCommandBuffer Context::begin_commands() const {
  VkCommandBufferAllocateInfo allocate = {};
  allocate.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  allocate.commandPool = pool_.get();
  allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  allocate.commandBufferCount = 1;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  check(vkAllocateCommandBuffers(device_, &allocate, &commands), "vkAllocateCommandBuffers");

  VkCommandBufferBeginInfo begin = {};
  begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
  return commands;
}

void Context::submit_and_wait(VkCommandBuffer commands) const {
  check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
  VkSubmitInfo submit = {};
  submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands;
  check(vkQueueSubmit(queue_, 1, &submit, fence_.get()), "vkQueueSubmit");
  check(vkWaitForFences(device_, 1, fence_.address(), VK_TRUE, UINT64_MAX), "vkWaitForFences");
  check(vkResetFences(device_, 1, fence_.address()), "vkResetFences");
  vkFreeCommandBuffers(device_, pool_.get(), 1, &commands);
}

std::vector<std::string> device_names() {
  const VkApplicationInfo application = application_info();
  VkInstanceCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pApplicationInfo = &application;
  VkInstance instance = VK_NULL_HANDLE;
  check(vkCreateInstance(&info, nullptr, &instance), "vkCreateInstance");
  std::vector<std::string> names;
  for (VkPhysicalDevice device : physical_devices(instance)) {
    VkPhysicalDeviceProperties properties = {};
    vkGetPhysicalDeviceProperties(device, &properties);
    names.emplace_back(properties.deviceName);
  }
  vkDestroyInstance(instance, nullptr);
  return names;
}

}  // namespace lapilli::samples
