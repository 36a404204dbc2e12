// Clipping: what is inside, that the points lie on the planes, and that neighbours agree.
#include "geometry/clip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace lapilli {
namespace {

// A 200x100 viewport at the origin.
constexpr ClipSpace kSpace = {100, 100, 50, 50, true};

std::vector<ClipPoint> clip(const float (&v)[3][4], const ClipSpace& space = kSpace, const UserPlanes& user = {}) {
  ClipPoint polygon[kMaxClippedVertices];
  const uint32_t count = clip_triangle(space, v, user, polygon);
  return {polygon, polygon + count};
}

TEST(Clip, KeepsWhatIsInside) {
  const float v[3][4] = {{-1, -1, 0, 1}, {1, -1, 0.5f, 1}, {0, 1, 1, 1}};
  const auto polygon = clip(v);
  ASSERT_EQ(polygon.size(), 3u);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(polygon[i].weight[i], 1.0);
    for (size_t k = 0; k < 4; ++k) EXPECT_EQ(polygon[i].position[k], static_cast<double>(v[i][k]));
  }
}

TEST(Clip, DropsWhatIsOutside) {
  const float behind[3][4] = {{0, 0, -1, -1}, {1, 0, -2, -1}, {0, 1, -1, -2}};
  EXPECT_TRUE(clip(behind).empty());
  const float in_front_of_near[3][4] = {{0, 0, -0.1f, 1}, {1, 0, -0.1f, 1}, {0, 1, -0.1f, 1}};
  EXPECT_TRUE(clip(in_front_of_near).empty());
  const float beyond_far[3][4] = {{0, 0, 2, 1}, {1, 0, 2, 1}, {0, 1, 2, 1}};
  EXPECT_TRUE(clip(beyond_far).empty());
  ClipSpace clamped = kSpace;
  clamped.clip_depth = false;
  EXPECT_EQ(clip(beyond_far, clamped).size(), 3u);
  const float all_zero[3][4] = {};
  EXPECT_TRUE(clip(all_zero).empty());
}

TEST(Clip, NearPlaneMakesAQuad) {
  const float v[3][4] = {{0, 0, -1, 1}, {1, 0, 1, 1}, {0, 1, 1, 1}};
  const auto polygon = clip(v);
  ASSERT_EQ(polygon.size(), 4u);
  const auto on_plane =
      std::count_if(polygon.begin(), polygon.end(), [](const ClipPoint& p) { return p.position[2] == 0; });
  EXPECT_EQ(on_plane, 2);
}

// Eight planes that each cut a corner off, and those of the view volume: no vertex is lost.
TEST(Clip, PlanesOfTheUser) {
  const float v[3][4] = {{-300, -300, -1, 1}, {900, -300, 0.5f, 1}, {-300, 900, 2.2f, 1}};
  float distances[3][kMaxDistances];
  UserPlanes user{kMaxDistances, {distances[0], distances[1], distances[2]}};
  for (size_t k = 0; k < kMaxDistances; ++k) {
    const double angle = 0.3 + static_cast<double>(k) * 2 * M_PI / kMaxDistances;
    for (size_t i = 0; i < 3; ++i) {
      distances[i][k] = static_cast<float>(std::cos(angle) * static_cast<double>(v[i][0]) +
                                           std::sin(angle) * static_cast<double>(v[i][1]) + 20);
    }
  }
  const auto polygon = clip(v, kSpace, user);
  ASSERT_GE(polygon.size(), 8u);
  for (const ClipPoint& p : polygon) {
    for (size_t k = 0; k < kMaxDistances; ++k) {
      double distance = 0;
      for (size_t i = 0; i < 3; ++i) distance += p.weight[i] * static_cast<double>(distances[i][k]);
      EXPECT_GE(distance, -1e-9);
    }
    EXPECT_GE(p.position[2], -1e-12);
    EXPECT_LE(p.position[2], 1 + 1e-12);
  }
  for (float& distance : distances[1]) distance = -1;
  for (float& distance : distances[0]) distance = -1;
  for (float& distance : distances[2]) distance = -1;
  EXPECT_TRUE(clip(v, kSpace, user).empty());
}

// With w varying, "screen" weights give values linear in the framebuffer: check against the projected position itself.
TEST(Clip, ScreenWeightsAreLinearInTheFramebuffer) {
  const float v[3][4] = {{-0.5f, 0.2f, -1, 0.5f}, {1, 0.1f, 1, 4}, {0.3f, 0.9f, 1, 2}};
  for (const ClipPoint& point : clip(v)) {
    const double x = point.position[0] / point.position[3];
    double mixed = 0;
    double sum = 0;
    for (size_t i = 0; i < 3; ++i) {
      mixed += point.screen_weight[i] * static_cast<double>(v[i][0]) / static_cast<double>(v[i][3]);
      sum += point.screen_weight[i];
    }
    EXPECT_NEAR(mixed, x, 1e-12);
    EXPECT_NEAR(sum, 1, 1e-12);
  }
}

TEST(Clip, NeighboursGetTheSamePoints) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> coordinate(-3, 3);
  int compared = 0;
  for (int i = 0; i < 2000; ++i) {
    float a[4], b[4], c[4], d[4];
    for (float* vertex : {a, b, c, d}) {
      for (int k = 0; k < 4; ++k) vertex[k] = coordinate(random);
    }
    float left[3][4], right[3][4];
    for (int k = 0; k < 4; ++k) {
      left[0][k] = a[k], left[1][k] = b[k], left[2][k] = c[k];
      right[0][k] = b[k], right[1][k] = a[k], right[2][k] = d[k];  // the shared edge, the other way round
    }
    // Points on the shared edge have no weight of the third vertex.
    const auto on_edge = [](const std::vector<ClipPoint>& polygon) {
      std::vector<std::vector<double>> points;
      for (const ClipPoint& p : polygon) {
        if (p.weight[2] == 0) points.push_back({p.position, p.position + 4});
      }
      std::sort(points.begin(), points.end());
      return points;
    };
    const auto l = on_edge(clip(left));
    const auto r = on_edge(clip(right));
    if (l.size() == 2 && r.size() == 2) {
      EXPECT_EQ(l, r);
      ++compared;
    }
  }
  EXPECT_GT(compared, 100);
}

// The coordinates of one triangle span 20 binary orders of magnitude; the points stay good to 1/512 pixel.
TEST(Clip, GuardBandBoundsEverything) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> exponent(-10, 10);
  std::uniform_int_distribution<int> sign(0, 1);
  const auto value = [&] { return std::ldexp(sign(random) ? 1.0f : -1.0f, static_cast<int>(exponent(random))); };
  for (int i = 0; i < 5000; ++i) {
    float v[3][4];
    for (auto& vertex : v) {
      for (float& component : vertex) component = value();
    }
    for (const ClipPoint& p : clip(v)) {
      const double w = p.position[3];
      EXPECT_GT(w, 0);
      EXPECT_LE(std::fabs(kSpace.scale_x * p.position[0] / w + kSpace.offset_x), kGuardBand + 1.0 / 512);
      EXPECT_LE(std::fabs(kSpace.scale_y * p.position[1] / w + kSpace.offset_y), kGuardBand + 1.0 / 512);
      EXPECT_GE(p.position[2] / w, -1e-7);
      EXPECT_LE(p.position[2] / w, 1 + 1e-7);
    }
  }
}

}  // namespace
}  // namespace lapilli
