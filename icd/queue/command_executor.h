// Runs recorded command buffers on the queue's thread.
#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include "command/record.h"
#include "queue/bound_state.h"
#include "queue/frame_ledger.h"
#include "queue/pass_state.h"

namespace lapilli {

struct CommandExecutor {
  CommandExecutor(DeviceContext& owner, ThreadPool& workers);

  DeviceContext& device;
  ThreadPool& pool;
  std::optional<Renderer> renderer;  // made for the first draw
  BoundState state;
  PassState pass;
  Arena arena;                               // of the blocks of draws, until these are rendered
  uint64_t* samples_passed = nullptr;        // of the active occlusion query
  std::unique_ptr<FrameLedger> ledger;       // null: nobody asks
  std::vector<VkDebugUtilsLabelEXT> labels;  // open in the command buffer
  uint64_t ledgers_printed = 0;
  VkResult result = VK_SUCCESS;  // the first failure; nothing is executed after it

  // A command buffer from its beginning to its end; bound state starts anew.
  VkResult run(const CommandBuffer& buffer);
  // Prints what the draws since the last time were spared, if there are any.
  void print_ledger();
  // Frees the blocks of draws: those that come make new ones.
  void drop_blocks();
  // Of one call of the renderer or of one dispatch.
  void start(ExecutionLimits& limits) const;
  void fail(VkResult code, const char* what);
};

void execute_commands(CommandExecutor& executor, const CommandBuffer& buffer);

// One handler for each kind of command, in the file of its chapter.
// execute_state.cpp
void execute(CommandExecutor& executor, const cmd::BindPipeline& command);
void execute(CommandExecutor& executor, const cmd::BindDescriptorSets& command);
void execute(CommandExecutor& executor, const cmd::BindVertexBuffers& command);
void execute(CommandExecutor& executor, const cmd::BindIndexBuffer& command);
void execute(CommandExecutor& executor, const cmd::PushConstants& command);
void execute(CommandExecutor& executor, const cmd::SetViewport& command);
void execute(CommandExecutor& executor, const cmd::SetScissor& command);
void execute(CommandExecutor& executor, const cmd::SetLineWidth& command);
void execute(CommandExecutor& executor, const cmd::SetDepthBias& command);
void execute(CommandExecutor& executor, const cmd::SetBlendConstants& command);
// execute_draw.cpp
void execute(CommandExecutor& executor, const cmd::Draw& command);
void execute(CommandExecutor& executor, const cmd::DrawIndexed& command);
void execute(CommandExecutor& executor, const cmd::DrawIndirect& command);
void execute(CommandExecutor& executor, const cmd::Dispatch& command);
void execute(CommandExecutor& executor, const cmd::DispatchIndirect& command);
// execute_copy.cpp
void execute(CommandExecutor& executor, const cmd::CopyBuffer& command);
void execute(CommandExecutor& executor, const cmd::CopyImage& command);
void execute(CommandExecutor& executor, const cmd::CopyBufferToImage& command);
void execute(CommandExecutor& executor, const cmd::CopyImageToBuffer& command);
void execute(CommandExecutor& executor, const cmd::UpdateBuffer& command);
void execute(CommandExecutor& executor, const cmd::FillBuffer& command);
// execute_blit.cpp
void execute(CommandExecutor& executor, const cmd::BlitImage& command);
// execute_clear.cpp
void execute(CommandExecutor& executor, const cmd::ClearImage& command);
void execute(CommandExecutor& executor, const cmd::ClearAttachments& command);
// execute_pass.cpp
void execute(CommandExecutor& executor, const cmd::BeginRenderPass& command);
void execute(CommandExecutor& executor, const cmd::NextSubpass& command);
void execute(CommandExecutor& executor, const cmd::EndRenderPass& command);
// execute_sync.cpp
void execute(CommandExecutor& executor, const cmd::VertexBarrier& command);
void execute(CommandExecutor& executor, const cmd::SetEvent& command);
void execute(CommandExecutor& executor, const cmd::WaitEvents& command);
void execute(CommandExecutor& executor, const cmd::ResetQueryPool& command);
void execute(CommandExecutor& executor, const cmd::BeginQuery& command);
void execute(CommandExecutor& executor, const cmd::EndQuery& command);
void execute(CommandExecutor& executor, const cmd::WriteTimestamp& command);
void execute(CommandExecutor& executor, const cmd::CopyQueryPoolResults& command);
void execute(CommandExecutor& executor, const cmd::BeginLabel& command);
void execute(CommandExecutor& executor, const cmd::EndLabel& command);

// execute_clear.cpp: `layers` layers of a view from `first_layer` on; the rectangle is clipped to the view.
void clear_rectangle(const ImageView& view, const VkRect2D& rectangle, uint32_t first_layer, uint32_t layers,
                     const VkClearValue& value);

}  // namespace lapilli
