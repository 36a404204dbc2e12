// Assembly against the vertex orders of the specification's "Primitive Topologies".
#include "geometry/primitives.h"

#include <gtest/gtest.h>

#include <cstring>

namespace lapilli {
namespace {

void expect_positions(VkPrimitiveTopology topology, uint32_t i, uint32_t a, uint32_t b, uint32_t c) {
  const TrianglePositions positions = triangle_positions(topology, i);
  EXPECT_EQ(positions.v[0], a);
  EXPECT_EQ(positions.v[1], b);
  EXPECT_EQ(positions.v[2], c);
}

TEST(Primitives, OrderAndProvokingVertex) {
  expect_positions(VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST, 2, 6, 7, 8);
  expect_positions(VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP, 0, 0, 1, 2);
  expect_positions(VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP, 1, 1, 3, 2);
  expect_positions(VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP, 2, 2, 3, 4);
  expect_positions(VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN, 0, 1, 2, 0);
  expect_positions(VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN, 3, 4, 5, 0);
}

TEST(Primitives, IncompleteTrianglesAreIgnored) {
  for (uint32_t n = 0; n < 10; ++n) {
    EXPECT_EQ(triangle_count(VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST, n), n / 3);
    EXPECT_EQ(triangle_count(VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP, n), n < 3 ? 0 : n - 2);
    EXPECT_EQ(triangle_count(VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN, n), n < 3 ? 0 : n - 2);
  }
}

TEST(Primitives, IndicesOutsideTheBufferAreZero) {
  const uint16_t data[] = {7, 8, 9};
  IndexBuffer indices{reinterpret_cast<const std::byte*>(data), 5, VK_INDEX_TYPE_UINT16};  // the third has one byte
  EXPECT_EQ(read_index(indices, 1), 8u);
  EXPECT_EQ(read_index(indices, 2), 0u);
  EXPECT_EQ(read_index(indices, UINT64_MAX), 0u);
  const uint32_t wide[] = {0x12345678};
  indices = {reinterpret_cast<const std::byte*>(wide), 4, VK_INDEX_TYPE_UINT32};
  EXPECT_EQ(read_index(indices, 0), 0x12345678u);
}

TEST(Primitives, RestartSplitsRuns) {
  const uint16_t data[] = {0xFFFF, 1, 2, 3, 0xFFFF, 0xFFFF, 4, 5};
  DrawState state;
  DrawCall draw;
  draw.state = &state;
  draw.indices = {reinterpret_cast<const std::byte*>(data), sizeof(data), VK_INDEX_TYPE_UINT16};
  draw.count = 8;
  std::vector<VertexRun> runs;
  split_runs(draw, runs);
  ASSERT_EQ(runs.size(), 1u);  // restart is off
  EXPECT_EQ(runs[0].count, 8u);

  state.raster.primitive_restart = true;
  split_runs(draw, runs);
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0].first, 1u);
  EXPECT_EQ(runs[0].count, 3u);
  EXPECT_EQ(runs[1].first, 6u);
  EXPECT_EQ(runs[1].count, 2u);
}

}  // namespace
}  // namespace lapilli
