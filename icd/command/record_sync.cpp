// Recording of barriers, events, queries and labels.
#include <cstring>

#include "command/record.h"

namespace lapilli {

// Memory is coherent, layouts do not change how an image lies in memory, and the queue executes one command after the
// other: every barrier is already kept, but for those between the vertices of a render pass, all of which are run at
// once. (Fragments come in the order of their draws, pixel by pixel: that is all a barrier between them may ask for.)
void record_barrier(CommandBuffer& commands, VkPipelineStageFlags from, VkPipelineStageFlags to) {
  constexpr VkPipelineStageFlags kVertices = VK_PIPELINE_STAGE_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_VERTEX_INPUT_BIT |
                                             VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_ALL_GRAPHICS_BIT |
                                             VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
  if ((from & kVertices) != 0 && (to & kVertices) != 0) commands.record<cmd::VertexBarrier>();
}

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
