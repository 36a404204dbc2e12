// All scenes under the validation layer: not a word.
#include <gtest/gtest.h>

#include "harness/devices.h"
#include "scenes/renderer.h"

namespace lapilli::conformance {
namespace {

TEST(Validation, ScenesAreSilent) {
  samples::ContextOptions options;
  options.device_name = subject_name();
  options.validation = true;
  {
    const samples::Context context(options);
    if (!context.validation_active()) GTEST_SKIP() << "VK_LAYER_KHRONOS_validation is not installed";
  }
  for (const samples::SceneEntry& scene : samples::scenes()) {
    const samples::Rendering rendering = samples::render_scene(scene.create({160, 120, 0.3f}), options, 2);
    for (const std::string& message : rendering.messages) ADD_FAILURE() << scene.name << ": " << message;
  }
}

}  // namespace
}  // namespace lapilli::conformance
