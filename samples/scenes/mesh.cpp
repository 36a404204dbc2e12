// The procedural mesh of solid_object.
#include "scenes/mesh.h"

#include <glm/gtc/constants.hpp>

#include "scenes/exact_transform.h"

namespace lapilli::samples {
namespace {

constexpr float kRingRadius = 0.66f;
constexpr float kKnotRadius = 0.30f;
constexpr float kTubeRadius = 0.185f;

// The centre line; `turn` in [0, 1) runs through it once.
glm::vec3 center_line(float turn) {
  const float angle = turn * glm::two_pi<float>();
  const float radius = kRingRadius + kKnotRadius * glm::cos(3.0f * angle);
  return {radius * glm::cos(2.0f * angle), radius * glm::sin(2.0f * angle), -kKnotRadius * glm::sin(3.0f * angle)};
}

glm::vec3 tube_point(float turn, float round) {
  constexpr float kStep = 1.0f / 1024.0f;
  const glm::vec3 here = center_line(turn);
  const glm::vec3 ahead = center_line(turn + kStep);
  const glm::vec3 tangent = glm::normalize(ahead - here);
  // The position itself is never along the tangent, so it gives a frame that closes.
  const glm::vec3 side = glm::normalize(glm::cross(here, tangent));
  const glm::vec3 up = glm::cross(tangent, side);
  const float angle = round * glm::two_pi<float>();
  return snap_position(here + kTubeRadius * (glm::cos(angle) * up + glm::sin(angle) * side));
}

// From ember through gold to slate and back along the knot, every other face a little darker.
glm::vec3 face_albedo(float turn, bool dark) {
  const glm::vec3 phase = glm::two_pi<float>() * (2.0f * turn + glm::vec3(0.0f, 0.16f, 0.38f));
  const glm::vec3 color = glm::vec3(0.62f, 0.46f, 0.38f) + glm::vec3(0.36f, 0.30f, 0.28f) * glm::cos(phase);
  return dark ? 0.86f * color : color;
}

}  // namespace

Mesh torus_knot(uint32_t segments, uint32_t sides) {
  const auto grid = [&](uint32_t segment, uint32_t side) {
    return tube_point(static_cast<float>(segment % segments) / static_cast<float>(segments),
                      static_cast<float>(side % sides) / static_cast<float>(sides));
  };
  // Of the two copies of a position, 0 starts the first face of its quad and 1 the second.
  const auto index = [&](uint32_t segment, uint32_t side, uint32_t copy) {
    return ((segment % segments) * sides + side % sides) * 2 + copy;
  };

  Mesh mesh;
  for (uint32_t i = 0; i < segments; ++i) {
    const float turn = static_cast<float>(i) / static_cast<float>(segments);
    for (uint32_t j = 0; j < sides; ++j) {
      const glm::vec3 a = grid(i, j);
      const glm::vec3 b = grid(i + 1, j);
      const glm::vec3 c = grid(i + 1, j + 1);
      const glm::vec3 d = grid(i, j + 1);
      const bool dark = (i + j) % 2 != 0;
      mesh.vertices.push_back({a, glm::normalize(glm::cross(b - a, c - a)), face_albedo(turn, dark)});
      mesh.vertices.push_back({a, glm::normalize(glm::cross(c - a, d - a)), face_albedo(turn, !dark)});
      const uint32_t faces[] = {index(i, j, 0), index(i + 1, j, 0),     index(i + 1, j + 1, 0),
                                index(i, j, 1), index(i + 1, j + 1, 0), index(i, j + 1, 0)};
      mesh.indices.insert(mesh.indices.end(), std::begin(faces), std::end(faces));
    }
  }
  return mesh;
}

}  // namespace lapilli::samples
