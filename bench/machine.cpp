// The measuring kernels. This file alone is compiled with contraction, so that a * b + c is one fma where there is one.
#include "machine.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

namespace lapilli::bench {
namespace {

using Clock = std::chrono::steady_clock;

// Whatever is computed into this is not optimized away.
std::atomic<uint32_t> sink;

#if defined(__x86_64__)
#define LAPILLI_BENCH_WIDE __attribute__((target("avx512f")))
#define LAPILLI_BENCH_FMA __attribute__((target("avx2,fma")))
enum class Isa { plain, fma, wide };
Isa isa() {
  if (__builtin_cpu_supports("avx512f")) return Isa::wide;
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? Isa::fma : Isa::plain;
}
#endif

typedef float Lanes4 __attribute__((vector_size(16)));
typedef float Lanes8 __attribute__((vector_size(32)));
typedef float Lanes16 __attribute__((vector_size(64)));

// `count` rounds of independent chains, enough to cover the latency of two fma units. Returns the operations done.
template <typename Lanes>
[[gnu::always_inline]] inline double multiply_add(int count) {
  constexpr int kChains = 12;
  Lanes chains[kChains];
  for (int c = 0; c < kChains; ++c) chains[c] = Lanes{} + static_cast<float>(c);
  const Lanes factor = Lanes{} + 0.999f, term = Lanes{} + 0.001f;
  for (int i = 0; i < count; ++i) {
#pragma GCC unroll 12
    for (int c = 0; c < kChains; ++c) chains[c] = chains[c] * factor + term;
  }
  Lanes sum = {};
  for (int c = 0; c < kChains; ++c) sum += chains[c];
  sink = static_cast<uint32_t>(sum[0]);
  return 1.0 * count * kChains * static_cast<double>(sizeof(Lanes) / sizeof(float));
}

#if defined(__x86_64__)
LAPILLI_BENCH_WIDE double multiply_add_wide(int count) { return multiply_add<Lanes16>(count); }
LAPILLI_BENCH_FMA double multiply_add_fma(int count) { return multiply_add<Lanes8>(count); }
#endif

double multiply_add_best(int count) {
#if defined(__x86_64__)
  if (isa() == Isa::wide) return multiply_add_wide(count);
  if (isa() == Isa::fma) return multiply_add_fma(count);
#endif
  return multiply_add<Lanes4>(count);
}

constexpr uint32_t kTableWords = 1u << 19;  // of 8 bytes: 4 MB

// Neighbouring rows of 1,024 texels, as a bilinear filter reads them.
double load(const uint64_t* table, int count) {
  uint64_t sum = 0;
  uint32_t place = 0;
  for (int i = 0; i < count; ++i) {
    sum += table[place % kTableWords];
    sum ^= table[(place + 512) % kTableWords];
    place += 1 + (i & 63 ? 0u : 448u);
  }
  sink = static_cast<uint32_t>(sum);
  return 2.0 * count;
}

// Adds to every word of 16 KB. Returns the bytes read and written.
double update(std::vector<uint32_t>& words, int count) {
  for (int i = 0; i < count; ++i) {
    for (uint32_t& word : words) word += 0x01010101u;
    asm volatile("" ::: "memory");  // each round really reads and writes
  }
  sink = words[5];
  return 8.0 * static_cast<double>(words.size()) * count;
}

// Runs `work(thread)` on all threads at once, `repeats` times; the shortest time from the first start to the last end,
// in seconds.
double best_seconds(int threads, int repeats, const std::function<void(int)>& work) {
  std::atomic<int> waiting = 0;
  std::atomic<int> round = 0;
  std::vector<double> starts(static_cast<size_t>(threads)), ends(static_cast<size_t>(threads));
  double best = 1e9;
  const Clock::time_point origin = Clock::now();
  const auto now = [&] { return std::chrono::duration<double>(Clock::now() - origin).count(); };
  const auto loop = [&](int thread) {
    const auto t = static_cast<size_t>(thread);
    for (int r = 0; r < repeats; ++r) {
      // The last to come opens the round. Waiting gives the CPU away: there may be fewer than threads.
      if (waiting.fetch_add(1) + 1 == threads) {
        if (r > 0)
          best = std::min(
              best, *std::max_element(ends.begin(), ends.end()) - *std::min_element(starts.begin(), starts.end()));
        waiting = 0;
        round = r + 1;
      }
      while (round.load() <= r) std::this_thread::yield();
      starts[t] = now();
      work(thread);
      ends[t] = now();
    }
  };
  {
    std::vector<std::jthread> others;
    for (int t = 1; t < threads; ++t) others.emplace_back(loop, t);
    loop(0);
  }
  return std::min(best, *std::max_element(ends.begin(), ends.end()) - *std::min_element(starts.begin(), starts.end()));
}

// Writes and reads so many bytes once; seconds.
double stream_seconds(int threads, double written, double read) {
  struct Part {
    std::vector<uint64_t> target, source;
  };
  std::vector<Part> parts(static_cast<size_t>(threads));
  for (Part& part : parts) {
    part.target.resize(static_cast<size_t>(written / threads / 8));
    part.source.assign(static_cast<size_t>(read / threads / 8), 1);
  }
  const int repeats = std::clamp(static_cast<int>(2e8 / (written + read)), 5, 40);
  return best_seconds(threads, repeats, [&](int thread) {
    Part& part = parts[static_cast<size_t>(thread)];
    if (!part.target.empty()) std::memset(part.target.data(), thread + 1, part.target.size() * 8);
    uint64_t sums[8] = {};
    for (size_t i = 0; i + 8 <= part.source.size(); i += 8) {
      for (size_t k = 0; k < 8; ++k) sums[k] += part.source[i + k];
    }
    for (uint64_t sum : sums) sink = static_cast<uint32_t>(sum);
  });
}

}  // namespace

Machine::Machine() : threads_(std::max(1, static_cast<int>(std::thread::hardware_concurrency()))) { measure(); }

void Machine::measure() {
  constexpr int kRepeats = 12;
  const auto rate = [&](double done, const std::function<void(int)>& work) {
    return done * threads_ / best_seconds(threads_, kRepeats, work);
  };
  constexpr int kRounds = 30000;
  rates_.operations =
      std::max(rates_.operations, rate(multiply_add_best(1) * kRounds, [](int) { multiply_add_best(kRounds); }));

  const std::vector<uint64_t> table(kTableWords, 3);
  constexpr int kLoads = 500000;
  rates_.loads = std::max(rates_.loads, rate(2.0 * kLoads, [&](int) { load(table.data(), kLoads); }));

  constexpr int kUpdates = 300;
  std::vector<std::vector<uint32_t>> words(static_cast<size_t>(threads_), std::vector<uint32_t>(4096));
  rates_.cached =
      std::max(rates_.cached,
               rate(8.0 * 4096 * kUpdates, [&](int thread) { update(words[static_cast<size_t>(thread)], kUpdates); }));
}

Machine::Limit Machine::limit_of(const Work& work) const {
  Limit limit;
  const auto take = [&](double seconds, const char* resource) {
    if (1e3 * seconds > limit.ms) limit = {1e3 * seconds, resource};
  };
  if (work.written_bytes + work.read_bytes > 0) {
    take(stream_seconds(threads_, work.written_bytes, work.read_bytes), "memory");
  }
  take(work.cached_bytes / rates_.cached, "cache");
  take(work.operations / rates_.operations, "arithmetic");
  take(work.loads / rates_.loads, "loads");
  return limit;
}

}  // namespace lapilli::bench
