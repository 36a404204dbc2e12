// A triangle in homogeneous framebuffer space (pixels times w): edge functions without a perspective divide, so that no
// clipping is needed to know what is covered (Olano and Greer's formulation). Used by the oracles only.
#pragma once

#include <cstddef>

#include "oracle/coverage.h"

namespace lapilli::oracle {

// 64 bit of mantissa and 15 bit of exponent on x86-64 (113 and 15 on aarch64): products of three float32 neither
// overflow nor lose anything that matters beside the tolerances in coverage.h.
using Wide = long double;

struct Homogeneous {
  std::array<std::array<Wide, 3>, 3> vertex{};  // (x_f * w, y_f * w, w) of each vertex
  std::array<std::array<Wide, 3>, 3> edge{};    // edge[i] = vertex[i + 1] x vertex[i + 2]
  Wide determinant = 0;
};

// From exact clip coordinates: x_f and y_f are not rounded.
Homogeneous homogeneous_exact(const Triangle& triangle, const Viewport& viewport);
// From the snapped vertices of an unclipped triangle (rules 2 and 3 of coverage.h).
Homogeneous homogeneous_snapped(const Triangle& triangle, const std::array<SnappedPoint, 3>& points);

// lambda[i] with sum(lambda[i] * vertex[i]) = (x, y, 1); the point (pixels) is inside if none is negative.
std::array<Wide, 3> homogeneous_weights(const Homogeneous& h, Wide x, Wide y);

// A line on the screen: distance(x, y) in pixels, signed. Without a slope it says kInfinite with the sign of its value.
struct ScreenLine {
  Wide a = 0, b = 0, c = 0;
  bool has_slope = false;
  Wide distance(Wide x, Wide y) const;
};

// The line of edge i, positive on the inner side. No slope if both ends are at the eye.
ScreenLine edge_line(const Homogeneous& h, size_t i);
// Where z = 0 (near) or z = w (far), positive on the visible side. z is affine on the screen.
ScreenLine depth_line(const Homogeneous& h, const Triangle& triangle, bool far_plane);

}  // namespace lapilli::oracle
