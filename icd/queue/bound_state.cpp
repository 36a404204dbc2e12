// Flattening: pointers to objects become pointers to memory, and dynamic state takes the place of the pipeline's.
#include "queue/bound_state.h"

#include <algorithm>

namespace lapilli {
namespace {

void set_raster_state(const GraphicsPart& pipeline, const DynamicState& dynamic, RasterState& out) {
  const DynamicState& bias = (pipeline.dynamic & kDynamicDepthBias) != 0 ? dynamic : pipeline.fixed;
  const DynamicState& line = (pipeline.dynamic & kDynamicLineWidth) != 0 ? dynamic : pipeline.fixed;
  out.topology = pipeline.topology;
  out.primitive_restart = pipeline.primitive_restart;
  out.rasterizer_discard = pipeline.rasterizer_discard;
  out.cull_mode = pipeline.cull_mode;
  out.front_face = pipeline.front_face;
  out.depth_bias = pipeline.depth_bias;
  out.depth_bias_constant = bias.depth_bias_constant;
  out.depth_bias_clamp = bias.depth_bias_clamp;
  out.depth_bias_slope = bias.depth_bias_slope;
  out.line_width = line.line_width;
}

void set_vertex_bindings(const BoundState& state, const GraphicsPart& pipeline, DrawCall& out) {
  for (uint32_t i = 0; i < kMaxVertexBindings; ++i) {
    const cmd::VertexBufferBinding& bound = state.vertex_buffers[i];
    if (bound.buffer == nullptr) continue;
    const BufferMemory bytes = bound.buffer->bytes(bound.offset);
    out.bindings[i] = {bytes.data, bytes.size, pipeline.bindings[i].stride, pipeline.bindings[i].per_instance};
  }
}

}  // namespace

bool flatten_resources(const BoundState& state, const BindPoint& bound, Arena& arena, ResourceTable& out) {
  const PipelineResources& layout = bound.pipeline->resources;
  std::copy(std::begin(state.push_constants), std::end(state.push_constants), out.push_constants);
  uint32_t* offsets = nullptr;
  if (layout.dynamic_total != 0) {
    offsets = arena.allocate_array<uint32_t>(layout.dynamic_total);
    if (offsets == nullptr) return false;
    std::fill_n(offsets, layout.dynamic_total, 0u);
    out.dynamic_offsets = offsets;
  }
  for (uint32_t i = 0; i < layout.set_count; ++i) {
    const cmd::SetBinding& binding = bound.sets[i];
    if (binding.set == nullptr || binding.set->descriptors.size() < layout.descriptor_count[i]) continue;
    out.sets[i] = binding.set->descriptors.data();
    const size_t count = std::min<size_t>(layout.dynamic_count[i], binding.dynamic_offsets.size());
    std::copy_n(binding.dynamic_offsets.begin(), count, offsets + layout.first_dynamic[i]);
  }
  return true;
}

bool flatten_draw(const BoundState& state, Arena& arena, DrawCall& out) {
  const GraphicsPart& pipeline = state.graphics.pipeline->graphics;
  out.programs = &pipeline.programs;
  if (!flatten_resources(state, state.graphics, arena, out.resources)) return false;
  set_vertex_bindings(state, pipeline, out);
  set_raster_state(pipeline, state.dynamic, out.raster);
  const DynamicState& fixed = pipeline.fixed;
  const DynamicState& dynamic = state.dynamic;
  out.viewport = (pipeline.dynamic & kDynamicViewport) != 0 ? dynamic.viewport : fixed.viewport;
  out.scissor = (pipeline.dynamic & kDynamicScissor) != 0 ? dynamic.scissor : fixed.scissor;
  const auto& blend =
      (pipeline.dynamic & kDynamicBlendConstants) != 0 ? dynamic.blend_constants : fixed.blend_constants;
  std::copy(std::begin(blend), std::end(blend), out.blend_constants);
  return true;
}

}  // namespace lapilli
