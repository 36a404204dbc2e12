// Times of every driver on one scene, taken in turns, and the pictures it drew.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "run/common.h"
#include "scenes/renderer.h"

namespace lapilli::run {

struct Plan {
  std::string program;  // this executable
  std::string scratch;  // directory for pixels on their way
  samples::SceneOptions scene_options;
  int starts = 5;            // fresh processes, whose medians are reported
  int rounds = 8;            // turns of each driver
  int frames_per_round = 8;  // in a turn
};

struct Measurement {
  Driver driver;
  std::string device;
  uint32_t subpixel_bits = 0;  // VkPhysicalDeviceLimits::subPixelPrecisionBits: coverage can only agree if they do
  samples::Timings timings;    // medians
  std::optional<samples::Frame> frame;
  std::string failure;  // why there is no frame
};

// In the order of `drivers`. All starts and rounds go A B C A B C …, one process at work at any time.
std::vector<Measurement> measure(const std::string& scene, const std::vector<Driver>& drivers, const Plan& plan);

}  // namespace lapilli::run
