// See cells.h.
#include "coverage/cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "harness/devices.h"

namespace lapilli::conformance {
namespace {

using oracle::ClipVertex;
using oracle::Coverage;

constexpr uint32_t kSide = kCell * kCellsAcross;
constexpr int kMostFailures = 5;  // printed; the rest is counted

// Compares the pixels of one cell; returns the covered ones and adds to `wrong` those that differ.
int compare_cell(const oracle::Triangle& triangle, const oracle::RasterState& state, const oracle::Rect& cell,
                 const std::vector<uint32_t>& image, int* wrong) {
  const oracle::TriangleCoverage expected = oracle::cover(triangle, state);
  int covered = 0;
  for (int y = cell.y; y < cell.y + cell.height; ++y) {
    for (int x = cell.x; x < cell.x + cell.width; ++x) {
      const Coverage want = expected.at(x, y);
      const bool got = image[size_t(y) * kSide + size_t(x)] != 0;
      covered += want == Coverage::kInside;
      if (want == Coverage::kEither || got == (want == Coverage::kInside)) continue;
      if (++*wrong <= kMostFailures) {
        ADD_FAILURE() << "pixel (" << x << ", " << y << ") is " << (got ? "covered" : "not covered")
                      << ", the oracle says otherwise; distance to the nearest edge "
                      << oracle::edge_distance(triangle, state, x, y) << " pixels, "
                      << (expected.exact ? "not clipped" : "clipped") << "\n"
                      << describe(triangle, state);
      }
    }
  }
  return covered;
}

}  // namespace

std::string describe(const oracle::Triangle& triangle, const oracle::RasterState& state) {
  char line[256];
  std::string out;
  for (const ClipVertex& v : triangle) {
    std::snprintf(line, sizeof(line), "  clip (%a, %a, %a, %a) = (%.9g, %.9g, %.9g, %.9g)\n", double(v.x), double(v.y),
                  double(v.z), double(v.w), double(v.x), double(v.y), double(v.z), double(v.w));
    out += line;
  }
  const oracle::Viewport& p = state.viewport;
  const oracle::Rect& s = state.scissor;
  std::snprintf(line, sizeof(line),
                "  viewport (%.9g, %.9g, %.9g, %.9g; %.9g .. %.9g) scissor (%d, %d, %d, %d) cull %d clockwise %d",
                double(p.x), double(p.y), double(p.width), double(p.height), double(p.min_depth), double(p.max_depth),
                s.x, s.y, s.width, s.height, int(state.cull), int(state.front_is_clockwise));
  return out + line;
}

oracle::RasterState cell_state(int index) {
  const int x = index % kCellsAcross * kCell, y = index / kCellsAcross * kCell;
  oracle::RasterState state;
  state.viewport = {float(x), float(y), kCell, kCell, 0, 1};
  state.scissor = {x, y, kCell, kCell};
  return state;
}

ClipVertex cell_vertex(const oracle::RasterState& state, double x, double y, float z, float w) {
  const oracle::Viewport& v = state.viewport;
  const double px = x + state.scissor.x - double(v.x), py = y + state.scissor.y - double(v.y);
  return {float((px / double(v.width) * 2 - 1) * double(w)), float((py / double(v.height) * 2 - 1) * double(w)), z * w,
          w};
}

int check_cells(std::span<const CellTriangle> cells) {
  std::vector<TriangleDraw> draws;
  for (const CellTriangle& c : cells) {
    TriangleDraw& d = draws.emplace_back();
    d.vertices.assign(c.triangle.begin(), c.triangle.end());
    d.raster = c.state;
  }
  const std::vector<uint32_t> image = draw_triangles(subject(), kSide, kSide, draws);
  int covered = 0, wrong = 0;
  for (size_t i = 0; i < cells.size(); ++i) {
    covered += compare_cell(cells[i].triangle, cells[i].state, cell_state(int(i)).scissor, image, &wrong);
  }
  EXPECT_EQ(wrong, 0) << "pixels differ from the exact coverage";
  return covered;
}

int check_cells_in_one_draw(std::span<const CellTriangle> cells) {
  TriangleDraw draw;
  draw.raster = full_state(kSide, kSide);
  for (const CellTriangle& c : cells) {
    const oracle::Viewport& v = c.state.viewport;
    for (const ClipVertex& p : c.triangle) {
      const double x = (double(p.x) / double(p.w) + 1) / 2 * double(v.width) + double(v.x);
      const double y = (double(p.y) / double(p.w) + 1) / 2 * double(v.height) + double(v.y);
      draw.vertices.push_back(
          {float((x / kSide * 2 - 1) * double(p.w)), float((y / kSide * 2 - 1) * double(p.w)), p.z, p.w});
    }
  }
  const std::vector<uint32_t> image = draw_triangles(subject(), kSide, kSide, {&draw, 1});
  int covered = 0, wrong = 0;
  for (size_t i = 0; i < cells.size(); ++i) {
    const oracle::Triangle t = {draw.vertices[3 * i], draw.vertices[3 * i + 1], draw.vertices[3 * i + 2]};
    covered += compare_cell(t, draw.raster, cell_state(int(i)).scissor, image, &wrong);
  }
  EXPECT_EQ(wrong, 0) << "pixels differ from the exact coverage";
  return covered;
}

}  // namespace lapilli::conformance
