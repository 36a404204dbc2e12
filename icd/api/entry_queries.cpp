// Entry points of chapter "Queries".
#include "api/entry.h"

namespace lapilli::entry {

VKAPI_ATTR VkResult VKAPI_CALL vkCreateQueryPool(VkDevice device, const VkQueryPoolCreateInfo* info,
                                                 const VkAllocationCallbacks* callbacks, VkQueryPool* pool) {
  return create_query_pool(*Device::from(device), *info, callbacks, pool);
}

VKAPI_ATTR void VKAPI_CALL vkDestroyQueryPool(VkDevice, VkQueryPool pool, const VkAllocationCallbacks*) {
  destroy(QueryPool::from(pool));
}

VKAPI_ATTR VkResult VKAPI_CALL vkGetQueryPoolResults(VkDevice, VkQueryPool pool, uint32_t first, uint32_t count,
                                                     size_t size, void* data, VkDeviceSize stride,
                                                     VkQueryResultFlags flags) {
  return get_query_results(*QueryPool::from(pool), first, count, {static_cast<std::byte*>(data), size, stride}, flags);
}

VKAPI_ATTR void VKAPI_CALL vkCmdResetQueryPool(VkCommandBuffer commands, VkQueryPool pool, uint32_t first,
                                               uint32_t count) {
  record_reset_query_pool(*CommandBuffer::from(commands), QueryPool::from(pool), first, count);
}

VKAPI_ATTR void VKAPI_CALL vkCmdBeginQuery(VkCommandBuffer commands, VkQueryPool pool, uint32_t query,
                                           VkQueryControlFlags) {
  record_begin_query(*CommandBuffer::from(commands), QueryPool::from(pool), query);
}

VKAPI_ATTR void VKAPI_CALL vkCmdEndQuery(VkCommandBuffer commands, VkQueryPool pool, uint32_t query) {
  record_end_query(*CommandBuffer::from(commands), QueryPool::from(pool), query);
}

VKAPI_ATTR void VKAPI_CALL vkCmdWriteTimestamp(VkCommandBuffer commands, VkPipelineStageFlagBits, VkQueryPool pool,
                                               uint32_t query) {
  record_write_timestamp(*CommandBuffer::from(commands), QueryPool::from(pool), query);
}

VKAPI_ATTR void VKAPI_CALL vkCmdCopyQueryPoolResults(VkCommandBuffer commands, VkQueryPool pool, uint32_t first,
                                                     uint32_t count, VkBuffer target, VkDeviceSize offset,
                                                     VkDeviceSize stride, VkQueryResultFlags flags) {
  record_copy_query_pool_results(*CommandBuffer::from(commands), QueryPool::from(pool), first, count,
                                 Buffer::from(target), {offset, stride, flags});
}

}  // namespace lapilli::entry
