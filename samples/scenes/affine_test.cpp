// The affine solver: known maps, every order of pivots, and source triangles that have no answer.
#include "scenes/affine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace lapilli::samples {
namespace {

void expect_maps(const Triangle& source, const Triangle& target, double tolerance) {
  const std::optional<AffineMap> map = solve_affine(source, target);
  ASSERT_TRUE(map.has_value());
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(map->apply(source[i]).x, target[i].x, tolerance);
    EXPECT_NEAR(map->apply(source[i]).y, target[i].y, tolerance);
  }
}

TEST(SolveAffine, FindsAKnownMap) {
  // x' = 2x - y + 5, y' = 3x + 4y - 7, by hand.
  const Triangle triangle = {{{1, 2}, {4, -1}, {0, 0}}};
  const Triangle image = {{{5, 4}, {14, 1}, {5, -7}}};
  const std::optional<AffineMap> solved = solve_affine(triangle, image);
  ASSERT_TRUE(solved.has_value());
  EXPECT_NEAR(solved->xx, 2, 1e-12);
  EXPECT_NEAR(solved->xy, -1, 1e-12);
  EXPECT_NEAR(solved->x0, 5, 1e-12);
  EXPECT_NEAR(solved->yx, 3, 1e-12);
  EXPECT_NEAR(solved->yy, 4, 1e-12);
  EXPECT_NEAR(solved->y0, -7, 1e-12);
}

TEST(SolveAffine, PivotsOnAbsoluteValues) {
  // The largest value of the first column is negative in the first and zero in the second triangle's first rows.
  expect_maps({{{-100, 1}, {0, 3}, {1e-9, -5}}}, {{{1, 2}, {3, 4}, {5, 7}}}, 1e-9);
  expect_maps({{{0, 0}, {0, 7}, {-3, 0}}}, {{{9, 9}, {-1, 2}, {4, -6}}}, 1e-12);
  expect_maps({{{-1e-6, -2}, {-1, -2}, {-3, -1e-6}}}, {{{0, 1}, {1, 0}, {1, 1}}}, 1e-12);
}

TEST(SolveAffine, DoesNotDependOnTheOrderOfCorners) {
  std::array<size_t, 3> order = {0, 1, 2};
  const Triangle source = {{{12, 400}, {300, 30}, {-50, -8}}};
  const Triangle target = {{{0.5, 0.25}, {-3, 8}, {100, 1}}};
  const Point probe = {77, 91};
  const Point expected = solve_affine(source, target)->apply(probe);
  do {
    const auto map = solve_affine({source[order[0]], source[order[1]], source[order[2]]},
                                  {target[order[0]], target[order[1]], target[order[2]]});
    ASSERT_TRUE(map.has_value());
    EXPECT_NEAR(map->apply(probe).x, expected.x, 1e-10);
    EXPECT_NEAR(map->apply(probe).y, expected.y, 1e-10);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(SolveAffine, MapsRandomTriangles) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-1000, 1000);
  const auto point = [&] { return Point{coordinate(random), coordinate(random)}; };
  for (int i = 0; i < 1000; ++i) {
    const Triangle source = {point(), point(), point()};
    const double twice_area = (source[1].x - source[0].x) * (source[2].y - source[0].y) -
                              (source[2].x - source[0].x) * (source[1].y - source[0].y);
    if (std::abs(twice_area) < 1000) continue;  // slivers lose digits
    expect_maps(source, {point(), point(), point()}, 1e-6);
  }
}

TEST(SolveAffine, RefusesDegenerateSources) {
  const Triangle target = {{{0, 0}, {1, 0}, {0, 1}}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(solve_affine({{{0, 0}, {0, 0}, {0, 0}}}, target));
  EXPECT_FALSE(solve_affine({{{5, 5}, {5, 5}, {9, 1}}}, target));
  EXPECT_FALSE(solve_affine({{{0.1, 0.1}, {0.2, 0.2}, {0.3, 0.3}}}, target));
  EXPECT_FALSE(solve_affine({{{3, -1}, {3, 0}, {3, 8}}}, target));
  EXPECT_FALSE(solve_affine({{{-4, 2}, {0, 2}, {7, 2}}}, target));
  EXPECT_FALSE(solve_affine({{{nan, 0}, {1, 0}, {0, 1}}}, target));
  EXPECT_FALSE(solve_affine({{{0, 0}, {1, nan}, {0, 1}}}, target));
  EXPECT_FALSE(solve_affine({{{infinity, 0}, {1, 0}, {0, 1}}}, target));
}

TEST(SolveAffine, AcceptsSmallTrianglesFarAway) {
  expect_maps({{{10000, 10000}, {10001, 10000}, {10000, 10001}}}, {{{0, 0}, {1, 0}, {0, 1}}}, 1e-6);
}

TEST(SolveAffine, MapsOntoALine) { expect_maps({{{0, 0}, {4, 0}, {0, 4}}}, {{{1, 1}, {2, 2}, {3, 3}}}, 1e-12); }

}  // namespace
}  // namespace lapilli::samples
