// Recording of bindings and dynamic state.
#include <algorithm>

#include "command/record.h"

namespace lapilli {

void record_bind_pipeline(CommandBuffer& commands, const Pipeline& pipeline) {
  commands.record<cmd::BindPipeline>().pipeline = &pipeline;
}

void record_bind_descriptor_sets(CommandBuffer& commands, VkPipelineBindPoint bind_point, const PipelineLayout& layout,
                                 uint32_t first, std::span<const VkDescriptorSet> sets,
                                 std::span<const uint32_t> dynamic_offsets) {
  if (first >= layout.set_count || sets.size() > layout.set_count - first) return;
  std::span<const uint32_t> offsets = commands.copy(dynamic_offsets);
  const std::span<cmd::SetBinding> bindings = commands.array<cmd::SetBinding>(sets.size());
  for (size_t i = 0; i < sets.size(); ++i) {
    // Each set takes its offsets from the front of what is left.
    const size_t count = std::min<size_t>(layout.dynamic_count[first + i], offsets.size());
    bindings[i] = {DescriptorSet::from(sets[i]), offsets.first(count)};
    offsets = offsets.subspan(count);
  }
  auto& command = commands.record<cmd::BindDescriptorSets>();
  command.bind_point = bind_point;
  command.first = first;
  command.sets = bindings;
}

void record_bind_vertex_buffers(CommandBuffer& commands, uint32_t first, std::span<const VkBuffer> buffers,
                                const VkDeviceSize* offsets) {
  if (first >= kMaxVertexBindings || buffers.size() > kMaxVertexBindings - first) return;
  const std::span<cmd::VertexBufferBinding> bindings = commands.array<cmd::VertexBufferBinding>(buffers.size());
  for (size_t i = 0; i < buffers.size(); ++i) bindings[i] = {Buffer::from(buffers[i]), offsets[i]};
  auto& command = commands.record<cmd::BindVertexBuffers>();
  command.first = first;
  command.buffers = bindings;
}

void record_bind_index_buffer(CommandBuffer& commands, Buffer* buffer, uint64_t offset, VkIndexType type) {
  auto& command = commands.record<cmd::BindIndexBuffer>();
  command.buffer = buffer;
  command.offset = offset;
  command.type = type;
}

void record_push_constants(CommandBuffer& commands, uint32_t offset, std::span<const std::byte> values) {
  if (offset > kMaxPushConstantBytes || values.size() > kMaxPushConstantBytes - offset) return;
  auto& command = commands.record<cmd::PushConstants>();
  command.offset = offset;
  command.values = commands.copy(values);
}

// There is one viewport: those above it have no meaning.
void record_set_viewport(CommandBuffer& commands, uint32_t first, std::span<const VkViewport> viewports) {
  if (first == 0 && !viewports.empty()) commands.record<cmd::SetViewport>().viewport = viewports[0];
}

void record_set_scissor(CommandBuffer& commands, uint32_t first, std::span<const VkRect2D> scissors) {
  if (first == 0 && !scissors.empty()) commands.record<cmd::SetScissor>().scissor = scissors[0];
}

void record_set_line_width(CommandBuffer& commands, float width) { commands.record<cmd::SetLineWidth>().width = width; }

void record_set_depth_bias(CommandBuffer& commands, float constant, float clamp, float slope) {
  auto& command = commands.record<cmd::SetDepthBias>();
  command.constant = constant;
  command.clamp = clamp;
  command.slope = slope;
}

void record_set_blend_constants(CommandBuffer& commands, const float values[4]) {
  std::copy_n(values, 4, commands.record<cmd::SetBlendConstants>().values);
}

}  // namespace lapilli
