// Assembly against the vertex orders of the specification's "Primitive Topologies".
#include "geometry/primitives.h"

#include <gtest/gtest.h>

#include <vector>

namespace lapilli {
namespace {

struct TestDraw : DrawCall {
  explicit TestDraw(VkPrimitiveTopology topology, uint32_t vertices = 0) {
    bound.raster.topology = topology;
    state = &bound;
    count = vertices;
  }
  void use(const std::vector<uint16_t>& values) {
    indices = {reinterpret_cast<const std::byte*>(values.data()), 2 * values.size(), VK_INDEX_TYPE_UINT16};
    count = static_cast<uint32_t>(values.size());
  }
  std::vector<VertexRun> runs() const {
    std::vector<VertexRun> all;
    VertexRun run;
    for (uint32_t position = 0; next_run(*this, position, run);) all.push_back(run);
    return all;
  }
  std::vector<uint32_t> triangles(const VertexRun& run, uint32_t from, uint32_t triangles) const {
    std::vector<uint32_t> out(3 * size_t{triangles});
    assemble_triangles(*this, run, from, out);
    return out;
  }
  DrawState bound;
};
using Vertices = std::vector<uint32_t>;

TEST(Primitives, OrderAndProvokingVertex) {
  const VertexRun run{100, 20};
  EXPECT_EQ(TestDraw(VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST).triangles(run, 2, 1), (Vertices{106, 107, 108}));
  const TestDraw strip(VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP);
  EXPECT_EQ(strip.triangles(run, 0, 3), (Vertices{100, 101, 102, 101, 103, 102, 102, 103, 104}));
  EXPECT_EQ(strip.triangles(run, 1, 1), (Vertices{101, 103, 102}));
  const TestDraw fan(VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN);
  EXPECT_EQ(fan.triangles(run, 0, 2), (Vertices{101, 102, 100, 102, 103, 100}));
  EXPECT_EQ(fan.triangles(run, 3, 1), (Vertices{104, 105, 100}));
}

// However the triangles of a run are split, they are the same.
TEST(Primitives, PartsOfARunAreItsTriangles) {
  std::vector<uint16_t> values(50);
  for (size_t i = 0; i < values.size(); ++i) values[i] = static_cast<uint16_t>(i * i % 41);
  for (const VkPrimitiveTopology topology : {VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST, VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP,
                                             VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN}) {
    TestDraw draw(topology);
    draw.use(values);
    draw.vertex_offset = -7;
    const VertexRun run{3, 47};
    const uint32_t count = triangle_count(topology, run.count);
    const Vertices all = draw.triangles(run, 0, count);
    if (topology == VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST) {
      EXPECT_EQ(all[4], static_cast<uint32_t>(values[7] - 7));
    }
    for (uint32_t first = 0; first < count; ++first) {
      for (uint32_t n = 1; n <= count - first; ++n) {
        const Vertices expected(all.begin() + 3 * first, all.begin() + 3 * (first + n));
        ASSERT_EQ(draw.triangles(run, first, n), expected) << first << " " << n;
      }
    }
  }
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
  Vertices out(3, 99);
  read_indices(indices, 1, out);
  EXPECT_EQ(out, (Vertices{8, 0, 0}));
  read_indices(indices, UINT64_MAX - 1, out);
  EXPECT_EQ(out, (Vertices{0, 0, 0}));
  const uint32_t wide[] = {0x12345678};
  indices = {reinterpret_cast<const std::byte*>(wide), 4, VK_INDEX_TYPE_UINT32};
  read_indices(indices, 0, out);
  EXPECT_EQ(out, (Vertices{0x12345678, 0, 0}));
}

TEST(Primitives, RestartSplitsRuns) {
  TestDraw draw(VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP);
  const std::vector<uint16_t> values = {0xFFFF, 1, 2, 3, 0xFFFF, 0xFFFF, 4, 5};
  draw.use(values);
  ASSERT_EQ(draw.runs().size(), 1u);  // restart is off
  EXPECT_EQ(draw.runs()[0].count, 8u);

  draw.bound.raster.primitive_restart = true;
  std::vector<std::pair<uint64_t, uint32_t>> found;
  for (const VertexRun& run : draw.runs()) {
    if (run.count > 0) found.emplace_back(run.first, run.count);
  }
  EXPECT_EQ(found, (std::vector<std::pair<uint64_t, uint32_t>>{{1, 3}, {6, 2}}));

  draw.count = 100;  // beyond the buffer there are zeros, and no restart
  EXPECT_EQ(draw.runs().back().first, 6u);
  EXPECT_EQ(draw.runs().back().count, 94u);
}

}  // namespace
}  // namespace lapilli
