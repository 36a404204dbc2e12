// Graphics pipelines with every state a test may want to change. Viewport and scissor are dynamic unless given.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "harness/canvas.h"

namespace lapilli::conformance {

using samples::Context;

// The default draws triangle lists of one vec4 position and one vec4 (the colour), tightly packed in binding 0.
struct PipelineState {
  std::span<const uint32_t> vertex_shader, fragment_shader;
  std::vector<VkVertexInputBindingDescription> bindings = {{0, 32, VK_VERTEX_INPUT_RATE_VERTEX}};
  std::vector<VkVertexInputAttributeDescription> attributes = {{0, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 0},
                                                               {1, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 16}};
  VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  bool primitive_restart = false;
  VkCullModeFlags cull = VK_CULL_MODE_NONE;
  VkFrontFace front_face = VK_FRONT_FACE_COUNTER_CLOCKWISE;
  bool rasterizer_discard = false;
  bool depth_test = false;
  bool depth_write = false;
  VkCompareOp depth_compare = VK_COMPARE_OP_LESS;
  VkPipelineColorBlendAttachmentState blend = {VK_FALSE,
                                               VK_BLEND_FACTOR_ONE,
                                               VK_BLEND_FACTOR_ZERO,
                                               VK_BLEND_OP_ADD,
                                               VK_BLEND_FACTOR_ONE,
                                               VK_BLEND_FACTOR_ZERO,
                                               VK_BLEND_OP_ADD,
                                               0xF};
  std::array<float, 4> blend_constants = {};
  bool has_color = true;  // false: a subpass without colour attachment
  std::optional<VkViewport> viewport;
  std::optional<VkRect2D> scissor;
  const VkSpecializationInfo* specialization = nullptr;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkRenderPass render_pass = VK_NULL_HANDLE;
  uint32_t subpass = 0;
};

// Without check(): for tests that expect an error.
VkResult try_create_pipeline(const Context& context, const PipelineState& state, VkPipeline* pipeline,
                             const VkAllocationCallbacks* allocator = nullptr);
samples::Pipeline create_pipeline(const Context& context, const PipelineState& state);

// A layout with the given sets and one range of push constants (bytes; 0: none) for all stages.
samples::PipelineLayout create_layout(const Context& context, std::span<const VkDescriptorSetLayout> sets = {},
                                      uint32_t push_bytes = 0);

// Draws all vertices, of the default layout (see PipelineState), on a cleared canvas and waits. `set`: bound as set 0.
void draw_vertices(const Canvas& canvas, const samples::Pipeline& pipeline, std::span<const std::byte> vertices,
                   VkPipelineLayout layout = VK_NULL_HANDLE, VkDescriptorSet set = VK_NULL_HANDLE);
// The same with a pipeline of its own: `state` less its layout, which is the descriptors', and its render pass.
template <class Descriptors>
void draw_with(const Canvas& canvas, PipelineState state, const Descriptors& descriptors,
               std::span<const std::byte> vertices) {
  const VkDescriptorSetLayout set_layout = descriptors.layout();
  const samples::PipelineLayout layout = create_layout(canvas.context(), {&set_layout, 1});
  state.layout = layout.get();
  state.render_pass = canvas.render_pass();
  const samples::Pipeline pipeline = create_pipeline(canvas.context(), state);
  draw_vertices(canvas, pipeline, vertices, layout.get(), descriptors.get());
}

}  // namespace lapilli::conformance
