// The affine map of the plane that takes one triangle to another.
#pragma once

#include <array>
#include <optional>

namespace lapilli::samples {

struct Point {
  double x = 0;
  double y = 0;
};
using Triangle = std::array<Point, 3>;

// x' = xx * x + xy * y + x0, y' = yx * x + yy * y + y0.
struct AffineMap {
  double xx = 1, xy = 0, x0 = 0;
  double yx = 0, yy = 1, y0 = 0;

  Point apply(Point p) const { return {xx * p.x + xy * p.y + x0, yx * p.x + yy * p.y + y0}; }
};

// Maps source[i] to target[i]. Nothing if the source triangle is degenerate (its corners are on one line to within
// 1e-12 of their size, or not finite). The target may be degenerate.
std::optional<AffineMap> solve_affine(const Triangle& source, const Triangle& target);

}  // namespace lapilli::samples
