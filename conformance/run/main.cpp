// lapilli_run: renders every scene on every driver that the loader is given, compares the pictures with each other and
// with the float64 oracle, and writes a table, PNGs, results.json and index.html.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "run/child.h"
#include "run/report.h"

namespace {

using namespace lapilli::run;
namespace samples = lapilli::samples;
namespace fs = std::filesystem;

// Whether the first driver, the one this is about, drew something everywhere.
bool first_driver_drew(const std::vector<SceneReport>& reports) {
  return std::all_of(reports.begin(), reports.end(), [](const SceneReport& report) {
    const auto& frame = report.rows.front().measurement.frame;
    return frame.has_value() && !is_empty(*frame);
  });
}

int run(const std::vector<std::string>& manifests, const std::vector<std::string>& only, const std::string& output,
        Plan plan) {
  const std::vector<Driver> drivers = drivers_of(manifests, "lapilli_run");
  if (drivers.empty()) {
    std::fprintf(stderr, "lapilli_run: no driver; name manifests with --icd or VK_DRIVER_FILES\n");
    return 1;
  }
  fs::create_directories(output);
  plan.scratch = output;
  plan.program = fs::read_symlink("/proc/self/exe");
  std::vector<SceneReport> reports;
  for (const samples::SceneEntry& entry : samples::scenes()) {
    if (!only.empty() && std::find(only.begin(), only.end(), entry.name) == only.end()) continue;
    const std::string name(entry.name);
    std::fprintf(stderr, "lapilli_run: %s\n", name.c_str());
    reports.push_back(make_report(entry.name, entry.summary, entry.create(plan.scene_options)->geometry(),
                                  measure(name, drivers, plan), output));
  }
  std::printf("%s", table(reports).c_str());
  const std::string data = output + "/results.json";
  std::ofstream(data) << page(reports, plan).dump(1) << '\n';
  const bool page_written = write_page(data, output + "/index.html");
  if (!page_written) std::fprintf(stderr, "lapilli_run: the page could not be made; results.json is there\n");
  if (!first_driver_drew(reports)) {
    std::fprintf(stderr, "lapilli_run: %s failed, or drew nothing\n", drivers.front().label.c_str());
    return 1;
  }
  return page_written ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) try {
  std::vector<std::string> manifests = manifests_from_environment();
  std::vector<std::string> only;
  std::string output = "out";
  std::string child_pixels;
  Plan plan;

  CLI::App app(
      "Renders every scene on Lapilli and its peers and compares them. The first driver is the one compared with.");
  app.add_option("--icd", manifests, "ICD manifests, ours first; default: VK_DRIVER_FILES");
  app.add_option("--scene", only, "only these scenes");
  app.add_option("--out", output, "directory for what is written")->capture_default_str();
  app.add_option("--width", plan.scene_options.width, "pixels")->capture_default_str()->check(CLI::Range(1, 4096));
  app.add_option("--height", plan.scene_options.height, "pixels")->capture_default_str()->check(CLI::Range(1, 4096));
  app.add_option("--angle", plan.scene_options.angle, "radians the scenes have turned")->capture_default_str();
  app.add_option("--starts", plan.starts, "fresh processes for each scene and driver")->capture_default_str();
  app.add_option("--rounds", plan.rounds, "turns of each driver")->capture_default_str();
  app.add_option("--frames", plan.frames_per_round, "frames in a turn")->capture_default_str();
  app.add_option("--child", child_pixels, "")->group("");  // this program's own use, see child.h
  CLI11_PARSE(app, argc, argv);

  if (!child_pixels.empty()) return child_main({only.at(0), plan.scene_options, child_pixels});
  std::signal(SIGPIPE, SIG_IGN);  // a child that died is noticed by its answer
  return run(manifests, only, output, plan);
} catch (const std::exception& error) {
  std::fprintf(stderr, "lapilli_run: %s\n", error.what());
  return 1;
}
