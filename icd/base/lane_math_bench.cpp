// Lanes per second of the functions of lane_math-inl.h, per SIMD target, on arrays in the first cache.
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "base/simd_targets.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "base/lane_math_bench.cpp"
#include <hwy/foreach_target.h>
//
#include "base/lane_math-inl.h"
#include "base/simd_dispatch.h"

#ifndef LAPILLI_BASE_LANE_MATH_BENCH_ONCE
#define LAPILLI_BASE_LANE_MATH_BENCH_ONCE
// clang-format off
#define LAPILLI_UNARY(X)                                                                        \
  X(sin) X(cos) X(tan) X(asin) X(acos) X(atan) X(sinh) X(tanh) X(asinh) X(atanh)                \
  X(exp) X(exp2) X(log) X(log2) X(inverse_sqrt) X(sqrt) X(floor) X(fract)
// clang-format on
#define LAPILLI_BINARY(X) X(pow) X(atan2) X(frem) X(fmod) X(min)
namespace lapilli {
using Run = void(const float* x, const float* y, float* result, std::size_t count);
}
#endif

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {
struct Runs {
#define LAPILLI_RUN(name)                                                                          \
  static void run_##name(const float* x, const float*, float* result, std::size_t count) {         \
    for (std::size_t i = 0; i < count; i += kVectorLanes) store(name(load<F>(x + i)), result + i); \
  }
  LAPILLI_UNARY(LAPILLI_RUN)
#undef LAPILLI_RUN
#define LAPILLI_RUN(name)                                                                    \
  static void run_##name(const float* x, const float* y, float* result, std::size_t count) { \
    for (std::size_t i = 0; i < count; i += kVectorLanes) {                                  \
      store(name(load<F>(x + i), load<F>(y + i)), result + i);                               \
    }                                                                                        \
  }
  LAPILLI_BINARY(LAPILLI_RUN)
#undef LAPILLI_RUN
  static void run_fma(const float* x, const float* y, float* result, std::size_t count) {
    for (std::size_t i = 0; i < count; i += kVectorLanes) {
      store(fma(load<F>(x + i), load<F>(y + i), load<F>(x + i)), result + i);
    }
  }
};
}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lapilli {
namespace {

void run(benchmark::State& state, Run* function, float scale) {
  constexpr std::size_t kCount = 1024;
  alignas(64) static float x[kCount];
  alignas(64) static float y[kCount];
  alignas(64) static float result[kCount];
  for (std::size_t i = 0; i < kCount; ++i) {
    x[i] = (static_cast<float>(i) + 0.5f) / kCount * scale;
    y[i] = 0.3f + static_cast<float>(i % 37) * 0.05f;
  }
  for (auto _ : state) {
    function(x, y, result, kCount);
    benchmark::ClobberMemory();
  }
  state.counters["Glanes/s"] = benchmark::Counter(
      static_cast<double>(kCount) * static_cast<double>(state.iterations()) * 1e-9, benchmark::Counter::kIsRate);
}

void add(const char* name, const PerTarget<Run>& table, float scale) {
  for (const SimdTarget target : supported_simd_targets()) {
    const std::string full = std::string(name) + "/" + simd_target_name(target);
    benchmark::RegisterBenchmark(full.c_str(), run, &for_target(table, target), scale);
  }
}

}  // namespace
}  // namespace lapilli

int main(int argc, char** argv) {
  using namespace lapilli;
#define LAPILLI_ADD(name) add(#name, LAPILLI_PER_TARGET(Runs::run_##name), 1.0f);
  LAPILLI_UNARY(LAPILLI_ADD)
  LAPILLI_BINARY(LAPILLI_ADD)
  LAPILLI_ADD(fma)
#undef LAPILLI_ADD
  add("sin of large angles", LAPILLI_PER_TARGET(Runs::run_sin), 1e9f);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
#endif
