// vkCmd…: each function appends what the queue will do. Arguments are objects and spans; api/ casts the handles.
// All throw std::bad_alloc. Specification: chapters "Command Buffers" to "Copy Commands".
#pragma once

#include "command/command_buffer.h"
#include "command/copy_commands.h"
#include "command/draw_commands.h"
#include "command/pass_commands.h"
#include "command/state_commands.h"
#include "command/sync_commands.h"

namespace lapilli {

// record_state.cpp
void record_bind_pipeline(CommandBuffer& commands, const Pipeline& pipeline);
void record_bind_descriptor_sets(CommandBuffer& commands, VkPipelineBindPoint bind_point, const PipelineLayout& layout,
                                 uint32_t first, std::span<const VkDescriptorSet> sets,
                                 std::span<const uint32_t> dynamic_offsets);
void record_bind_vertex_buffers(CommandBuffer& commands, uint32_t first, std::span<const VkBuffer> buffers,
                                const VkDeviceSize* offsets);
void record_bind_index_buffer(CommandBuffer& commands, Buffer* buffer, uint64_t offset, VkIndexType type);
void record_push_constants(CommandBuffer& commands, uint32_t offset, std::span<const std::byte> values);
void record_set_viewport(CommandBuffer& commands, uint32_t first, std::span<const VkViewport> viewports);
void record_set_scissor(CommandBuffer& commands, uint32_t first, std::span<const VkRect2D> scissors);
void record_set_line_width(CommandBuffer& commands, float width);
void record_set_depth_bias(CommandBuffer& commands, float constant, float clamp, float slope);
void record_set_blend_constants(CommandBuffer& commands, const float values[4]);

// record_draw.cpp
void record_draw(CommandBuffer& commands, const VkDrawIndirectCommand& draw);
void record_draw_indexed(CommandBuffer& commands, const VkDrawIndexedIndirectCommand& draw);
struct IndirectDraws {
  Buffer* buffer = nullptr;
  uint64_t offset = 0;  // bytes
  uint32_t count = 0;
  uint32_t stride = 0;  // bytes
  bool indexed = false;
};
void record_draw_indirect(CommandBuffer& commands, const IndirectDraws& draws);
void record_dispatch(CommandBuffer& commands, uint32_t x, uint32_t y, uint32_t z);
void record_dispatch_indirect(CommandBuffer& commands, Buffer* buffer, uint64_t offset);

// record_copy.cpp
void record_copy_buffer(CommandBuffer& commands, Buffer* source, Buffer* target, std::span<const VkBufferCopy> regions);
void record_copy_image(CommandBuffer& commands, Image* source, Image* target, std::span<const VkImageCopy> regions);
void record_copy_buffer_to_image(CommandBuffer& commands, Buffer* source, Image* target,
                                 std::span<const VkBufferImageCopy> regions);
void record_copy_image_to_buffer(CommandBuffer& commands, Image* source, Buffer* target,
                                 std::span<const VkBufferImageCopy> regions);
void record_blit_image(CommandBuffer& commands, Image* source, Image* target, std::span<const VkImageBlit> regions,
                       VkFilter filter);
void record_update_buffer(CommandBuffer& commands, Buffer* target, uint64_t offset, std::span<const std::byte> data);
void record_fill_buffer(CommandBuffer& commands, Buffer* target, uint64_t offset, uint64_t size, uint32_t word);
void record_clear_image(CommandBuffer& commands, Image* image, const VkClearValue& value,
                        std::span<const VkImageSubresourceRange> ranges);
void record_clear_attachments(CommandBuffer& commands, std::span<const VkClearAttachment> attachments,
                              std::span<const VkClearRect> rectangles);

// record_pass.cpp
void record_begin_render_pass(CommandBuffer& commands, const VkRenderPassBeginInfo& info);
void record_next_subpass(CommandBuffer& commands);
void record_end_render_pass(CommandBuffer& commands);
void record_execute_commands(CommandBuffer& commands, std::span<const VkCommandBuffer> buffers);

// record_sync.cpp
void record_barrier(CommandBuffer& commands, VkPipelineStageFlags from, VkPipelineStageFlags to);
void record_set_event(CommandBuffer& commands, Event* event, bool signaled);
void record_wait_events(CommandBuffer& commands, std::span<const VkEvent> events);
void record_reset_query_pool(CommandBuffer& commands, QueryPool* pool, uint32_t first, uint32_t count);
void record_begin_query(CommandBuffer& commands, QueryPool* pool, uint32_t query);
void record_end_query(CommandBuffer& commands, QueryPool* pool, uint32_t query);
void record_write_timestamp(CommandBuffer& commands, QueryPool* pool, uint32_t query);
struct QueryCopy {
  uint64_t offset = 0;  // bytes
  uint64_t stride = 0;  // bytes
  VkQueryResultFlags flags = 0;
};
void record_copy_query_pool_results(CommandBuffer& commands, QueryPool* pool, uint32_t first, uint32_t count,
                                    Buffer* target, const QueryCopy& copy);
void record_begin_label(CommandBuffer& commands, const char* name);
void record_end_label(CommandBuffer& commands);

}  // namespace lapilli
