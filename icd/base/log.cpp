// Formatting, levels and the list of sinks.
#include "base/log.h"

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <mutex>

namespace lapilli {
namespace {

constexpr std::array<const char*, 4> kNames = {"error", "warning", "info", "debug"};
constexpr int kNobody = -1;

struct Listeners {
  std::mutex mutex;
  std::condition_variable quiet;  // a sink that leaves is not called any more
  LogSink* sinks = nullptr;
  int stderr_level = kNobody;
  // The least grave level that anyone wants: read without the lock.
  std::atomic<int> widest{kNobody};

  void update_widest() {
    int level = stderr_level;
    for (const LogSink* sink = sinks; sink != nullptr; sink = sink->next) {
      if (static_cast<int>(sink->level) > level) level = static_cast<int>(sink->level);
    }
    widest.store(level, std::memory_order_relaxed);
  }
};

// Never destroyed: threads of the application may outlive static destructors.
Listeners& listeners() {
  alignas(Listeners) static unsigned char storage[sizeof(Listeners)];
  static Listeners* all = new (storage) Listeners;
  return *all;
}

void log_list(LogLevel level, const char* format, std::va_list arguments) {
  if (!log_enabled(level)) return;
  char message[kMaxLogMessage];
  if (std::vsnprintf(message, sizeof message, format, arguments) < 0) return;
  Listeners& all = listeners();
  std::unique_lock lock(all.mutex);
  if (static_cast<int>(level) <= all.stderr_level) {
    std::fprintf(stderr, "lapilli: %s: %s\n", log_level_name(level), message);
  }
  for (LogSink* sink = all.sinks; sink != nullptr; sink = sink->next) {
    if (level > sink->level || sink->leaving) continue;
    // While it is called it stays in the list: the loop finds its way on.
    ++sink->calls;
    lock.unlock();
    sink->write(sink->user, level, message);
    lock.lock();
    if (--sink->calls == 0 && sink->leaving) all.quiet.notify_all();
  }
}

}  // namespace

const char* log_level_name(LogLevel level) { return kNames[static_cast<std::size_t>(level)]; }

std::optional<LogLevel> log_level_of_name(std::string_view name) {
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (name == kNames[i]) return static_cast<LogLevel>(i);
  }
  return std::nullopt;
}

bool log_enabled(LogLevel level) {
  return static_cast<int>(level) <= listeners().widest.load(std::memory_order_relaxed);
}

#define LAPILLI_LOG_TO_LIST(level)    \
  std::va_list arguments;             \
  va_start(arguments, format);        \
  log_list(level, format, arguments); \
  va_end(arguments)

void log(LogLevel level, const char* format, ...) { LAPILLI_LOG_TO_LIST(level); }
void log_error(const char* format, ...) { LAPILLI_LOG_TO_LIST(LogLevel::kError); }
void log_warning(const char* format, ...) { LAPILLI_LOG_TO_LIST(LogLevel::kWarning); }
void log_info(const char* format, ...) { LAPILLI_LOG_TO_LIST(LogLevel::kInfo); }
void log_debug(const char* format, ...) { LAPILLI_LOG_TO_LIST(LogLevel::kDebug); }

#undef LAPILLI_LOG_TO_LIST

void set_stderr_log_level(std::optional<LogLevel> level) {
  Listeners& all = listeners();
  const std::lock_guard lock(all.mutex);
  all.stderr_level = level.has_value() ? static_cast<int>(*level) : kNobody;
  all.update_widest();
}

void set_stderr_log_level_from_environment() {
  const char* value = std::getenv("LAPILLI_LOG");
  if (value == nullptr || *value == '\0') {
    set_stderr_log_level(std::nullopt);
    return;
  }
  const std::optional<LogLevel> level = log_level_of_name(value);
  set_stderr_log_level(level.value_or(LogLevel::kWarning));
  if (!level.has_value()) log_warning("LAPILLI_LOG=%s is not one of error, warning, info, debug", value);
}

void add_log_sink(LogSink& sink) {
  Listeners& all = listeners();
  const std::lock_guard lock(all.mutex);
  sink.next = all.sinks;
  all.sinks = &sink;
  all.update_widest();
}

void set_log_sink_level(LogSink& sink, LogLevel level) {
  Listeners& all = listeners();
  const std::lock_guard lock(all.mutex);
  sink.level = level;
  all.update_widest();
}

void remove_log_sink(LogSink& sink) {
  Listeners& all = listeners();
  std::unique_lock lock(all.mutex);
  sink.leaving = true;
  all.quiet.wait(lock, [&] { return sink.calls == 0; });
  for (LogSink** link = &all.sinks; *link != nullptr; link = &(*link)->next) {
    if (*link == &sink) {
      *link = sink.next;
      break;
    }
  }
  sink.next = nullptr;
  sink.leaving = false;
  all.update_widest();
}

}  // namespace lapilli
