// Draws are collected for the subpass; dispatches run at once.
// Specification: chapters "Drawing Commands", "Dispatching Commands".
#include <cstring>

#include "base/log.h"
#include "object/limits.h"
#include "queue/command_executor.h"
#include "shader/compute.h"

namespace lapilli {
namespace {

// Whether the subpass has the attachments that the pipeline's programs write: memory is at stake, not only validity.
bool fits_subpass(const GraphicsPart& pipeline, const PassState& pass) {
  const Subpass& subpass = pass.pass->subpasses[pass.subpass];
  for (size_t i = 0; i < pipeline.color_formats.size(); ++i) {
    if (pipeline.color_formats[i] == VK_FORMAT_UNDEFINED) continue;
    if (i >= subpass.color.size() || pass.pass->format_of(subpass.color[i]) != pipeline.color_formats[i]) return false;
  }
  return pipeline.depth_format == VK_FORMAT_UNDEFINED || pass.pass->format_of(subpass.depth) == pipeline.depth_format;
}

// False if a draw with the bound pipeline can have no effect here.
bool may_draw(const CommandExecutor& executor) {
  const Pipeline* pipeline = executor.state.graphics.pipeline;
  if (executor.pass.pass == nullptr || pipeline == nullptr) return false;
  if (pipeline->graphics.rasterizer_discard) return pipeline->graphics.programs.vertices_store;
  if (fits_subpass(pipeline->graphics, executor.pass)) return true;
  log_error("a draw with a pipeline for other attachments than the subpass has");
  return false;
}

// Brings the blocks up to date with what is bound; false if nothing is to be drawn with that.
bool prepare_draws(CommandExecutor& executor) {
  if ((executor.state.stale & kStaleState) != 0 && !may_draw(executor)) return false;
  if (refresh_blocks(executor.state, executor.arena)) return true;
  executor.fail(VK_ERROR_OUT_OF_HOST_MEMORY, "out of memory for a draw");
  return false;
}

// The draw with everything bound, its counts still to be filled in; null if it can have no effect.
DrawCall* add_draw(CommandExecutor& executor, uint32_t count, uint32_t instances) {
  if (count == 0 || instances == 0) return nullptr;
  if (executor.pass.draws.size() == kMaxDraws) flush_pass(executor, false);
  // Nothing is stale: the draw before was prepared in the same subpass with the same state.
  if (executor.state.stale != 0 && !prepare_draws(executor)) return nullptr;
  DrawCall& draw = executor.pass.draws.emplace_back(executor.state.blocks);
  draw.count = count;
  draw.instance_count = instances;
  draw.samples_passed = executor.samples_passed;
  if (executor.ledger != nullptr) draw.ledger = executor.ledger->add_draw(*draw.state->programs);
  return &draw;
}

void draw(CommandExecutor& executor, const VkDrawIndirectCommand& command, uint32_t index = 0) {
  DrawCall* call = add_draw(executor, command.vertexCount, command.instanceCount);
  if (call == nullptr) return;
  call->first = command.firstVertex;
  call->draw_index = index;
  call->first_instance = command.firstInstance;
}

void draw(CommandExecutor& executor, const VkDrawIndexedIndirectCommand& command, uint32_t index = 0) {
  DrawCall* call = add_draw(executor, command.indexCount, command.instanceCount);
  if (call == nullptr) return;
  call->first = command.firstIndex;
  call->draw_index = index;
  call->vertex_offset = command.vertexOffset;
  call->first_instance = command.firstInstance;
  call->indices = executor.state.indices;
}

// Reads one structure of an indirect command; false if it does not lie in the buffer.
template <class T>
bool read(Buffer& buffer, uint64_t offset, T& out) {
  const BufferMemory bytes = buffer.bytes(offset, sizeof(T));
  if (bytes.size < sizeof(T)) return false;
  std::memcpy(&out, bytes.data, sizeof(T));
  return true;
}

template <class T>
void draw_indirect(CommandExecutor& executor, const cmd::DrawIndirect& command) {
  for (uint32_t i = 0; i < command.count && executor.result == VK_SUCCESS; ++i) {
    T parameters;
    if (!read(*command.buffer, command.offset + uint64_t{i} * command.stride, parameters)) return;
    draw(executor, parameters, i);
  }
}

void run_compute(CommandExecutor& executor, const uint32_t groups[3]) {
  const Pipeline* pipeline = executor.state.compute.pipeline;
  if (pipeline == nullptr || groups[0] == 0 || groups[1] == 0 || groups[2] == 0) return;
  for (int axis = 0; axis < 3; ++axis) {
    if (groups[axis] > kMaxWorkgroupCount) {
      log_error("a dispatch of %u x %u x %u workgroups is above the limit", groups[0], groups[1], groups[2]);
      return;
    }
  }
  ResourceTable resources;
  ExecutionLimits limits;
  executor.start(limits);
  const bool done = flatten_resources(executor.state, executor.state.compute, executor.arena, resources) &&
                    dispatch(executor.pool, *pipeline->compute, resources, groups, &limits);
  if (!done) executor.fail(VK_ERROR_OUT_OF_HOST_MEMORY, "out of memory for a dispatch");
  if (limits.expired) executor.fail(VK_ERROR_DEVICE_LOST, "a compute shader ran past the time limit");
  if (executor.pass.pass == nullptr) executor.drop_blocks();
}

}  // namespace

void execute(CommandExecutor& executor, const cmd::Draw& command) { draw(executor, command.draw); }

void execute(CommandExecutor& executor, const cmd::DrawIndexed& command) { draw(executor, command.draw); }

void execute(CommandExecutor& executor, const cmd::DrawIndirect& command) {
  if (command.indexed) {
    draw_indirect<VkDrawIndexedIndirectCommand>(executor, command);
  } else {
    draw_indirect<VkDrawIndirectCommand>(executor, command);
  }
}

void execute(CommandExecutor& executor, const cmd::Dispatch& command) { run_compute(executor, command.groups); }

void execute(CommandExecutor& executor, const cmd::DispatchIndirect& command) {
  VkDispatchIndirectCommand parameters;
  if (!read(*command.buffer, command.offset, parameters)) return;
  const uint32_t groups[3] = {parameters.x, parameters.y, parameters.z};
  run_compute(executor, groups);
}

}  // namespace lapilli
