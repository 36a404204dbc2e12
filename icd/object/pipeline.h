// VkPipeline: the programs and the state that goes with them. Specification: chapter "Pipelines".
#pragma once

#include <array>

#include "object/descriptor_layout.h"
#include "object/render_pass.h"
#include "object/shader_module.h"

namespace lapilli {

// What vkCmdSet… changes and a pipeline may fix.
struct DynamicState {
  VkViewport viewport = {};
  VkRect2D scissor = {};
  float line_width = 1;
  float depth_bias_constant = 0, depth_bias_clamp = 0, depth_bias_slope = 0;
  float blend_constants[4] = {};
};
// Members of DynamicState, as bits.
enum DynamicStateBit : uint32_t {
  kDynamicViewport = 1,
  kDynamicScissor = 2,
  kDynamicLineWidth = 4,
  kDynamicDepthBias = 8,
  kDynamicBlendConstants = 16,
};

struct VertexInputBinding {
  uint32_t stride = 0;  // bytes
  bool per_instance = false;
};

// What only graphics pipelines have. In words of the specification; queue/ makes a RasterState of it.
struct GraphicsPart {
  GraphicsPrograms programs;
  VertexInputBinding bindings[kMaxVertexBindings];
  uint32_t binding_count = 0;  // above the last that is described or that an attribute names
  VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  bool primitive_restart = false;
  bool rasterizer_discard = false;
  bool depth_bias = false;
  VkCullModeFlags cull_mode = VK_CULL_MODE_NONE;
  VkFrontFace front_face = VK_FRONT_FACE_COUNTER_CLOCKWISE;
  // Attachments that the programs write; VK_FORMAT_UNDEFINED: none. A subpass with others is not drawn to.
  std::array<VkFormat, kMaxColorAttachments> color_formats = {};
  VkFormat depth_format = VK_FORMAT_UNDEFINED;
  DynamicState fixed;
  uint32_t dynamic = 0;  // DynamicStateBit: taken from the command buffer instead of `fixed`
};

// What binding resources needs to know of a pipeline's layout, copied from it.
struct PipelineResources {
  uint32_t set_count = 0;
  uint32_t descriptor_count[kMaxDescriptorSets] = {};  // a bound set with fewer is not used
  uint32_t dynamic_count[kMaxDescriptorSets] = {};
  uint32_t first_dynamic[kMaxDescriptorSets] = {};
  uint32_t dynamic_total = 0;
};

struct Pipeline : Handle<Pipeline, VkPipeline> {
  using Handle::Handle;

  VkPipelineBindPoint bind_point = VK_PIPELINE_BIND_POINT_GRAPHICS;
  PipelineResources resources;
  GraphicsPart graphics;
  ProgramPtr compute;
};

// On an error every pipeline that could be made is made; the handles of the others are null.
VkResult create_graphics_pipelines(DeviceContext& device, std::span<const VkGraphicsPipelineCreateInfo> infos,
                                   const VkAllocationCallbacks* callbacks, VkPipeline* handles);
VkResult create_compute_pipelines(DeviceContext& device, std::span<const VkComputePipelineCreateInfo> infos,
                                  const VkAllocationCallbacks* callbacks, VkPipeline* handles);

// Shared by both kinds. The entries live as long as the result.
struct StageInfo {
  StageInfo(const VkPipelineShaderStageCreateInfo& info);
  std::vector<SpecializationEntry> entries;
  ShaderStage stage;
};
PipelineResources resources_of(const PipelineLayout& layout);

}  // namespace lapilli
