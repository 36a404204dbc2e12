// VkShaderModule. Specification: chapter "Shaders".
#pragma once

#include <memory>

#include "object/device_context.h"
#include "shader/stage.h"

namespace lapilli {

struct ShaderModule : Handle<ShaderModule, VkShaderModule> {
  using Handle::Handle;

  std::shared_ptr<const SpirvModule> spirv;
};

VkResult create_shader_module(DeviceContext& device, const VkShaderModuleCreateInfo& info,
                              const VkAllocationCallbacks* callbacks, VkShaderModule* handle);

}  // namespace lapilli
