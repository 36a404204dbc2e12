// Renders a scene on a device and takes the time of each step.
#pragma once

#include <memory>
#include <string>

#include "scenes/scene.h"

namespace lapilli::samples {

// All in milliseconds of wall clock.
struct Timings {
  double instance_device = 0;  // vkCreateInstance to vkGetDeviceQueue
  double pipelines = 0;        // shader modules and pipelines
  double first_frame = 0;      // record, submit and wait for the fence, the first time
  double median_frame = 0;     // the same, afterwards; 0 if no further frame was drawn
};

class SceneRenderer {
 public:
  // The context must outlive the renderer.
  SceneRenderer(const Context& context, std::unique_ptr<Scene> scene);

  // Records, submits and waits; returns milliseconds. The copy to the host is not part of a frame.
  double draw_frame();
  Frame read_back() const { return target_.read_back(context_); }
  double pipelines_ms() const { return pipelines_ms_; }
  const SceneGeometry& geometry() const { return geometry_; }

 private:
  const Context& context_;
  std::unique_ptr<Scene> scene_;
  SceneGeometry geometry_;
  RenderTarget target_;
  double pipelines_ms_ = 0;
};

struct Rendering {
  std::string device;
  Frame frame;
  Timings timings;
  std::vector<std::string> messages;  // of the layers and the driver, with ContextOptions::messages or validation
  bool validated = false;             // the validation layer was there
};

// Everything from the instance to the pixels: one first frame and `further_frames` more.
Rendering render_scene(std::unique_ptr<Scene> scene, const ContextOptions& options, int further_frames = 0);

}  // namespace lapilli::samples
