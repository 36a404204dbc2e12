// Homogeneous triangle setup for the oracles: see homogeneous.h.
#include "oracle/homogeneous.h"

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

Wide line_distance(const Homogeneous& h, int i, Wide x, Wide y) {
  const Vec3& edge = h.edge[size_t(i)];
  const Wide length = std::hypot(edge[0], edge[1]);
  const Wide value = dot(edge, {x, y, 1});
  const Wide side = h.determinant < 0 ? Wide(-1) : Wide(1);
  if (!(length > 0)) {
    // The line at infinity: everything is on one side of it.
    return side * value < 0 ? -std::numeric_limits<Wide>::infinity() : std::numeric_limits<Wide>::infinity();
  }
  return side * value / length;
}

}  // namespace lapilli::oracle
