// Barriers, events, queries and labels.
// Specification: chapters "Synchronization and Cache Control", "Queries", "Debugging".
#include <algorithm>

#include "queue/command_executor.h"

namespace lapilli {

void execute(CommandExecutor& executor, const cmd::VertexBarrier&) {
  if (executor.pass.pass != nullptr && !executor.pass.draws.empty()) flush_pass(executor, false);
}

void execute(CommandExecutor& executor, const cmd::SetEvent& command) {
  set_signaled(executor.device, *command.event, command.signaled);
}

// An event may be set by the host while the queue waits.
void execute(CommandExecutor& executor, const cmd::WaitEvents& command) {
  DeviceContext& device = executor.device;
  std::unique_lock lock(device.sync.mutex);
  device.sync.changed.wait(lock, [&] {
    return device.lost || std::ranges::all_of(command.events, [](const Event* event) { return event->signaled; });
  });
}

void execute(CommandExecutor&, const cmd::ResetQueryPool& command) {
  command.pool->reset(command.first, command.count);
}

void execute(CommandExecutor& executor, const cmd::BeginQuery& command) {
  executor.samples_passed = &command.pool->queries[command.query].value;
  *executor.samples_passed = 0;
}

// The draws of a render pass are counted when they are rendered: until then the result is not available.
void execute(CommandExecutor& executor, const cmd::EndQuery& command) {
  executor.samples_passed = nullptr;
  if (executor.pass.pass != nullptr) {
    executor.pass.ended_queries.emplace_back(command.pool, command.query);
  } else {
    command.pool->make_available(command.query);
  }
}

void execute(CommandExecutor& executor, const cmd::WriteTimestamp& command) {
  // Collected draws belong before the timestamp.
  if (executor.pass.pass != nullptr && !executor.pass.draws.empty()) flush_pass(executor, false);
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  command.pool->queries[command.query].value =
      static_cast<uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(now).count());
  command.pool->make_available(command.query);
}

void execute(CommandExecutor&, const cmd::CopyQueryPoolResults& command) {
  const BufferMemory target = command.target->bytes(command.offset);
  // What was begun before has ended: the queue works in order. A query that never began would be waited for in vain.
  const VkQueryResultFlags flags = command.flags & ~VkQueryResultFlags{VK_QUERY_RESULT_WAIT_BIT};
  get_query_results(*command.pool, command.first, command.count, {target.data, target.size, command.stride}, flags);
}

void execute(CommandExecutor& executor, const cmd::BeginLabel& command) {
  VkDebugUtilsLabelEXT label = {};
  label.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT;
  label.pLabelName = command.name;
  executor.labels.push_back(label);
}

void execute(CommandExecutor& executor, const cmd::EndLabel&) {
  if (!executor.labels.empty()) executor.labels.pop_back();
}

}  // namespace lapilli
