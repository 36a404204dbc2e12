// Tests of the interpolation oracle against values derived by hand.
#include "oracle/interpolate.h"

#include <gtest/gtest.h>

namespace lapilli::oracle {
namespace {

RasterState state8() {
  RasterState s;
  s.viewport = {0, 0, 8, 8, 0, 1};
  s.scissor = {0, 0, 8, 8};
  return s;
}

TEST(InterpolateOracle, WeightsAreOneAtTheirVertex) {
  const RasterState s = state8();
  const Triangle t = {ClipVertex{-1, -1, 0.25f, 1}, ClipVertex{2, -2, 1, 2}, ClipVertex{-0.5f, 0.5f, 0.125f, 0.5f}};
  const double corner[3][2] = {{0, 0}, {8, 0}, {0, 8}};
  const double depth[3] = {0.25, 0.5, 0.25}, inverse_w[3] = {1, 0.5, 2};
  for (int i = 0; i < 3; ++i) {
    const Weights w = interpolate(t, s, Positions::kExact, corner[i][0], corner[i][1]);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(w.perspective[k], i == k, 1e-12);
      EXPECT_NEAR(w.linear[k], i == k, 1e-12);
    }
    EXPECT_NEAR(w.depth, depth[i], 1e-12);
    EXPECT_NEAR(w.inverse_w, inverse_w[i], 1e-12);
  }
}

TEST(InterpolateOracle, PerspectiveIsHarmonicAlongAnEdge) {
  const RasterState s = state8();
  // w = 1 at x = 0 and w = 3 at x = 8. Half way, 1/w = (1 + 1/3)/2 = 2/3, the nearer vertex weighs (1/1)/(2 * 2/3).
  const Triangle t = {ClipVertex{-1, -1, 0, 1}, ClipVertex{3, -3, 0, 3}, ClipVertex{-1, 1, 0, 1}};
  const Weights w = interpolate(t, s, Positions::kExact, 4, 0);
  EXPECT_NEAR(w.perspective[0], 0.75, 1e-12);
  EXPECT_NEAR(w.perspective[1], 0.25, 1e-12);
  EXPECT_NEAR(w.linear[0], 0.5, 1e-12);
  EXPECT_NEAR(w.inverse_w, 2.0 / 3.0, 1e-12);
}

TEST(InterpolateOracle, DepthGoesThroughTheViewportsRange) {
  RasterState s = state8();
  s.viewport.min_depth = 0.5f;
  s.viewport.max_depth = 0.25f;
  const Triangle t = {ClipVertex{-1, -1, 0, 1}, ClipVertex{1, -1, 1, 1}, ClipVertex{-1, 1, 0, 1}};
  EXPECT_NEAR(interpolate(t, s, Positions::kSnapped, 4, 2).depth, 0.375, 1e-12);
}

}  // namespace
}  // namespace lapilli::oracle
