// VkQueryPool: occlusion and timestamp queries. Specification: chapter "Queries".
#pragma once

#include "object/device_context.h"

namespace lapilli {

struct Query {
  // Samples passed, or nanoseconds. Written by the queue while the query is not available, read by all once it is.
  uint64_t value = 0;
  bool available = false;  // guarded by the device's SyncDomain
};

struct QueryPool : Handle<QueryPool, VkQueryPool> {
  QueryPool(const HostMemory& memory, DeviceContext& owner, uint32_t count)
      : Handle(memory), device(owner), queries(count, host) {}

  DeviceContext& device;
  VkQueryType type = VK_QUERY_TYPE_OCCLUSION;
  HostVector<Query> queries;

  void reset(uint32_t first, uint32_t count);
  void make_available(uint32_t query);
};

VkResult create_query_pool(DeviceContext& device, const VkQueryPoolCreateInfo& info,
                           const VkAllocationCallbacks* callbacks, VkQueryPool* handle);

// Where results go: `size` bytes, `stride` bytes from query to query.
struct QueryResultTarget {
  std::byte* data = nullptr;
  uint64_t size = 0;
  uint64_t stride = 0;
};
// VK_NOT_READY if one was not available; nothing is written for that one, unless flags ask for partial results.
VkResult get_query_results(QueryPool& pool, uint32_t first, uint32_t count, const QueryResultTarget& target,
                           VkQueryResultFlags flags);

}  // namespace lapilli
