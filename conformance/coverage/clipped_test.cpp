// Triangles that must be clipped: far outside, through near and far plane, behind the eye; and ones that must vanish.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "coverage/cells.h"
#include "harness/devices.h"

namespace lapilli::conformance {
namespace {

using oracle::ClipVertex;

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

template <typename Make>
void check_kind(uint32_t seed, int rounds, int least_covered, Make make) {
  std::mt19937 random(seed);
  int covered = 0;
  for (int round = 0; round < rounds; ++round) {
    std::vector<CellTriangle> cells;
    for (int i = 0; i < kCells; ++i) {
      CellTriangle& c = cells.emplace_back();
      c.state = cell_state(i);
      for (ClipVertex& v : c.triangle) v = make(random, c.state);
    }
    covered += check_cells(cells);
  }
  EXPECT_GT(covered, least_covered);
}

TEST(ClippedTriangles, UpToAMillionPixelsOutside) {
  for (const double reach : {5e4, 2e5, 1e6}) {
    check_kind(201, 2, 1000, [reach](std::mt19937& r, const oracle::RasterState& s) {
      return cell_vertex(s, uniform(r, -reach, reach), uniform(r, -reach, reach));
    });
  }
}

TEST(ClippedTriangles, OneVertexInTheCellOthersFarAway) {
  int corner = 0;
  check_kind(202, 4, 1000, [&corner](std::mt19937& r, const oracle::RasterState& s) {
    const double reach = corner++ % 3 == 0 ? 32 : 1e6;
    return cell_vertex(s, uniform(r, -reach, reach) + 16, uniform(r, -reach, reach) + 16);
  });
}

TEST(ClippedTriangles, ThroughNearAndFarPlane) {
  check_kind(203, 4, 1000, [](std::mt19937& r, const oracle::RasterState& s) {
    return cell_vertex(s, uniform(r, -8, 40), uniform(r, -8, 40), float(uniform(r, -1.5, 2.5)));
  });
}

TEST(ClippedTriangles, ThroughNearAndFarPlaneInPerspective) {
  check_kind(204, 4, 1000, [](std::mt19937& r, const oracle::RasterState& s) {
    return cell_vertex(s, uniform(r, -8, 40), uniform(r, -8, 40), float(uniform(r, -1.5, 2.5)),
                       float(uniform(r, 0.1, 4)));
  });
}

TEST(ClippedTriangles, WeightsOfBothSigns) {
  check_kind(205, 4, 200, [](std::mt19937& r, const oracle::RasterState&) {
    return ClipVertex{float(uniform(r, -2, 2)), float(uniform(r, -2, 2)), float(uniform(r, -0.5, 1)),
                      float(uniform(r, -1, 2))};
  });
}

TEST(ClippedTriangles, PerspectiveProjectionOfGeometryAroundTheEye) {
  // A real projection: 90 degrees, near 0.1, far 100; points around the eye, before and behind it.
  check_kind(206, 4, 1000, [](std::mt19937& r, const oracle::RasterState&) {
    const double z = uniform(r, -3, 5), near = 0.1, far = 100;
    return ClipVertex{float(uniform(r, -4, 4)), float(uniform(r, -4, 4)),
                      float(far / (far - near) * z - far * near / (far - near)), float(z)};
  });
}

TEST(ClippedTriangles, ExactlyOnTheNearAndFarPlaneIsInside) {
  std::vector<CellTriangle> cells;
  for (int i = 0; i < kCells; ++i) {
    CellTriangle& c = cells.emplace_back();
    c.state = cell_state(i);
    const float z = i % 2 == 0 ? 0.0f : 1.0f;
    c.triangle = {cell_vertex(c.state, 1, 1, z), cell_vertex(c.state, 30, 2, z), cell_vertex(c.state, 3, 29, z)};
  }
  EXPECT_GT(check_cells(cells), kCells * 300);
}

TEST(ClippedTriangles, BehindBeforeAndBeyondAreInvisible) {
  std::mt19937 random(207);
  std::vector<CellTriangle> cells;
  for (int i = 0; i < kCells; ++i) {
    CellTriangle& c = cells.emplace_back();
    c.state = cell_state(i);
    for (ClipVertex& v : c.triangle) {
      const double x = uniform(random, 0, 32), y = uniform(random, 0, 32);
      switch (i % 4) {
        case 0:
          v = cell_vertex(c.state, x, y, float(uniform(random, -2, -0.01)));
          break;
        case 1:
          v = cell_vertex(c.state, x, y, float(uniform(random, 1.01, 3)));
          break;
        case 2:
          v = cell_vertex(c.state, x, y, 0.5f, float(uniform(random, -3, -0.1)));
          break;
        default:
          v = cell_vertex(c.state, x + 40, y);
          break;
      }
    }
  }
  EXPECT_EQ(check_cells(cells), 0);
}

// Numbers that overflow on the way, and ones that are none: nothing outside the oracle's rule may be drawn, and nothing
// may crash. With a NaN or an infinity the triangle is dropped.
TEST(ClippedTriangles, NonFiniteVerticesDropTheTriangle) {
  const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  std::mt19937 random(208);
  std::vector<CellTriangle> cells;
  for (int i = 0; i < kCells; ++i) {
    CellTriangle& c = cells.emplace_back();
    c.state = cell_state(i);
    for (ClipVertex& v : c.triangle) v = cell_vertex(c.state, uniform(random, -9, 40), uniform(random, -9, 40));
    ClipVertex& bad = c.triangle[size_t(i) % 3];
    float* const fields[4] = {&bad.x, &bad.y, &bad.z, &bad.w};
    const float values[3] = {inf, -inf, nan};
    *fields[i / 3 % 4] = values[i / 12 % 3];
    if (i % 5 == 0) c.triangle[size_t(i + 1) % 3].w = nan;
  }
  EXPECT_EQ(check_cells(cells), 0);
}

TEST(ClippedTriangles, HugeAndTinyNumbersDoNoHarm) {
  // Positions over the whole range of float32, signs and denormals included. What is right is known only roughly (the
  // tolerance of coverage.h says nothing at 1e30 pixels), so: no crash, and the cell next to it stays untouched.
  std::mt19937 random(209);
  std::vector<TriangleDraw> draws;
  for (int i = 0; i < 4096; ++i) {
    TriangleDraw& d = draws.emplace_back();
    d.raster = full_state(64, 64);
    d.raster.scissor = {16, 16, 32, 32};
    for (int k = 0; k < 3; ++k) {
      float f[4];
      for (float& v : f) {
        const uint32_t bits = random() & 0xFF7FFFFFu;  // an exponent below the largest: finite
        std::memcpy(&v, &bits, 4);
      }
      d.vertices.push_back({f[0], f[1], i % 2 == 0 ? 0.0f : f[2], i % 3 == 0 ? std::abs(f[3]) : f[3]});
    }
  }
  const std::vector<uint32_t> image = draw_triangles(subject(), 64, 64, draws);
  int inside = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const bool in_scissor = x >= 16 && x < 48 && y >= 16 && y < 48;
      const bool drawn = image[size_t(y) * 64 + size_t(x)] != 0;
      inside += drawn;
      EXPECT_FALSE(drawn && !in_scissor) << x << "," << y;
    }
  }
  EXPECT_GT(inside, 0);
}

}  // namespace
}  // namespace lapilli::conformance
