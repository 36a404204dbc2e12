// Time and memory of an instance and a device, beside those of a driver that does nothing.
#pragma once

#include <vector>

#include "measure.h"

namespace lapilli::bench {

struct Start {
  std::string driver;
  std::string absent;          // how it failed
  double instance_device = 0;  // ms: vkCreateInstance to vkGetDeviceQueue, a command pool and a fence; medians
  double resident_kb = 0, anonymous_kb = 0;  // of the whole process after it
};
// One for each driver, and one more, named "nothing", of the null driver.
std::vector<Start> measure_starts(const std::vector<run::Driver>& drivers, const Plan& plan, int rounds);

}  // namespace lapilli::bench
