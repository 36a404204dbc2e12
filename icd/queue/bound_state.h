// What is bound while a command buffer runs, and how it is flattened into a DrawCall or a ResourceTable.
// Specification: chapters "Pipelines", "Resource Descriptors", "Drawing Commands".
#pragma once

#include "base/arena.h"
#include "command/state_commands.h"
#include "geometry/draw_call.h"

namespace lapilli {

struct BindPoint {
  const Pipeline* pipeline = nullptr;
  cmd::SetBinding sets[kMaxDescriptorSets];
};

struct BoundState {
  BindPoint graphics;
  BindPoint compute;
  cmd::VertexBufferBinding vertex_buffers[kMaxVertexBindings];
  Buffer* index_buffer = nullptr;
  uint64_t index_offset = 0;  // bytes
  VkIndexType index_type = VK_INDEX_TYPE_UINT16;
  DynamicState dynamic;
  alignas(16) std::byte push_constants[kMaxPushConstantBytes] = {};

  BindPoint& at(VkPipelineBindPoint point) { return point == VK_PIPELINE_BIND_POINT_COMPUTE ? compute : graphics; }
};

// Sets that do not fit the pipeline's layout are left unbound: reading them gives 0. Dynamic offsets are kept in
// `arena`. False: out of memory.
bool flatten_resources(const BoundState& state, const BindPoint& bound, Arena& arena, ResourceTable& out);

// All of a draw but its counts. False: out of memory. The state has a graphics pipeline.
bool flatten_draw(const BoundState& state, Arena& arena, DrawCall& out);

}  // namespace lapilli
