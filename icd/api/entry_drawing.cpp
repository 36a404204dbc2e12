// Entry points of chapters "Drawing Commands" and "Dispatching Commands".
#include "api/entry.h"

namespace lapilli::entry {

VKAPI_ATTR void VKAPI_CALL vkCmdBindVertexBuffers(VkCommandBuffer commands, uint32_t first, uint32_t count,
                                                  const VkBuffer* buffers, const VkDeviceSize* offsets) {
  record_bind_vertex_buffers(*CommandBuffer::from(commands), first, list(buffers, count), offsets);
}

VKAPI_ATTR void VKAPI_CALL vkCmdBindIndexBuffer(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset,
                                                VkIndexType type) {
  record_bind_index_buffer(*CommandBuffer::from(commands), Buffer::from(buffer), offset, type);
}

VKAPI_ATTR void VKAPI_CALL vkCmdDraw(VkCommandBuffer commands, uint32_t vertices, uint32_t instances,
                                     uint32_t first_vertex, uint32_t first_instance) {
  record_draw(*CommandBuffer::from(commands), {vertices, instances, first_vertex, first_instance});
}

VKAPI_ATTR void VKAPI_CALL vkCmdDrawIndexed(VkCommandBuffer commands, uint32_t indices, uint32_t instances,
                                            uint32_t first_index, int32_t vertex_offset, uint32_t first_instance) {
  record_draw_indexed(*CommandBuffer::from(commands), {indices, instances, first_index, vertex_offset, first_instance});
}

VKAPI_ATTR void VKAPI_CALL vkCmdDrawIndirect(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset,
                                             uint32_t count, uint32_t stride) {
  record_draw_indirect(*CommandBuffer::from(commands), {Buffer::from(buffer), offset, count, stride, false});
}

VKAPI_ATTR void VKAPI_CALL vkCmdDrawIndexedIndirect(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset,
                                                    uint32_t count, uint32_t stride) {
  record_draw_indirect(*CommandBuffer::from(commands), {Buffer::from(buffer), offset, count, stride, true});
}

VKAPI_ATTR void VKAPI_CALL vkCmdDispatch(VkCommandBuffer commands, uint32_t x, uint32_t y, uint32_t z) {
  record_dispatch(*CommandBuffer::from(commands), x, y, z);
}

VKAPI_ATTR void VKAPI_CALL vkCmdDispatchIndirect(VkCommandBuffer commands, VkBuffer buffer, VkDeviceSize offset) {
  record_dispatch_indirect(*CommandBuffer::from(commands), Buffer::from(buffer), offset);
}

}  // namespace lapilli::entry
