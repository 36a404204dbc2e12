// See goals.h. The numbers are those of the issue "The renderer: ahead of both JITs, without a JIT".
#include "goals.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace lapilli::bench {
namespace {

using run::number;

std::string times(double value) { return number(value, value < 10 ? 2 : 1) + "×"; }

Goal unmeasured(const char* what, const std::string& required) { return {what, required, "", Verdict::unknown}; }

Goal goal(const char* what, const std::string& required, const std::string& measured, bool holds) {
  return {what, required, measured, holds ? Verdict::holds : Verdict::fails};
}

// The scenes at 1280x720 that the first driver drew and somebody else did too.
std::vector<const Series*> compared(const Run& run) {
  std::vector<const Series*> scenes;
  for (const Series& series : run.series) {
    if (series.size() == "1280x720" && series.ratio() > 0) scenes.push_back(&series);
  }
  return scenes;
}

const Series* find(const Run& run, std::string_view scene) {
  for (const Series* series : compared(run)) {
    if (series->scene == scene) return series;
  }
  return nullptr;
}

Goal faster(const Run& run, const char* what, std::initializer_list<std::pair<const char*, double>> scenes) {
  std::string required, measured;
  bool holds = true;
  for (const auto& [scene, least] : scenes) {
    const Series* series = find(run, scene);
    const std::string separator = required.empty() ? "" : "; ";
    required += separator + number(least, 0) + "×";
    measured += separator + (series != nullptr ? times(series->ratio()) : "?");
    if (series == nullptr) return unmeasured(what, required);
    holds = holds && series->ratio() >= least;
  }
  return goal(what, required, measured, holds);
}

Goal every_scene(const Run& run) {
  const auto scenes = compared(run);
  const char* what = "every scene, frame, against the faster peer";
  if (scenes.empty()) return unmeasured(what, "1× each");
  std::string slower;
  size_t fine = 0;
  for (const Series* series : scenes) {
    if (series->ratio() >= 1) {
      ++fine;
    } else {
      slower += (slower.empty() ? "; slower: " : ", ") + series->scene + " " + times(series->ratio());
    }
  }
  return goal(what, "1× each", std::to_string(fine) + " of " + std::to_string(scenes.size()) + slower,
              fine == scenes.size());
}

Goal geometric_mean(const Run& run) {
  std::vector<double> ratios;
  for (const Series* series : compared(run)) ratios.push_back(series->ratio());
  const char* what = "geometric mean over all scenes but our two best";
  if (ratios.size() < 3) return unmeasured(what, "4×");
  std::sort(ratios.begin(), ratios.end());
  double sum = 0;
  for (size_t i = 0; i + 2 < ratios.size(); ++i) sum += std::log(ratios[i]);
  const double mean = std::exp(sum / static_cast<double>(ratios.size() - 2));
  return goal(what, "4×", times(mean), mean >= 4);
}

Goal many_pipelines(const Run& run) {
  const char* what = "200 pipelines, create + first frame, against SwiftShader; lavapipe";
  const Series* series = find(run, "pipelines");
  if (series == nullptr) return unmeasured(what, "50×; 150×");
  const auto total = [](const Result& result) { return result.pipelines + result.first_frame; };
  const double ours = total(series->results.front());
  std::string measured;
  bool holds = true;
  for (const auto& [driver, least] : {std::pair("SwiftShader", 50.0), std::pair("lavapipe", 150.0)}) {
    const auto peer = std::find_if(series->results.begin(), series->results.end(),
                                   [&](const Result& r) { return r.driver == driver && r.absent.empty(); });
    const bool there = peer != series->results.end();
    measured += (measured.empty() ? "" : "; ") + (there ? times(total(*peer) / ours) : std::string("?"));
    holds = holds && (!there || total(*peer) / ours >= least);
  }
  return goal(what, "50×; 150×", measured + " (" + number(ours, 2) + " ms)", holds);
}

Goal first_triangle(const Run& run) {
  const char* what = "first frame of one triangle with its pipeline, device already there";
  const Series* series = find(run, "triangle");
  if (series == nullptr) return unmeasured(what, "under 1 ms");
  const Result& ours = series->results.front();
  const double ms = ours.pipelines + ours.first_frame;
  return goal(
      what, "under 1 ms",
      number(ms, 2) + " ms (pipeline " + number(ours.pipelines, 2) + ", frame " + number(ours.first_frame, 2) + ")",
      ms < 1);
}

Goal small_start(const Run& run) {
  const char* what = "instance + device; memory after it, above a driver that does nothing";
  const char* required = "at most 1 ms; 4 MB";
  if (run.starts.size() < 2 || !run.starts.front().absent.empty() || !run.starts.back().absent.empty()) {
    return unmeasured(what, required);
  }
  const Start& ours = run.starts.front();
  const Start& nothing = run.starts.back();
  const double ms = ours.instance_device - nothing.instance_device;
  const double mb = (ours.resident_kb - nothing.resident_kb) / 1024;
  return goal(what, required, number(ms, 2) + " ms; " + number(mb, 1) + " MB", ms <= 1 && mb <= 4);
}

// Frames below this are too short to be shared: waking a thread takes a noticeable part of them.
constexpr double kSmallest = 0.5;  // ms with one thread

Goal two_threads(const Run& run) {
  const char* what = "two threads against one, scenes of at least 0.5 ms";
  double least = 0;
  std::string below;
  for (const TwoThreads& scene : run.two_threads) {
    if (scene.one_ms < kSmallest || scene.two_ms <= 0) continue;
    const double ratio = scene.one_ms / scene.two_ms;
    least = least == 0 ? ratio : std::min(least, ratio);
    if (ratio < 1.8) below += (below.empty() ? "; below: " : ", ") + scene.scene + " " + times(ratio);
  }
  if (least == 0) return unmeasured(what, "1.8× each");
  return goal(what, "1.8× each", "least " + times(least) + below, below.empty());
}

Goal near_limits(const Run& run) {
  const char* what = "each scene against its limit";
  const char* required = "within 4×, or a reason";
  const auto scenes = compared(run);
  if (scenes.empty()) return unmeasured(what, required);
  size_t within = 0;
  std::string beyond;
  bool holds = true;
  for (const Series* series : scenes) {
    const double distance = series->results.front().frame / series->limit.ms;
    if (distance <= 4) {
      ++within;
      continue;
    }
    const bool excused = !reason_for_distance(series->scene).empty();
    holds = holds && excused;
    beyond += (beyond.empty() ? "; beyond: " : ", ") + series->scene + " " + times(distance) +
              (excused ? " (reason given)" : "");
  }
  return goal(what, required, std::to_string(within) + " of " + std::to_string(scenes.size()) + beyond, holds);
}

}  // namespace

std::vector<Goal> goals_of(const Run& run) {
  return {
      every_scene(run),
      geometric_mean(run),
      faster(run, "64 opaque layers, back to front; front to back", {{"layers_btf", 15}, {"layers_ftb", 5}}),
      faster(run, "million-triangle grid; tiny triangles", {{"grid", 4}, {"tiny", 4}}),
      faster(run, "blending, 32 layers", {{"blend", 4}}),
      faster(run, "bilinear full screen", {{"bilinear", 3}}),
      faster(run, "10,000 draws; 1,000 draws with dynamic UBO and texture", {{"draws", 3}, {"descriptors", 8}}),
      many_pipelines(run),
      first_triangle(run),
      small_start(run),
      two_threads(run),
      near_limits(run),
  };
}

std::string reason_for_distance(std::string_view /*scene*/) { return {}; }

}  // namespace lapilli::bench
