// Sutherland-Hodgman over a table of planes, in float64.
#include "geometry/clip.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace lapilli {
namespace {

using Plane = std::array<double, 4>;  // inside: dot(plane, position) >= 0

double distance(const Plane& plane, const ClipPoint& point) {
  return plane[0] * point.position[0] + plane[1] * point.position[1] + plane[2] * point.position[2] +
         plane[3] * point.position[3];
}

// Of a plane of the user's; infinite ones are as far away as floats go.
double user_distance(const UserPlanes& user, uint32_t plane, const ClipPoint& point) {
  constexpr double kFar = static_cast<double>(std::numeric_limits<float>::max());
  double sum = 0;
  for (uint32_t i = 0; i < 3; ++i) {
    sum += point.weight[i] * std::clamp(static_cast<double>(user.distances[i][plane]), -kFar, kFar);
  }
  return sum;
}

// The point where the edge from `inside` (distance d_in >= 0) to `outside` (d_out < 0) meets the plane.
ClipPoint cross_point(const ClipPoint& inside, double d_in, const ClipPoint& outside, double d_out) {
  const double t = d_in / (d_in - d_out);
  ClipPoint point;
  // Both weights are positive, so that only the positions themselves can cancel.
  for (int i = 0; i < 4; ++i) {
    point.position[i] = (d_in * outside.position[i] - d_out * inside.position[i]) / (d_in - d_out);
  }
  // "the value of t used … will be adjusted to produce results that vary linearly in framebuffer space"
  const double w = point.position[3];
  const double screen_t = w != 0 ? t * outside.position[3] / w : t;
  for (int i = 0; i < 3; ++i) {
    point.weight[i] = inside.weight[i] + t * (outside.weight[i] - inside.weight[i]);
    point.screen_weight[i] = inside.screen_weight[i] + screen_t * (outside.screen_weight[i] - inside.screen_weight[i]);
  }
  return point;
}

}  // namespace

uint32_t clip_triangle(const ClipSpace& space, const float (&vertices)[3][4], const UserPlanes& user,
                       std::span<ClipPoint, kMaxClippedVertices> polygon) {
  std::array<ClipPoint, kMaxClippedVertices> buffers[2];
  ClipPoint* from = buffers[0].data();
  ClipPoint* to = buffers[1].data();
  uint32_t count = 3;
  for (uint32_t v = 0; v < 3; ++v) {
    from[v] = ClipPoint{};
    for (int i = 0; i < 4; ++i) from[v].position[i] = static_cast<double>(vertices[v][i]);
    from[v].weight[v] = from[v].screen_weight[v] = 1;
  }

  // Framebuffer position * w = scale * x + offset * w must stay within +-kGuardBand * w.
  constexpr uint32_t kFixed = 6;
  const Plane planes[kFixed] = {
      {0, 0, 1, 0},
      {0, 0, -1, 1},
      {space.scale_x, 0, 0, kGuardBand + space.offset_x},
      {-space.scale_x, 0, 0, kGuardBand - space.offset_x},
      {0, space.scale_y, 0, kGuardBand + space.offset_y},
      {0, -space.scale_y, 0, kGuardBand - space.offset_y},
  };
  for (uint32_t p = space.clip_depth ? 0 : 2; p < kFixed + user.count; ++p) {
    double distances[kMaxClippedVertices];
    bool any_outside = false;
    for (uint32_t i = 0; i < count; ++i) {
      distances[i] = p < kFixed ? distance(planes[p], from[i]) : user_distance(user, p - kFixed, from[i]);
      any_outside |= distances[i] < 0;
    }
    if (!any_outside) continue;
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; ++i) {
      const uint32_t next = i + 1 == count ? 0 : i + 1;
      const bool in = distances[i] >= 0;
      const bool next_in = distances[next] >= 0;
      if (in && kept < kMaxClippedVertices) to[kept++] = from[i];
      if (in != next_in && kept < kMaxClippedVertices) {
        to[kept++] = in ? cross_point(from[i], distances[i], from[next], distances[next])
                        : cross_point(from[next], distances[next], from[i], distances[i]);
      }
    }
    std::swap(from, to);
    count = kept;
    if (count < 3) return 0;
  }
  for (uint32_t i = 0; i < count; ++i) {
    if (!(from[i].position[3] > 0)) return 0;  // only (0, 0, 0, 0) or NaN is left on w = 0
  }
  std::copy_n(from, count, polygon.begin());
  return count;
}

}  // namespace lapilli
