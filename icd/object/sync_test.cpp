// Fences and queries as the host sees them.
#include "object/sync.h"

#include <gtest/gtest.h>

#include <thread>

#include "object/query_pool.h"
#include "object/test_context.h"

namespace lapilli {
namespace {

class Sync : public testing::Test {
 protected:
  TestContext context;
  DeviceContext& device = *context.device;
  ObjectPtr<Fence> fences[2] = {make_object<Fence>(HostMemory(), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT),
                                make_object<Fence>(HostMemory(), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT)};
  VkFence handles[2] = {fences[0]->handle(), fences[1]->handle()};
};

TEST_F(Sync, WaitForOneOrForAll) {
  set_signaled(device, *fences[0], true);
  EXPECT_EQ(wait_for_fences(device, handles, false, 0), VK_SUCCESS);
  EXPECT_EQ(wait_for_fences(device, handles, true, 0), VK_TIMEOUT);
  EXPECT_EQ(wait_for_fences(device, handles, true, 1000), VK_TIMEOUT);
  set_signaled(device, *fences[1], true);
  EXPECT_EQ(wait_for_fences(device, handles, true, 0), VK_SUCCESS);
  EXPECT_EQ(reset_fences(device, handles), VK_SUCCESS);
  EXPECT_EQ(fence_status(device, *fences[0]), VK_NOT_READY);
}

TEST_F(Sync, AWaiterWakesUp) {
  std::thread other([&] { set_signaled(device, *fences[0], true); });
  EXPECT_EQ(wait_for_fences(device, std::span(handles, 1), true, UINT64_MAX), VK_SUCCESS);
  other.join();
}

TEST_F(Sync, NobodyWaitsForALostDevice) {
  device.lost = true;
  EXPECT_EQ(wait_for_fences(device, handles, true, UINT64_MAX), VK_ERROR_DEVICE_LOST);
  EXPECT_EQ(fence_status(device, *fences[0]), VK_ERROR_DEVICE_LOST);
}

TEST_F(Sync, DeadlinesDoNotOverflow) {
  using Clock = std::chrono::steady_clock;
  EXPECT_EQ(deadline_after(UINT64_MAX), Clock::time_point::max());
  EXPECT_EQ(deadline_after(uint64_t{1} << 63), Clock::time_point::max());
  const auto before = Clock::now();
  const auto deadline = deadline_after(1000);
  EXPECT_GE(deadline, before + std::chrono::nanoseconds(1000));
  EXPECT_LE(deadline, Clock::now() + std::chrono::nanoseconds(1000));
}

TEST_F(Sync, QueryResultsInAllTheirForms) {
  auto pool = make_object<QueryPool>(HostMemory(), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT, device, 2u);
  pool->queries[0].value = 0x1'0000'0005;
  pool->make_available(0);
  uint64_t wide[4] = {99, 99, 99, 99};
  auto* bytes = reinterpret_cast<std::byte*>(wide);
  EXPECT_EQ(get_query_results(*pool, 0, 2, {bytes, sizeof(wide), 16},
                              VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WITH_AVAILABILITY_BIT),
            VK_NOT_READY);
  EXPECT_EQ(wide[0], 0x1'0000'0005u);
  EXPECT_EQ(wide[1], 1u);
  EXPECT_EQ(wide[2], 99u);  // not available: untouched
  EXPECT_EQ(wide[3], 0u);
  uint32_t narrow[2] = {77, 77};
  EXPECT_EQ(get_query_results(*pool, 0, 1, {reinterpret_cast<std::byte*>(narrow), 4, 4}, 0), VK_SUCCESS);
  EXPECT_EQ(narrow[0], 5u);
  EXPECT_EQ(narrow[1], 77u);
  EXPECT_EQ(get_query_results(*pool, 1, 1, {reinterpret_cast<std::byte*>(narrow), 4, 4}, VK_QUERY_RESULT_PARTIAL_BIT),
            VK_NOT_READY);
  EXPECT_EQ(narrow[0], 0u);
  pool->reset(0, 1);
  EXPECT_FALSE(pool->queries[0].available);
}

TEST(Queries, AbsurdNumbersAreRefused) {
  TestContext context;
  VkQueryPoolCreateInfo info = {};
  info.queryType = VK_QUERY_TYPE_OCCLUSION;
  VkQueryPool pool = VK_NULL_HANDLE;
  for (const uint32_t count : {UINT32_MAX, 1u << 28}) {
    info.queryCount = count;
    EXPECT_EQ(create_query_pool(*context.device, info, nullptr, &pool), VK_ERROR_OUT_OF_HOST_MEMORY);
  }
  info.queryCount = 1000;
  ASSERT_EQ(create_query_pool(*context.device, info, nullptr, &pool), VK_SUCCESS);
  destroy(QueryPool::from(pool));
}

}  // namespace
}  // namespace lapilli
