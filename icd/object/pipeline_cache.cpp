// The header of a pipeline cache.
#include "object/pipeline_cache.h"

#include <cstring>

namespace lapilli {

VkResult create_pipeline_cache(DeviceContext& device, const VkAllocationCallbacks* callbacks, VkPipelineCache* handle) {
  return publish(make_object<PipelineCache>(device.object_memory(callbacks), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT),
                 handle);
}

VkResult pipeline_cache_data(const DeviceContext& device, size_t* size, void* data) {
  const VkPhysicalDeviceProperties properties = device_properties(device.physical_device);
  VkPipelineCacheHeaderVersionOne header = {};
  header.headerSize = sizeof(header);
  header.headerVersion = VK_PIPELINE_CACHE_HEADER_VERSION_ONE;
  header.vendorID = properties.vendorID;
  header.deviceID = properties.deviceID;
  std::memcpy(header.pipelineCacheUUID, properties.pipelineCacheUUID, VK_UUID_SIZE);
  if (data == nullptr) {
    *size = sizeof(header);
    return VK_SUCCESS;
  }
  if (*size < sizeof(header)) {
    *size = 0;
    return VK_INCOMPLETE;
  }
  std::memcpy(data, &header, sizeof(header));
  *size = sizeof(header);
  return VK_SUCCESS;
}

}  // namespace lapilli
