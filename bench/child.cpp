// See child.h.
#include "child.h"

#include <unistd.h>

#include <chrono>
#include <cstring>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>

#include "common/png.h"
#include "process_usage.h"
#include "scenes/renderer.h"

namespace lapilli::bench {
namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

void say(const json& line) { std::cout << line.dump() << std::endl; }

json memory() {
  const Memory now = memory_now();
  return {{"resident_kb", now.resident_kb}, {"anonymous_kb", now.anonymous_kb}, {"peak_kb", now.peak_kb}};
}

json turn(SceneRenderer& renderer, double milliseconds, int most) {
  json frames = json::array();
  json records = json::array();
  const Usage before = usage_now();
  const Clock::time_point start = Clock::now();
  while (static_cast<int>(frames.size()) < most && (frames.empty() || milliseconds_since(start) < milliseconds)) {
    const FrameTime time = renderer.draw_frame();
    frames.push_back(time.frame);
    records.push_back(time.record);
  }
  const double wall = milliseconds_since(start);
  const Usage after = usage_now();
  const double own = after.process_ms - before.process_ms;
  const double others = after.machine_ms - before.machine_ms - own;
  const auto cpus = static_cast<double>(sysconf(_SC_NPROCESSORS_ONLN));
  const auto count = static_cast<double>(frames.size());
  return {{"frames", frames},
          {"records", records},
          {"cpu", own / count},
          {"others", std::max(others / (wall * cpus), 0.0)},
          {"waited", std::max(after.waited_ms - before.waited_ms, 0.0) / wall}};
}

json save_picture(const SceneRenderer& renderer, const std::string& path) {
  const samples::Frame frame = renderer.read_back();
  std::set<uint32_t> colors;
  for (size_t i = 0; i < frame.color.size() && colors.size() < 1000; i += 4) {
    uint32_t color = 0;
    std::memcpy(&color, &frame.color[i], 4);
    colors.insert(color);
  }
  samples::write_png(path, frame.width, frame.height, frame.color);
  return {{"colors", colors.size()}};
}

void obey(SceneRenderer& renderer) {
  std::string command;
  while (std::cin >> command) {
    if (command == "turn") {
      double milliseconds = 0;
      int most = 0;
      std::cin >> milliseconds >> most;
      say(turn(renderer, milliseconds, most));
    } else if (command == "memory") {
      say(memory());
    } else if (command == "picture") {
      std::string path;
      std::getline(std::cin >> std::ws, path);
      say(save_picture(renderer, path));
    }
  }
}

}  // namespace

std::vector<std::string> arguments_of(const ChildOptions& options) {
  const SceneOptions& o = options.scene_options;
  return {"--child", options.scene.empty() ? "-" : options.scene,
          "--sizes", std::to_string(o.extent.width) + "x" + std::to_string(o.extent.height),
          "--count", std::to_string(o.count)};
}

int child_main(const ChildOptions& options) try {
  const Clock::time_point start = Clock::now();
  const samples::Context context;
  const double instance_device = milliseconds_since(start);
  json hello = memory();
  hello["instance_device"] = instance_device;
  hello["device"] = context.properties().deviceName;
  const SceneEntry* entry = find_scene(options.scene);
  if (entry == nullptr) {
    say(hello);
    return 0;
  }
  std::unique_ptr<Scene> scene = create_scene(*entry, options.scene_options);
  const std::string missing = scene->missing(context);
  if (!missing.empty()) {
    hello["missing"] = missing;
    say(hello);
    return 0;
  }
  SceneRenderer renderer(context, std::move(scene));
  const FrameTime first = renderer.draw_frame();
  hello["pipelines"] = renderer.pipelines_ms();
  hello["first_record"] = first.record;
  hello["first_frame"] = first.frame;
  say(hello);
  obey(renderer);
  return 0;
} catch (const std::exception& error) {
  say({{"failure", error.what()}});
  return 1;
}

}  // namespace lapilli::bench
