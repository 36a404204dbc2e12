// Exact coverage oracle: which pixels a triangle given in float32 clip coordinates covers. Shares no code with the
// driver. Vulkan chapters "Vertex Post-Processing" (clipping, viewport) and "Rasterization" (polygons, basic polygon
// rasterization).
//
// THE RULE THAT THE DRIVER FOLLOWS (bit for bit; geometry/ implements the same):
//  1. A triangle with a vertex that has a NaN or infinite x, y, z or w is dropped.
//  2. Unclipped triangles are those whose three vertices have w > 0, 0 <= z <= w, and x_f, y_f (below) within
//     [-kGuardBand, kGuardBand] pixels. For them, in float32, round to nearest even, no fma:
//        x_d = x_c / w_c                       (correctly rounded division)
//        x_f = x_d * (width / 2) + (x + width / 2)      (multiply, then add; likewise y, and z_f)
//     A result that overflows float32 makes the triangle a clipped one.
//  3. snap(v) = llrint(v * 256): signed 24.8 fixed point, ties to even. Pixel (i, j) has its centre (sample) at
//     (i + 0.5, j + 0.5) = (256 i + 128, 256 j + 128).
//  4. Edge functions of the snapped vertices are exact integers. A centre is covered if it lies strictly inside, or on
//     an edge that is a top edge (horizontal, interior at greater y) or a left edge (interior at greater x). Zero area
//     after snapping covers nothing.
//  5. Facing is the sign of the area of the snapped vertices: a = -1/2 sum(x_i y_i+1 - x_i+1 y_i), y down;
//     VK_FRONT_FACE_COUNTER_CLOCKWISE: a > 0 is front-facing.
//  6. Clipping to x, y = +-w is the same as discarding pixels whose centre is outside the viewport's rectangle
//     [x, x + width) x [y, y + height). (A centre on the rectangle's left or top border is in, on the right or bottom
//     border is out, as the top-left rule would decide for the clipped polygon.)
//  7. Every other triangle is clipped (0 <= z <= w, w > 0 and the guard band). Points made by clipping must be within
//     1/512 pixel of the exact point before they are snapped (float64 does it), and are then snapped as in 3. The
//     oracle calls a pixel kEither if less than kClipTolerance decides about it, and demands everything else.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace lapilli::oracle {

inline constexpr double kGuardBand = 32768.0;              // pixels
inline constexpr int kSubpixelBits = 8;                    // 24.8 fixed point
inline constexpr double kClipTolerance = 1.25 / 256.0;     // pixels; a snapped clip point is off by 0.71/256 + 1/512
inline constexpr double kViewportTolerance = 1.0 / 512.0;  // pixels

struct ClipVertex {
  float x = 0, y = 0, z = 0, w = 1;
};

struct Viewport {
  float x = 0, y = 0, width = 0, height = 0, min_depth = 0, max_depth = 1;
};

// Pixels [x, x + width) x [y, y + height).
struct Rect {
  int x = 0, y = 0, width = 0, height = 0;
};

enum class Cull : uint8_t { kNone, kFront, kBack, kBoth };
enum class Facing : uint8_t { kFront, kBack, kDegenerate };
enum class Coverage : uint8_t { kOutside, kInside, kEither };

struct RasterState {
  Viewport viewport;
  Rect scissor;  // already intersected with the framebuffer
  Cull cull = Cull::kNone;
  bool front_is_clockwise = false;  // VK_FRONT_FACE_CLOCKWISE
};

using Triangle = std::array<ClipVertex, 3>;

// Coverage of one triangle on the pixels of `bounds` (row by row); everything outside of `bounds` is kOutside.
struct TriangleCoverage {
  Rect bounds;
  std::vector<Coverage> pixels;
  Facing facing = Facing::kDegenerate;
  bool exact = true;  // false: the triangle is clipped (rule 7) and pixels may be kEither

  Coverage at(int px, int py) const;
};

TriangleCoverage cover(const Triangle& triangle, const RasterState& state);

// Signed distance in pixels of the centre of pixel (px, py) to the nearest edge (positive inside), from the snapped
// vertices where the triangle is unclipped, from the exact ones otherwise: says how close a decision was.
double edge_distance(const Triangle& triangle, const RasterState& state, int px, int py);

// Rules 2 and 3 for one vertex: false if the vertex alone makes its triangle a clipped one.
struct SnappedPoint {
  int64_t x = 0, y = 0;  // 24.8
  float z = 0;           // z_f
};
bool snap_vertex(const ClipVertex& vertex, const Viewport& viewport, SnappedPoint* out);

}  // namespace lapilli::oracle
