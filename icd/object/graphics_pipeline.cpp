// Graphics pipelines. What no feature bit offers is refused here, by name. Specification: chapter "Pipelines".
#include <algorithm>
#include <optional>

#include "object/pipeline.h"

namespace lapilli {
namespace {

using Info = VkGraphicsPipelineCreateInfo;

Error unsupported(std::string what) { return {VK_ERROR_UNKNOWN, std::move(what)}; }

Result<void> check_raster(const Info& info) {
  const VkPipelineRasterizationStateCreateInfo& raster = *info.pRasterizationState;
  if (raster.depthClampEnable != VK_FALSE)
    return unsupported("depthClampEnable: the feature depthClamp is not offered");
  if (raster.polygonMode != VK_POLYGON_MODE_FILL) {
    return unsupported("polygonMode: the feature fillModeNonSolid is not offered");
  }
  const VkPrimitiveTopology topology = info.pInputAssemblyState->topology;
  if (topology != VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST && topology != VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP &&
      topology != VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN) {
    return unsupported("topology " + std::to_string(topology) + " is not supported: only triangles are drawn");
  }
  return {};
}

Result<void> check_fragment(const Info& info) {
  if (const auto* samples = info.pMultisampleState) {
    if (samples->rasterizationSamples != VK_SAMPLE_COUNT_1_BIT) return unsupported("multisampling is not supported");
    if (samples->alphaToCoverageEnable != VK_FALSE) return unsupported("alphaToCoverageEnable is not supported");
    if (samples->alphaToOneEnable != VK_FALSE) return unsupported("the feature alphaToOne is not offered");
  }
  if (const auto* blend = info.pColorBlendState; blend != nullptr && blend->logicOpEnable != VK_FALSE) {
    return unsupported("the feature logicOp is not offered");
  }
  if (const auto* depth = info.pDepthStencilState; depth != nullptr && depth->depthBoundsTestEnable != VK_FALSE) {
    return unsupported("the feature depthBounds is not offered");
  }
  return {};
}

// Null where the state says nothing.
std::optional<uint32_t> dynamic_bit(VkDynamicState state) {
  switch (state) {
    case VK_DYNAMIC_STATE_VIEWPORT:
      return kDynamicViewport;
    case VK_DYNAMIC_STATE_SCISSOR:
      return kDynamicScissor;
    case VK_DYNAMIC_STATE_LINE_WIDTH:
      return kDynamicLineWidth;
    case VK_DYNAMIC_STATE_DEPTH_BIAS:
      return kDynamicDepthBias;
    case VK_DYNAMIC_STATE_BLEND_CONSTANTS:
      return kDynamicBlendConstants;
    // No format has stencil and depth bounds are not offered: these change nothing.
    case VK_DYNAMIC_STATE_DEPTH_BOUNDS:
    case VK_DYNAMIC_STATE_STENCIL_COMPARE_MASK:
    case VK_DYNAMIC_STATE_STENCIL_WRITE_MASK:
    case VK_DYNAMIC_STATE_STENCIL_REFERENCE:
      return 0;
    default:
      return std::nullopt;
  }
}

Result<void> set_dynamic(GraphicsPart& part, const Info& info) {
  if (info.pDynamicState == nullptr) return {};
  for (uint32_t i = 0; i < info.pDynamicState->dynamicStateCount; ++i) {
    const VkDynamicState state = info.pDynamicState->pDynamicStates[i];
    const std::optional<uint32_t> bit = dynamic_bit(state);
    if (!bit) return unsupported("dynamic state " + std::to_string(state) + " is not supported");
    part.dynamic |= *bit;
  }
  return {};
}

Result<void> set_viewport(GraphicsPart& part, const Info& info) {
  const VkPipelineViewportStateCreateInfo* state = info.pViewportState;
  if (part.rasterizer_discard || state == nullptr) return {};
  if (state->viewportCount > 1 || state->scissorCount > 1) {
    return unsupported("several viewports: the feature multiViewport is not offered");
  }
  if ((part.dynamic & kDynamicViewport) == 0 && state->pViewports != nullptr)
    part.fixed.viewport = state->pViewports[0];
  if ((part.dynamic & kDynamicScissor) == 0 && state->pScissors != nullptr) part.fixed.scissor = state->pScissors[0];
  return {};
}

void set_raster(GraphicsPart& part, const Info& info) {
  const VkPipelineRasterizationStateCreateInfo& raster = *info.pRasterizationState;
  part.topology = info.pInputAssemblyState->topology;
  part.primitive_restart = info.pInputAssemblyState->primitiveRestartEnable != VK_FALSE;
  part.rasterizer_discard = raster.rasterizerDiscardEnable != VK_FALSE;
  part.cull_mode = raster.cullMode;
  part.front_face = raster.frontFace;
  part.depth_bias = raster.depthBiasEnable != VK_FALSE;
  part.fixed.depth_bias_constant = raster.depthBiasConstantFactor;
  part.fixed.depth_bias_clamp = raster.depthBiasClamp;
  part.fixed.depth_bias_slope = raster.depthBiasSlopeFactor;
  part.fixed.line_width = raster.lineWidth;
  if (part.rasterizer_discard) return;  // what follows is ignored and may be garbage
  if (info.pColorBlendState != nullptr) {
    std::copy_n(info.pColorBlendState->blendConstants, 4, part.fixed.blend_constants);
  }
  const VkSampleMask* mask = info.pMultisampleState != nullptr ? info.pMultisampleState->pSampleMask : nullptr;
  // With the only sample masked off nothing is ever covered.
  if (mask != nullptr && (*mask & 1) == 0) part.rasterizer_discard = true;
}

Result<std::vector<VertexAttribute>> vertex_input(GraphicsPart& part, const Info& info) {
  const VkPipelineVertexInputStateCreateInfo& input = *info.pVertexInputState;
  for (uint32_t i = 0; i < input.vertexBindingDescriptionCount; ++i) {
    const VkVertexInputBindingDescription& binding = input.pVertexBindingDescriptions[i];
    if (binding.binding >= kMaxVertexBindings) return unsupported("a vertex binding above maxVertexInputBindings");
    part.binding_count = std::max(part.binding_count, binding.binding + 1);
    part.bindings[binding.binding] = {binding.stride, binding.inputRate == VK_VERTEX_INPUT_RATE_INSTANCE};
  }
  std::vector<VertexAttribute> attributes;
  for (uint32_t i = 0; i < input.vertexAttributeDescriptionCount; ++i) {
    const VkVertexInputAttributeDescription& from = input.pVertexAttributeDescriptions[i];
    const FormatInfo* format = find_format(from.format);
    if (format == nullptr || !format->has(kVertex)) {
      return unsupported("vertex attribute format " + std::to_string(from.format) + " is not supported");
    }
    if (from.location >= kMaxVertexAttributes || from.binding >= kMaxVertexBindings) {
      return unsupported("a vertex attribute above maxVertexInputAttributes");
    }
    part.binding_count = std::max(part.binding_count, from.binding + 1);
    attributes.push_back({from.location, from.binding, from.offset, from.format});
  }
  return attributes;
}

struct Stages {
  std::optional<StageInfo> vertex, fragment;
};
Result<void> find_stages(Stages& stages, const Info& info, bool rasterizer_discard) {
  for (uint32_t i = 0; i < info.stageCount; ++i) {
    const VkPipelineShaderStageCreateInfo& stage = info.pStages[i];
    if (stage.stage == VK_SHADER_STAGE_VERTEX_BIT) {
      stages.vertex.emplace(stage);
    } else if (stage.stage == VK_SHADER_STAGE_FRAGMENT_BIT) {
      if (!rasterizer_discard) stages.fragment.emplace(stage);
    } else {
      return unsupported("shader stage " + std::to_string(stage.stage) + " of VkShaderStageFlagBits is not offered");
    }
  }
  if (!stages.vertex) return unsupported("there is no vertex shader");
  return {};
}

// The attachments of the subpass, and what fixed function does with them.
struct Targets {
  std::vector<VkFormat> formats;
  std::vector<VkPipelineColorBlendAttachmentState> blend;
  VkFormat depth_format = VK_FORMAT_UNDEFINED;  // if the depth test is on
};
Result<Targets> find_targets(GraphicsState& state, const Info& info, bool rasterizer_discard) {
  const RenderPass& pass = *RenderPass::from(info.renderPass);
  if (info.subpass >= pass.subpasses.size()) return unsupported("the render pass has no such subpass");
  const Subpass& subpass = pass.subpasses[info.subpass];
  Targets targets;
  if (rasterizer_discard) return targets;
  for (uint32_t attachment : subpass.color) targets.formats.push_back(pass.format_of(attachment));
  targets.blend.resize(targets.formats.size());
  if (const auto* blend = info.pColorBlendState) {
    const size_t count = std::min<size_t>(blend->attachmentCount, targets.blend.size());
    std::copy_n(blend->pAttachments, count, targets.blend.begin());
  }
  for (size_t i = 0; i < targets.blend.size(); ++i) {
    const FormatInfo* format = find_format(targets.formats[i]);
    if (targets.blend[i].blendEnable != VK_FALSE && format != nullptr && !format->has(kBlendable)) {
      return unsupported(std::string("format ") + format->name + " cannot be blended");
    }
  }
  if (const auto* depth = info.pDepthStencilState; depth != nullptr && subpass.depth != kUnusedAttachment) {
    state.depth_test = depth->depthTestEnable != VK_FALSE;
    state.depth_write = state.depth_test && depth->depthWriteEnable != VK_FALSE;
    state.depth_compare = depth->depthCompareOp;
    if (state.depth_test) targets.depth_format = pass.format_of(subpass.depth);
  }
  return targets;
}

Result<void> build(GraphicsPart& part, const Info& info, bool counts_removals) {
  if (Result<void> checked = check_raster(info); !checked) return checked;
  set_raster(part, info);
  if (!part.rasterizer_discard) {
    if (Result<void> checked = check_fragment(info); !checked) return checked;
  }
  if (Result<void> dynamic = set_dynamic(part, info); !dynamic) return dynamic;
  if (Result<void> viewport = set_viewport(part, info); !viewport) return viewport;
  Result<std::vector<VertexAttribute>> attributes = vertex_input(part, info);
  if (!attributes) return attributes.error();
  Stages stages;
  if (Result<void> found = find_stages(stages, info, part.rasterizer_discard); !found) return found;

  GraphicsState state;
  state.counts_removals = counts_removals;
  Result<Targets> targets = find_targets(state, info, part.rasterizer_discard);
  if (!targets) return targets.error();
  std::copy(targets->formats.begin(), targets->formats.end(), part.color_formats.begin());
  part.depth_format = targets->depth_format;
  state.attributes = *attributes;
  state.color_formats = targets->formats;
  state.blend = targets->blend;
  const ShaderStage* fragment = stages.fragment ? &stages.fragment->stage : nullptr;
  Result<GraphicsPrograms> programs =
      build_graphics(stages.vertex->stage, fragment, state, PipelineLayout::from(info.layout)->resources());
  if (!programs) return programs.error();
  part.programs = std::move(*programs);
  return {};
}

VkResult create_one(DeviceContext& device, const Info& info, const VkAllocationCallbacks* callbacks,
                    VkPipeline* handle) {
  auto pipeline = make_object<Pipeline>(device.object_memory(callbacks), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  if (Result<void> built = build(pipeline->graphics, info, device.physical_device.environment.stats); !built) {
    log_error("vkCreateGraphicsPipelines: %s", built.error().message.c_str());
    return built.error().code;
  }
  pipeline->bind_point = VK_PIPELINE_BIND_POINT_GRAPHICS;
  pipeline->resources = resources_of(*PipelineLayout::from(info.layout));
  return publish(std::move(pipeline), handle);
}

}  // namespace

VkResult create_graphics_pipelines(DeviceContext& device, std::span<const VkGraphicsPipelineCreateInfo> infos,
                                   const VkAllocationCallbacks* callbacks, VkPipeline* handles) {
  std::fill_n(handles, infos.size(), VkPipeline{VK_NULL_HANDLE});
  VkResult worst = VK_SUCCESS;
  for (size_t i = 0; i < infos.size(); ++i) {
    const VkResult result = create_one(device, infos[i], callbacks, &handles[i]);
    if (worst == VK_SUCCESS) worst = result;
  }
  return worst;
}

}  // namespace lapilli
