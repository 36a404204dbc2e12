// Recording of render passes and of secondary command buffers.
#include "command/record.h"

namespace lapilli {

void record_begin_render_pass(CommandBuffer& commands, const VkRenderPassBeginInfo& info) {
  auto& command = commands.record<cmd::BeginRenderPass>();
  command.pass = RenderPass::from(info.renderPass);
  command.framebuffer = Framebuffer::from(info.framebuffer);
  command.area = info.renderArea;
  command.clear_values = commands.copy(std::span(info.pClearValues, info.clearValueCount));
}

void record_next_subpass(CommandBuffer& commands) { commands.record<cmd::NextSubpass>(); }

void record_end_render_pass(CommandBuffer& commands) { commands.record<cmd::EndRenderPass>(); }

void record_execute_commands(CommandBuffer& commands, std::span<const VkCommandBuffer> buffers) {
  const std::span<CommandBuffer*> list = commands.array<CommandBuffer*>(buffers.size());
  for (size_t i = 0; i < buffers.size(); ++i) list[i] = CommandBuffer::from(buffers[i]);
  commands.record<cmd::ExecuteCommands>().buffers = list;
}

}  // namespace lapilli
