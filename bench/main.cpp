// lapilli_bench: how fast each driver draws each scene, beside the others and beside what the machine could do.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>

#include "child.h"
#include "measure.h"

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

// The fastest of the others, in ms; 0 if there is none.
double best_peer(const Series& series) {
  double best = 0;
  for (size_t i = 1; i < series.results.size(); ++i) {
    const Result& result = series.results[i];
    if (result.absent.empty() && (best == 0 || result.frame < best)) best = result.frame;
  }
  return best;
}

// The least CPU time of the others, in ms a frame; 0 if there is none.
double least_cpu(const Series& series) {
  double least = 0;
  for (size_t i = 1; i < series.results.size(); ++i) {
    const Result& result = series.results[i];
    if (result.absent.empty() && (least == 0 || result.cpu < least)) least = result.cpu;
  }
  return least;
}

void print_heading(const std::vector<run::Driver>& drivers) {
  std::printf("%-13s %-9s", "frames in ms", "");
  for (const run::Driver& driver : drivers) std::printf(" %11s", driver.label.c_str());
  std::printf(" %7s | CPU", "ratio");
  for (const run::Driver& driver : drivers) std::printf(" %11s", driver.label.c_str());
  std::printf(" %7s | others\n", "ratio");
}

void print_line(const Series& series) {
  const std::string size =
      std::to_string(series.options.extent.width) + "x" + std::to_string(series.options.extent.height);
  std::printf("%-13s %-9s", series.scene.c_str(), size.c_str());
  const Result& ours = series.results.front();
  const auto column = [&](double Result::*value, double peer) {
    for (const Result& result : series.results) {
      std::printf(" %11s", result.absent.empty() ? run::number(result.*value, 3).c_str() : "-");
    }
    const bool both = ours.absent.empty() && peer > 0;
    std::printf(" %7s", both ? run::number(peer / (ours.*value), 2).c_str() : "-");
  };
  column(&Result::frame, best_peer(series));
  std::printf(" |    ");
  column(&Result::cpu, least_cpu(series));
  double others = 0;
  for (const Result& result : series.results) others = std::max(others, result.others);
  std::printf(" | %3.0f %%\n", 100 * others);
  for (const Result& result : series.results) {
    if (!result.absent.empty()) std::printf("    %s: %s\n", result.driver.c_str(), result.absent.c_str());
  }
  std::fflush(stdout);
}

int bench(const Arguments& arguments) {
  const std::vector<run::Driver> drivers = run::drivers_of(arguments.manifests, "lapilli_bench");
  if (drivers.empty()) {
    std::fprintf(stderr, "lapilli_bench: no driver; name manifests with --icd or VK_DRIVER_FILES\n");
    return 1;
  }
  Plan plan;
  plan.program = fs::read_symlink("/proc/self/exe");
  plan.pictures = arguments.output + "/bench";
  fs::create_directories(plan.pictures);
  if (arguments.quick) {
    plan.starts = 1;
    plan.rounds = 3;
    plan.turn_ms = 100;
  }
  print_heading(drivers);
  for (const VkExtent2D& size : sizes_of(arguments)) {
    for (const SceneEntry* entry : scenes_of(arguments)) {
      const Series series = measure(*entry, {size, arguments.count}, drivers, plan);
      print_line(series);
    }
  }
  return 0;
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
