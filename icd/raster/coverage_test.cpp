// Coverage of a tile against the definition: 64-bit edge functions with the top-left rule at every pixel centre.
#include "raster/coverage.h"

#include <gtest/gtest.h>

#include <random>

namespace lapilli {
namespace {

struct Point {
  int64_t x, y;  // 24.8
};

// The triangle's edges as geometry/planes.cpp states them; p, q, r clockwise on the screen (y down).
CoverageEdges edges_of(Point p, Point q, Point r) {
  CoverageEdges edges{};
  const Point from[3] = {q, r, p};
  const Point to[3] = {r, p, q};
  for (int i = 0; i < 3; ++i) {
    const int64_t dx = to[i].x - from[i].x;
    const int64_t dy = to[i].y - from[i].y;
    const bool owns_edge = dy < 0 || (dy == 0 && dx > 0);
    edges.a[i] = static_cast<int32_t>(-dy);
    edges.b[i] = static_cast<int32_t>(dx);
    edges.c[i] = (dx * (128 - from[i].y) - dy * (128 - from[i].x) - (owns_edge ? 0 : 1)) >> 8;
  }
  return edges;
}

int64_t cross(Point p, Point q, Point c) { return (q.x - p.x) * (c.y - p.y) - (q.y - p.y) * (c.x - p.x); }

// Straight from the rule: inside, or on a top or left edge.
bool covers(const Point (&v)[3], int64_t x, int64_t y) {
  const Point centre{256 * x + 128, 256 * y + 128};
  for (int i = 0; i < 3; ++i) {
    const Point& p = v[i];
    const Point& q = v[(i + 1) % 3];
    const int64_t e = cross(p, q, centre);
    const bool left = q.y < p.y;               // going up: the interior is at greater x
    const bool top = q.y == p.y && q.x > p.x;  // going right: the interior is at greater y
    if (e < 0 || (e == 0 && !left && !top)) return false;
  }
  return true;
}

void expect_equal(Point p, Point q, Point r, const PixelRect& bounds, int32_t tile_x, int32_t tile_y) {
  const int64_t area = cross(p, q, r);
  if (area == 0) return;
  if (area < 0) std::swap(q, r);
  const Point v[3] = {p, q, r};
  const PixelRect in_tile =
      intersect({bounds.x0 - tile_x, bounds.y0 - tile_y, bounds.x1 - tile_x, bounds.y1 - tile_y}, {0, 0, 64, 64});
  TileCoverage coverage;
  TileCoverage::Blocks blocks{};
  const bool touched = coverage.begin(edges_of(p, q, r), tile_x, tile_y, in_tile);
  if (touched) blocks = coverage.blocks();
  for (uint32_t block = 0; block < 64; ++block) {
    const int32_t x = tile_x + static_cast<int32_t>(column_of_bit(block)) * 8;
    const int32_t y = tile_y + static_cast<int32_t>(row_of_bit(block)) * 8;
    uint64_t expected = 0;
    for (uint32_t bit = 0; bit < 64; ++bit) {
      const int32_t px = x + static_cast<int32_t>(column_of_bit(bit));
      const int32_t py = y + static_cast<int32_t>(row_of_bit(bit));
      const bool in_bounds = px >= bounds.x0 && px < bounds.x1 && py >= bounds.y0 && py < bounds.y1;
      expected |= static_cast<uint64_t>(in_bounds && covers(v, px, py)) << bit;
    }
    if (touched) {
      ASSERT_EQ(coverage.pixels(block), expected) << x << ", " << y;
    }
    const bool may_be_touched = (blocks.touched >> block & 1) != 0;
    ASSERT_TRUE(may_be_touched || expected == 0) << x << ", " << y;
    ASSERT_EQ((blocks.inside >> block & 1) != 0, expected == kAllBits) << x << ", " << y;
  }
}

constexpr PixelRect kEverything = {0, 0, 1 << 14, 1 << 14};

TEST(Coverage, RandomTriangles) {
  std::mt19937 random(1);
  for (const int64_t extent : {int64_t{512}, int64_t{20000}, int64_t{1} << 23}) {
    std::uniform_int_distribution<int64_t> coordinate(extent == 1 << 23 ? -extent : -300, extent);
    for (int i = 0; i < 400; ++i) {
      const Point p{coordinate(random), coordinate(random)};
      const Point q{coordinate(random), coordinate(random)};
      const Point r{coordinate(random), coordinate(random)};
      expect_equal(p, q, r, kEverything, 0, 0);
      expect_equal(p, q, r, kEverything, 64, 0);
    }
  }
}

TEST(Coverage, VerticesOnCentresAndPixelEdges) {
  std::mt19937 random(2);
  std::uniform_int_distribution<int64_t> half(0, 140);
  for (int i = 0; i < 1000; ++i) {
    const auto point = [&] { return Point{half(random) * 128, half(random) * 128}; };
    expect_equal(point(), point(), point(), kEverything, 0, 0);
  }
}

// The largest edge coefficients there are, across a tile far from the origin.
TEST(Coverage, ExtremeSlopes) {
  constexpr int64_t kFar = int64_t{1} << 23;
  const Point far_corner[] = {{-kFar, -kFar}, {kFar, -kFar}, {kFar, kFar}, {-kFar, kFar}};
  for (const Point& p : far_corner) {
    for (const Point& q : far_corner) {
      expect_equal(p, q, {8192 * 256 - 77, 8192 * 256 - 3}, kEverything, 8128, 8128);
      expect_equal(p, q, {200, 100}, kEverything, 0, 0);
    }
  }
}

TEST(Coverage, BoundsCutAtAnyPixel) {
  for (int32_t x0 = 0; x0 < 20; x0 += 3) {
    for (int32_t x1 = x0 + 1; x1 < 64; x1 += 7) {
      expect_equal({-1000, -1000}, {60000, -1000}, {-1000, 60000}, {x0, x0 + 1, x1, x1 + 2}, 0, 0);
    }
  }
}

}  // namespace
}  // namespace lapilli
