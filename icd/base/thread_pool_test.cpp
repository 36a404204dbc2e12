// Every index once, every worker's number once at a time, and threads that leave signals and rounding alone.
#include "base/thread_pool.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <time.h>

#include <array>
#include <atomic>
#include <cfenv>
#include <chrono>
#include <thread>
#include <vector>

namespace lapilli {
namespace {

TEST(ThreadPool, RunsEveryIndexOnce) {
  for (const unsigned workers : {1u, 2u, 7u}) {
    ThreadPool pool(workers);
    ASSERT_EQ(pool.size(), workers);
    for (const std::size_t count : {0u, 1u, 2u, 63u, 1000u}) {
      std::vector<std::atomic<int>> calls(count);
      pool.parallel_for(count, [&](std::size_t index, unsigned) { calls[index].fetch_add(1); });
      for (const std::atomic<int>& call : calls) ASSERT_EQ(call.load(), 1);
    }
  }
}

// Unsynchronized writes of the bodies are visible afterwards, and each worker's scratch has one user: tsan watches too.
void run_many_short_loops(ThreadPool& pool) {
  std::array<long, 4> sums{};
  std::vector<int> data(16);
  long expected = 0;
  for (int round = 0; round < 20000; ++round) {
    pool.parallel_for(data.size(), [&](std::size_t index, unsigned worker) {
      data[index] = round;
      sums[worker] += static_cast<long>(index);
    });
    for (const int value : data) ASSERT_EQ(value, round);
    expected += 15 * 16 / 2;
  }
  EXPECT_EQ(sums[0] + sums[1] + sums[2] + sums[3], expected);
}

TEST(ThreadPool, ManyShortLoopsStayApart) {
  ThreadPool sleeping(4);
  run_many_short_loops(sleeping);
  ThreadPool spinning(4, std::chrono::microseconds(20));
  run_many_short_loops(spinning);
}

// A body that blocks until all workers are inside proves that they run at the same time.
TEST(ThreadPool, AllWorkersTakePart) {
  ThreadPool pool(3);
  std::atomic<unsigned> inside{0};
  std::atomic<unsigned> workers_seen{0};
  pool.parallel_for(3, [&](std::size_t, unsigned worker) {
    workers_seen.fetch_or(1u << worker);
    inside.fetch_add(1);
    while (inside.load() < 3) std::this_thread::yield();
  });
  EXPECT_EQ(workers_seen.load(), 7u);
}

// Each worker stays at its first index but the last, which does all the rest.
TEST(ThreadPool, BeginWithPartsOfTheirOwnAndTakeFromTheEndOfOthers) {
  ThreadPool pool(3);
  std::atomic<unsigned> inside{0};
  std::array<std::vector<std::size_t>, 3> taken;
  std::atomic<unsigned> done{0};
  pool.parallel_for(9, [&](std::size_t index, unsigned worker) {
    taken[worker].push_back(index);
    inside.fetch_add(1);
    while (inside.load() < 3) std::this_thread::yield();
    // The others stay at their first index until worker 2 has done everything else.
    if (worker == 2) done.fetch_add(1);
    while (worker != 2 && done.load() < 7) std::this_thread::yield();
  });
  EXPECT_EQ(taken[0], (std::vector<std::size_t>{0}));
  EXPECT_EQ(taken[1], (std::vector<std::size_t>{3}));
  EXPECT_EQ(taken[2], (std::vector<std::size_t>{6, 7, 8, 2, 1, 5, 4}));
}

TEST(ThreadPool, WorkersBlockAllSignals) {
  ThreadPool pool(2);
  std::atomic<unsigned> inside{0};
  std::atomic<bool> blocked{false};
  pool.parallel_for(2, [&](std::size_t, unsigned worker) {
    inside.fetch_add(1);
    while (inside.load() < 2) std::this_thread::yield();
    if (worker == 0) return;
    sigset_t mask;
    pthread_sigmask(SIG_SETMASK, nullptr, &mask);
    blocked = sigismember(&mask, SIGINT) == 1 && sigismember(&mask, SIGPROF) == 1 && sigismember(&mask, SIGUSR1) == 1;
  });
  EXPECT_TRUE(blocked.load());
  sigset_t mine;
  pthread_sigmask(SIG_SETMASK, nullptr, &mine);
  EXPECT_EQ(sigismember(&mine, SIGINT), 0);
}

// 1 + 2^-30, which only rounding upward makes more than 1.
bool rounds_up() {
  const volatile float one = 1.0f;
  const volatile float little = 0x1p-30f;
  return one + little > 1.0f;
}

TEST(ThreadPool, BodiesRoundToNearestWhateverTheCallerDoes) {
  ASSERT_EQ(std::fesetround(FE_UPWARD), 0);
  ASSERT_TRUE(rounds_up());
  {
    ThreadPool pool(2);
    std::atomic<int> wrong{0};
    std::atomic<unsigned> inside{0};
    pool.parallel_for(2, [&](std::size_t, unsigned) {
      inside.fetch_add(1);
      while (inside.load() < 2) std::this_thread::yield();
      if (rounds_up()) wrong.fetch_add(1);
    });
    EXPECT_EQ(wrong.load(), 0);
    EXPECT_TRUE(rounds_up());
  }
  std::fesetround(FE_TONEAREST);
}

TEST(ThreadPool, IdleWorkersSleep) {
  ThreadPool pool(4, std::chrono::microseconds(50));
  pool.parallel_for(64, [](std::size_t, unsigned) {});
  timespec before{}, after{};
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &before);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &after);
  const double used =
      static_cast<double>(after.tv_sec - before.tv_sec) + static_cast<double>(after.tv_nsec - before.tv_nsec) * 1e-9;
  // Three spinning workers would use 0.4 seconds on two cores.
  EXPECT_LT(used, 0.05);
}

}  // namespace
}  // namespace lapilli
