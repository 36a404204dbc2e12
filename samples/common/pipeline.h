// Graphics and compute pipelines from what differs between the samples. Specification: Pipelines.
#pragma once

#include <span>

#include "common/context.h"

namespace lapilli::samples {

struct VertexLayout {
  uint32_t stride = 0;  // bytes; one binding, number 0, or none without attributes
  std::span<const VkVertexInputAttributeDescription> attributes;
};

// Triangle list over the whole extent, counter-clockwise front faces.
struct GraphicsPipelineInfo {
  std::span<const uint32_t> vertex_shader;
  std::span<const uint32_t> fragment_shader;  // none: depth alone is written
  const VkSpecializationInfo* fragment_constants = nullptr;
  VertexLayout vertices;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkRenderPass render_pass = VK_NULL_HANDLE;
  VkExtent2D extent = {};
  bool cull_back_faces = false;
  bool depth_test = false;  // VK_COMPARE_OP_LESS, with writes
  bool blend = false;       // source alpha over destination
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
};

ShaderModule create_shader_module(const Context& context, std::span<const uint32_t> code);
PipelineLayout create_pipeline_layout(const Context& context, std::span<const VkDescriptorSetLayout> sets,
                                      std::span<const VkPushConstantRange> push_constants = {});
Pipeline create_graphics_pipeline(const Context& context, const GraphicsPipelineInfo& info);
Pipeline create_compute_pipeline(const Context& context, std::span<const uint32_t> shader, VkPipelineLayout layout);

}  // namespace lapilli::samples
