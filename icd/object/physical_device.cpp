// Properties, features, queue families and memory of the one physical device.
#include "object/physical_device.h"

#include <sys/sysinfo.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "base/simd_dispatch.h"
#include "object/limits.h"

namespace lapilli {
namespace {

constexpr uint32_t kDriverVersion = VK_MAKE_API_VERSION(0, 0, 1, 0);
// Not a PCI device and not registered with Khronos; the mark says "none" in a way that nothing else uses.
constexpr uint32_t kVendorId = 0x1A9111;
constexpr uint32_t kDeviceId = 1;

// Three quarters of the machine's memory: what is left keeps the machine alive.
uint64_t choose_heap_size() {
  struct sysinfo info = {};
  if (sysinfo(&info) != 0) return uint64_t{1} << 30;
  const uint64_t total = static_cast<uint64_t>(info.totalram) * info.mem_unit;
  return total / 4 * 3;
}

const char* simd_display_name() {
  switch (simd_target()) {
    case SimdTarget::kAvx3:
      return "AVX-512";
    case SimdTarget::kAvx2:
      return "AVX2";
    case SimdTarget::kBaseline:
      break;
  }
#if defined(__aarch64__)
  return "NEON";
#else
  return "SSE2";
#endif
}

}  // namespace

PhysicalDevice::PhysicalDevice(const HostMemory& memory, Instance& owner, const Environment& settings)
    : Handle(memory), instance(owner), environment(settings), heap_size(choose_heap_size()) {}

VkPhysicalDeviceProperties device_properties(const PhysicalDevice& device) {
  VkPhysicalDeviceProperties properties = {};
  properties.apiVersion = VK_MAKE_API_VERSION(0, 1, 0, VK_HEADER_VERSION);
  properties.driverVersion = kDriverVersion;
  properties.vendorID = kVendorId;
  properties.deviceID = kDeviceId;
  properties.deviceType = VK_PHYSICAL_DEVICE_TYPE_CPU;
  const unsigned threads = device.environment.threads;
  std::snprintf(properties.deviceName, sizeof(properties.deviceName), "Lapilli (%u thread%s, %s)", threads,
                threads == 1 ? "" : "s", simd_display_name());
  write_uuid(properties.pipelineCacheUUID);
  properties.limits = device_limits();
  return properties;
}

VkPhysicalDeviceFeatures device_features() {
  VkPhysicalDeviceFeatures features = {};
  features.robustBufferAccess = VK_TRUE;
  features.multiDrawIndirect = VK_TRUE;
  features.drawIndirectFirstInstance = VK_TRUE;
  features.vertexPipelineStoresAndAtomics = VK_TRUE;
  features.fragmentStoresAndAtomics = VK_TRUE;
  features.sampleRateShading = VK_TRUE;
  features.shaderClipDistance = VK_TRUE;
  features.shaderCullDistance = VK_TRUE;
  features.shaderImageGatherExtended = VK_TRUE;
  features.shaderStorageImageExtendedFormats = VK_TRUE;
  features.shaderStorageImageReadWithoutFormat = VK_TRUE;
  features.shaderStorageImageWriteWithoutFormat = VK_TRUE;
  features.shaderUniformBufferArrayDynamicIndexing = VK_TRUE;
  features.shaderSampledImageArrayDynamicIndexing = VK_TRUE;
  features.shaderStorageBufferArrayDynamicIndexing = VK_TRUE;
  features.shaderStorageImageArrayDynamicIndexing = VK_TRUE;
  return features;
}

VkQueueFamilyProperties queue_family_properties() {
  VkQueueFamilyProperties family = {};
  family.queueFlags = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT | VK_QUEUE_TRANSFER_BIT;
  family.queueCount = 1;
  family.timestampValidBits = 64;
  family.minImageTransferGranularity = {1, 1, 1};
  return family;
}

VkPhysicalDeviceMemoryProperties memory_properties(const PhysicalDevice& device) {
  VkPhysicalDeviceMemoryProperties properties = {};
  properties.memoryHeapCount = 1;
  properties.memoryHeaps[0] = {device.heap_size, VK_MEMORY_HEAP_DEVICE_LOCAL_BIT};
  properties.memoryTypeCount = 1;
  properties.memoryTypes[0].heapIndex = 0;
  properties.memoryTypes[0].propertyFlags = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                                            VK_MEMORY_PROPERTY_HOST_COHERENT_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
  return properties;
}

void write_uuid(uint8_t (&uuid)[VK_UUID_SIZE]) {
  char text[VK_UUID_SIZE + 1];
  std::snprintf(text, sizeof(text), "lapilli %08x", kDriverVersion);
  std::memcpy(uuid, text, VK_UUID_SIZE);
}

}  // namespace lapilli
