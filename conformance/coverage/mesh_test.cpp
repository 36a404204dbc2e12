// Meshes: every pixel exactly once across shared edges, for lists, strips and fans, with and without indices.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "coverage/cells.h"
#include "harness/devices.h"

namespace lapilli::conformance {
namespace {

using oracle::ClipVertex;
using oracle::Coverage;

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

ClipVertex at_pixel(double x, double y, double side, double w = 1) {
  return {float((x / side * 2 - 1) * w), float((y / side * 2 - 1) * w), float(0.5 * w), float(w)};
}

// A grid of (n + 1)^2 jittered points that reaches beyond the framebuffer, each square cut along a random diagonal.
// Jitter below a quarter of a step keeps the squares convex, so that nothing folds over.
struct Grid {
  std::vector<ClipVertex> points;
  std::vector<uint32_t> indices;
};

Grid random_grid(std::mt19937& random, int n, double side, bool perspective, double jitter = 0.24) {
  Grid g;
  const double step = side * 1.2 / n;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const double x = (i + uniform(random, -jitter, jitter)) * step - 0.1 * side;
      const double y = (j + uniform(random, -jitter, jitter)) * step - 0.1 * side;
      const bool border = i == 0 || j == 0 || i == n || j == n;
      g.points.push_back(at_pixel(border ? i * step - 0.1 * side : x, border ? j * step - 0.1 * side : y, side,
                                  perspective ? uniform(random, 0.5, 3) : 1));
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const uint32_t a = uint32_t(j * (n + 1) + i), b = a + 1, c = a + uint32_t(n) + 1, d = c + 1;
      if (random() % 2 == 0) {
        g.indices.insert(g.indices.end(), {a, b, c, b, d, c});
      } else {
        g.indices.insert(g.indices.end(), {a, b, d, a, d, c});
      }
    }
  }
  return g;
}

void expect_count_everywhere(const std::vector<uint32_t>& image, uint32_t side, uint32_t count) {
  int wrong = 0;
  for (size_t i = 0; i < image.size(); ++i) {
    if (image[i] == count * 0x01010101u) continue;
    if (++wrong <= 5) {
      ADD_FAILURE() << "pixel (" << i % side << ", " << i / side << ") is drawn " << (image[i] & 0xFF)
                    << " times instead of " << count;
    }
  }
  EXPECT_EQ(wrong, 0);
}

class Meshes : public testing::TestWithParam<bool> {};

TEST_P(Meshes, EachPixelExactlyOnce) {
  constexpr uint32_t kSide = 256;
  for (const int n : {3, 17, 90}) {
    std::mt19937 random(uint32_t(400 + n));
    const Grid g = random_grid(random, n, kSide, GetParam());
    TriangleDraw d;
    d.vertices = g.points;
    d.indices = g.indices;
    d.index_type = n % 2 == 0 ? Indices::k16 : Indices::k32;
    d.raster = full_state(kSide, kSide);
    d.count = true;
    expect_count_everywhere(draw_triangles(subject(), kSide, kSide, {&d, 1}), kSide, 1);
  }
}

TEST_P(Meshes, SmallerThanPixelsEachPixelExactlyOnce) {
  constexpr uint32_t kSide = 96;
  std::mt19937 random(410);
  const Grid g = random_grid(random, 200, kSide, GetParam());
  TriangleDraw d;
  d.vertices = g.points;
  d.indices = g.indices;
  d.index_type = Indices::k32;
  d.raster = full_state(kSide, kSide);
  d.count = true;
  expect_count_everywhere(draw_triangles(subject(), kSide, kSide, {&d, 1}), kSide, 1);
}

// Each triangle has its own colour: the owner of every pixel is the one the oracle names.
TEST_P(Meshes, EachPixelBelongsToTheTriangleTheOracleNames) {
  constexpr uint32_t kSide = 256;
  std::mt19937 random(420);
  const Grid g = random_grid(random, 40, kSide, GetParam());
  TriangleDraw d;
  d.raster = full_state(kSide, kSide);
  for (size_t i = 0; i < g.indices.size(); ++i) {
    const uint32_t id = uint32_t(i / 3) + 1;
    d.vertices.push_back(g.points[g.indices[i]]);
    d.colors.push_back({float(id & 0xFF) / 255, float(id >> 8) / 255, 0, 1});
  }
  const std::vector<uint32_t> image = draw_triangles(subject(), kSide, kSide, {&d, 1});
  int wrong = 0, seen = 0;
  for (size_t t = 0; t + 2 < d.vertices.size(); t += 3) {
    const oracle::Triangle triangle = {d.vertices[t], d.vertices[t + 1], d.vertices[t + 2]};
    const oracle::TriangleCoverage c = oracle::cover(triangle, d.raster);
    const uint32_t id = uint32_t(t / 3) + 1;
    for (int y = c.bounds.y; y < c.bounds.y + c.bounds.height; ++y) {
      for (int x = c.bounds.x; x < c.bounds.x + c.bounds.width; ++x) {
        if (c.at(x, y) != Coverage::kInside) continue;
        ++seen;
        const uint32_t got = image[size_t(y) * kSide + size_t(x)] & 0xFFFF;
        if (got != id && ++wrong <= 5) {
          ADD_FAILURE() << "pixel (" << x << ", " << y << ") belongs to triangle " << id - 1 << ", drawn by "
                        << int(got) - 1 << "\n"
                        << describe(triangle, d.raster);
        }
      }
    }
  }
  EXPECT_EQ(seen, int(kSide * kSide));
  EXPECT_EQ(wrong, 0);
}

INSTANTIATE_TEST_SUITE_P(Weights, Meshes, testing::Bool(),
                         [](const auto& kind) { return kind.param ? "Perspective" : "Affine"; });

// A mesh through the near plane: neighbours agree about the points that clipping makes, so no pixel is drawn twice and
// none within the visible part is left out.
TEST(ClippedMeshes, NoPixelTwiceAndNoHoles) {
  constexpr uint32_t kSide = 128;
  std::mt19937 random(430);
  for (int round = 0; round < 6; ++round) {
    // A height field seen by a 90 degree perspective whose near plane cuts through it.
    Grid g = random_grid(random, 24, kSide, false);
    const double near = 0.5, far = 20;
    for (ClipVertex& v : g.points) {
      const double x = double(v.x) * 6, z = double(v.y) * 4 + 1.5;
      v = {float(x), float(1 + 0.3 * z), float(far / (far - near) * (z - near)), float(z)};
    }
    TriangleDraw d;
    d.vertices = g.points;
    d.indices = g.indices;
    d.index_type = Indices::k16;
    d.raster = full_state(kSide, kSide);
    d.count = true;
    const std::vector<uint32_t> image = draw_triangles(subject(), kSide, kSide, {&d, 1});
    std::vector<int> least(image.size()), most(image.size());
    for (size_t t = 0; t + 2 < g.indices.size(); t += 3) {
      const oracle::TriangleCoverage c =
          oracle::cover({g.points[g.indices[t]], g.points[g.indices[t + 1]], g.points[g.indices[t + 2]]}, d.raster);
      for (int y = c.bounds.y; y < c.bounds.y + c.bounds.height; ++y) {
        for (int x = c.bounds.x; x < c.bounds.x + c.bounds.width; ++x) {
          const size_t at = size_t(y) * kSide + size_t(x);
          least[at] += c.at(x, y) == Coverage::kInside;
          most[at] += c.at(x, y) != Coverage::kOutside;
        }
      }
    }
    // The field is a function of the direction of view, so nothing overlaps: at most once. Where two or more triangles
    // might own a pixel, it lies on an inner edge (or on the border of the field, where one of them is alone).
    int wrong = 0, drawn = 0;
    for (size_t i = 0; i < image.size(); ++i) {
      const int got = int(image[i] & 0xFF);
      drawn += got;
      if (got < least[i] || got > std::min(most[i], 1)) {
        if (++wrong <= 5) {
          ADD_FAILURE() << "pixel (" << i % kSide << ", " << i / kSide << ") drawn " << got << " times, expected "
                        << least[i] << " to " << std::min(most[i], 1);
        }
      }
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(drawn, 1000);
  }
}

TEST(Fans, AroundAPointEachPixelAtMostOnce) {
  constexpr uint32_t kSide = 128;
  std::mt19937 random(440);
  for (int round = 0; round < 8; ++round) {
    const int corners = round == 7 ? 1000 : 3 + round * 5;
    TriangleDraw d;
    d.topology = Topology::kFan;
    d.count = true;
    d.raster = full_state(kSide, kSide);
    const double cx = round % 2 == 0 ? 64.5 : uniform(random, 50, 80), cy = round % 2 == 0 ? 63.5 : 64;
    d.vertices.push_back(at_pixel(cx, cy, kSide));
    std::vector<double> angles;
    for (int i = 0; i < corners; ++i) angles.push_back(uniform(random, 0, 2 * std::numbers::pi));
    for (int i = 0; i < 3; ++i) angles.push_back(i * 2.1);  // never a gap of half a turn
    std::sort(angles.begin(), angles.end());
    angles.push_back(angles.front());
    for (const double a : angles) {
      d.vertices.push_back(at_pixel(cx + 60 * std::cos(a), cy + 60 * std::sin(a), kSide));
    }
    const std::vector<uint32_t> image = draw_triangles(subject(), kSide, kSide, {&d, 1});
    std::vector<uint32_t> expected(image.size());
    for (const auto& t : assemble(d)) {
      const oracle::TriangleCoverage c =
          oracle::cover({d.vertices[t[0]], d.vertices[t[1]], d.vertices[t[2]]}, d.raster);
      for (int y = c.bounds.y; y < c.bounds.y + c.bounds.height; ++y) {
        for (int x = c.bounds.x; x < c.bounds.x + c.bounds.width; ++x) {
          expected[size_t(y) * kSide + size_t(x)] += c.at(x, y) == Coverage::kInside;
        }
      }
    }
    int wrong = 0;
    for (size_t i = 0; i < image.size(); ++i) {
      ASSERT_LE(expected[i], 1u);  // the oracle itself keeps the promise
      wrong += (image[i] & 0xFF) != expected[i];
    }
    EXPECT_EQ(wrong, 0) << "round " << round;
  }
}

// Topologies, index types, restart and vertexOffset assemble the triangles, provoking vertices and windings that the
// specification says. Colours are per vertex, so the provoking one shows.
TEST(Topologies, AssembleAsTheSpecificationSays) {
  constexpr uint32_t kSide = 64;
  std::mt19937 random(450);
  int total = 0;
  for (const auto topology : {Topology::kList, Topology::kStrip, Topology::kFan}) {
    for (const auto index_type : {Indices::kNone, Indices::k16, Indices::k32}) {
      for (const auto cull : {oracle::Cull::kNone, oracle::Cull::kBack, oracle::Cull::kFront}) {
        for (const bool restart : {false, true}) {
          if (restart && (topology == Topology::kList || index_type == Indices::kNone)) continue;
          TriangleDraw d;
          d.topology = topology;
          d.index_type = index_type;
          d.primitive_restart = restart;
          d.raster = full_state(kSide, kSide);
          d.raster.cull = cull;
          for (int i = 0; i < 14; ++i) {  // a list leaves two vertices over
            d.vertices.push_back(at_pixel(uniform(random, 0, 64), uniform(random, 0, 64), kSide));
            d.colors.push_back({float(i + 1) / 255, float(random() % 256) / 255, 0, 1});
          }
          if (index_type != Indices::kNone) {
            d.vertex_offset = 2;
            for (int i = 0; i < 14; ++i) d.indices.push_back(uint32_t(random() % 12));
            if (restart) d.indices[6] = d.indices[9] = index_type == Indices::k16 ? 0xFFFF : 0xFFFFFFFF;
          }
          const std::vector<uint32_t> image = draw_triangles(subject(), kSide, kSide, {&d, 1});
          std::vector<uint32_t> expected(image.size());
          for (const auto& t : assemble(d)) {
            const auto c = oracle::cover({d.vertices[t[0]], d.vertices[t[1]], d.vertices[t[2]]}, d.raster);
            const std::array<float, 4>& color = d.colors[t[0]];
            for (int y = c.bounds.y; y < c.bounds.y + c.bounds.height; ++y) {
              for (int x = c.bounds.x; x < c.bounds.x + c.bounds.width; ++x) {
                if (c.at(x, y) != Coverage::kInside) continue;
                expected[size_t(y) * kSide + size_t(x)] =
                    rgba(uint32_t(std::lround(color[0] * 255)), uint32_t(std::lround(color[1] * 255)), 0, 255);
              }
            }
          }
          int wrong = 0;
          for (size_t i = 0; i < image.size(); ++i) {
            wrong += image[i] != expected[i];
            total += expected[i] != 0;
          }
          EXPECT_EQ(wrong, 0) << "topology " << int(topology) << " indices " << int(index_type) << " cull " << int(cull)
                              << " restart " << restart;
        }
      }
    }
  }
  EXPECT_GT(total, 10000);
}

}  // namespace
}  // namespace lapilli::conformance
