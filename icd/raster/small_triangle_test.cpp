// Small triangles in a block against the integers of make_edge_functions and the depth test of whole blocks.
#include "raster/small_triangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <random>

#include "raster/coverage.h"
#include "shader/block_depth.h"

namespace lapilli {
namespace {

constexpr uint32_t kTileX = 128, kTileY = 1984;

struct Block {
  alignas(64) float depths[64];
  alignas(64) uint32_t numbers[64];
};

// Puts the chunk's triangle into a group, among others that are not there.
void set_up_alone(const BinChunk& chunk, uint32_t tile_x, uint32_t tile_y, uint32_t place, TriangleGroup& group) {
  std::memset(&group, 0x55, sizeof group);
  group.put(place, chunk, chunk.triangles[0]);
  small_triangle_functions().set_up(group, place + 1, tile_x, tile_y, {0, 0, 64, 64});
}

bool covers(const EdgeFunctions& edges, uint32_t x, uint32_t y) {
  return std::all_of(edges.begin(), edges.end(), [&](const EdgeFunction& edge) {
    const int64_t e = edge.a * x + edge.b * y + edge.c;
    return e > 0 || (e == 0 && edge.owns);
  });
}

void expect_block(const BinChunk& chunk, uint32_t column, uint32_t row, VkCompareOp compare, bool write,
                  const Block& before) {
  Block block = before;
  const BinTriangle& triangle = chunk.triangles[0];
  const uint32_t x = kTileX + column * 8, y = kTileY + row * 8;
  const EdgeFunctions edges = make_edge_functions(chunk, triangle);
  uint64_t covered = 0;
  for (uint32_t bit = 0; bit < 64; ++bit) {
    covered |= uint64_t{covers(edges, x + column_of_bit(bit), y + row_of_bit(bit))} << bit;
  }
  const uint64_t asked = 0xFFFF'7F13'FFFF'FFFE;  // of the block's pixels
  Block expected = block;
  DepthRange range;
  const TriangleDepth depth = triangle_depth(make_triangle_setup(chunk, triangle));
  const uint64_t passed =
      block_depth_functions().test[compare](depth, x, y, covered & asked, write, expected.depths, range);
  for (uint32_t bit = 0; bit < 64; ++bit) {
    if ((passed >> bit & 1) != 0) expected.numbers[bit] = 77;
  }

  TriangleGroup small;
  const uint32_t place = column + row;
  set_up_alone(chunk, kTileX, kTileY, place, small);
  ASSERT_EQ(small.small >> place & 1, 1u);
  DrawSmallTriangle* const draw = small_triangle_functions().draw[compare];
  const uint32_t block_x = column * 8, block_y = row * 8;
  const SmallDrawn drawn =
      draw(small, place, block_x, block_y, asked, {block.depths, write, depth.plane.z0, 0, 1, block.numbers, 77});
  EXPECT_EQ(drawn.covered, covered & asked);
  EXPECT_EQ(drawn.passed, passed);
  EXPECT_EQ(std::memcmp(&block, &expected, sizeof block), 0);
  const SmallDrawn alone = draw(small, place, block_x, block_y, kAllBits, {});
  EXPECT_EQ(alone.covered, covered);
  EXPECT_EQ(alone.passed, covered);
}

// Clockwise on the screen; false: without an area.
bool add_triangle(BinVertex (&v)[3], const BinTriangle& triangle, BinChunk& chunk) {
  const int64_t area = int64_t{v[1].x - v[0].x} * (v[2].y - v[0].y) - int64_t{v[2].x - v[0].x} * (v[1].y - v[0].y);
  if (area == 0) return false;
  if (area < 0) std::swap(v[1], v[2]);
  for (const BinVertex& each : v) chunk.vertices.push_back(each);
  chunk.triangles.push_back(triangle);
  return true;
}

void expect_tiny(const BinChunk& chunk, uint32_t place, float min_depth, float max_depth) {
  const BinTriangle& triangle = chunk.triangles[0];
  const EdgeFunctions edges = make_edge_functions(chunk, triangle);
  const TriangleDepth plane = triangle_depth(make_triangle_setup(chunk, triangle));
  TriangleGroup group;
  set_up_alone(chunk, kTileX, kTileY, place, group);
  ASSERT_EQ(group.tiny >> place & 1, 1u);
  small_triangle_functions().cover_tiny(group, place + 1, min_depth, max_depth);
  uint32_t covered = 0;
  for (uint32_t p = 0; p < 4; ++p) {
    const uint32_t x = triangle.x0 + p % 2, y = triangle.y0 + p / 2;
    if (x >= triangle.x1 || y >= triangle.y1 || !covers(edges, x, y)) continue;
    covered |= 1u << p;
    Block block;
    block_depth_functions().depth(plane, x & ~7u, y & ~7u, block.depths);
    const float& expected = block.depths[bit_of(x % 8, y % 8)];
    EXPECT_EQ(std::memcmp(&group.tiny_depth[p][place], &expected, sizeof expected), 0) << p;
  }
  EXPECT_EQ(group.tiny_covered[place], covered);
}

TEST(SmallTriangle, CoversAndTestsAsTheExactRules) {
  const SimdTarget before = simd_target();
  std::mt19937 random(3);
  const auto between = [&](int32_t low, int32_t high) {
    return std::uniform_int_distribution<int32_t>(low, high)(random);
  };
  for (int i = 0; i < 3000; ++i) {
    const int32_t size = i % 3 == 0 ? 300 : i % 3 == 1 ? 1500 : 8191;
    const int32_t step = i % 5 == 0 ? 128 : 1;  // on centres and pixel edges
    const uint32_t column = random() % 8, row = random() % 8;
    const int32_t x = static_cast<int32_t>(kTileX + column * 8) * 256 + between(0, 2048);
    const int32_t y = static_cast<int32_t>(kTileY + row * 8) * 256 + between(0, 2048);
    BinChunk chunk;
    chunk.runs.push_back({0, {}, 0.0f, 1.0f, i % 4 == 0, 3.0f, 0, 1.5f});
    BinVertex v[3] = {};
    for (BinVertex& each : v) {
      each.x = (x + between(-size / 2, size / 2)) / step * step;
      each.y = (y + between(-size / 2, size / 2)) / step * step;
      each.z = 0.01 * between(-10, 110);
    }
    if (!add_triangle(v, {{0, 1, 2}, 0, kTileX, kTileY, kTileX + 16, kTileY + 16}, chunk)) continue;
    Block block;
    for (float& depth : block.depths) depth = 0.25f * static_cast<float>(between(0, 4));
    for (uint32_t& number : block.numbers) number = static_cast<uint32_t>(random());
    const auto compare = static_cast<VkCompareOp>(i % 8);
    for (const SimdTarget target : supported_simd_targets()) {
      ASSERT_TRUE(set_simd_target(target));
      SCOPED_TRACE(simd_target_name(target));
      expect_block(chunk, column, row, compare, i % 2 == 0, block);
    }
    set_simd_target(before);
    if (HasFailure()) break;
  }
}

TEST(SmallTriangle, OfFourPixelsIsCoveredAsTheExactRules) {
  const SimdTarget before = simd_target();
  std::mt19937 random(4);
  const auto between = [&](int32_t low, int32_t high) {
    return std::uniform_int_distribution<int32_t>(low, high)(random);
  };
  for (int i = 0; i < 3000 && !HasFailure(); ++i) {
    const uint16_t x0 = static_cast<uint16_t>(kTileX + random() % 63);
    const uint16_t y0 = static_cast<uint16_t>(kTileY + random() % 63);
    const uint16_t x1 = static_cast<uint16_t>(x0 + 1 + random() % 2), y1 = static_cast<uint16_t>(y0 + 1 + random() % 2);
    const int32_t step = i % 5 == 0 ? 128 : 1;  // on centres and pixel edges
    const float min_depth = i % 3 == 0 ? 0.25f : 0.0f, max_depth = i % 3 == 1 ? 0.75f : 1.0f;
    BinChunk chunk;
    chunk.runs.push_back({0, {}, min_depth, max_depth});
    BinVertex v[3] = {};
    for (BinVertex& each : v) {
      each.x = (256 * x0 + between(-300, 700)) / step * step;
      each.y = (256 * y0 + between(-300, 700)) / step * step;
      each.z = 0.01 * between(-10, 110);
    }
    if (!add_triangle(v, {{0, 1, 2}, 0, x0, y0, x1, y1}, chunk)) continue;
    for (const SimdTarget target : supported_simd_targets()) {
      ASSERT_TRUE(set_simd_target(target));
      SCOPED_TRACE(simd_target_name(target));
      expect_tiny(chunk, static_cast<uint32_t>(i) % TriangleGroup::kMost, min_depth, max_depth);
    }
    set_simd_target(before);
  }
}

TEST(SmallTriangle, PixelsPassAsTheCompareOpSays) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float z : {-0.0f, 0.0f, 0.5f, 1.0f, nan}) {
    for (const float stored : {0.0f, 0.5f, 1.0f, nan}) {
      const bool expected[] = {false, z<stored, z == stored, z <= stored, z> stored, z != stored, z >= stored, true};
      for (int op = 0; op < 8; ++op) {
        EXPECT_EQ(passes(static_cast<VkCompareOp>(op), z, stored), expected[op]) << op << ' ' << z << ' ' << stored;
      }
    }
  }
}

TEST(SmallTriangle, IsWhatFits32BitsAndFewBlocks) {
  const SimdTarget before = simd_target();
  BinChunk chunk;
  chunk.runs.push_back({});
  chunk.vertices.push_back({0, 0, 0, 1, 0});
  chunk.vertices.push_back({});
  chunk.vertices.push_back({0, 100, 0, 1, 0});
  chunk.triangles.push_back({{0, 1, 2}, 0, 0, 0, 1, 1});
  for (const SimdTarget target : supported_simd_targets()) {
    ASSERT_TRUE(set_simd_target(target));
    TriangleGroup group;
    const auto is_small = [&](int32_t extent, uint32_t tile_x, uint16_t x1, uint16_t y1) {
      chunk.vertices[1] = {extent, 0, 0, 1, 0};
      chunk.triangles[0].x1 = x1;
      chunk.triangles[0].y1 = y1;
      set_up_alone(chunk, tile_x, 0, 5, group);
      return (group.small >> 5 & 1) != 0;
    };
    EXPECT_TRUE(is_small(TriangleGroup::kMostExtent - 1, 0, 32, 8));
    EXPECT_EQ(group.x0[5], 0);
    EXPECT_EQ(group.x1[5], 32);
    EXPECT_EQ(group.y1[5], 8);
    EXPECT_FALSE(is_small(TriangleGroup::kMostExtent, 0, 32, 8));
    EXPECT_TRUE(is_small(1000, 0, 24, 24));
    EXPECT_FALSE(is_small(1000, 0, 24, 25));
    EXPECT_FALSE(is_small(1000, 64, 32, 8));  // not in this tile
    chunk.vertices[0].x = chunk.vertices[2].x = -140 * 256;
    EXPECT_FALSE(is_small(-140 * 256 + 100, 0, 32, 8));
    chunk.vertices[0].x = chunk.vertices[2].x = 0;
  }
  set_simd_target(before);
}

}  // namespace
}  // namespace lapilli
