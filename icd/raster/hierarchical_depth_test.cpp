// Bounds of depth against the depths themselves: slivers, steep planes, planes far outside of the clamp range.
#include "raster/hierarchical_depth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "raster/coverage.h"

namespace lapilli {
namespace {

BinChunk chunk_of(const BinVertex (&v)[3], bool bias, float min_depth, float max_depth) {
  BinChunk chunk;
  chunk.runs.push_back({0, {}, min_depth, max_depth, bias, 3.0f, 0, 1.5f});
  for (const BinVertex& each : v) chunk.vertices.push_back(each);
  const int64_t area = int64_t{v[1].x - v[0].x} * (v[2].y - v[0].y) - int64_t{v[2].x - v[0].x} * (v[1].y - v[0].y);
  BinTriangle triangle{{0, 1, 2}, 0, 0, 0, 1, 1};
  if (area < 0) std::swap(triangle.v[1], triangle.v[2]);
  if (area != 0) chunk.triangles.push_back(triangle);
  return chunk;
}

// Every block of some tiles around the triangle.
void expect_bounds(const BinChunk& chunk, uint32_t tile_x, uint32_t tile_y) {
  const TriangleDepth triangle = triangle_depth(make_triangle_setup(chunk, chunk.triangles[0]));
  const DepthBounds bounds = depth_bounds(triangle, tile_x, tile_y);
  if (!bounds.known) return;
  BlockRanges ranges, anything{};
  judge(VK_COMPARE_OP_LESS, bounds, anything, ranges);
  const DepthRange tile = range_in_rect(bounds, {0, 0, 64, 64});
  for (uint32_t block = 0; block < 64; ++block) {
    const int32_t x = static_cast<int32_t>(column_of_bit(block) * 8), y = static_cast<int32_t>(row_of_bit(block) * 8);
    const DepthRange rect = range_in_rect(bounds, {x, y, x + 8, y + 8});
    alignas(64) float z[64];
    block_depth_functions().depth(triangle, tile_x + column_of_bit(block) * 8, tile_y + row_of_bit(block) * 8, z);
    for (uint32_t i = 0; i < 64; ++i) {
      const float low = std::max({ranges.min[block], rect.min, tile.min});
      const float high = std::min({ranges.max[block], rect.max, tile.max});
      ASSERT_LE(low, z[i]) << "block " << block << " pixel " << i;
      ASSERT_GE(high, z[i]) << "block " << block << " pixel " << i;
    }
  }
}

TEST(HierarchicalDepth, BoundsHoldForRandomTriangles) {
  std::mt19937 random(1);
  const auto integer = [&](int64_t low, int64_t high) {
    return std::uniform_int_distribution<int64_t>(low, high)(random);
  };
  const auto real = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  int known = 0;
  for (int i = 0; i < 6000; ++i) {
    const int64_t sizes[] = {3, 40, 3000, 200000, 8000000};
    const int64_t size = sizes[i % 5];
    const int64_t x = integer(0, 16000 * 256), y = integer(0, 16000 * 256);
    BinVertex v[3] = {};
    const double steep = std::exp2(real(-40, 30));
    for (BinVertex& each : v) {
      const auto coordinate = [](int64_t c) {
        return static_cast<int32_t>(std::clamp<int64_t>(c, -(1 << 23), 1 << 23));
      };
      each.x = coordinate(x + integer(-size, size));
      // A third are slivers.
      each.y = coordinate(y + (i % 3 == 0 ? integer(-2, 2) : integer(-size, size)));
      each.z = i % 7 == 0 ? 0.5 : 0.5 + real(-1, 1) * steep;
    }
    const bool clamp = i % 2 == 0;
    const BinChunk chunk = chunk_of(v, i % 11 == 0, clamp ? 0.25f : -1e9f, clamp ? 0.75f : 1e9f);
    if (chunk.triangles.empty()) continue;
    const auto tile = [](int64_t c) { return static_cast<uint32_t>(std::clamp<int64_t>(c, 0, 16300) / 64 * 64); };
    expect_bounds(chunk, tile(x / 256), tile(y / 256));
    expect_bounds(chunk, tile(v[0].x / 256), tile(v[0].y / 256));
    ++known;
    if (HasFatalFailure()) break;
  }
  EXPECT_GT(known, 4000);
}

// Bounds are of use: no wider than what the block spans and some rounding.
TEST(HierarchicalDepth, BoundsAreTight) {
  const BinVertex flat[3] = {{0, 0, 0.3, 1, 0}, {512 * 256, 0, 0.3, 1, 0}, {0, 512 * 256, 0.3, 1, 0}};
  const BinChunk chunk = chunk_of(flat, false, 0, 1);
  const DepthBounds bounds = depth_bounds(triangle_depth(make_triangle_setup(chunk, chunk.triangles[0])), 64, 128);
  const DepthRange range = range_in_rect(bounds, {0, 0, 64, 64});
  EXPECT_EQ(range.min, 0.3f);
  EXPECT_EQ(range.max, 0.3f);
  const BinVertex tilted[3] = {{0, 0, 0, 1, 0}, {512 * 256, 0, 1, 1, 0}, {0, 512 * 256, 0, 1, 0}};
  const BinChunk other = chunk_of(tilted, false, 0, 1);
  const DepthRange block = range_in_rect(
      depth_bounds(triangle_depth(make_triangle_setup(other, other.triangles[0])), 64, 128), {8, 16, 16, 24});
  EXPECT_FLOAT_EQ(block.min, 72.5f / 512);
  EXPECT_FLOAT_EQ(block.max, 79.5f / 512);
}

// The definition: a verdict may be given only if every pair of depths agrees.
TEST(HierarchicalDepth, VerdictsFollowFromTheRanges) {
  const float levels[] = {0, 0.25f, 0.5f, 0.75f, 1};
  const auto passes = [](VkCompareOp compare, float z, float stored) {
    const int sign = z < stored ? 1 : z == stored ? 2 : 4;
    return (static_cast<int>(compare) & sign) != 0;
  };
  for (int op = 0; op < 8; ++op) {
    const VkCompareOp compare = static_cast<VkCompareOp>(op);
    for (int a = 0; a < 5; ++a) {
      for (int b = a; b < 5; ++b) {
        for (int c = 0; c < 5; ++c) {
          for (int d = c; d < 5; ++d) {
            bool all = true, some = false;
            for (int z = a; z <= b; ++z) {
              for (int s = c; s <= d; ++s) {
                const bool pass = passes(compare, levels[z], levels[s]);
                all &= pass;
                some |= pass;
              }
            }
            const BlockVerdicts verdict = judge(compare, {levels[a], levels[b]}, {levels[c], levels[d]});
            EXPECT_EQ(verdict.always & 1, static_cast<uint64_t>(all)) << op;
            EXPECT_EQ(verdict.never & 1, static_cast<uint64_t>(!some)) << op;
          }
        }
      }
    }
  }
}

TEST(HierarchicalDepth, StoredInfinitiesAndNansGiveNoVerdict) {
  const float infinity = HUGE_VALF;
  for (const DepthRange stored : {DepthRange{-infinity, infinity}, DepthRange{NAN, NAN}}) {
    for (const VkCompareOp compare : {VK_COMPARE_OP_LESS, VK_COMPARE_OP_EQUAL, VK_COMPARE_OP_LESS_OR_EQUAL,
                                      VK_COMPARE_OP_GREATER, VK_COMPARE_OP_NOT_EQUAL, VK_COMPARE_OP_GREATER_OR_EQUAL}) {
      const BlockVerdicts verdict = judge(compare, {0, 1}, stored);
      EXPECT_EQ(verdict.always | verdict.never, 0u);
    }
  }
}

}  // namespace
}  // namespace lapilli
