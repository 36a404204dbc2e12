// Lets the drivers take turns and takes the medians.
#include "run/measure.h"

#include <memory>

#include "run/child.h"

namespace lapilli::run {
namespace {

struct Series {
  std::vector<double> instance_device, pipelines, first_frame, frames;
  std::unique_ptr<Child> child;  // the last one started

  samples::Timings medians() const {
    return {median(instance_device), median(pipelines), median(first_frame), median(frames)};
  }
};

}  // namespace

std::vector<Measurement> measure(const std::string& scene, const std::vector<Driver>& drivers, const Plan& plan) {
  std::vector<Measurement> results(drivers.size());
  std::vector<Series> series(drivers.size());
  for (size_t i = 0; i < drivers.size(); ++i) results[i].driver = drivers[i];

  for (int start = 0; start < plan.starts; ++start) {
    for (size_t i = 0; i < drivers.size(); ++i) {
      if (!results[i].failure.empty()) continue;
      series[i].child.reset();
      series[i].child = std::make_unique<Child>(
          plan.program, drivers[i].manifest,
          ChildOptions{scene, plan.scene_options, plan.scratch + "/" + scene + "." + drivers[i].label + ".pixels"});
      if (const auto first = series[i].child->first_frame()) {
        results[i].device = first->at("device");
        results[i].subpixel_bits = first->at("subpixel_bits");
        series[i].instance_device.push_back(first->at("instance_device"));
        series[i].pipelines.push_back(first->at("pipelines"));
        series[i].first_frame.push_back(first->at("first_frame"));
      } else {
        results[i].failure = "no first frame: " + series[i].child->ended();
      }
    }
  }

  for (int round = 0; round < plan.rounds; ++round) {
    for (size_t i = 0; i < drivers.size(); ++i) {
      if (!results[i].failure.empty()) continue;
      const std::vector<double> frames = series[i].child->frames(plan.frames_per_round);
      series[i].frames.insert(series[i].frames.end(), frames.begin(), frames.end());
      if (frames.empty()) results[i].failure = "ended while drawing: " + series[i].child->ended();
    }
  }

  for (size_t i = 0; i < drivers.size(); ++i) {
    if (!results[i].failure.empty()) continue;
    results[i].timings = series[i].medians();
    results[i].frame = series[i].child->finish();
    if (!results[i].frame) results[i].failure = "no pixels: " + series[i].child->ended();
  }
  return results;
}

}  // namespace lapilli::run
