// Reads getrusage(), /proc/stat, /proc/self/status and schedstat of the threads (see proc(5)).
#include "process_usage.h"

#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace lapilli::bench {

Usage usage_now() {
  Usage usage;
  rusage self = {};
  getrusage(RUSAGE_SELF, &self);
  const auto ms = [](const timeval& t) {
    return 1e3 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_usec);
  };
  usage.process_ms = ms(self.ru_utime) + ms(self.ru_stime);
  std::error_code ignored;
  for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task", ignored)) {
    std::ifstream schedstat(thread.path() / "schedstat");
    double ran = 0, waited = 0;  // ns
    schedstat >> ran >> waited;
    usage.waited_ms += 1e-6 * waited;
  }

  std::ifstream stat("/proc/stat");
  std::string name;
  // user, nice, system, idle, iowait, irq, softirq, steal
  std::array<double, 8> ticks = {};
  stat >> name;
  for (double& t : ticks) stat >> t;
  const double busy = ticks[0] + ticks[1] + ticks[2] + ticks[5] + ticks[6] + ticks[7];
  usage.machine_ms = busy * 1e3 / static_cast<double>(sysconf(_SC_CLK_TCK));
  return usage;
}

Memory memory_now() {
  Memory memory;
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    std::istringstream words(line);
    std::string name;
    double kilobytes = 0;
    words >> name >> kilobytes;
    if (name == "VmRSS:") memory.resident_kb = kilobytes;
    if (name == "RssAnon:") memory.anonymous_kb = kilobytes;
    if (name == "VmHWM:") memory.peak_kb = kilobytes;
  }
  return memory;
}

}  // namespace lapilli::bench
