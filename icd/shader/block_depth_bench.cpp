// Time of one block of 64 depths, for each SIMD target.
#include <benchmark/benchmark.h>
#include <vulkan/vulkan_core.h>

#include "shader/block_depth.h"

namespace lapilli {
namespace {

void test_block(benchmark::State& state, bool write) {
  const auto target = static_cast<SimdTarget>(state.range(0));
  state.SetLabel(simd_target_name(target));
  if (!simd_target_supported(target)) return state.SkipWithError("not supported here");
  const BlockDepthFunctions& functions = block_depth_functions(target);
  TriangleDepth triangle = {{256, -512}, {768, 1024}, {1e6, 2e6}, {0.5, 1e-10, 1e-10, 0, 1}};
  alignas(64) float stored[64] = {};
  DepthRange range;
  uint32_t x = 0;
  for (auto _ : state) {
    x = (x + 8) % 1024;
    benchmark::DoNotOptimize(
        functions.test[VK_COMPARE_OP_ALWAYS - (write ? 0 : 4)](triangle, x, 64, ~uint64_t{0}, write, stored, range));
  }
}
BENCHMARK_CAPTURE(test_block, write, true)->DenseRange(0, 2);
BENCHMARK_CAPTURE(test_block, test_only, false)->DenseRange(0, 2);

void depth_block(benchmark::State& state) {
  const auto target = static_cast<SimdTarget>(state.range(0));
  state.SetLabel(simd_target_name(target));
  if (!simd_target_supported(target)) return state.SkipWithError("not supported here");
  TriangleDepth triangle = {{256, -512}, {768, 1024}, {1e6, 2e6}, {0.5, 1e-10, 1e-10, 0, 1}};
  alignas(64) float z[64] = {};
  uint32_t x = 0;
  for (auto _ : state) {
    x = (x + 8) % 1024;
    block_depth_functions(target).depth(triangle, x, 64, z);
  }
}
BENCHMARK(depth_block)->DenseRange(0, 2);

}  // namespace
}  // namespace lapilli

BENCHMARK_MAIN();
