// Levels, sinks and stderr.
#include "base/log.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace lapilli {
namespace {

struct Recorder {
  LogSink sink;
  std::mutex mutex;
  std::vector<std::string> messages;

  explicit Recorder(LogLevel level) {
    sink.level = level;
    sink.user = this;
    sink.write = [](void* user, LogLevel message_level, const char* message) {
      auto& recorder = *static_cast<Recorder*>(user);
      const std::lock_guard lock(recorder.mutex);
      recorder.messages.push_back(std::string(log_level_name(message_level)) + ":" + message);
    };
    add_log_sink(sink);
  }
  ~Recorder() { remove_log_sink(sink); }
};

TEST(Log, SinksGetWhatTheyAskFor) {
  EXPECT_FALSE(log_enabled(LogLevel::kError));
  {
    Recorder warnings(LogLevel::kWarning);
    Recorder all(LogLevel::kDebug);
    log_debug("tile %d", 7);
    log_warning("format %s", "R8");
    log_error("%x", 255u);
    EXPECT_EQ(warnings.messages, (std::vector<std::string>{"warning:format R8", "error:ff"}));
    EXPECT_EQ(all.messages, (std::vector<std::string>{"debug:tile 7", "warning:format R8", "error:ff"}));
    EXPECT_TRUE(log_enabled(LogLevel::kDebug));
  }
  EXPECT_FALSE(log_enabled(LogLevel::kError));
  log_error("nobody listens");
}

TEST(Log, CutsLongMessages) {
  Recorder recorder(LogLevel::kInfo);
  log_info("%s", std::string(5000, 'x').c_str());
  ASSERT_EQ(recorder.messages.size(), 1u);
  EXPECT_EQ(recorder.messages[0].size(), std::string("info:").size() + kMaxLogMessage - 1);
}

TEST(Log, StderrFollowsTheEnvironment) {
  setenv("LAPILLI_LOG", "info", 1);
  set_stderr_log_level_from_environment();
  testing::internal::CaptureStderr();
  log_info("shown");
  log_debug("not shown");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "lapilli: info: shown\n");

  setenv("LAPILLI_LOG", "loud", 1);
  testing::internal::CaptureStderr();
  set_stderr_log_level_from_environment();
  log_info("not shown");
  EXPECT_NE(testing::internal::GetCapturedStderr().find("LAPILLI_LOG=loud"), std::string::npos);

  unsetenv("LAPILLI_LOG");
  testing::internal::CaptureStderr();
  set_stderr_log_level_from_environment();
  log_error("not shown");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Log, ThreadsMayLogTogether) {
  Recorder recorder(LogLevel::kInfo);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([] {
      for (int i = 0; i < 500; ++i) log_info("message %d", i);
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(recorder.messages.size(), 2000u);
}

// A sink that is being called holds nobody up, and removal waits for it.
TEST(Log, OthersLogAndListenWhileASinkIsBusy) {
  struct Busy {
    std::atomic<bool> inside{false}, go_on{false}, left{false};
  } busy;
  LogSink sink;
  sink.level = LogLevel::kError;
  sink.user = &busy;
  sink.write = [](void* user, LogLevel, const char*) {
    auto& state = *static_cast<Busy*>(user);
    state.inside = true;
    while (!state.go_on) std::this_thread::yield();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    state.left = true;
  };
  add_log_sink(sink);
  std::thread logger([] { log_error("slow"); });
  while (!busy.inside) std::this_thread::yield();
  {
    Recorder recorder(LogLevel::kWarning);
    log_warning("meanwhile");
    EXPECT_EQ(recorder.messages, std::vector<std::string>{"warning:meanwhile"});
  }
  busy.go_on = true;
  remove_log_sink(sink);
  EXPECT_TRUE(busy.left);
  logger.join();
}

TEST(Log, ASinkMayLogAndAddSinks) {
  static Recorder* inner;
  LogSink sink;
  sink.level = LogLevel::kError;
  sink.write = [](void*, LogLevel, const char*) {
    inner = new Recorder(LogLevel::kInfo);
    log_info("from the sink");
  };
  add_log_sink(sink);
  log_error("outer");
  remove_log_sink(sink);
  EXPECT_EQ(inner->messages, std::vector<std::string>{"info:from the sink"});
  delete inner;
}

}  // namespace
}  // namespace lapilli
