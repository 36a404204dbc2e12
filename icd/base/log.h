// Messages of the driver: to stderr as far as LAPILLI_LOG asks, and to sinks such as a VkInstance's debug messengers.
#pragma once

#include <optional>
#include <string_view>

namespace lapilli {

// The values of LAPILLI_LOG, from the gravest on.
enum class LogLevel { kError, kWarning, kInfo, kDebug };

const char* log_level_name(LogLevel level);
std::optional<LogLevel> log_level_of_name(std::string_view name);

// Writes one message, printf-style, without a line end. Cheap when nobody listens at this level. From any thread.
// Longer ones are cut at kMaxLogMessage bytes.
inline constexpr int kMaxLogMessage = 2048;
[[gnu::format(printf, 2, 3)]] void log(LogLevel level, const char* format, ...);
[[gnu::format(printf, 1, 2)]] void log_error(const char* format, ...);
[[gnu::format(printf, 1, 2)]] void log_warning(const char* format, ...);
[[gnu::format(printf, 1, 2)]] void log_info(const char* format, ...);
[[gnu::format(printf, 1, 2)]] void log_debug(const char* format, ...);
bool log_enabled(LogLevel level);

// What goes to stderr: this level and graver ones; nothing without a level (the start).
void set_stderr_log_level(std::optional<LogLevel> level);
// As the environment variable LAPILLI_LOG says; an unknown value means warning, and says so.
void set_stderr_log_level_from_environment();

// A listener. The caller keeps it alive from add to remove.
// No lock is held while write runs: several threads may be in it, and it may log, add sinks and remove other ones.
struct LogSink {
  LogLevel level = LogLevel::kDebug;  // this and graver ones; once it is added only set_log_sink_level changes it
  void (*write)(void* user, LogLevel level, const char* message) = nullptr;
  void* user = nullptr;
  // The log's own.
  LogSink* next = nullptr;
  int calls = 0;  // threads in write
  bool leaving = false;
};
void add_log_sink(LogSink& sink);
void set_log_sink_level(LogSink& sink, LogLevel level);
// Waits until no thread is in its write any more. Not from that write itself.
void remove_log_sink(LogSink& sink);

}  // namespace lapilli
