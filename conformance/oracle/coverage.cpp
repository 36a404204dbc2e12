// Exact coverage oracle: see the rule in coverage.h.
#include "oracle/coverage.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "oracle/homogeneous.h"

namespace lapilli::oracle {
namespace {

constexpr int64_t kOne = int64_t{1} << kSubpixelBits;
constexpr int64_t kHalf = kOne / 2;

bool finite(const ClipVertex& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

bool culled(Facing facing, Cull cull) {
  return cull == Cull::kBoth || (cull == Cull::kFront && facing == Facing::kFront) ||
         (cull == Cull::kBack && facing == Facing::kBack);
}

// `area` has the sign of the specification's a (rule 5).
Facing facing_of(int area_sign, bool front_is_clockwise) {
  if (area_sign == 0) return Facing::kDegenerate;
  return (area_sign > 0) != front_is_clockwise ? Facing::kFront : Facing::kBack;
}

Rect intersect(const Rect& r, double min_x, double min_y, double max_x, double max_y) {
  const auto clamp = [](double v, int low, int high) { return int(std::clamp(v, double(low), double(high))); };
  const int x0 = clamp(std::floor(min_x), r.x, r.x + r.width);
  const int y0 = clamp(std::floor(min_y), r.y, r.y + r.height);
  const int x1 = clamp(std::ceil(max_x), x0, r.x + r.width);
  const int y1 = clamp(std::ceil(max_y), y0, r.y + r.height);
  return {x0, y0, x1 - x0, y1 - y0};
}

// Rule 6 on one axis.
Coverage inside_span(double centre, double low, double high) {
  if (centre == low) return Coverage::kInside;
  if (centre == high) return Coverage::kOutside;
  const double distance = std::min(centre - low, high - centre);
  if (distance > kViewportTolerance) return Coverage::kInside;
  return distance < -kViewportTolerance ? Coverage::kOutside : Coverage::kEither;
}

Coverage both(Coverage a, Coverage b) {
  if (a == Coverage::kOutside || b == Coverage::kOutside) return Coverage::kOutside;
  return a == Coverage::kInside ? b : a;
}

Coverage inside_viewport(const Viewport& v, int px, int py) {
  return both(inside_span(px + 0.5, v.x, double(v.x) + v.width), inside_span(py + 0.5, v.y, double(v.y) + v.height));
}

struct IntegerEdge {
  int64_t ax, ay, dx, dy;
  bool owns;  // top or left edge: centres on it are inside

  bool inside(int64_t x, int64_t y) const {
    const int64_t e = dx * (y - ay) - dy * (x - ax);
    return e > 0 || (e == 0 && owns);
  }
};

void cover_exact(const std::array<SnappedPoint, 3>& p, const RasterState& state, TriangleCoverage* out) {
  // |coordinate| <= 2^23, so a difference has 24 bits and a product 48: int64 is exact.
  const int64_t twice_area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
  out->facing = facing_of(twice_area > 0 ? -1 : twice_area < 0 ? 1 : 0, state.front_is_clockwise);
  if (twice_area == 0 || culled(out->facing, state.cull)) return;

  std::array<IntegerEdge, 3> edges;
  for (size_t i = 0; i < 3; ++i) {
    SnappedPoint a = p[i], b = p[(i + 1) % 3];
    if (twice_area < 0) std::swap(a, b);
    const int64_t dx = b.x - a.x, dy = b.y - a.y;
    edges[i] = {a.x, a.y, dx, dy, dy < 0 || (dy == 0 && dx > 0)};
  }
  const auto [min_x, max_x] = std::minmax({p[0].x, p[1].x, p[2].x});
  const auto [min_y, max_y] = std::minmax({p[0].y, p[1].y, p[2].y});
  out->bounds =
      intersect(state.scissor, double(min_x) / kOne, double(min_y) / kOne, double(max_x) / kOne, double(max_y) / kOne);
  out->pixels.reserve(size_t(out->bounds.width) * size_t(out->bounds.height));
  for (int y = out->bounds.y; y < out->bounds.y + out->bounds.height; ++y) {
    for (int x = out->bounds.x; x < out->bounds.x + out->bounds.width; ++x) {
      const int64_t cx = x * kOne + kHalf, cy = y * kOne + kHalf;
      const bool in = edges[0].inside(cx, cy) && edges[1].inside(cx, cy) && edges[2].inside(cx, cy);
      out->pixels.push_back(in ? inside_viewport(state.viewport, x, y) : Coverage::kOutside);
    }
  }
}

// What the triangle may cover, a pixel added on each side; everything if a vertex is not before the eye.
Rect screen_bounds(const Homogeneous& h, const Rect& scissor) {
  double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
  for (const auto& v : h.vertex) {
    if (!(v[2] > 0)) return scissor;
    for (size_t i = 0; i < 2; ++i) {
      low[i] = std::min(low[i], double(v[i] / v[2]) - 1);
      high[i] = std::max(high[i], double(v[i] / v[2]) + 1);
    }
  }
  return intersect(scissor, low[0], low[1], high[0], high[1]);
}

Coverage decide(Wide distance) {
  if (distance > kClipTolerance) return Coverage::kInside;
  return distance < -kClipTolerance ? Coverage::kOutside : Coverage::kEither;
}

void cover_clipped(const Triangle& triangle, const RasterState& state, TriangleCoverage* out) {
  const Homogeneous h = homogeneous_exact(triangle, state.viewport);
  out->exact = false;
  // In framebuffer space a positive determinant is a clockwise turn on the screen, which is a < 0 (rule 5).
  out->facing = facing_of(h.determinant > 0 ? -1 : h.determinant < 0 ? 1 : 0, state.front_is_clockwise);
  if (culled(out->facing, state.cull)) return;
  out->bounds = screen_bounds(h, state.scissor);
  out->pixels.reserve(size_t(out->bounds.width) * size_t(out->bounds.height));
  std::array<ScreenLine, 5> lines = {edge_line(h, 0), edge_line(h, 1), edge_line(h, 2)};
  const bool degenerate = h.determinant == 0;
  if (!degenerate) {
    lines[3] = depth_line(h, triangle, false);
    lines[4] = depth_line(h, triangle, true);
  }
  for (int y = out->bounds.y; y < out->bounds.y + out->bounds.height; ++y) {
    for (int x = out->bounds.x; x < out->bounds.x + out->bounds.width; ++x) {
      Coverage c = inside_viewport(state.viewport, x, y);
      for (size_t i = 0; i < (degenerate ? 3 : 5) && c != Coverage::kOutside; ++i) {
        const Coverage side = decide(lines[i].distance(x + 0.5L, y + 0.5L));
        // Without area nothing is inside, but snapping may give it some.
        c = both(c, degenerate && side == Coverage::kInside ? Coverage::kOutside : side);
      }
      out->pixels.push_back(c);
    }
  }
}

}  // namespace

Coverage TriangleCoverage::at(int px, int py) const {
  const int x = px - bounds.x, y = py - bounds.y;
  if (x < 0 || y < 0 || x >= bounds.width || y >= bounds.height || pixels.empty()) return Coverage::kOutside;
  return pixels[size_t(y) * size_t(bounds.width) + size_t(x)];
}

bool snap_vertex(const ClipVertex& v, const Viewport& viewport, SnappedPoint* out) {
  if (!(v.w > 0) || !(v.z >= 0) || !(v.z <= v.w)) return false;
  // volatile: every step is rounded to float32 by itself, whatever the compiler likes to contract.
  volatile float xd = v.x / v.w, yd = v.y / v.w, zd = v.z / v.w;
  volatile float half_width = viewport.width / 2, half_height = viewport.height / 2;
  volatile float centre_x = viewport.x + half_width, centre_y = viewport.y + half_height;
  volatile float xs = xd * half_width, ys = yd * half_height;
  volatile float xf = xs + centre_x, yf = ys + centre_y;
  volatile float range = viewport.max_depth - viewport.min_depth;
  volatile float zs = zd * range;
  if (!(std::abs(xf) <= kGuardBand) || !(std::abs(yf) <= kGuardBand)) return false;
  out->x = std::llrint(xf * float(kOne));
  out->y = std::llrint(yf * float(kOne));
  out->z = zs + viewport.min_depth;
  return true;
}

TriangleCoverage cover(const Triangle& triangle, const RasterState& state) {
  TriangleCoverage out;
  out.bounds = {state.scissor.x, state.scissor.y, 0, 0};
  std::array<SnappedPoint, 3> points;
  bool unclipped = true;
  for (size_t i = 0; i < 3; ++i) {
    if (!finite(triangle[i])) return out;
    unclipped = snap_vertex(triangle[i], state.viewport, &points[i]) && unclipped;
  }
  if (unclipped) {
    cover_exact(points, state, &out);
  } else {
    cover_clipped(triangle, state, &out);
  }
  return out;
}

double edge_distance(const Triangle& triangle, const RasterState& state, int px, int py) {
  std::array<SnappedPoint, 3> points;
  bool unclipped = true;
  for (size_t i = 0; i < 3; ++i) unclipped = snap_vertex(triangle[i], state.viewport, &points[i]) && unclipped;
  const Homogeneous h = unclipped ? homogeneous_snapped(triangle, points) : homogeneous_exact(triangle, state.viewport);
  Wide nearest = std::numeric_limits<Wide>::infinity();
  for (size_t i = 0; i < 3; ++i) nearest = std::min(nearest, edge_line(h, i).distance(px + 0.5L, py + 0.5L));
  return double(nearest);
}

}  // namespace lapilli::oracle
