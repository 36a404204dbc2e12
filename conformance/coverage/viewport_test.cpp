// Viewports (fractional, negative, larger than the framebuffer, any depth range) and scissors against the oracle.
#include <gtest/gtest.h>

#include <cmath>

#include "coverage/cells.h"
#include "harness/devices.h"

namespace lapilli::conformance {
namespace {

using oracle::ClipVertex;

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

// `change` edits the state of each cell; the triangles are placed by pixel in the cell, partly outside.
template <typename Change>
int check_states(uint32_t seed, Change change) {
  std::mt19937 random(seed);
  int covered = 0;
  for (int round = 0; round < 3; ++round) {
    std::vector<CellTriangle> cells;
    for (int i = 0; i < kCells; ++i) {
      CellTriangle& c = cells.emplace_back();
      c.state = cell_state(i);
      const oracle::Rect cell = c.state.scissor;
      change(random, &c.state);
      for (ClipVertex& v : c.triangle) {
        const double x = uniform(random, -16, 48) + cell.x - c.state.scissor.x;
        const double y = uniform(random, -16, 48) + cell.y - c.state.scissor.y;
        v = cell_vertex(c.state, x, y, float(uniform(random, 0, 1)));
      }
    }
    covered += check_cells(cells);
  }
  return covered;
}

TEST(Viewports, FractionalOffsetsAndSizes) {
  EXPECT_GT(check_states(301,
                         [](std::mt19937& r, oracle::RasterState* s) {
                           s->viewport.x += float(uniform(r, -3, 9));
                           s->viewport.y += float(uniform(r, -3, 9));
                           s->viewport.width = float(uniform(r, 3, 32));
                           s->viewport.height = float(uniform(r, 3, 32));
                         }),
            5000);
}

TEST(Viewports, EdgesOnPixelCentres) {
  EXPECT_GT(check_states(302,
                         [](std::mt19937& r, oracle::RasterState* s) {
                           s->viewport.x += std::floor(float(uniform(r, 0, 9))) + 0.5f;
                           s->viewport.y += std::floor(float(uniform(r, 0, 9))) + 0.5f;
                           s->viewport.width = std::floor(float(uniform(r, 2, 20)));
                           s->viewport.height = std::floor(float(uniform(r, 2, 20)));
                         }),
            5000);
}

TEST(Viewports, LargerThanTheFramebufferAndNegative) {
  EXPECT_GT(check_states(303,
                         [](std::mt19937& r, oracle::RasterState* s) {
                           s->viewport.x = float(uniform(r, -700, 0));
                           s->viewport.y = float(uniform(r, -700, 0));
                           s->viewport.width = float(uniform(r, 1400, 2000));
                           s->viewport.height = float(uniform(r, 1400, 2000));
                         }),
            5000);
}

TEST(Viewports, DepthRangesDoNotChangeCoverage) {
  EXPECT_GT(check_states(304,
                         [](std::mt19937& r, oracle::RasterState* s) {
                           s->viewport.min_depth = float(uniform(r, 0, 1));
                           s->viewport.max_depth = float(uniform(r, 0, 1));
                         }),
            5000);
}

TEST(Scissors, AnyRectangleEmptyOnesToo) {
  EXPECT_GT(check_states(305,
                         [](std::mt19937& r, oracle::RasterState* s) {
                           const int x = int(r() % 32), y = int(r() % 32);
                           s->scissor.x += x;
                           s->scissor.y += y;
                           s->scissor.width = int(r() % uint32_t(33 - x));
                           s->scissor.height = int(r() % uint32_t(33 - y));
                         }),
            2000);
}

TEST(Scissors, LargerThanTheFramebufferIsAllowed) {
  TriangleDraw d;
  d.vertices = {{-1, -1, 0, 1}, {3, -1, 0, 1}, {-1, 3, 0, 1}};
  d.raster = full_state(40, 24);
  d.raster.scissor = {0, 0, 0x7FFFFFFF, 0x7FFFFFFF};
  const std::vector<uint32_t> image = draw_triangles(subject(), 40, 24, {&d, 1});
  for (const uint32_t p : image) ASSERT_EQ(p, 0xFFFFFFFFu);
}

}  // namespace
}  // namespace lapilli::conformance
