// Render passes and secondary command buffers. Specification: chapters "Render Pass", "Command Buffers".
#pragma once

#include <span>

#include "command/command.h"
#include "object/render_pass.h"

namespace lapilli {

struct CommandBuffer;

namespace cmd {

struct BeginRenderPass : CommandOf<CommandKind::kBeginRenderPass> {
  const RenderPass* pass = nullptr;
  const Framebuffer* framebuffer = nullptr;
  VkRect2D area = {};
  std::span<const VkClearValue> clear_values;
};
struct NextSubpass : CommandOf<CommandKind::kNextSubpass> {};
struct EndRenderPass : CommandOf<CommandKind::kEndRenderPass> {};

struct ExecuteCommands : CommandOf<CommandKind::kExecuteCommands> {
  std::span<CommandBuffer* const> buffers;
};

}  // namespace cmd
}  // namespace lapilli
