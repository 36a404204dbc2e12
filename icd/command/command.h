// The recorded form of vkCmd…: a list of plain structs, executed in order by queue/.
// The structs themselves are in state_commands.h, draw_commands.h, copy_commands.h, pass_commands.h, sync_commands.h.
#pragma once

#include <cstdint>

namespace lapilli {

enum class CommandKind : uint32_t {
  // state_commands.h
  kBindPipeline,
  kBindDescriptorSets,
  kBindVertexBuffers,
  kBindIndexBuffer,
  kPushConstants,
  kSetViewport,
  kSetScissor,
  kSetLineWidth,
  kSetDepthBias,
  kSetBlendConstants,
  // draw_commands.h
  kDraw,
  kDrawIndexed,
  kDrawIndirect,
  kDispatch,
  kDispatchIndirect,
  // copy_commands.h
  kCopyBuffer,
  kCopyImage,
  kCopyBufferToImage,
  kCopyImageToBuffer,
  kBlitImage,
  kUpdateBuffer,
  kFillBuffer,
  kClearImage,
  kClearAttachments,
  // pass_commands.h
  kBeginRenderPass,
  kNextSubpass,
  kEndRenderPass,
  kExecuteCommands,
  // sync_commands.h
  kVertexBarrier,
  kSetEvent,
  kWaitEvents,
  kResetQueryPool,
  kBeginQuery,
  kEndQuery,
  kWriteTimestamp,
  kCopyQueryPoolResults,
  kBeginLabel,
  kEndLabel,
};

struct Command {
  CommandKind kind;
  const Command* next = nullptr;
};

// Base of the struct of one kind.
template <CommandKind kKindOfThis>
struct CommandOf : Command {
  static constexpr CommandKind kKind = kKindOfThis;
  CommandOf() : Command{kKindOfThis, nullptr} {}
};

}  // namespace lapilli
