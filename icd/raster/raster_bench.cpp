// Passes made by hand, at 1280x720 on one thread: where the time of a tile goes.
#include <benchmark/benchmark.h>

#include <cmath>

#include "base/simd_dispatch.h"
#include "raster/coverage.h"
#include "raster/scene_fixture.h"
#include "raster/small_triangle.h"

namespace lapilli {
namespace {

constexpr uint32_t kWidth = 1280, kHeight = 720;

FragmentPlan plan(bool depth, bool blend) {
  FragmentPlan plan;
  plan.depth_test = plan.early_depth = plan.depth_write = depth;
  plan.depth_compare = depth ? VK_COMPARE_OP_LESS : VK_COMPARE_OP_ALWAYS;
  plan.writes_color = true;
  plan.deferrable = plan.pixels_alone = !blend;
  return plan;
}

// RGBA8 and depth, both cleared; depth is not stored.
struct BenchPass : ScenePass {
  std::vector<uint32_t> texels;
  explicit BenchPass(bool with_depth) : ScenePass(kWidth, kHeight, 1), texels(size_t{kWidth} * kHeight) {
    color_target.data = reinterpret_cast<std::byte*>(texels.data());
    color_target.format = find_format(VK_FORMAT_R8G8B8A8_UNORM);
    color_target.row_pitch = uint64_t{kWidth} * 4;
    color_target.load_op = depth_target.load_op = VK_ATTACHMENT_LOAD_OP_CLEAR;
    depth_target.store_op = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    depth_target.clear.depthStencil.depth = 1;
    if (!with_depth) depth_target.data = nullptr;
  }
  ScenePass::Draw& add_draw(FragmentPlan which, bool accumulate) {
    Draw& draw = draws.emplace_back();
    draw.plan = which;
    draw.accumulate = accumulate;
    return draw;
  }
  void measure(benchmark::State& state) {
    build_draws(false, VK_FORMAT_R8G8B8A8_UNORM);
    for (auto _ : state) {
      if (run(false, false) != VK_SUCCESS) state.SkipWithError("render");
    }
  }
};

void clear(benchmark::State& state) {
  BenchPass pass(false);
  pass.measure(state);
}
BENCHMARK(clear)->Unit(benchmark::kMicrosecond);

void one_triangle(benchmark::State& state) {
  BenchPass pass(false);
  for (const auto& [x, y] : {std::pair{-0.8f, -0.8f}, {0.8f, -0.8f}, {0.0f, 0.8f}}) {
    auto& vertices = pass.draws.empty() ? pass.add_draw(plan(false, false), false).vertices : pass.draws[0].vertices;
    vertices.push_back({{x, y, 0.5f, 1}, {x, y, 0.5f, 1}});
  }
  pass.measure(state);
}
BENCHMARK(one_triangle)->Unit(benchmark::kMicrosecond);

// 64 layers over the whole screen. 0: back to front, 1: front to back, 2: without depth, 3: blended.
void layers(benchmark::State& state) {
  const bool blend = state.range(0) == 3;
  const bool depth = state.range(0) < 2;
  BenchPass pass(depth);
  pass.draws.reserve(64);
  for (int i = 0; i < 64; ++i) {
    const int layer = state.range(0) == 1 ? i : 63 - i;
    add_rectangle(pass.add_draw(plan(depth, blend), blend).vertices, -1, -1, 1, 1,
                  0.1f + static_cast<float>(layer) / 80, 0.01f);
  }
  pass.measure(state);
}
BENCHMARK(layers)->DenseRange(0, 3)->Unit(benchmark::kMicrosecond);

// A wavy grid of columns x rows cells with depth.
void grid(benchmark::State& state) {
  const auto columns = static_cast<int>(state.range(0)), rows = static_cast<int>(state.range(1));
  BenchPass pass(true);
  auto& vertices = pass.add_draw(plan(true, false), false).vertices;
  const auto corner = [&](int x, int y) {
    const float u = static_cast<float>(x) / static_cast<float>(columns);
    const float v = static_cast<float>(y) / static_cast<float>(rows);
    const float z = 0.5f + 0.2f * std::sin(20 * u) * std::cos(15 * v);
    return Vertex{{2 * u - 1, 2 * v - 1, z, 1}, {u, v, z, 1}};
  };
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const Vertex quad[4] = {corner(x, y), corner(x + 1, y), corner(x, y + 1), corner(x + 1, y + 1)};
      for (const int i : {0, 1, 2, 2, 1, 3}) vertices.push_back(quad[i]);
    }
  }
  pass.measure(state);
  state.counters["per triangle"] = benchmark::Counter(
      2.0 * columns * rows, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(grid)->Args({1000, 500})->Args({158, 158})->Unit(benchmark::kMillisecond);

// 10,000 draws of one small triangle.
void draws(benchmark::State& state) {
  BenchPass pass(true);
  pass.draws.reserve(10000);
  for (int i = 0; i < 10000; ++i) {
    const float x = -1 + static_cast<float>(i % 100) * 0.02f, y = -1 + static_cast<float>(i / 100) * 0.02f;
    auto& vertices = pass.add_draw(plan(true, false), false).vertices;
    for (const auto& [dx, dy] : {std::pair{0.0f, 0.0f}, {0.015f, 0.0f}, {0.0f, 0.015f}}) {
      vertices.push_back({{x + dx, y + dy, 0.5f, 1}, {x, y, dx, 1}});
    }
  }
  pass.measure(state);
  state.counters["per draw"] =
      benchmark::Counter(10000, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(draws)->Unit(benchmark::kMillisecond);

// 16 triangles of some pixels in one block, by SimdTarget: what they cost before anything is shaded.
void small_triangles(benchmark::State& state) {
  const SimdTarget before = simd_target();
  if (!set_simd_target(static_cast<SimdTarget>(state.range(0)))) return state.SkipWithError("not on this machine");
  BinChunk chunk;
  chunk.runs.push_back({});
  for (int32_t i = 0; i < 16; ++i) {
    const int32_t x = 256 * (i % 4) + 60, y = 256 * (i / 4) + 40;
    const uint16_t first = static_cast<uint16_t>(3 * i);
    for (const auto& [dx, dy] : {std::pair{0, 0}, {900, 100}, {200, 800}}) {
      chunk.vertices.push_back({x + dx, y + dy, 0.5 - 0.01 * i, 1, 0});
    }
    chunk.triangles.push_back(
        {{first, static_cast<uint16_t>(first + 1), static_cast<uint16_t>(first + 2)}, 0, 0, 0, 8, 8});
  }
  const SmallTriangleFunctions& functions = small_triangle_functions();
  TriangleGroup group;
  alignas(64) float depths[64];
  alignas(64) uint32_t numbers[64];
  for (auto _ : state) {
    std::fill_n(depths, 64, 1.0f);
    for (uint32_t i = 0; i < 16; ++i) group.put(i, chunk, chunk.triangles[i]);
    functions.set_up(group, 16, 0, 0, {0, 0, 64, 64});
    for (uint32_t i = 0; i < 16; ++i) {
      const SmallTarget target = {depths, true, group.z[0][i], 0, 1, numbers, i};
      const uint64_t pixels = pixels_in_rect({group.x0[i], group.y0[i], group.x1[i], group.y1[i]}, 0);
      benchmark::DoNotOptimize(functions.draw[VK_COMPARE_OP_LESS](group, i, 0, 0, pixels, target));
    }
  }
  state.SetItemsProcessed(16 * state.iterations());
  set_simd_target(before);
}
BENCHMARK(small_triangles)->DenseRange(0, 2);

}  // namespace
}  // namespace lapilli

BENCHMARK_MAIN();
