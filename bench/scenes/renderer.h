// Draws a scene frame by frame and takes the times.
#pragma once

#include <memory>

#include "scenes/scene.h"

namespace lapilli::bench {

// Milliseconds of wall clock.
struct FrameTime {
  double record = 0;  // vkBeginCommandBuffer to vkEndCommandBuffer
  double frame = 0;   // vkQueueSubmit until the fence is seen
};

class SceneRenderer {
 public:
  // The context must outlive the renderer, and offer what the scene needs.
  SceneRenderer(const samples::Context& context, std::unique_ptr<Scene> scene);

  double pipelines_ms() const { return pipelines_ms_; }
  // Records the command buffer anew, as applications do, submits it and waits.
  FrameTime draw_frame();
  samples::Frame read_back() const { return scene_->read_back(context_); }

 private:
  const samples::Context& context_;
  std::unique_ptr<Scene> scene_;
  double pipelines_ms_ = 0;
  samples::CommandPool pool_;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  samples::Fence fence_;
};

// One frame of a scene at its small count; empty if the device lacks something for it.
samples::Frame draw_once(const samples::Context& context, const SceneEntry& entry, VkExtent2D extent);

}  // namespace lapilli::bench
