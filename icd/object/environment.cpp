// Reads the environment when an instance is created.
#include "object/environment.h"

#include <sched.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <optional>

#include "base/log.h"
#include "base/removals.h"
#include "base/simd_dispatch.h"
#include "shader/passes/passes.h"

namespace lapilli {
namespace {

constexpr long kMaxThreads = 256;
// An application that waits for its frame submits the next one soon after.
constexpr std::chrono::microseconds kSpin{50};
constexpr long kMaxTimeoutMs = 24L * 3600 * 1000;

std::optional<long> positive_number(const char* variable, long max) {
  const char* text = std::getenv(variable);
  if (text == nullptr || *text == 0) return std::nullopt;
  char* end = nullptr;
  errno = 0;
  const long value = std::strtol(text, &end, 10);
  if (errno == 0 && *end == 0 && value >= 1 && value <= max) return value;
  log_warning("%s=%s is not a number from 1 to %ld", variable, text, max);
  return std::nullopt;
}

bool is_on(const char* variable) {
  const char* const text = std::getenv(variable);
  return text != nullptr && *text != 0 && std::strcmp(text, "0") != 0;
}

// CPUs that the process may use.
unsigned cpu_count() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof(set), &set) != 0) return 1;
  const int count = CPU_COUNT(&set);
  return count > 0 ? static_cast<unsigned>(count) : 1;
}

void choose_simd_target() {
  const char* text = std::getenv("LAPILLI_SIMD");
  if (text == nullptr || *text == 0) {
    set_simd_target(best_simd_target());
    return;
  }
  const std::optional<SimdTarget> target = simd_target_of_name(text);
  if (target && set_simd_target(*target)) return;
  set_simd_target(best_simd_target());
  log_warning("LAPILLI_SIMD=%s is %s; using %s", text, target ? "not supported by this machine" : "unknown",
              simd_target_name(simd_target()));
}

}  // namespace

Environment read_environment() {
  set_stderr_log_level_from_environment();
  choose_simd_target();
  set_kept_removals_from_environment();
  Environment environment;
  const unsigned cpus = cpu_count();
  environment.threads = static_cast<unsigned>(positive_number("LAPILLI_THREADS", kMaxThreads).value_or(cpus));
  environment.stats = is_on("LAPILLI_STATS");
  set_dump_passes(is_on("LAPILLI_DUMP"));
  if (cpus > 1) environment.spin = kSpin;
  if (const auto timeout = positive_number("LAPILLI_TIMEOUT_MS", kMaxTimeoutMs)) {
    environment.timeout = std::chrono::milliseconds(*timeout);
  }
  return environment;
}

}  // namespace lapilli
