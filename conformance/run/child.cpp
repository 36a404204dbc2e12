// Both ends of the pipe between the runner and a process that draws.
#include "run/child.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>

namespace lapilli::run {
namespace {

using nlohmann::json;

void save_pixels(const std::string& path, const samples::Frame& frame) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(frame.color.data()), static_cast<std::streamsize>(frame.color.size()));
  file.write(reinterpret_cast<const char*>(frame.depth.data()),
             static_cast<std::streamsize>(frame.depth.size() * sizeof(float)));
  file.flush();
  if (!file) throw std::runtime_error("cannot write " + path);
}

std::optional<samples::Frame> load_pixels(const std::string& path, uint32_t width, uint32_t height) {
  const size_t pixels = size_t{width} * height;
  samples::Frame frame = {width, height, std::vector<uint8_t>(pixels * 4), std::vector<float>(pixels)};
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(frame.color.data()), static_cast<std::streamsize>(frame.color.size()));
  file.read(reinterpret_cast<char*>(frame.depth.data()), static_cast<std::streamsize>(pixels * sizeof(float)));
  if (!file) return std::nullopt;
  return frame;
}

void say(const json& line) { std::cout << line.dump() << std::endl; }

std::vector<std::string> arguments_of(const ChildOptions& options) {
  std::array<char, 32> angle = {};
  std::snprintf(angle.data(), angle.size(), "%.9g", static_cast<double>(options.scene_options.angle));
  return {"--child",  options.pixels_path,
          "--scene",  options.scene,
          "--width",  std::to_string(options.scene_options.width),
          "--height", std::to_string(options.scene_options.height),
          "--angle",  angle.data()};
}

}  // namespace

int child_main(const ChildOptions& options) try {
  const auto start = std::chrono::steady_clock::now();
  const samples::Context context;
  const std::chrono::duration<double, std::milli> instance_device = std::chrono::steady_clock::now() - start;
  samples::SceneRenderer renderer(context, samples::create_scene(options.scene, options.scene_options));
  const double first_frame = renderer.draw_frame();
  say({{"device", context.properties().deviceName},
       {"subpixel_bits", context.properties().limits.subPixelPrecisionBits},
       {"instance_device", instance_device.count()},
       {"pipelines", renderer.pipelines_ms()},
       {"first_frame", first_frame}});

  std::string command;
  while (std::cin >> command) {
    if (command == "frames") {
      int count = 0;
      std::cin >> count;
      json times = json::array();
      for (int i = 0; i < count; ++i) times.push_back(renderer.draw_frame());
      say({{"frames", times}});
    } else if (command == "end") {
      save_pixels(options.pixels_path, renderer.read_back());
      say({{"saved", true}});
      return 0;
    }
  }
  return 1;
} catch (const std::exception& error) {
  std::cerr << "lapilli_run: " << options.scene << ": " << error.what() << std::endl;
  return 1;
}

Child::Child(const std::string& program, const std::string& manifest, const ChildOptions& options)
    : options_(options), process_({program, arguments_of(options), manifest, {}}) {}

Child::~Child() {
  process_.wait_for_end();
  std::remove(options_.pixels_path.c_str());
}

std::optional<json> Child::first_frame() { return process_.answer(); }

std::vector<double> Child::frames(int count) {
  if (!process_.tell("frames " + std::to_string(count))) return {};
  const std::optional<json> reply = process_.answer();
  return reply ? reply->at("frames").get<std::vector<double>>() : std::vector<double>();
}

std::optional<samples::Frame> Child::finish() {
  if (!process_.tell("end") || !process_.answer()) return std::nullopt;
  process_.wait_for_end();
  return load_pixels(options_.pixels_path, options_.scene_options.width, options_.scene_options.height);
}

}  // namespace lapilli::run
