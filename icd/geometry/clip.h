// Clipping of triangles in clip space. Specification: chapter "Fixed-Function Vertex Post-Processing", Primitive
// Clipping.
#pragma once

#include <cstdint>
#include <span>

#include "geometry/bins.h"

namespace lapilli {

constexpr uint32_t kMaxClippedVertices = 3 + 6 + kMaxDistances;  // each plane adds at most one

// A corner of a clipped polygon as a mixture of the triangle's three vertices.
struct ClipPoint {
  double position[4];       // clip space x y z w
  double weight[3];         // of the vertices, for attributes linear in clip space (perspective)
  double screen_weight[3];  // for attributes linear in framebuffer space (noperspective)
};

struct ClipSpace {
  double scale_x, offset_x;  // framebuffer x = scale_x * x/w + offset_x, pixels
  double scale_y, offset_y;
  bool clip_depth;  // 0 <= z <= w; off with depthClampEnable
};

// The vertices' distances to the planes of the user: inside is what has none below 0.
struct UserPlanes {
  uint32_t count = 0;
  const float* distances[3] = {};  // [vertex][plane]; no NaNs
};

// Clips a triangle against 0 <= z <= w, the guard band (which implies w >= 0) and the user's planes. Returns the number
// of corners written to `polygon` (0, or 3 to kMaxClippedVertices). A point on an edge is always computed from the end
// inside towards the end outside, so that triangles which share the edge get the same point.
uint32_t clip_triangle(const ClipSpace& space, const float (&vertices)[3][4], const UserPlanes& user,
                       std::span<ClipPoint, kMaxClippedVertices> polygon);

}  // namespace lapilli
