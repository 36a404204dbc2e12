// Many triangles against the exact oracle in one image: each has a cell of the framebuffer to itself.
#pragma once

#include <random>
#include <span>
#include <string>

#include "coverage/draw_triangles.h"

namespace lapilli::conformance {

inline constexpr int kCell = 32;         // pixels
inline constexpr int kCellsAcross = 16;  // 512 x 512 framebuffer, 256 triangles
inline constexpr int kCells = kCellsAcross * kCellsAcross;

// A triangle and the state it is drawn with; the scissor must lie within the cell.
struct CellTriangle {
  oracle::Triangle triangle;
  oracle::RasterState state;
};

// The state of cell `index`: viewport and scissor are the cell.
oracle::RasterState cell_state(int index);

// Clip coordinates (w = 1 unless given) of the point (x, y), in pixels from the cell's corner.
oracle::ClipVertex cell_vertex(const oracle::RasterState& state, double x, double y, float z = 0.5f, float w = 1.0f);

// Draws up to kCells triangles, one draw each with its own viewport and scissor, and compares every pixel with the
// oracle. Differences become test failures with what is needed to reproduce them.
// Returns the number of pixels that the oracle calls covered, so that tests can see they tested something.
int check_cells(std::span<const CellTriangle> cells);

// The same in one draw with one viewport over everything: x_f and y_f take other roundings, many triangles share bins.
// Only the triangles' pixel positions within the cells are taken over.
int check_cells_in_one_draw(std::span<const CellTriangle> cells);

// Compares an image of triangles that do not overlap (each pixel belongs to the one that `cells` says).
std::string describe(const oracle::Triangle& triangle, const oracle::RasterState& state);

}  // namespace lapilli::conformance
