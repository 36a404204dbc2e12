// Samplers.
#include "object/sampler.h"

namespace lapilli {

VkResult create_sampler(DeviceContext& device, const VkSamplerCreateInfo& info, const VkAllocationCallbacks* callbacks,
                        VkSampler* handle) {
  Result<SamplerState> state = make_sampler(info);
  if (!state) {
    log_error("vkCreateSampler: %s", state.error().message.c_str());
    return state.error().code;
  }
  auto sampler = make_object<Sampler>(device.object_memory(callbacks), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  sampler->state = *state;
  return publish(std::move(sampler), handle);
}

}  // namespace lapilli
