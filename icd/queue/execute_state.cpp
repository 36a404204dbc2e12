// Bindings and dynamic state.
#include <algorithm>

#include "queue/command_executor.h"

namespace lapilli {

void execute(CommandExecutor& executor, const cmd::BindPipeline& command) {
  executor.state.at(command.pipeline->bind_point).pipeline = command.pipeline;
}

void execute(CommandExecutor& executor, const cmd::BindDescriptorSets& command) {
  std::copy(command.sets.begin(), command.sets.end(), executor.state.at(command.bind_point).sets + command.first);
}

void execute(CommandExecutor& executor, const cmd::BindVertexBuffers& command) {
  std::copy(command.buffers.begin(), command.buffers.end(), executor.state.vertex_buffers + command.first);
}

void execute(CommandExecutor& executor, const cmd::BindIndexBuffer& command) {
  executor.state.index_buffer = command.buffer;
  executor.state.index_offset = command.offset;
  executor.state.index_type = command.type;
}

void execute(CommandExecutor& executor, const cmd::PushConstants& command) {
  std::copy(command.values.begin(), command.values.end(), executor.state.push_constants + command.offset);
}

void execute(CommandExecutor& executor, const cmd::SetViewport& command) {
  executor.state.dynamic.viewport = command.viewport;
}

void execute(CommandExecutor& executor, const cmd::SetScissor& command) {
  executor.state.dynamic.scissor = command.scissor;
}

void execute(CommandExecutor& executor, const cmd::SetLineWidth& command) {
  executor.state.dynamic.line_width = command.width;
}

void execute(CommandExecutor& executor, const cmd::SetDepthBias& command) {
  executor.state.dynamic.depth_bias_constant = command.constant;
  executor.state.dynamic.depth_bias_clamp = command.clamp;
  executor.state.dynamic.depth_bias_slope = command.slope;
}

void execute(CommandExecutor& executor, const cmd::SetBlendConstants& command) {
  std::copy(std::begin(command.values), std::end(command.values), executor.state.dynamic.blend_constants);
}

}  // namespace lapilli
