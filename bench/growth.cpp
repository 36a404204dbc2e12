// See growth.h.
#include "growth.h"

#include <thread>

namespace lapilli::bench {
namespace {

struct Step {
  double x;
  SceneOptions options;
  int threads = 0;
};

Curve curve(std::string_view scene, const std::string& title, const std::string& x_label,
            const std::vector<Step>& steps, const std::vector<run::Driver>& drivers, const Plan& plan) {
  Curve curve = {title, x_label, {}};
  const SceneEntry& entry = *find_scene(scene);
  for (const Step& step : steps) {
    const Series series = measure(entry, step.options, contestants_of(drivers, step.threads), plan);
    for (const Result& result : series.results) {
      if (result.absent.empty()) curve.points.push_back({result.driver, step.x, result.frame});
    }
  }
  return curve;
}

std::vector<Step> counts(std::initializer_list<uint32_t> values) {
  std::vector<Step> steps;
  for (uint32_t count : values) steps.push_back({static_cast<double>(count), {.count = count}});
  return steps;
}

std::vector<Step> sizes() {
  std::vector<Step> steps;
  for (const VkExtent2D extent : {VkExtent2D{320, 180}, {640, 360}, {1280, 720}, {2560, 1440}}) {
    steps.push_back({1e-6 * extent.width * extent.height, {extent}});
  }
  return steps;
}

std::vector<Step> threads() {
  std::vector<Step> steps;
  for (int n = 1; n <= static_cast<int>(std::thread::hardware_concurrency()); n *= 2) {
    steps.push_back({static_cast<double>(n), {}, n});
  }
  return steps;
}

}  // namespace

std::vector<Curve> measure_growth(const std::vector<run::Driver>& drivers, const Plan& plan) {
  Plan p = plan;
  p.starts = 1;
  p.rounds = 2;
  p.turn_ms = 60;
  p.pictures.clear();
  const auto with = [&](std::string_view scene, const char* title, const char* x_label,
                        const std::vector<Step>& steps) { return curve(scene, title, x_label, steps, drivers, p); };
  return {
      with("bilinear", "bilinear, resolution", "megapixels", sizes()),
      with("phong", "phong, resolution", "megapixels", sizes()),
      with("grid", "grid, triangles", "triangles", counts({1000, 10000, 100000, 1000000})),
      with("draws", "draws", "draws", counts({100, 1000, 10000, 30000})),
      with("layers_btf", "opaque layers, back to front", "layers", counts({1, 4, 16, 64})),
      with("blend", "blended layers", "layers", counts({1, 4, 16, 64})),
      with("bilinear", "bilinear, threads", "threads", threads()),
      with("grid", "grid, threads", "threads", threads()),
      with("phong", "phong, threads", "threads", threads()),
  };
}

std::vector<TwoThreads> measure_two_threads(const std::vector<const SceneEntry*>& scenes, const run::Driver& driver,
                                            const Plan& plan) {
  Plan p = plan;
  p.starts = 1;
  p.rounds = 3;
  p.turn_ms = 60;
  p.pictures.clear();
  std::vector<TwoThreads> all;
  for (const SceneEntry* entry : scenes) {
    const Series series =
        measure(*entry, {}, {{driver.label, driver.manifest, 1}, {driver.label, driver.manifest, 2}}, p);
    if (!series.results[0].absent.empty() || !series.results[1].absent.empty()) continue;
    all.push_back({series.scene, series.results[0].frame, series.results[1].frame});
  }
  return all;
}

}  // namespace lapilli::bench
