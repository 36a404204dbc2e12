// lapilli_bench: how fast each driver draws each scene, beside the others and beside what the machine could do.
#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "child.h"
#include "report.h"

namespace {

using namespace lapilli::bench;
namespace run = lapilli::run;
namespace fs = std::filesystem;

struct Arguments {
  std::vector<std::string> manifests = run::manifests_from_environment();
  std::vector<std::string> scenes;
  std::vector<std::string> sizes;
  std::string output = "out";
  uint32_t count = 0;
  bool quick = false;
  std::string child;
};

constexpr VkExtent2D kMainSize = {1280, 720};

// "1280x720"; throws CLI::ValidationError where it is not that.
VkExtent2D extent_of(const std::string& text) {
  VkExtent2D extent = {};
  char rest = 0;
  if (std::sscanf(text.c_str(), "%ux%u%c", &extent.width, &extent.height, &rest) != 2 || extent.width == 0 ||
      extent.height == 0 || extent.width > 8192 || extent.height > 8192) {
    throw CLI::ValidationError("--sizes", text + " is not a size such as 1280x720");
  }
  return extent;
}

std::vector<VkExtent2D> sizes_of(const Arguments& arguments) {
  std::vector<VkExtent2D> sizes;
  for (const std::string& text : arguments.sizes) sizes.push_back(extent_of(text));
  if (!sizes.empty()) return sizes;
  return arguments.quick ? std::vector<VkExtent2D>{kMainSize}
                         : std::vector<VkExtent2D>{kMainSize, {256, 256}, {1920, 1080}};
}

std::vector<const SceneEntry*> scenes_of(const Arguments& arguments) {
  std::vector<const SceneEntry*> chosen;
  for (const std::string& name : arguments.scenes) {
    chosen.push_back(find_scene(name));
    if (chosen.back() == nullptr) throw CLI::ValidationError("--scenes", "there is no scene " + name);
  }
  if (chosen.empty()) {
    for (const SceneEntry& entry : scenes()) chosen.push_back(&entry);
  }
  return chosen;
}

int bench(const Arguments& arguments) {
  Findings found;
  found.drivers = run::drivers_of(arguments.manifests, "lapilli_bench");
  if (found.drivers.empty()) {
    std::fprintf(stderr, "lapilli_bench: no driver; name manifests with --icd or VK_DRIVER_FILES\n");
    return 1;
  }
  Plan& plan = found.plan;
  plan.program = fs::read_symlink("/proc/self/exe");
  plan.pictures = arguments.output + "/bench";
  fs::create_directories(plan.pictures);
  if (arguments.quick) {
    plan.starts = 1;
    plan.rounds = 7;
    plan.turn_ms = 50;
  }
  const bool everything = arguments.scenes.empty();
  Machine machine;
  std::printf("%s", heading(found.drivers).c_str());
  for (const VkExtent2D& size : sizes_of(arguments)) {
    const bool main_size = size.width == kMainSize.width && size.height == kMainSize.height;
    Plan here = plan;
    if (!main_size) {
      here.starts = 1;
      here.rounds = 3;
    }
    for (const SceneEntry* entry : scenes_of(arguments)) {
      machine.measure();
      Series series = measure(*entry, {size, arguments.count}, contestants_of(found.drivers), here);
      series.limit = machine.limit_of(create_scene(*entry, series.options)->work());
      std::printf("%s", line(series).c_str());
      std::fflush(stdout);
      found.series.push_back(std::move(series));
    }
  }
  if (everything) {
    std::fprintf(stderr, "lapilli_bench: instance and device; threads\n");
    found.starts = measure_starts(found.drivers, plan, 9);
    found.two_threads = measure_two_threads(scenes_of(arguments), found.drivers.front(), plan);
    found.scaling = machine.scaling();
  }
  if (everything && !arguments.quick) {
    std::fprintf(stderr, "lapilli_bench: growth\n");
    found.growth = measure_growth(found.drivers, plan);
  }
  found.rates = machine.rates();
  found.threads = machine.threads();
  if (everything) std::printf("\n%s", table(goals_of(found)).c_str());

  const std::string data = arguments.output + "/bench.json";
  std::ofstream(data) << page(found).dump(1) << '\n';
  if (run::write_page(data, arguments.output + "/bench.html")) return 0;
  std::fprintf(stderr, "lapilli_bench: the page could not be made; %s is there\n", data.c_str());
  return 1;
}

}  // namespace

int main(int argc, char** argv) try {
  Arguments arguments;
  CLI::App app("Measures the scenes on every driver, in turns. The first driver is the one compared with the others.");
  app.add_option("--icd", arguments.manifests, "ICD manifests, ours first; default: VK_DRIVER_FILES")->delimiter(':');
  app.add_option("--scenes", arguments.scenes, "only these scenes (a,b,c)")->delimiter(',');
  app.add_option("--sizes", arguments.sizes, "sizes in pixels (256x256,1280x720)")->delimiter(',');
  app.add_option("--count", arguments.count, "layers, triangles, draws … of the scenes; 0: their own");
  app.add_flag("--quick", arguments.quick, "1280x720 only, fewer turns");
  app.add_option("--out", arguments.output, "directory for what is written")->capture_default_str();
  app.add_option("--child", arguments.child, "")->group("");  // this program's own use, see child.h
  CLI11_PARSE(app, argc, argv);
  try {
    if (!arguments.child.empty()) {
      return child_main({arguments.child, {extent_of(arguments.sizes.at(0)), arguments.count}});
    }
    std::signal(SIGPIPE, SIG_IGN);  // a child that died is noticed by its answer
    return bench(arguments);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "lapilli_bench: %s\n", error.what());
  return 1;
}
