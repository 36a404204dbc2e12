// The switch over all commands.
#include "queue/command_executor.h"

#include <cstdio>

#include "base/log.h"

namespace lapilli {
namespace {

constexpr size_t kArenaLimit = size_t{1} << 30;  // bytes

template <class C>
void execute_as(CommandExecutor& executor, const Command& command) {
  execute(executor, static_cast<const C&>(command));
}

// State set before or by the secondary command buffers is undefined after them, so that it may as well start anew.
void execute_secondaries(CommandExecutor& executor, const cmd::ExecuteCommands& command) {
  for (const CommandBuffer* buffer : command.buffers) {
    executor.state = {};
    execute_commands(executor, *buffer);
  }
  executor.state = {};
}

void execute_one(CommandExecutor& executor, const Command& command) {
  switch (command.kind) {
    case CommandKind::kBindPipeline:
      return execute_as<cmd::BindPipeline>(executor, command);
    case CommandKind::kBindDescriptorSets:
      return execute_as<cmd::BindDescriptorSets>(executor, command);
    case CommandKind::kBindVertexBuffers:
      return execute_as<cmd::BindVertexBuffers>(executor, command);
    case CommandKind::kBindIndexBuffer:
      return execute_as<cmd::BindIndexBuffer>(executor, command);
    case CommandKind::kPushConstants:
      return execute_as<cmd::PushConstants>(executor, command);
    case CommandKind::kSetViewport:
      return execute_as<cmd::SetViewport>(executor, command);
    case CommandKind::kSetScissor:
      return execute_as<cmd::SetScissor>(executor, command);
    case CommandKind::kSetLineWidth:
      return execute_as<cmd::SetLineWidth>(executor, command);
    case CommandKind::kSetDepthBias:
      return execute_as<cmd::SetDepthBias>(executor, command);
    case CommandKind::kSetBlendConstants:
      return execute_as<cmd::SetBlendConstants>(executor, command);
    case CommandKind::kDraw:
      return execute_as<cmd::Draw>(executor, command);
    case CommandKind::kDrawIndexed:
      return execute_as<cmd::DrawIndexed>(executor, command);
    case CommandKind::kDrawIndirect:
      return execute_as<cmd::DrawIndirect>(executor, command);
    case CommandKind::kDispatch:
      return execute_as<cmd::Dispatch>(executor, command);
    case CommandKind::kDispatchIndirect:
      return execute_as<cmd::DispatchIndirect>(executor, command);
    case CommandKind::kCopyBuffer:
      return execute_as<cmd::CopyBuffer>(executor, command);
    case CommandKind::kCopyImage:
      return execute_as<cmd::CopyImage>(executor, command);
    case CommandKind::kCopyBufferToImage:
      return execute_as<cmd::CopyBufferToImage>(executor, command);
    case CommandKind::kCopyImageToBuffer:
      return execute_as<cmd::CopyImageToBuffer>(executor, command);
    case CommandKind::kBlitImage:
      return execute_as<cmd::BlitImage>(executor, command);
    case CommandKind::kUpdateBuffer:
      return execute_as<cmd::UpdateBuffer>(executor, command);
    case CommandKind::kFillBuffer:
      return execute_as<cmd::FillBuffer>(executor, command);
    case CommandKind::kClearImage:
      return execute_as<cmd::ClearImage>(executor, command);
    case CommandKind::kClearAttachments:
      return execute_as<cmd::ClearAttachments>(executor, command);
    case CommandKind::kBeginRenderPass:
      return execute_as<cmd::BeginRenderPass>(executor, command);
    case CommandKind::kNextSubpass:
      return execute_as<cmd::NextSubpass>(executor, command);
    case CommandKind::kEndRenderPass:
      return execute_as<cmd::EndRenderPass>(executor, command);
    case CommandKind::kExecuteCommands:
      return execute_secondaries(executor, static_cast<const cmd::ExecuteCommands&>(command));
    case CommandKind::kVertexBarrier:
      return execute_as<cmd::VertexBarrier>(executor, command);
    case CommandKind::kSetEvent:
      return execute_as<cmd::SetEvent>(executor, command);
    case CommandKind::kWaitEvents:
      return execute_as<cmd::WaitEvents>(executor, command);
    case CommandKind::kResetQueryPool:
      return execute_as<cmd::ResetQueryPool>(executor, command);
    case CommandKind::kBeginQuery:
      return execute_as<cmd::BeginQuery>(executor, command);
    case CommandKind::kEndQuery:
      return execute_as<cmd::EndQuery>(executor, command);
    case CommandKind::kWriteTimestamp:
      return execute_as<cmd::WriteTimestamp>(executor, command);
    case CommandKind::kCopyQueryPoolResults:
      return execute_as<cmd::CopyQueryPoolResults>(executor, command);
    case CommandKind::kBeginLabel:
      return execute_as<cmd::BeginLabel>(executor, command);
    case CommandKind::kEndLabel:
      return execute_as<cmd::EndLabel>(executor, command);
  }
}

}  // namespace

CommandExecutor::CommandExecutor(DeviceContext& owner, ThreadPool& workers)
    : device(owner), pool(workers), arena(kArenaLimit) {
  if (owner.physical_device.environment.stats) ledger = std::make_unique<FrameLedger>();
}

VkResult CommandExecutor::run(const CommandBuffer& buffer) {
  state = {};
  pass.pass = nullptr;  // a buffer that left one open must not lend its objects to the next
  samples_passed = nullptr;
  result = VK_SUCCESS;
  execute_commands(*this, buffer);
  labels.clear();
  return result;
}

void CommandExecutor::print_ledger() {
  if (ledger == nullptr || ledger->empty()) return;
  const std::string text = ledger->text(++ledgers_printed);
  std::fwrite(text.data(), 1, text.size(), stderr);
  ledger->clear();
}

void CommandExecutor::drop_blocks() {
  arena.reset();
  state.stale = kStaleAll;
}

void CommandExecutor::start(ExecutionLimits& limits) const {
  limits.deadline = std::chrono::steady_clock::now() + device.physical_device.environment.timeout;
}

void CommandExecutor::fail(VkResult code, const char* what) {
  if (result != VK_SUCCESS) return;
  result = code;
  log_error("%s", what);
}

void execute_commands(CommandExecutor& executor, const CommandBuffer& buffer) {
  for (const Command* command = buffer.first; command != nullptr; command = command->next) {
    if (executor.result != VK_SUCCESS) return;
    execute_one(executor, *command);
  }
}

}  // namespace lapilli
