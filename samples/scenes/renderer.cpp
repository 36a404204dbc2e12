// Renders a scene on a device and takes the time of each step.
#include "scenes/renderer.h"

#include <algorithm>
#include <chrono>

namespace lapilli::samples {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

SceneRenderer::SceneRenderer(const Context& context, std::unique_ptr<Scene> scene)
    : context_(context),
      scene_(std::move(scene)),
      geometry_(scene_->geometry()),
      target_(context, {geometry_.width, geometry_.height}) {
  scene_->create_resources(context_);
  const Clock::time_point start = Clock::now();
  scene_->create_pipelines(context_, target_);
  pipelines_ms_ = milliseconds_since(start);
}

double SceneRenderer::draw_frame() {
  const Clock::time_point start = Clock::now();
  const Color& clear = geometry_.clear_color;
  VkCommandBuffer commands = context_.begin_commands();
  target_.begin(commands,
                {static_cast<float>(clear[0]), static_cast<float>(clear[1]), static_cast<float>(clear[2]),
                 static_cast<float>(clear[3])},
                geometry_.clear_depth);
  scene_->record(commands);
  target_.end(commands);
  context_.submit_and_wait(commands);
  return milliseconds_since(start);
}

Rendering render_scene(std::unique_ptr<Scene> scene, const ContextOptions& options, int further_frames) {
  Rendering result;
  const Clock::time_point start = Clock::now();
  const Context context(options);
  result.timings.instance_device = milliseconds_since(start);
  result.device = context.properties().deviceName;

  {
    SceneRenderer renderer(context, std::move(scene));
    result.timings.pipelines = renderer.pipelines_ms();
    result.timings.first_frame = renderer.draw_frame();
    std::vector<double> frames;
    for (int i = 0; i < further_frames; ++i) frames.push_back(renderer.draw_frame());
    if (!frames.empty()) {
      const auto middle = frames.begin() + static_cast<std::ptrdiff_t>(frames.size() / 2);
      std::nth_element(frames.begin(), middle, frames.end());
      result.timings.median_frame = *middle;
    }
    result.frame = renderer.read_back();
  }
  result.messages = context.messages();
  result.validated = context.validation_active();
  return result;
}

}  // namespace lapilli::samples
