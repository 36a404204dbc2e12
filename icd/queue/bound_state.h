// What is bound while a command buffer runs, and how it is flattened into the blocks of a DrawCall or a ResourceTable.
// Specification: chapters "Pipelines", "Resource Descriptors", "Drawing Commands".
#pragma once

#include <cstring>

#include "base/arena.h"
#include "command/state_commands.h"
#include "geometry/draw_call.h"

namespace lapilli {

struct BindPoint {
  const Pipeline* pipeline = nullptr;
  cmd::SetBinding sets[kMaxDescriptorSets];
};

// Blocks of a DrawCall, as bits: those that no longer say what is bound.
enum StaleBit : uint32_t {
  kStaleState = 1,
  kStaleVertexInput = 2,
  kStaleResources = 4,
  kStalePushConstants = 8,  // lie in a block of their own, which the resources point to
  kStaleAll = 15,
};

struct BoundState {
  BindPoint graphics;
  BindPoint compute;
  cmd::VertexBufferBinding vertex_buffers[kMaxVertexBindings];
  IndexBuffer indices = no_indices();
  DynamicState dynamic;
  uint32_t push_constant_bytes = 0;  // up to the last one that was set, in whole vectors of 16
  alignas(16) std::byte push_constants[kMaxPushConstantBytes] = {};

  uint32_t stale = kStaleAll;
  DrawCall blocks;  // those of the last draw; its counts mean nothing

  // Without a buffer all indices are outside of it and read as 0.
  static IndexBuffer no_indices();
};

// The commands that change what is bound. A block is stale only if they change something.
void bind_pipeline(BoundState& state, const Pipeline& pipeline);
void bind_sets(BoundState& state, const cmd::BindDescriptorSets& command);
void bind_vertex_buffers(BoundState& state, const cmd::BindVertexBuffers& command);
void bind_index_buffer(BoundState& state, const cmd::BindIndexBuffer& command);
void push_constants(BoundState& state, const cmd::PushConstants& command);
// `member` is one of state.dynamic.
template <class T>
void set_dynamic(BoundState& state, T& member, const T& value) {
  // Bits, not values: two patterns of one value cost a flattening, no more.
  // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
  if (std::memcmp(&member, &value, sizeof(T)) == 0) return;
  std::memcpy(&member, &value, sizeof(T));
  state.stale |= kStaleState;
}

// The resources of a bind point. Sets that do not fit the pipeline's layout are left unbound: reading them gives 0.
// Dynamic offsets are kept in `arena`, push constants are those of `state` itself. False: out of memory.
bool flatten_resources(const BoundState& state, const BindPoint& bound, Arena& arena, ResourceTable& out);

// Makes the stale blocks of state.blocks anew, in `arena`. False: out of memory. The state has a graphics pipeline.
bool refresh_blocks(BoundState& state, Arena& arena);

}  // namespace lapilli
