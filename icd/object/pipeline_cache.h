// VkPipelineCache: pipelines are made in well under a millisecond, so that a cache holds nothing but its header.
// Specification: chapter "Pipelines", section "Pipeline Cache".
#pragma once

#include "object/device_context.h"

namespace lapilli {

struct PipelineCache : Handle<PipelineCache, VkPipelineCache> {
  using Handle::Handle;
};

VkResult create_pipeline_cache(DeviceContext& device, const VkAllocationCallbacks* callbacks, VkPipelineCache* handle);
VkResult pipeline_cache_data(const DeviceContext& device, size_t* size, void* data);

}  // namespace lapilli
