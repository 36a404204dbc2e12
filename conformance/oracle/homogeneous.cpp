// Homogeneous triangle setup for the oracles: see homogeneous.h.
#include "oracle/homogeneous.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lapilli::oracle {
namespace {

using Vec3 = std::array<Wide, 3>;

Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Wide dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

void finish(Homogeneous* h) {
  for (size_t i = 0; i < 3; ++i) h->edge[i] = cross(h->vertex[(i + 1) % 3], h->vertex[(i + 2) % 3]);
  h->determinant = dot(h->vertex[0], h->edge[0]);
}

}  // namespace

Homogeneous homogeneous_exact(const Triangle& triangle, const Viewport& viewport) {
  const Wide half_width = Wide(viewport.width) / 2;
  const Wide half_height = Wide(viewport.height) / 2;
  Homogeneous h;
  for (size_t i = 0; i < 3; ++i) {
    const ClipVertex& v = triangle[i];
    h.vertex[i] = {Wide(v.x) * half_width + Wide(v.w) * (Wide(viewport.x) + half_width),
                   Wide(v.y) * half_height + Wide(v.w) * (Wide(viewport.y) + half_height), Wide(v.w)};
  }
  finish(&h);
  return h;
}

Homogeneous homogeneous_snapped(const Triangle& triangle, const std::array<SnappedPoint, 3>& points) {
  Homogeneous h;
  for (size_t i = 0; i < 3; ++i) {
    const Wide w = triangle[i].w;
    h.vertex[i] = {Wide(points[i].x) / 256 * w, Wide(points[i].y) / 256 * w, w};
  }
  finish(&h);
  return h;
}

std::array<Wide, 3> homogeneous_weights(const Homogeneous& h, Wide x, Wide y) {
  const Vec3 point = {x, y, 1};
  std::array<Wide, 3> lambda;
  for (size_t i = 0; i < 3; ++i) lambda[i] = dot(h.edge[i], point) / h.determinant;
  return lambda;
}

Wide ScreenLine::distance(Wide x, Wide y) const {
  const Wide value = a * x + b * y + c;
  if (has_slope || value == 0) return value;
  return value < 0 ? -std::numeric_limits<Wide>::infinity() : std::numeric_limits<Wide>::infinity();
}

ScreenLine edge_line(const Homogeneous& h, size_t i) {
  const Vec3& edge = h.edge[i];
  const Wide length = std::hypot(edge[0], edge[1]);
  const Wide scale = (h.determinant < 0 ? Wide(-1) : Wide(1)) / (length > 0 ? length : Wide(1));
  return {edge[0] * scale, edge[1] * scale, edge[2] * scale, length > 0};
}

ScreenLine depth_line(const Homogeneous& h, const Triangle& triangle, bool far_plane) {
  Vec3 plane{};
  Wide scale = 0;  // of the terms that are added: what rounding is relative to
  for (size_t i = 0; i < 3; ++i) {
    const Wide d = far_plane ? Wide(triangle[i].w) - Wide(triangle[i].z) : Wide(triangle[i].z);
    for (size_t k = 0; k < 3; ++k) {
      const Wide term = h.edge[i][k] / h.determinant * d;
      plane[k] += term;
      if (k < 2) scale = std::max(scale, std::abs(term));
    }
  }
  const Wide slope = std::hypot(plane[0], plane[1]);
  if (slope > scale * 1e-12L) return {plane[0] / slope, plane[1] / slope, plane[2] / slope, true};
  // The same depth everywhere: inside, outside, or exactly on the plane.
  return {0, 0, std::abs(plane[2]) < 1e-12L ? 0 : plane[2], false};
}

}  // namespace lapilli::oracle
