// Shader modules: SPIR-V is parsed and checked once, here.
#include "object/shader_module.h"

namespace lapilli {

VkResult create_shader_module(DeviceContext& device, const VkShaderModuleCreateInfo& info,
                              const VkAllocationCallbacks* callbacks, VkShaderModule* handle) {
  if (info.codeSize % 4 != 0) {
    log_error("vkCreateShaderModule: %zu bytes are no whole number of words", info.codeSize);
    return VK_ERROR_UNKNOWN;
  }
  auto spirv = parse_spirv({info.pCode, info.codeSize / 4});
  if (!spirv) {
    log_error("vkCreateShaderModule: %s", spirv.error().message.c_str());
    return spirv.error().code;
  }
  auto module = make_object<ShaderModule>(device.object_memory(callbacks), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  module->spirv = std::move(*spirv);
  return publish(std::move(module), handle);
}

}  // namespace lapilli
