// Both ends of the pipe between the runner and a process that draws.
#include "run/child.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
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

Child::Child(const std::string& program, const std::string& manifest, const ChildOptions& options) : options_(options) {
  std::array<int, 2> down = {};
  std::array<int, 2> up = {};
  // Closed on exec, or the next child would hold this one's pipe open.
  if (pipe2(down.data(), O_CLOEXEC) != 0 || pipe2(up.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipes");
  process_ = fork();
  if (process_ < 0) throw std::runtime_error("no process");
  if (process_ == 0) {
    dup2(down[0], STDIN_FILENO);
    dup2(up[1], STDOUT_FILENO);
    setenv("VK_DRIVER_FILES", manifest.c_str(), 1);
    setenv("VK_ICD_FILENAMES", manifest.c_str(), 1);
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);  // a first frame compiles
    const std::string width = std::to_string(options.scene_options.width);
    const std::string height = std::to_string(options.scene_options.height);
    std::array<char, 32> angle = {};
    std::snprintf(angle.data(), angle.size(), "%.9g", static_cast<double>(options.scene_options.angle));
    execl(program.c_str(), program.c_str(), "--child", options.pixels_path.c_str(), "--scene", options.scene.c_str(),
          "--width", width.c_str(), "--height", height.c_str(), "--angle", angle.data(), static_cast<char*>(nullptr));
    _exit(127);
  }
  close(down[0]);
  close(up[1]);
  to_child_ = fdopen(down[1], "w");
  from_child_ = fdopen(up[0], "r");
}

Child::~Child() {
  wait_for_end();
  std::remove(options_.pixels_path.c_str());
}

std::optional<json> Child::first_frame() { return answer(); }

std::vector<double> Child::frames(int count) {
  if (!tell("frames " + std::to_string(count))) return {};
  const std::optional<json> reply = answer();
  return reply ? reply->at("frames").get<std::vector<double>>() : std::vector<double>();
}

std::optional<samples::Frame> Child::finish() {
  if (!tell("end") || !answer()) return std::nullopt;
  wait_for_end();
  return load_pixels(options_.pixels_path, options_.scene_options.width, options_.scene_options.height);
}

std::optional<json> Child::answer() {
  if (from_child_ == nullptr) return std::nullopt;
  std::string line;
  for (int c = std::fgetc(from_child_); c != EOF; c = std::fgetc(from_child_)) {
    if (c != '\n') {
      line.push_back(static_cast<char>(c));
      continue;
    }
    // Whatever else a driver prints is not for us.
    const json reply = json::parse(line, nullptr, false);
    if (reply.is_object()) return reply;
    line.clear();
  }
  wait_for_end();
  return std::nullopt;
}

bool Child::tell(const std::string& line) {
  if (to_child_ == nullptr) return false;
  return std::fputs((line + "\n").c_str(), to_child_) >= 0 && std::fflush(to_child_) == 0;
}

void Child::wait_for_end() {
  if (process_ < 0) return;
  std::fclose(to_child_);  // the end of its input ends the child
  std::fclose(from_child_);
  to_child_ = nullptr;
  from_child_ = nullptr;
  int status = 0;
  waitpid(process_, &status, 0);
  process_ = -1;
  ended_ = WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status))
                               : "exit status " + std::to_string(WEXITSTATUS(status));
}

}  // namespace lapilli::run
