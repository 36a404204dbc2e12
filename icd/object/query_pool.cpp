// Queries and their results.
#include "object/query_pool.h"

#include <cstring>

namespace lapilli {
namespace {

// 256 MB. The specification has no limit; memory for 2^32 queries might be promised, but is not there.
constexpr uint32_t kMaxQueries = 1u << 24;

// A 32-bit result that is too small for the value wraps: the specification allows that or saturation.
void put(std::byte* target, uint64_t index, uint64_t value, bool wide) {
  if (wide) {
    std::memcpy(target + index * 8, &value, 8);
  } else {
    const auto narrow = static_cast<uint32_t>(value);
    std::memcpy(target + index * 4, &narrow, 4);
  }
}

}  // namespace

void QueryPool::reset(uint32_t first, uint32_t count) {
  const std::scoped_lock lock(device.sync.mutex);
  for (uint64_t i = first; i < uint64_t{first} + count && i < queries.size(); ++i) queries[i] = {};
}

void QueryPool::make_available(uint32_t query) {
  const std::scoped_lock lock(device.sync.mutex);
  if (query < queries.size()) queries[query].available = true;
  device.sync.changed.notify_all();
}

VkResult create_query_pool(DeviceContext& device, const VkQueryPoolCreateInfo& info,
                           const VkAllocationCallbacks* callbacks, VkQueryPool* handle) {
  if (info.queryType != VK_QUERY_TYPE_OCCLUSION && info.queryType != VK_QUERY_TYPE_TIMESTAMP) {
    log_error("vkCreateQueryPool: queries of type %d are not supported", info.queryType);
    return VK_ERROR_UNKNOWN;
  }
  if (info.queryCount > kMaxQueries) {
    log_error("vkCreateQueryPool: %u queries are more than the %u that a pool may have", info.queryCount, kMaxQueries);
    return VK_ERROR_OUT_OF_HOST_MEMORY;
  }
  auto pool = make_object<QueryPool>(device.object_memory(callbacks), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT, device,
                                     info.queryCount);
  pool->type = info.queryType;
  return publish(std::move(pool), handle);
}

VkResult get_query_results(QueryPool& pool, uint32_t first, uint32_t count, const QueryResultTarget& target,
                           VkQueryResultFlags flags) {
  const bool wide = (flags & VK_QUERY_RESULT_64_BIT) != 0;
  const bool with_availability = (flags & VK_QUERY_RESULT_WITH_AVAILABILITY_BIT) != 0;
  const uint64_t needed = uint64_t{wide ? 8u : 4u} * (with_availability ? 2 : 1);
  VkResult result = VK_SUCCESS;
  std::unique_lock lock(pool.device.sync.mutex);
  for (uint32_t i = 0; i < count && uint64_t{first} + i < pool.queries.size(); ++i) {
    const Query& query = pool.queries[first + i];
    if ((flags & VK_QUERY_RESULT_WAIT_BIT) != 0) {
      pool.device.sync.changed.wait(lock, [&] { return query.available || pool.device.lost; });
      if (!query.available) return VK_ERROR_DEVICE_LOST;
    }
    const uint64_t offset = target.stride * i;
    if (offset > target.size || needed > target.size - offset) break;
    std::byte* out = target.data + offset;
    if (query.available) {
      put(out, 0, query.value, wide);
    } else {
      result = VK_NOT_READY;
      // Any value from 0 to the final one is a partial result.
      if ((flags & VK_QUERY_RESULT_PARTIAL_BIT) != 0) put(out, 0, 0, wide);
    }
    if (with_availability) put(out, 1, query.available ? 1 : 0, wide);
  }
  return result;
}

}  // namespace lapilli
