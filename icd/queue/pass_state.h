// The render pass that is running: its draws are collected and rendered at the end of each subpass.
// Specification: chapter "Render Pass".
#pragma once

#include <vector>

#include "command/pass_commands.h"
#include "raster/render_pass.h"

namespace lapilli {

struct CommandExecutor;

struct PassState {
  const RenderPass* pass = nullptr;  // null outside of one
  const Framebuffer* framebuffer = nullptr;
  VkRect2D area = {};  // inside the framebuffer
  std::span<const VkClearValue> clear_values;
  uint32_t subpass = 0;
  std::vector<bool> loaded;                                    // attachments whose load operation has been done
  std::vector<DrawCall> draws;                                 // of this subpass, not yet rendered
  std::vector<std::pair<QueryPool*, uint32_t>> ended_queries;  // available once the draws are rendered
};

// Renders what has been collected. `end_of_subpass`: store operations are due.
void flush_pass(CommandExecutor& executor, bool end_of_subpass);

}  // namespace lapilli
