// What is measured: scenes that use Vulkan 1.0 without features or extensions, and the least work each of them is.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "common/target.h"

namespace lapilli::bench {

struct SceneOptions {
  VkExtent2D extent = {1280, 720};
  uint32_t count = 0;  // of what the scene has many of (SceneEntry::counted); 0: SceneEntry::count
};

// What no driver gets around for one frame; the limit of a frame is the longest of the times these take at the rates
// that machine.h measures.
struct Work {
  double written_bytes = 0;  // to attachments and buffers
  double read_bytes = 0;     // vertices, indices, buffers; once each
  double cached_bytes = 0;   // read and written in a tile that stays in the cache
  double operations = 0;     // arithmetic on float32, an fma counting as one
  double draws = 0;          // each with its state and a triangle, in order
  double loads = 0;          // from places that are computed; two texels side by side are one
};

// The functions that take a context are called once each, in this order; record() as often as frames are wanted.
class Scene {
 public:
  virtual ~Scene() = default;

  // What the device lacks for this scene; empty if it can draw it.
  virtual std::string missing(const samples::Context& /*context*/) const { return {}; }
  // Buffers, images, descriptor sets, render passes and pipeline layouts, and everything uploaded.
  virtual void create_resources(const samples::Context& context) = 0;
  // Shader modules and pipelines, and nothing else: this is what "pipelines" measures.
  virtual void create_pipelines(const samples::Context& context) = 0;
  // A whole frame, render passes and all.
  virtual void record(VkCommandBuffer commands) const = 0;
  // The last frame's picture, its depth left out. Scenes that compute show their results as bytes.
  virtual samples::Frame read_back(const samples::Context& context) const = 0;
  virtual Work work() const = 0;
};

// Which rows of the table of goals a scene belongs to is decided by its name, in verdict.cpp.
struct SceneEntry {
  std::string_view name;
  std::string_view summary;
  std::string_view counted;  // "layers", "triangles", "draws" …; empty if there is nothing to count
  uint32_t count;
  uint32_t small_count;  // for tests
  std::unique_ptr<Scene> (*create)(const SceneOptions& options);
};

std::span<const SceneEntry> scenes();
// Null if there is none of this name.
const SceneEntry* find_scene(std::string_view name);
// With the entry's own count if `options` names none.
std::unique_ptr<Scene> create_scene(const SceneEntry& entry, SceneOptions options);

}  // namespace lapilli::bench
