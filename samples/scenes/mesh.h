// A closed triangle mesh with one normal and one colour for each face.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scenes/geometry.h"

namespace lapilli::samples {

struct FaceVertex {
  glm::vec3 position;  // object space, on the grid of exact_transform.h
  glm::vec3 normal;    // unit, of the face whose first vertex this is
  glm::vec3 albedo;    // of that face
};

// Triangles are counter-clockwise seen from outside.
struct Mesh {
  std::vector<FaceVertex> vertices;
  std::vector<uint32_t> indices;
};

// A (2, 3) torus knot about the z axis within a radius of 1.15: a tube of `sides` faces round, `segments` pieces long,
// two triangles for each of them. Every position is there twice, so that each of its two faces has a provoking vertex
// of its own.
Mesh torus_knot(uint32_t segments, uint32_t sides);

}  // namespace lapilli::samples
