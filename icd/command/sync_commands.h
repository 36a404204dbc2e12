// Events, queries, labels, and the only barriers that matter: the queue runs its commands in order but for draws.
// Specification: chapters "Synchronization and Cache Control", "Queries", "Debugging".
#pragma once

#include <span>

#include "command/command.h"
#include "object/buffer.h"
#include "object/query_pool.h"
#include "object/sync.h"

namespace lapilli::cmd {

// What comes after it reads in vertex shaders what vertex shaders before it have stored.
struct VertexBarrier : CommandOf<CommandKind::kVertexBarrier> {};

struct SetEvent : CommandOf<CommandKind::kSetEvent> {
  Event* event = nullptr;
  bool signaled = false;
};
struct WaitEvents : CommandOf<CommandKind::kWaitEvents> {
  std::span<Event* const> events;
};

struct ResetQueryPool : CommandOf<CommandKind::kResetQueryPool> {
  QueryPool* pool = nullptr;
  uint32_t first = 0, count = 0;
};
struct BeginQuery : CommandOf<CommandKind::kBeginQuery> {
  QueryPool* pool = nullptr;
  uint32_t query = 0;
};
struct EndQuery : CommandOf<CommandKind::kEndQuery> {
  QueryPool* pool = nullptr;
  uint32_t query = 0;
};
struct WriteTimestamp : CommandOf<CommandKind::kWriteTimestamp> {
  QueryPool* pool = nullptr;
  uint32_t query = 0;
};
struct CopyQueryPoolResults : CommandOf<CommandKind::kCopyQueryPoolResults> {
  QueryPool* pool = nullptr;
  uint32_t first = 0, count = 0;
  Buffer* target = nullptr;
  uint64_t offset = 0;  // bytes
  uint64_t stride = 0;  // bytes
  VkQueryResultFlags flags = 0;
};

struct BeginLabel : CommandOf<CommandKind::kBeginLabel> {
  const char* name = "";
};
struct EndLabel : CommandOf<CommandKind::kEndLabel> {};

}  // namespace lapilli::cmd
