// Recording of draws and dispatches.
#include "command/record.h"

namespace lapilli {

void record_draw(CommandBuffer& commands, const VkDrawIndirectCommand& draw) {
  commands.record<cmd::Draw>().draw = draw;
}

void record_draw_indexed(CommandBuffer& commands, const VkDrawIndexedIndirectCommand& draw) {
  commands.record<cmd::DrawIndexed>().draw = draw;
}

void record_draw_indirect(CommandBuffer& commands, const IndirectDraws& draws) {
  auto& command = commands.record<cmd::DrawIndirect>();
  command.buffer = draws.buffer;
  command.offset = draws.offset;
  command.count = draws.count;
  command.stride = draws.stride;
  command.indexed = draws.indexed;
}

void record_dispatch(CommandBuffer& commands, uint32_t x, uint32_t y, uint32_t z) {
  auto& command = commands.record<cmd::Dispatch>();
  command.groups[0] = x;
  command.groups[1] = y;
  command.groups[2] = z;
}

void record_dispatch_indirect(CommandBuffer& commands, Buffer* buffer, uint64_t offset) {
  auto& command = commands.record<cmd::DispatchIndirect>();
  command.buffer = buffer;
  command.offset = offset;
}

}  // namespace lapilli
