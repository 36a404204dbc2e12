// Random triangles that need no clipping: every pixel as the exact oracle says.
#include <gtest/gtest.h>

#include <cmath>

#include "coverage/cells.h"

namespace lapilli::conformance {
namespace {

constexpr int kRounds = 6;  // of kCells triangles

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

// Fills kCells cells with triangles whose corners `point` makes (pixels from the cell's corner).
template <typename Point>
std::vector<CellTriangle> fill_cells(std::mt19937& random, Point point) {
  std::vector<CellTriangle> cells;
  for (int i = 0; i < kCells; ++i) {
    CellTriangle& c = cells.emplace_back();
    c.state = cell_state(i);
    for (oracle::ClipVertex& v : c.triangle) {
      const auto [x, y] = point(random);
      v = cell_vertex(c.state, x, y);
    }
  }
  return cells;
}

template <typename Point>
void check_kind(uint32_t seed, Point point, int least_covered = 1000) {
  std::mt19937 random(seed);
  int covered = 0;
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<CellTriangle> cells = fill_cells(random, point);
    covered += check_cells(cells);
    covered += check_cells_in_one_draw(cells);
  }
  EXPECT_GT(covered, least_covered);
}

TEST(RandomTriangles, AnyPositionInTheCell) {
  check_kind(101, [](std::mt19937& r) { return std::pair(uniform(r, 0, kCell), uniform(r, 0, kCell)); });
}

TEST(RandomTriangles, SmallerThanAFewPixels) {
  check_kind(102, [](std::mt19937& r) { return std::pair(uniform(r, 14, 17), uniform(r, 14, 17)); });
}

TEST(RandomTriangles, VerticesOnPixelCentres) {
  check_kind(103, [](std::mt19937& r) {
    return std::pair(std::floor(uniform(r, 0, kCell)) + 0.5, std::floor(uniform(r, 0, kCell)) + 0.5);
  });
}

TEST(RandomTriangles, VerticesOnPixelCornersAndCentres) {
  check_kind(104, [](std::mt19937& r) {
    return std::pair(std::floor(uniform(r, 0, 2 * kCell + 1)) / 2, std::floor(uniform(r, 0, 2 * kCell + 1)) / 2);
  });
}

TEST(RandomTriangles, VerticesOnAndBetweenSubpixels) {
  // Multiples of 1/512: half of them are ties of the snapping.
  check_kind(105, [](std::mt19937& r) {
    return std::pair(std::floor(uniform(r, 0, 512 * 4)) / 512 + 8, std::floor(uniform(r, 0, 512 * 4)) / 512 + 8);
  });
}

TEST(RandomTriangles, SliversAlongACommonLine) {
  // All corners within a subpixel or two of one line: mostly no area, sometimes a long thin one.
  check_kind(
      106,
      [](std::mt19937& r) {
        const double t = uniform(r, 0, 1), off = 3.0 / 256;
        return std::pair(1 + 29 * t + uniform(r, -off, off), 4 + 21 * t + uniform(r, -off, off));
      },
      20);
}

TEST(RandomTriangles, HorizontalAndVerticalEdges) {
  check_kind(107, [](std::mt19937& r) {
    return std::pair(std::floor(uniform(r, 0, 5)) * 7.5 + 0.5, std::floor(uniform(r, 0, 5)) * 7.5 + 0.25);
  });
}

TEST(RandomTriangles, AnyWeightGivesTheDividedPosition) {
  std::mt19937 random(108);
  int covered = 0;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<CellTriangle> cells;
    for (int i = 0; i < kCells; ++i) {
      CellTriangle& c = cells.emplace_back();
      c.state = cell_state(i);
      for (oracle::ClipVertex& v : c.triangle) {
        const float w = std::exp2(float(uniform(random, -20, 20)));
        v = cell_vertex(c.state, uniform(random, 0, kCell), uniform(random, 0, kCell), float(uniform(random, 0, 1)), w);
      }
    }
    covered += check_cells(cells);
    covered += check_cells_in_one_draw(cells);
  }
  EXPECT_GT(covered, 1000);
}

TEST(RandomTriangles, LargerThanTheViewportButInsideTheGuardBand) {
  std::mt19937 random(109);
  for (const double reach : {100.0, 3000.0, 30000.0}) {
    const std::vector<CellTriangle> cells = fill_cells(
        random, [reach](std::mt19937& r) { return std::pair(uniform(r, -reach, reach), uniform(r, -reach, reach)); });
    EXPECT_GT(check_cells(cells), 1000);
  }
}

TEST(RandomTriangles, BothWindingsAndAllCullModes) {
  std::mt19937 random(110);
  for (const auto cull : {oracle::Cull::kNone, oracle::Cull::kFront, oracle::Cull::kBack, oracle::Cull::kBoth}) {
    for (const bool clockwise : {false, true}) {
      std::vector<CellTriangle> cells =
          fill_cells(random, [](std::mt19937& r) { return std::pair(uniform(r, 0, kCell), uniform(r, 0, kCell)); });
      for (CellTriangle& c : cells) {
        c.state.cull = cull;
        c.state.front_is_clockwise = clockwise;
      }
      const int covered = check_cells(cells);
      EXPECT_EQ(covered > 0, cull != oracle::Cull::kBoth);
    }
  }
}

}  // namespace
}  // namespace lapilli::conformance
