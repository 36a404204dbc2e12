// Tests of the coverage oracle itself, against counts that can be derived by hand.
#include "oracle/coverage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace lapilli::oracle {
namespace {

// A 16x16 framebuffer whose clip coordinates are multiples of 1/8 at pixel corners.
RasterState state16() {
  RasterState s;
  s.viewport = {0, 0, 16, 16, 0, 1};
  s.scissor = {0, 0, 16, 16};
  return s;
}

ClipVertex at_pixel(double x, double y, float z = 0.5f, float w = 1.0f) {
  return {float((x / 8 - 1) * w), float((y / 8 - 1) * w), z * w, w};
}

int count(const TriangleCoverage& c, Coverage which = Coverage::kInside) {
  int n = 0;
  for (const Coverage p : c.pixels) n += p == which;
  return n;
}

TEST(CoverageOracle, SquareOfTwoTrianglesCoversEachPixelOnce) {
  const RasterState s = state16();
  const TriangleCoverage a = cover({at_pixel(2, 3), at_pixel(10, 3), at_pixel(2, 11)}, s);
  const TriangleCoverage b = cover({at_pixel(10, 3), at_pixel(10, 11), at_pixel(2, 11)}, s);
  EXPECT_EQ(count(a) + count(b), 64);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      const int hits = (a.at(x, y) == Coverage::kInside) + (b.at(x, y) == Coverage::kInside);
      EXPECT_EQ(hits, x >= 2 && x < 10 && y >= 3 && y < 11) << x << "," << y;
    }
  }
}

TEST(CoverageOracle, CentresOnTopAndLeftEdgesAreInOnBottomAndRightOut) {
  // A square with corners on pixel centres (2.5, 2.5) to (5.5, 5.5): owns centres 2..4 in both directions.
  const RasterState s = state16();
  const TriangleCoverage a = cover({at_pixel(2.5, 2.5), at_pixel(5.5, 2.5), at_pixel(2.5, 5.5)}, s);
  const TriangleCoverage b = cover({at_pixel(5.5, 2.5), at_pixel(5.5, 5.5), at_pixel(2.5, 5.5)}, s);
  EXPECT_EQ(count(a) + count(b), 9);
  EXPECT_EQ(a.at(2, 2), Coverage::kInside);
  EXPECT_EQ(a.at(4, 2), Coverage::kInside);
  EXPECT_EQ(a.at(5, 2), Coverage::kOutside);
  EXPECT_EQ(a.at(2, 5), Coverage::kOutside);
  EXPECT_EQ(b.at(5, 5), Coverage::kOutside);
}

TEST(CoverageOracle, FacingFollowsTheSignOfTheArea) {
  RasterState s = state16();
  // Clockwise on a screen whose y points down: a < 0.
  const Triangle clockwise = {at_pixel(2, 2), at_pixel(12, 2), at_pixel(2, 12)};
  EXPECT_EQ(cover(clockwise, s).facing, Facing::kBack);
  s.front_is_clockwise = true;
  EXPECT_EQ(cover(clockwise, s).facing, Facing::kFront);
  s.cull = Cull::kFront;
  EXPECT_EQ(count(cover(clockwise, s)), 0);
  s.cull = Cull::kBack;
  EXPECT_GT(count(cover(clockwise, s)), 0);
  // The same through the clipped path: a vertex in front of the near plane.
  Triangle near = clockwise;
  near[0].z = -0.25f;
  EXPECT_FALSE(cover(near, s).exact);
  EXPECT_EQ(cover(near, s).facing, Facing::kFront);
}

TEST(CoverageOracle, DegenerateAndNonFiniteTrianglesCoverNothing) {
  const RasterState s = state16();
  EXPECT_EQ(count(cover({at_pixel(1, 1), at_pixel(8, 8), at_pixel(12, 12)}, s)), 0);
  EXPECT_EQ(count(cover({at_pixel(1, 1), at_pixel(1, 1), at_pixel(12, 2)}, s)), 0);
  const float inf = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float bad : {inf, -inf, nan}) {
    Triangle t = {at_pixel(1, 1), at_pixel(14, 1), at_pixel(1, 14)};
    t[1].x = bad;
    EXPECT_EQ(cover(t, s).pixels.size(), 0u);
    t[1].x = 0;
    t[2].w = bad;
    EXPECT_EQ(cover(t, s).pixels.size(), 0u);
  }
}

TEST(CoverageOracle, ViewportIsTheClipVolume) {
  RasterState s = state16();
  s.viewport = {4.5f, 3.25f, 6, 5, 0, 1};
  const Triangle all = {ClipVertex{-3, -3, 0, 1}, ClipVertex{9, -3, 0, 1}, ClipVertex{-3, 9, 0, 1}};
  const TriangleCoverage c = cover(all, s);
  EXPECT_TRUE(c.exact);
  // Centres in [4.5, 10.5) x [3.25, 8.25): columns 4..9, rows 3..7.
  EXPECT_EQ(count(c), 30);
  EXPECT_EQ(c.at(4, 3), Coverage::kInside);
  EXPECT_EQ(c.at(10, 3), Coverage::kOutside);
  EXPECT_EQ(c.at(9, 8), Coverage::kOutside);
}

TEST(CoverageOracle, NearPlaneCutsWhereDepthIsZero) {
  const RasterState s = state16();
  // z grows from -0.5 at x = 0 to 0.5 at x = 16: cut at x = 8, far from every centre (7.5, 8.5).
  const TriangleCoverage a = cover({at_pixel(0, 0, -0.5f), at_pixel(16, 0, 0.5f), at_pixel(0, 16, -0.5f)}, s);
  EXPECT_FALSE(a.exact);
  EXPECT_EQ(a.at(7, 0), Coverage::kOutside);
  EXPECT_EQ(a.at(8, 0), Coverage::kInside);
  // The hypotenuse x + y = 16 runs through centres: those are decided by the fill rule, so either is right here.
  EXPECT_EQ(a.at(8, 7), Coverage::kEither);
  EXPECT_EQ(a.at(8, 6), Coverage::kInside);
}

TEST(CoverageOracle, TriangleThroughTheEyePlaneShowsOnlyItsFrontPart) {
  const RasterState s = state16();
  // A floor: y/w from the eye's height, running from in front of the viewer to behind (w < 0).
  const Triangle floor = {ClipVertex{-4, 1, 0.9f, 1}, ClipVertex{4, 1, 0.9f, 1}, ClipVertex{0, 1, -1.1f, -1}};
  const TriangleCoverage c = cover(floor, s);
  EXPECT_FALSE(c.exact);
  // w > 0 and 0 <= z only where w >= 0.1: y/w in [1, 10] is below the screen except at y/w = 1, the lower border.
  EXPECT_EQ(count(c), 0);
}

// The integer edge functions and the homogeneous ones of the clipped path are two ways to the same answer.
TEST(CoverageOracle, IntegerAndHomogeneousEdgesAgree) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> xy(-1.5f, 1.5f), depth(0.0f, 1.0f), weight(0.25f, 4.0f);
  const RasterState s = state16();
  int decided = 0;
  for (int i = 0; i < 2000; ++i) {
    Triangle t;
    for (ClipVertex& v : t) {
      const float w = weight(random);
      v = {xy(random) * w, xy(random) * w, depth(random) * w, w};
    }
    const TriangleCoverage exact = cover(t, s);
    ASSERT_TRUE(exact.exact);
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) {
        const double distance = edge_distance(t, s, x, y);
        if (std::abs(distance) <= 1e-9) continue;
        EXPECT_EQ(exact.at(x, y), distance > 0 ? Coverage::kInside : Coverage::kOutside);
        ++decided;
      }
    }
  }
  EXPECT_GT(decided, 2000 * 250);
}

TEST(CoverageOracle, SnapsTiesToEven) {
  Viewport v{0, 0, 256, 256, 0, 1};
  SnappedPoint p;
  // x_f = 128 + 1/512: exactly between 32768 and 32769 in 24.8.
  ASSERT_TRUE(snap_vertex({1.0f / 65536, 3.0f / 65536, 0.5f, 1}, v, &p));
  EXPECT_EQ(p.x, 128 * 256);
  EXPECT_EQ(p.y, 128 * 256 + 2);
  EXPECT_FALSE(snap_vertex({0, 0, 1.5f, 1}, v, &p));
  EXPECT_FALSE(snap_vertex({0, 0, 0, 0}, v, &p));
  EXPECT_FALSE(snap_vertex({400, 0, 0, 1}, v, &p));
}

}  // namespace
}  // namespace lapilli::oracle
