// Time per triangle (or draw) of the front end on one thread, over draws made by hand at 1280x720.
#include <benchmark/benchmark.h>

#include <random>

#include "geometry/geometry_fixture.h"

namespace lapilli {
namespace {

constexpr uint32_t kWidth = 1280, kHeight = 720;

// Bins all draws once per iteration; items: triangles (or draws).
void run(benchmark::State& state, std::span<const DrawCall> draws, uint64_t items) {
  ThreadPool pool(1);
  FrontEnd front_end(pool);
  ExecutionLimits limits;
  uint64_t binned = 0, vertices = 0, sets = 0;
  for (auto _ : state) {
    binned = vertices = sets = 0;
    front_end.begin(draws, tiles_of(kWidth, kHeight), {0, 0, kWidth, kHeight}, limits);
    BinSet set;
    do {
      if (!front_end.next(set)) return state.SkipWithError("out of memory");
      ++sets;
      for (const BinChunk& chunk : set.chunks) {
        binned += chunk.triangles.size();
        vertices += chunk.vertices.size();
      }
    } while (!set.last);
  }
  state.SetItemsProcessed(static_cast<int64_t>(items) * static_cast<int64_t>(state.iterations()));
  state.counters["ns_each"] =
      benchmark::Counter(static_cast<double>(items) * static_cast<double>(state.iterations()) * 1e-9,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["binned"] = static_cast<double>(binned);
  state.counters["vertices"] = static_cast<double>(vertices);
  state.counters["sets"] = static_cast<double>(sets);
}

void grid(benchmark::State& state, uint32_t columns, uint32_t rows) {
  const GridMesh mesh(columns, rows);
  TestProgram program;
  program.bind(mesh.vertices);
  const DrawCall draw = program.draw_indexed(mesh.indices);
  run(state, {&draw, 1}, mesh.indices.size() / 3);
}
BENCHMARK_CAPTURE(grid, million, 1000, 500)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(grid, ten_million, 2500, 2000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(grid, tiles, 20, 12);  // a tile a cell

std::vector<MeshVertex> random_triangles(uint32_t count, float size) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> place(-1, 1), offset(-size, size);
  std::vector<MeshVertex> vertices;
  for (uint32_t i = 0; i < count; ++i) {
    const float x = place(random), y = place(random);
    for (uint32_t v = 0; v < 3; ++v) {
      vertices.push_back({x + offset(random), y + offset(random), 0.5f, {x, y, 0}});
    }
  }
  return vertices;
}

void list(benchmark::State& state, uint32_t count, float size) {
  const std::vector<MeshVertex> vertices = random_triangles(count, size);
  TestProgram program;
  program.bind(vertices);
  const DrawCall draw = program.draw(count * 3);
  run(state, {&draw, 1}, count);
}
BENCHMARK_CAPTURE(list, million_tiny, 1'000'000, 0.002f)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(list, large, 1000, 0.5f);

// One triangle a draw. `blocks`: the resources change with every draw.
void draws(benchmark::State& state, bool blocks) {
  constexpr uint32_t kCount = 10'000;
  const std::vector<MeshVertex> vertices = random_triangles(kCount, 0.02f);
  TestProgram program;
  program.bind(vertices);
  const std::vector<ResourceTable> resources(kCount);
  std::vector<DrawCall> calls;
  for (uint32_t i = 0; i < kCount; ++i) {
    calls.push_back(program.draw(3));
    calls.back().first = 3 * i;
    if (blocks) calls.back().resources = &resources[i];
  }
  run(state, calls, kCount);
}
BENCHMARK_CAPTURE(draws, same_state, false);
BENCHMARK_CAPTURE(draws, other_resources, true);

}  // namespace
}  // namespace lapilli

BENCHMARK_MAIN();
