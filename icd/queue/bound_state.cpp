// Flattening: pointers to objects become pointers to memory, and dynamic state takes the place of the pipeline's.
#include "queue/bound_state.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace lapilli {
namespace {

template <class T>
T* new_block(Arena& arena) {
  void* memory = arena.allocate(sizeof(T), alignof(T));
  return memory == nullptr ? nullptr : new (memory) T();
}

bool make_state(BoundState& state, Arena& arena) {
  DrawState* const out = new_block<DrawState>(arena);
  if (out == nullptr) return false;
  const GraphicsPart& pipeline = state.graphics.pipeline->graphics;
  const auto source = [&](DynamicStateBit bit) -> const DynamicState& {
    return (pipeline.dynamic & bit) != 0 ? state.dynamic : pipeline.fixed;
  };
  out->programs = &pipeline.programs;
  RasterState& raster = out->raster;
  raster.topology = pipeline.topology;
  raster.primitive_restart = pipeline.primitive_restart;
  raster.rasterizer_discard = pipeline.rasterizer_discard;
  raster.cull_mode = pipeline.cull_mode;
  raster.front_face = pipeline.front_face;
  raster.depth_bias = pipeline.depth_bias;
  const DynamicState& bias = source(kDynamicDepthBias);
  raster.depth_bias_constant = bias.depth_bias_constant;
  raster.depth_bias_clamp = bias.depth_bias_clamp;
  raster.depth_bias_slope = bias.depth_bias_slope;
  raster.line_width = source(kDynamicLineWidth).line_width;
  out->viewport = source(kDynamicViewport).viewport;
  out->scissor = source(kDynamicScissor).scissor;
  std::ranges::copy(source(kDynamicBlendConstants).blend_constants, out->blend_constants);
  state.blocks.state = out;
  return true;
}

bool make_vertex_input(BoundState& state, Arena& arena) {
  const GraphicsPart& pipeline = state.graphics.pipeline->graphics;
  VertexBinding* const out = arena.allocate_array<VertexBinding>(pipeline.binding_count);
  if (out == nullptr) return false;
  for (uint32_t i = 0; i < pipeline.binding_count; ++i) {
    const cmd::VertexBufferBinding& bound = state.vertex_buffers[i];
    const VertexInputBinding& layout = pipeline.bindings[i];
    const BufferMemory bytes = bound.buffer != nullptr ? bound.buffer->bytes(bound.offset) : BufferMemory();
    out[i] = {bytes.data, bytes.size, layout.stride, layout.per_instance};
  }
  state.blocks.bindings = out;
  return true;
}

// Push constants are copied only when they changed: a new table points to those of the last one.
bool make_resources(BoundState& state, Arena& arena) {
  ResourceTable* const out = new_block<ResourceTable>(arena);
  if (out == nullptr || !flatten_resources(state, state.graphics, arena, *out)) return false;
  if ((state.stale & kStalePushConstants) != 0) {
    std::byte* const copy = arena.allocate_array<std::byte>(state.push_constant_bytes);
    if (copy == nullptr) return false;
    std::memcpy(copy, state.push_constants, state.push_constant_bytes);
    out->push_constants = copy;
  } else {
    out->push_constants = state.blocks.resources->push_constants;
  }
  state.blocks.resources = out;
  return true;
}

template <class T>
bool same_bytes(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

bool same_vertex_layout(const GraphicsPart& a, const GraphicsPart& b) {
  return a.binding_count == b.binding_count && std::equal(a.bindings, a.bindings + a.binding_count, b.bindings,
                                                          [](const VertexInputBinding& x, const VertexInputBinding& y) {
                                                            return x.stride == y.stride &&
                                                                   x.per_instance == y.per_instance;
                                                          });
}

}  // namespace

IndexBuffer BoundState::no_indices() {
  static constexpr std::byte kNothing[4] = {};
  return {kNothing, 0, VK_INDEX_TYPE_UINT16};
}

void bind_pipeline(BoundState& state, const Pipeline& pipeline) {
  const bool graphics = pipeline.bind_point == VK_PIPELINE_BIND_POINT_GRAPHICS;
  BindPoint& point = graphics ? state.graphics : state.compute;
  const Pipeline* const before = std::exchange(point.pipeline, &pipeline);
  if (!graphics || before == &pipeline) return;
  state.stale |= kStaleState;
  if (before == nullptr || !same_vertex_layout(before->graphics, pipeline.graphics)) state.stale |= kStaleVertexInput;
  if (before == nullptr || !same_bytes(before->resources, pipeline.resources)) state.stale |= kStaleResources;
}

void bind_sets(BoundState& state, const cmd::BindDescriptorSets& command) {
  const bool graphics = command.bind_point == VK_PIPELINE_BIND_POINT_GRAPHICS;
  cmd::SetBinding* bound = (graphics ? state.graphics : state.compute).sets + command.first;
  for (const cmd::SetBinding& set : command.sets) {
    const bool same = bound->set == set.set && std::ranges::equal(bound->dynamic_offsets, set.dynamic_offsets);
    if (graphics && !same) state.stale |= kStaleResources;
    *bound++ = set;
  }
}

void bind_vertex_buffers(BoundState& state, const cmd::BindVertexBuffers& command) {
  cmd::VertexBufferBinding* bound = state.vertex_buffers + command.first;
  for (const cmd::VertexBufferBinding& buffer : command.buffers) {
    if (bound->buffer != buffer.buffer || bound->offset != buffer.offset) state.stale |= kStaleVertexInput;
    *bound++ = buffer;
  }
}

void bind_index_buffer(BoundState& state, const cmd::BindIndexBuffer& command) {
  state.indices = BoundState::no_indices();
  if (command.buffer != nullptr) {
    const BufferMemory bytes = command.buffer->bytes(command.offset);
    if (bytes.data != nullptr) state.indices = {bytes.data, bytes.size, VK_INDEX_TYPE_UINT16};
  }
  state.indices.type = command.type;
}

void push_constants(BoundState& state, const cmd::PushConstants& command) {
  std::byte* const target = state.push_constants + command.offset;
  const auto end = static_cast<uint32_t>(command.offset + command.values.size());
  if (end <= state.push_constant_bytes && std::memcmp(target, command.values.data(), command.values.size()) == 0) {
    return;
  }
  std::memcpy(target, command.values.data(), command.values.size());
  state.push_constant_bytes = std::max(state.push_constant_bytes, (end + 15) / 16 * 16);
  state.stale |= kStaleResources | kStalePushConstants;
}

bool flatten_resources(const BoundState& state, const BindPoint& bound, Arena& arena, ResourceTable& out) {
  const PipelineResources& layout = bound.pipeline->resources;
  out.push_constants = state.push_constants;
  out.push_constant_bytes = state.push_constant_bytes;
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

bool refresh_blocks(BoundState& state, Arena& arena) {
  if ((state.stale & kStaleState) != 0 && !make_state(state, arena)) return false;
  if ((state.stale & kStaleVertexInput) != 0 && !make_vertex_input(state, arena)) return false;
  if ((state.stale & (kStaleResources | kStalePushConstants)) != 0 && !make_resources(state, arena)) return false;
  state.stale = 0;
  return true;
}

}  // namespace lapilli
