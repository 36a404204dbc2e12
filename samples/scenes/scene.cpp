// The list of scenes.
#include "scenes/scene.h"

#include <array>
#include <stdexcept>
#include <string>

#include "scenes/barycentric.h"
#include "scenes/solid_object.h"
#include "scenes/transform.h"
#include "scenes/triangle_blit.h"

namespace lapilli::samples {

std::span<const SceneEntry> scenes() {
  static constexpr std::array<SceneEntry, 4> kScenes = {{
      {"barycentric", "red, green and blue corners before a second triangle, with depth", create_barycentric},
      {"transform", "scaled, turned, moved, looked at and projected; intensity falls from a corner", create_transform},
      {"solid_object", "a turning torus knot, one flat colour per face, back faces dropped", create_solid_object},
      {"triangle_blit", "a triangle cut out of a picture and mapped onto another", create_triangle_blit},
  }};
  return kScenes;
}

std::unique_ptr<Scene> create_scene(std::string_view name, const SceneOptions& options) {
  for (const SceneEntry& entry : scenes()) {
    if (entry.name == name) return entry.create(options);
  }
  throw std::runtime_error("no scene is called '" + std::string(name) + "'");
}

}  // namespace lapilli::samples
