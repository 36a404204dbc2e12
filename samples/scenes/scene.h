// What all scenes have in common, and the list of them.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "common/target.h"
#include "scenes/geometry.h"

namespace lapilli::samples {

struct SceneOptions {
  uint32_t width = 640;  // pixels
  uint32_t height = 480;
  float angle = 0.0f;  // radians; what a scene turns with time, added to the pose it starts in
};

// A scene describes itself without Vulkan and draws itself with it. The functions that take a context are called once
// each, in this order; record() as often as frames are wanted.
class Scene {
 public:
  virtual ~Scene() = default;

  virtual SceneGeometry geometry() const = 0;

  // Buffers, images, descriptor sets and pipeline layouts.
  virtual void create_resources(const Context& context) = 0;
  // Shader modules and pipelines, and nothing else: this is what "pipeline creation" measures.
  virtual void create_pipelines(const Context& context, const RenderTarget& target) = 0;
  // The draws, inside the target's render pass.
  virtual void record(VkCommandBuffer commands) const = 0;
};

struct SceneEntry {
  std::string_view name;
  std::string_view summary;
  std::unique_ptr<Scene> (*create)(const SceneOptions& options);
};

// barycentric, transform, solid_object, triangle_blit.
std::span<const SceneEntry> scenes();

// Throws std::runtime_error if there is no scene of this name.
std::unique_ptr<Scene> create_scene(std::string_view name, const SceneOptions& options);

}  // namespace lapilli::samples
