// One scene rendered to a PNG.
#include "sample_main.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "common/png.h"
#include "scenes/renderer.h"

namespace lapilli::samples {

int sample_main(int argc, char** argv, const SampleProgram& program) {
  SceneOptions scene;
  ContextOptions context;
  const std::string name = program.name;
  std::string output = name + ".png";
  int frames = 0;

  CLI::App app("Renders the scene " + name + " with Vulkan 1.0 and writes a PNG.");
  app.add_option("-o,--output", output, "PNG file to write")->capture_default_str();
  app.add_option("--width", scene.width, "pixels")->capture_default_str()->check(CLI::Range(1, 4096));
  app.add_option("--height", scene.height, "pixels")->capture_default_str()->check(CLI::Range(1, 4096));
  app.add_option("--angle", scene.angle, "radians the scene has turned")->capture_default_str();
  app.add_option("--device", context.device_name, "part of the device's name; default: the first device");
  app.add_option("--frames", frames, "further frames to time")->capture_default_str()->check(CLI::NonNegativeNumber);
  app.add_flag("--validate", context.validation, "load VK_LAYER_KHRONOS_validation; a message is a failure");
  program.add_options(app);
  CLI11_PARSE(app, argc, argv);

  try {
    const Rendering result = render_scene(program.create(scene), context, frames);
    write_png(output, result.frame.width, result.frame.height, result.frame.color);
    std::printf("%s on %s: instance + device %.2f ms, pipelines %.2f ms, first frame %.2f ms", output.c_str(),
                result.device.c_str(), result.timings.instance_device, result.timings.pipelines,
                result.timings.first_frame);
    if (frames > 0) std::printf(", median of %d further frames %.3f ms", frames, result.timings.median_frame);
    std::printf("\n");
    for (const std::string& message : result.messages) std::fprintf(stderr, "%s\n", message.c_str());
    if (context.validation && !result.validated) {
      std::fprintf(stderr, "%s: the validation layer is not installed\n", program.name);
      return 1;
    }
    return result.messages.empty() ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", program.name, error.what());
    return 1;
  }
}

}  // namespace lapilli::samples
