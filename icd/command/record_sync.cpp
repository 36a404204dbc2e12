// Recording of events, queries and labels.
#include <cstring>

#include "command/record.h"

namespace lapilli {

void record_set_event(CommandBuffer& commands, Event* event, bool signaled) {
  auto& command = commands.record<cmd::SetEvent>();
  command.event = event;
  command.signaled = signaled;
}

void record_wait_events(CommandBuffer& commands, std::span<const VkEvent> events) {
  const std::span<Event*> list = commands.array<Event*>(events.size());
  for (size_t i = 0; i < events.size(); ++i) list[i] = Event::from(events[i]);
  commands.record<cmd::WaitEvents>().events = list;
}

void record_reset_query_pool(CommandBuffer& commands, QueryPool* pool, uint32_t first, uint32_t count) {
  auto& command = commands.record<cmd::ResetQueryPool>();
  command.pool = pool;
  command.first = first;
  command.count = count;
}

namespace {

template <class C>
void record_query(CommandBuffer& commands, QueryPool* pool, uint32_t query) {
  if (query >= pool->queries.size()) return;
  C& command = commands.record<C>();
  command.pool = pool;
  command.query = query;
}

}  // namespace

void record_begin_query(CommandBuffer& commands, QueryPool* pool, uint32_t query) {
  record_query<cmd::BeginQuery>(commands, pool, query);
}

void record_end_query(CommandBuffer& commands, QueryPool* pool, uint32_t query) {
  record_query<cmd::EndQuery>(commands, pool, query);
}

void record_write_timestamp(CommandBuffer& commands, QueryPool* pool, uint32_t query) {
  record_query<cmd::WriteTimestamp>(commands, pool, query);
}

void record_copy_query_pool_results(CommandBuffer& commands, QueryPool* pool, uint32_t first, uint32_t count,
                                    Buffer* target, const QueryCopy& copy) {
  auto& command = commands.record<cmd::CopyQueryPoolResults>();
  command.pool = pool;
  command.first = first;
  command.count = count;
  command.target = target;
  command.offset = copy.offset;
  command.stride = copy.stride;
  command.flags = copy.flags;
}

void record_begin_label(CommandBuffer& commands, const char* name) {
  const std::span<const char> text = commands.copy(std::span(name, std::strlen(name) + 1));
  commands.record<cmd::BeginLabel>().name = text.data();
}

void record_end_label(CommandBuffer& commands) { commands.record<cmd::EndLabel>(); }

}  // namespace lapilli
