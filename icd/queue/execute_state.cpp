// Bindings and dynamic state.
#include "queue/command_executor.h"

namespace lapilli {

void execute(CommandExecutor& executor, const cmd::BindPipeline& command) {
  bind_pipeline(executor.state, *command.pipeline);
}

void execute(CommandExecutor& executor, const cmd::BindDescriptorSets& command) { bind_sets(executor.state, command); }

void execute(CommandExecutor& executor, const cmd::BindVertexBuffers& command) {
  bind_vertex_buffers(executor.state, command);
}

void execute(CommandExecutor& executor, const cmd::BindIndexBuffer& command) {
  bind_index_buffer(executor.state, command);
}

void execute(CommandExecutor& executor, const cmd::PushConstants& command) { push_constants(executor.state, command); }

void execute(CommandExecutor& executor, const cmd::SetViewport& command) {
  set_dynamic(executor.state, executor.state.dynamic.viewport, command.viewport);
}

void execute(CommandExecutor& executor, const cmd::SetScissor& command) {
  set_dynamic(executor.state, executor.state.dynamic.scissor, command.scissor);
}

void execute(CommandExecutor& executor, const cmd::SetLineWidth& command) {
  set_dynamic(executor.state, executor.state.dynamic.line_width, command.width);
}

void execute(CommandExecutor& executor, const cmd::SetDepthBias& command) {
  DynamicState& dynamic = executor.state.dynamic;
  set_dynamic(executor.state, dynamic.depth_bias_constant, command.constant);
  set_dynamic(executor.state, dynamic.depth_bias_clamp, command.clamp);
  set_dynamic(executor.state, dynamic.depth_bias_slope, command.slope);
}

void execute(CommandExecutor& executor, const cmd::SetBlendConstants& command) {
  set_dynamic(executor.state, executor.state.dynamic.blend_constants, command.values);
}

}  // namespace lapilli
