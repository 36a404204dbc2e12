// Writes the shader pictures as PNGs into a directory.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>

#include "common/png.h"
#include "scenes/shader_pictures.h"

int main(int argc, char** argv) try {
  using namespace lapilli::samples;
  ContextOptions options;
  VkExtent2D extent = {640, 480};
  std::string directory = ".";
  CLI::App app("Draws pictures with fragment shaders alone and writes PNGs.");
  app.add_option("-o,--output", directory, "directory for the PNGs")->capture_default_str();
  app.add_option("--width", extent.width, "pixels")->capture_default_str()->check(CLI::Range(1, 4096));
  app.add_option("--height", extent.height, "pixels")->capture_default_str()->check(CLI::Range(1, 4096));
  app.add_option("--device", options.device_name, "part of the device's name; default: the first device");
  app.add_flag("--validate", options.validation, "load VK_LAYER_KHRONOS_validation; a message is a failure");
  CLI11_PARSE(app, argc, argv);

  std::filesystem::create_directories(directory);
  const Context context(options);
  for (const ShaderPicture& picture : shader_pictures()) {
    const std::string path = directory + "/" + std::string(picture.name) + ".png";
    const Frame frame = draw_shader_picture(context, picture, extent);
    write_png(path, frame.width, frame.height, frame.color);
    std::printf("%s on %s\n", path.c_str(), context.properties().deviceName);
  }
  for (const std::string& message : context.messages()) std::fprintf(stderr, "%s\n", message.c_str());
  return context.messages().empty() ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "pictures: %s\n", error.what());
  return 1;
}
