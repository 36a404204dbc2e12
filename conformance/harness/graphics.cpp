// Graphics pipeline creation for the tests: see graphics.h.
#include "harness/graphics.h"

#include <array>

#include "common/pipeline.h"
#include "harness/variants.h"

namespace lapilli::conformance {
namespace {

template <typename T>
T zeroed(VkStructureType type) {
  T info = {};
  info.sType = type;
  return info;
}

VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits kind, VkShaderModule module,
                                      const VkSpecializationInfo* specialization) {
  auto info = zeroed<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
  info.stage = kind;
  info.module = module;
  info.pName = "main";
  info.pSpecializationInfo = specialization;
  return info;
}

}  // namespace

VkResult try_create_pipeline(const Context& context, const PipelineState& s, VkPipeline* pipeline,
                             const VkAllocationCallbacks* allocator) {
  const samples::ShaderModule vertex = samples::create_shader_module(context, in_variant(s.vertex_shader));
  samples::ShaderModule fragment;
  std::vector<VkPipelineShaderStageCreateInfo> stages = {
      stage(VK_SHADER_STAGE_VERTEX_BIT, vertex.get(), s.specialization)};
  if (!s.fragment_shader.empty()) {
    fragment = samples::create_shader_module(context, in_variant(s.fragment_shader));
    stages.push_back(stage(VK_SHADER_STAGE_FRAGMENT_BIT, fragment.get(), s.specialization));
  }

  auto input = zeroed<VkPipelineVertexInputStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
  input.vertexBindingDescriptionCount = uint32_t(s.bindings.size());
  input.pVertexBindingDescriptions = s.bindings.data();
  input.vertexAttributeDescriptionCount = uint32_t(s.attributes.size());
  input.pVertexAttributeDescriptions = s.attributes.data();

  auto assembly =
      zeroed<VkPipelineInputAssemblyStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
  assembly.topology = s.topology;
  assembly.primitiveRestartEnable = s.primitive_restart;

  auto viewport = zeroed<VkPipelineViewportStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO);
  viewport.viewportCount = viewport.scissorCount = 1;
  viewport.pViewports = s.viewport ? &*s.viewport : nullptr;
  viewport.pScissors = s.scissor ? &*s.scissor : nullptr;
  std::vector<VkDynamicState> dynamic_states;
  if (!s.viewport) dynamic_states.push_back(VK_DYNAMIC_STATE_VIEWPORT);
  if (!s.scissor) dynamic_states.push_back(VK_DYNAMIC_STATE_SCISSOR);
  auto dynamic = zeroed<VkPipelineDynamicStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO);
  dynamic.dynamicStateCount = uint32_t(dynamic_states.size());
  dynamic.pDynamicStates = dynamic_states.data();

  auto raster =
      zeroed<VkPipelineRasterizationStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO);
  raster.rasterizerDiscardEnable = s.rasterizer_discard;
  raster.cullMode = s.cull;
  raster.frontFace = s.front_face;
  raster.lineWidth = 1;

  auto multisample =
      zeroed<VkPipelineMultisampleStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
  multisample.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;

  auto depth =
      zeroed<VkPipelineDepthStencilStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO);
  depth.depthTestEnable = s.depth_test;
  depth.depthWriteEnable = s.depth_write;
  depth.depthCompareOp = s.depth_compare;

  auto blend = zeroed<VkPipelineColorBlendStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
  blend.attachmentCount = s.has_color ? 1 : 0;
  blend.pAttachments = &s.blend;
  for (size_t i = 0; i < 4; ++i) blend.blendConstants[i] = s.blend_constants[i];

  auto info = zeroed<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO);
  info.stageCount = uint32_t(stages.size());
  info.pStages = stages.data();
  info.pVertexInputState = &input;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &viewport;
  info.pRasterizationState = &raster;
  info.pMultisampleState = &multisample;
  info.pDepthStencilState = &depth;
  info.pColorBlendState = &blend;
  info.pDynamicState = &dynamic;
  info.layout = s.layout;
  info.renderPass = s.render_pass;
  info.subpass = s.subpass;
  return vkCreateGraphicsPipelines(context.device(), VK_NULL_HANDLE, 1, &info, allocator, pipeline);
}

samples::Pipeline create_pipeline(const Context& context, const PipelineState& state) {
  VkPipeline pipeline = VK_NULL_HANDLE;
  samples::check(try_create_pipeline(context, state, &pipeline), "vkCreateGraphicsPipelines");
  return {context.device(), pipeline};
}

samples::PipelineLayout create_layout(const Context& context, std::span<const VkDescriptorSetLayout> sets,
                                      uint32_t push_bytes) {
  const VkPushConstantRange range = {
      VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT | VK_SHADER_STAGE_COMPUTE_BIT, 0, push_bytes};
  return samples::create_pipeline_layout(context, sets, {&range, push_bytes > 0 ? size_t(1) : size_t(0)});
}

void draw_vertices(const Canvas& canvas, const samples::Pipeline& pipeline, std::span<const std::byte> vertices,
                   VkPipelineLayout layout, VkDescriptorSet set) {
  const samples::Buffer buffer(canvas.context(), vertices, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  const VkBuffer vertex_buffer = buffer.get();
  const VkDeviceSize offset = 0;
  VkCommandBuffer commands = canvas.context().begin_commands();
  canvas.begin(commands, {});
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
  if (set != VK_NULL_HANDLE)
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &set, 0, nullptr);
  vkCmdBindVertexBuffers(commands, 0, 1, &vertex_buffer, &offset);
  vkCmdDraw(commands, uint32_t(vertices.size() / 32), 1, 0, 0);
  Canvas::end(commands);
  canvas.context().submit_and_wait(commands);
}

}  // namespace lapilli::conformance
