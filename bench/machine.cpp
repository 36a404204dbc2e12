// The measuring kernels. This file alone is compiled with contraction, so that a * b + c is one fma where there is one.
#include "machine.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
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

// The kernels that need vectors, as wide as the machine has them.
struct Job {
  enum Kind { arithmetic, update, sum } kind;
  int rounds = 1;
  float* data = nullptr;  // aligned to 64 bytes
  size_t count = 0;       // floats, a multiple of 64
};

typedef float Lanes4 __attribute__((vector_size(16)));
typedef float Lanes8 __attribute__((vector_size(32)));
typedef float Lanes16 __attribute__((vector_size(64)));

template <typename Lanes>
[[gnu::always_inline]] inline void run(const Job& job) {
  // Independent chains, enough to cover the latency of two fma units.
  constexpr int kChains = 12;
  Lanes chains[kChains];
  for (int c = 0; c < kChains; ++c) chains[c] = Lanes{} + static_cast<float>(c);
  const Lanes factor = Lanes{} + 0.999f, term = Lanes{} + 0.001f;
  auto* data = reinterpret_cast<Lanes*>(job.data);
  const size_t vectors = job.count / (sizeof(Lanes) / sizeof(float));
  if (job.kind == Job::arithmetic) {
    for (int round = 0; round < job.rounds; ++round) {
#pragma GCC unroll 12
      for (int c = 0; c < kChains; ++c) chains[c] = chains[c] * factor + term;
    }
  } else if (job.kind == Job::update) {
    for (int round = 0; round < job.rounds; ++round) {
#pragma GCC unroll 4
      for (size_t i = 0; i < vectors; ++i) data[i] += term;
      asm volatile("" ::: "memory");  // each round really reads and writes
    }
  } else {
    for (size_t i = 0; i < vectors; i += 4) {
#pragma GCC unroll 4
      for (size_t k = 0; k < 4; ++k) chains[k] += data[i + k];
    }
  }
  Lanes sum = {};
  for (int c = 0; c < kChains; ++c) sum += chains[c];
  sink = static_cast<uint32_t>(std::min(std::abs(sum[0]), 1e9f));
}

#if defined(__x86_64__)
__attribute__((target("avx512f"))) void run_wide(const Job& job) { run<Lanes16>(job); }
__attribute__((target("avx2,fma"))) void run_fma(const Job& job) { run<Lanes8>(job); }
#endif

void run_best(const Job& job) {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) return run_wide(job);
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return run_fma(job);
#endif
  run<Lanes4>(job);
}

int lanes() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) return 16;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return 8;
#endif
  return 4;
}

struct AlignedDelete {
  void operator()(float* data) const { std::free(data); }
};
using Floats = std::unique_ptr<float, AlignedDelete>;
// `count` ones; a multiple of 64.
Floats floats(size_t count) {
  Floats data(static_cast<float*>(std::aligned_alloc(64, std::max(count, size_t{64}) * sizeof(float))));
  std::fill_n(data.get(), count, 1.0f);
  return data;
}

constexpr uint32_t kTableWords = 1u << 19;  // of 8 bytes: 4 MB

// Two neighbouring rows of 1,024 texels at places from a list, as a bilinear filter reads them; two loads a place.
void load(const uint64_t* table, const std::vector<uint32_t>& places, int rounds) {
  uint64_t sum = 0;
  for (int round = 0; round < rounds; ++round) {
    const uint64_t* here = table + (static_cast<uint32_t>(round) % 256) * 1024;
#pragma GCC unroll 8
    for (const uint32_t place : places) sum += here[place] ^ here[place + 512];
  }
  sink = static_cast<uint32_t>(sum);
}

// What a queue does for a small draw at the least, one after the other: reads a command of 64 bytes, calls what it
// names, keeps its constants and sets up a triangle.
struct Command {
  uint32_t handler;
  float constants[15];
};
struct DrawState {
  float constants[15] = {};
  float edges[3][3] = {};
};
template <int kKind>
void obey(const Command& command, DrawState& state) {
  std::memcpy(state.constants, command.constants, sizeof(state.constants));
  float x[3], y[3];
  for (int i = 0; i < 3; ++i) {
    x[i] = command.constants[2 * i] * command.constants[8] + command.constants[9];
    y[i] = command.constants[2 * i + 1] * command.constants[10] + command.constants[11];
  }
  const float area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]) + static_cast<float>(kKind);
  const float inverse = 1.0f / area;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    state.edges[i][0] += (y[i] - y[j]) * inverse;
    state.edges[i][1] += (x[j] - x[i]) * inverse;
    state.edges[i][2] += (x[i] * y[j] - x[j] * y[i]) * inverse;
  }
}
void obey_all(const std::vector<Command>& commands) {
  static constexpr void (*kHandlers[])(const Command&, DrawState&) = {obey<1>, obey<2>, obey<3>, obey<4>};
  DrawState state;
  for (const Command& command : commands) kHandlers[command.handler](command, state);
  sink = static_cast<uint32_t>(std::min(std::abs(state.edges[0][0]), 1e9f));
}

// Runs `work(thread)` on all threads at once, `repeats` times; the shortest time from the first start to the last end,
// in seconds.
constexpr int kRepeats = 10;
constexpr double kLongest = 0.2;  // seconds: where others keep the machine busy, fewer repeats have to do
double best_seconds(int threads, int repeats, const std::function<void(int)>& work) {
  std::atomic<int> waiting = 0;
  std::atomic<int> round = 0;
  std::atomic<bool> enough = false;
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
        enough = r >= 2 && now() > kLongest;
        round = r + 1;
      }
      while (round.load() <= r) std::this_thread::yield();
      if (enough) break;
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
  const auto share = [&](double bytes) { return static_cast<size_t>(bytes / threads / sizeof(float)) / 64 * 64; };
  std::vector<Floats> targets, sources;
  for (int t = 0; t < threads; ++t) {
    targets.push_back(floats(share(written)));
    sources.push_back(floats(share(read)));
  }
  const int repeats = std::clamp(static_cast<int>(3e8 / (written + read)), 8, 40);
  return best_seconds(threads, repeats, [&](int thread) {
    const auto t = static_cast<size_t>(thread);
    std::memset(targets[t].get(), thread + 1, share(written) * sizeof(float));
    run_best({Job::sum, 1, sources[t].get(), share(read)});
  });
}

// What one measurement does on `threads` threads; rates of all of them together.
double operations_per_second(int threads) {
  constexpr int kRounds = 30000;
  return 12.0 * lanes() * kRounds * threads / best_seconds(threads, kRepeats, [](int) {
           run_best({Job::arithmetic, kRounds});
         });
}

double cached_bytes_per_second(int threads) {
  constexpr size_t kWords = 4096;
  constexpr int kUpdates = 1000;
  std::vector<Floats> words;
  for (int t = 0; t < threads; ++t) words.push_back(floats(kWords));
  return 8.0 * kWords * kUpdates * threads / best_seconds(threads, kRepeats, [&](int thread) {
           run_best({Job::update, kUpdates, words[static_cast<size_t>(thread)].get(), kWords});
         });
}

double loads_per_second(int threads) {
  const std::vector<uint64_t> table(kTableWords, 3);
  std::vector<uint32_t> places(2048);
  for (uint32_t i = 0; i < places.size(); ++i) places[i] = i * 37 / 100 + i % 64 / 8 * 512;
  constexpr int kLoads = 500;
  return 2.0 * static_cast<double>(places.size()) * kLoads * threads /
         best_seconds(threads, kRepeats, [&](int) { load(table.data(), places, kLoads); });
}

double memory_bytes_per_second(int threads) {
  constexpr double kBytes = 32u << 20;  // written, and as many read
  return 2 * kBytes / stream_seconds(threads, kBytes, kBytes);
}

}  // namespace

Machine::Machine() : threads_(std::max(1, static_cast<int>(std::thread::hardware_concurrency()))) { measure(); }

void Machine::measure() {
  rates_.operations = std::max(rates_.operations, operations_per_second(threads_));
  rates_.cached = std::max(rates_.cached, cached_bytes_per_second(threads_));
  rates_.loads = std::max(rates_.loads, loads_per_second(threads_));

  std::vector<Command> commands(10000);
  for (uint32_t i = 0; i < commands.size(); ++i) {
    commands[i].handler = (i * 0x9E3779B1u) >> 30;
    for (uint32_t k = 0; k < 15; ++k) commands[i].constants[k] = 0.1f + static_cast<float>((i * 7 + k * 13) % 29);
  }
  rates_.draws = std::max(
      rates_.draws, static_cast<double>(commands.size()) / best_seconds(1, kRepeats, [&](int) { obey_all(commands); }));
}

Scaling Machine::scaling() const {
  if (threads_ < 2) return {};
  // In turns, because the speed of a machine that is shared changes.
  const auto ratio = [](double (*rate)(int)) {
    double one = 0, two = 0;
    for (int turn = 0; turn < 3; ++turn) {
      one = std::max(one, rate(1));
      two = std::max(two, rate(2));
    }
    return two / one;
  };
  return {ratio(operations_per_second), ratio(loads_per_second), ratio(cached_bytes_per_second),
          ratio(memory_bytes_per_second)};
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
  take(work.draws / rates_.draws, "draws");
  return limit;
}

}  // namespace lapilli::bench
