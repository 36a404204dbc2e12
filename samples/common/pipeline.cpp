// Pipeline creation for the samples. Specification: Pipelines; Rasterization; Fragment Operations; The Framebuffer.
#include "common/pipeline.h"

#include <array>

namespace lapilli::samples {
namespace {

VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits kind, const ShaderModule& module) {
  VkPipelineShaderStageCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage = kind;
  info.module = module.get();
  info.pName = "main";
  return info;
}

VkPipelineRasterizationStateCreateInfo rasterization(bool cull_back_faces) {
  VkPipelineRasterizationStateCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
  info.polygonMode = VK_POLYGON_MODE_FILL;
  info.cullMode = cull_back_faces ? VK_CULL_MODE_BACK_BIT : VK_CULL_MODE_NONE;
  info.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
  info.lineWidth = 1.0f;
  return info;
}

VkPipelineDepthStencilStateCreateInfo depth_stencil(bool depth_test) {
  VkPipelineDepthStencilStateCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
  info.depthTestEnable = depth_test ? VK_TRUE : VK_FALSE;
  info.depthWriteEnable = info.depthTestEnable;
  info.depthCompareOp = VK_COMPARE_OP_LESS;
  return info;
}

VkPipelineColorBlendAttachmentState blend_state(bool blend) {
  VkPipelineColorBlendAttachmentState state = {};
  state.blendEnable = blend ? VK_TRUE : VK_FALSE;
  state.srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
  state.dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
  state.colorBlendOp = VK_BLEND_OP_ADD;
  state.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
  state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
  state.alphaBlendOp = VK_BLEND_OP_ADD;
  state.colorWriteMask =
      VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
  return state;
}

}  // namespace

ShaderModule create_shader_module(const Context& context, std::span<const uint32_t> code) {
  VkShaderModuleCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  info.codeSize = code.size_bytes();
  info.pCode = code.data();
  VkShaderModule module = VK_NULL_HANDLE;
  check(vkCreateShaderModule(context.device(), &info, nullptr, &module), "vkCreateShaderModule");
  return {context.device(), module};
}

PipelineLayout create_pipeline_layout(const Context& context, std::span<const VkDescriptorSetLayout> sets,
                                      std::span<const VkPushConstantRange> push_constants) {
  VkPipelineLayoutCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  info.setLayoutCount = static_cast<uint32_t>(sets.size());
  info.pSetLayouts = sets.data();
  info.pushConstantRangeCount = static_cast<uint32_t>(push_constants.size());
  info.pPushConstantRanges = push_constants.data();
  VkPipelineLayout layout = VK_NULL_HANDLE;
  check(vkCreatePipelineLayout(context.device(), &info, nullptr, &layout), "vkCreatePipelineLayout");
  return {context.device(), layout};
}

Pipeline create_graphics_pipeline(const Context& context, const GraphicsPipelineInfo& info) {
  const ShaderModule vertex = create_shader_module(context, info.vertex_shader);
  const bool has_fragments = !info.fragment_shader.empty();
  const ShaderModule fragment = has_fragments ? create_shader_module(context, info.fragment_shader) : ShaderModule();
  std::array<VkPipelineShaderStageCreateInfo, 2> stages = {stage(VK_SHADER_STAGE_VERTEX_BIT, vertex),
                                                           stage(VK_SHADER_STAGE_FRAGMENT_BIT, fragment)};
  stages[1].pSpecializationInfo = info.fragment_constants;

  const VkVertexInputBindingDescription binding = {0, info.vertices.stride, VK_VERTEX_INPUT_RATE_VERTEX};
  VkPipelineVertexInputStateCreateInfo vertex_input = {};
  vertex_input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
  vertex_input.vertexBindingDescriptionCount = info.vertices.attributes.empty() ? 0 : 1;
  vertex_input.pVertexBindingDescriptions = &binding;
  vertex_input.vertexAttributeDescriptionCount = static_cast<uint32_t>(info.vertices.attributes.size());
  vertex_input.pVertexAttributeDescriptions = info.vertices.attributes.data();

  VkPipelineInputAssemblyStateCreateInfo input_assembly = {};
  input_assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
  input_assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;

  const VkViewport viewport = {0,    0,   static_cast<float>(info.extent.width), static_cast<float>(info.extent.height),
                               0.0f, 1.0f};
  const VkRect2D scissor = {{0, 0}, info.extent};
  VkPipelineViewportStateCreateInfo viewports = {};
  viewports.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
  viewports.viewportCount = 1;
  viewports.pViewports = &viewport;
  viewports.scissorCount = 1;
  viewports.pScissors = &scissor;

  VkPipelineMultisampleStateCreateInfo multisample = {};
  multisample.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
  multisample.rasterizationSamples = info.samples;

  const VkPipelineRasterizationStateCreateInfo raster = rasterization(info.cull_back_faces);
  const VkPipelineDepthStencilStateCreateInfo depth = depth_stencil(info.depth_test);
  const VkPipelineColorBlendAttachmentState attachment = blend_state(info.blend);
  VkPipelineColorBlendStateCreateInfo blend = {};
  blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
  blend.attachmentCount = has_fragments ? 1 : 0;
  blend.pAttachments = &attachment;

  VkGraphicsPipelineCreateInfo create = {};
  create.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
  create.stageCount = has_fragments ? 2 : 1;
  create.pStages = stages.data();
  create.pVertexInputState = &vertex_input;
  create.pInputAssemblyState = &input_assembly;
  create.pViewportState = &viewports;
  create.pRasterizationState = &raster;
  create.pMultisampleState = &multisample;
  create.pDepthStencilState = &depth;
  create.pColorBlendState = &blend;
  create.layout = info.layout;
  create.renderPass = info.render_pass;
  VkPipeline pipeline = VK_NULL_HANDLE;
  check(vkCreateGraphicsPipelines(context.device(), VK_NULL_HANDLE, 1, &create, nullptr, &pipeline),
        "vkCreateGraphicsPipelines");
  return {context.device(), pipeline};
}

Pipeline create_compute_pipeline(const Context& context, std::span<const uint32_t> shader, VkPipelineLayout layout) {
  const ShaderModule module = create_shader_module(context, shader);
  VkComputePipelineCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.stage = stage(VK_SHADER_STAGE_COMPUTE_BIT, module);
  info.layout = layout;
  VkPipeline pipeline = VK_NULL_HANDLE;
  check(vkCreateComputePipelines(context.device(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
        "vkCreateComputePipelines");
  return {context.device(), pipeline};
}

}  // namespace lapilli::samples
