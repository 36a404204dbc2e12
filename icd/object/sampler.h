// VkSampler. Specification: chapter "Samplers".
#pragma once

#include "image/texture.h"
#include "object/device_context.h"

namespace lapilli {

struct Sampler : Handle<Sampler, VkSampler> {
  using Handle::Handle;

  SamplerState state;
};

VkResult create_sampler(DeviceContext& device, const VkSamplerCreateInfo& info, const VkAllocationCallbacks* callbacks,
                        VkSampler* handle);

}  // namespace lapilli
