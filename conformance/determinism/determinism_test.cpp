// The same bits whatever the thread count, the SIMD target and the application's floating-point mode.
#include <gtest/gtest.h>

#include <cstdlib>

#include "determinism/workload.h"
#include "harness/devices.h"

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace lapilli::conformance {
namespace {

class Environment {
 public:
  Environment(const char* name, const char* value) : name_(name) { setenv(name, value, 1); }
  ~Environment() { unsetenv(name_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
};

class Determinism : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    workload = new Workload;
    baseline = new std::vector<Result>(workload->run(subject()));
  }
  static void TearDownTestSuite() {
    delete baseline;
    delete workload;
  }
  static void expect_same(const std::string& what) {
    workload->prepare_scenes();
    const auto context = new_subject();
    EXPECT_EQ(first_difference(*baseline, workload->run(*context)), "") << what;
  }
  static inline Workload* workload;
  static inline std::vector<Result>* baseline;
};

TEST_F(Determinism, TheWorkloadIsNotEmpty) {
  for (const Result& r : *baseline) {
    size_t distinct = 0;
    for (size_t i = 1; i < r.bytes.size(); ++i) distinct += r.bytes[i] != r.bytes[i - 1];
    EXPECT_GT(distinct, r.bytes.size() / 100) << r.name;
  }
}

TEST_F(Determinism, FromRunToRun) { expect_same("a second run"); }

TEST_F(Determinism, AcrossThreadCounts) {
  for (const char* threads : {"1", "2", "7"}) {
    const Environment set("LAPILLI_THREADS", threads);
    expect_same(std::string(threads) + " threads");
  }
}

// A target that the machine does not have is replaced by the best one it has, so all three always run.
TEST_F(Determinism, AcrossSimdTargets) {
  for (const char* target : {"sse2", "avx2", "avx3"}) {
    const Environment set("LAPILLI_SIMD", target);
    expect_same(target);
  }
}

TEST_F(Determinism, AcrossSimdTargetsAndThreadsTogether) {
  const Environment threads("LAPILLI_THREADS", "3");
  const Environment target("LAPILLI_SIMD", "sse2");
  expect_same("three threads, SSE2");
}

// What a draw is spared cannot be seen.
TEST_F(Determinism, WhateverWorkIsKept) {
  for (const char* kept : {"hidden", "blocks", "all"}) {
    const Environment set("LAPILLI_KEEP", kept);
    expect_same(std::string("LAPILLI_KEEP=") + kept);
  }
}

#if defined(__x86_64__)
// Threads inherit the control register of the one that creates them, so it is set before the device is made.
TEST_F(Determinism, UnderTheApplicationsFloatingPointMode) {
  const unsigned original = _mm_getcsr() & ~0x3Fu;  // without the sticky exception flags
  struct Mode {
    unsigned bits;
    const char* name;
  };
  const Mode modes[] = {{0x8040, "flush to zero, denormals are zero"},
                        {0x6000, "round toward zero"},
                        {0x2000 | 0x8040, "round down, flush to zero"},
                        {0x4000, "round up"}};
  for (const Mode& mode : modes) {
    // The scenes' own arithmetic (clear colours in float) follows the rounding mode: only for the first mode.
    const bool rounds_to_nearest = (mode.bits & 0x6000) == 0;
    workload->forget_scenes();
    if (rounds_to_nearest) workload->prepare_scenes();
    std::vector<Result> wanted = *baseline;
    if (!rounds_to_nearest) wanted.erase(wanted.begin(), wanted.begin() + std::ptrdiff_t(2 * samples::scenes().size()));
    _mm_setcsr(original | mode.bits);
    std::vector<Result> results;
    bool kept = true;
    {
      const auto context = new_subject();
      results = workload->run(*context, [&] { kept &= (_mm_getcsr() & ~0x3Fu) == (original | mode.bits); });
    }
    kept &= (_mm_getcsr() & ~0x3Fu) == (original | mode.bits);
    _mm_setcsr(original);
    EXPECT_TRUE(kept) << "the driver changed the application's control register: " << mode.name;
    EXPECT_EQ(first_difference(wanted, results), "") << mode.name;
  }
}
#endif

}  // namespace
}  // namespace lapilli::conformance
