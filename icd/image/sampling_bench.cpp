// Time of one batch (64 lanes) of texture reads and tile stores, for each SIMD target. Budget (DESIGN.md): a bilinear
// RGBA8 read of 1280x720 lanes in 1.3 ms is 90 ns a batch.
#include <benchmark/benchmark.h>

#include <vector>

#include "image/sampling.h"
#include "image/texel.h"
#include "image/tile.h"

namespace lapilli {
namespace {

struct Batch {
  alignas(64) float u[64];
  alignas(64) float v[64];
  alignas(64) float rgba[4][64];
  float* out[4] = {rgba[0], rgba[1], rgba[2], rgba[3]};
  const float* in[4] = {rgba[0], rgba[1], rgba[2], rgba[3]};
};

bool choose(benchmark::State& state) {
  const auto target = static_cast<SimdTarget>(state.range(0));
  state.SetLabel(simd_target_name(target));
  if (!set_simd_target(target)) state.SkipWithError("not supported here");
  return simd_target() == target;
}

// Quads walk over the texture row by row, 1 texel a pixel at an odd offset.
void move_batch(Batch& batch, uint32_t number) {
  for (uint32_t lane = 0; lane < 64; ++lane) {
    const uint32_t x = (number * 32 + lane / 4 * 2 + lane % 2) % 512;
    const uint32_t y = number * 32 / 512 * 2 + lane / 2 % 2;
    batch.u[lane] = (static_cast<float>(x) + 0.3f) / 512.0f;
    batch.v[lane] = (static_cast<float>(y) + 0.7f) / 512.0f;
  }
}

void sample(benchmark::State& state, VkFormat format, VkFilter filter, VkSamplerAddressMode mode, uint32_t levels = 1) {
  if (!choose(state)) return;
  const auto layout = make_layout(format, {.width = 512, .height = 512, .mip_levels = levels});
  std::vector<std::byte> memory(layout->size, std::byte{0x3F});
  const auto view = make_view(*layout, memory.data(), format, {}, {layout->format->aspects, 0, levels, 0, 1});
  SamplerState sampler;
  sampler.mag_filter = sampler.min_filter = filter;
  sampler.address_u = sampler.address_v = mode;
  sampler.mipmap_mode = VK_SAMPLER_MIPMAP_MODE_LINEAR;
  sampler.max_lod = 100;
  sampler.lod_bias = levels > 1 ? 0.25f : 0.0f;
  std::vector<Batch> batches(64);
  for (uint32_t i = 0; i < 64; ++i) move_batch(batches[i], i);
  const SamplingFunctions& functions = sampling_functions();
  uint32_t i = 0;
  for (auto _ : state) {
    Batch& batch = batches[i++ % 64];
    functions.sample_2d(&*view, &sampler, {batch.u, batch.v, nullptr, LodSource::derivatives, ~uint64_t{0}}, batch.out);
  }
  state.counters["lanes/s"] = benchmark::Counter(64.0, benchmark::Counter::kIsIterationInvariantRate);
}

// `sparse`: as tiny triangles cover the quads.
constexpr uint64_t kSparseLanes = 0x13F78C21F3718E42;
void store_and_load(benchmark::State& state, VkFormat format, bool whole_block, bool sparse = false) {
  if (!choose(state)) return;
  const TexelFunctions& functions = texel_functions(*find_format(format));
  std::vector<std::byte> plane(kTileTexels * 16);
  Batch batch;
  move_batch(batch, 0);
  for (auto& reg : batch.rgba) std::copy(batch.u, batch.u + 64, reg);
  uint16_t quads[16];
  for (uint16_t q = 0; q < 16; ++q) quads[q] = static_cast<uint16_t>(whole_block ? q : q * 32);
  const QuadPlaces places = {quads, whole_block};
  const uint64_t lanes = sparse ? kSparseLanes : ~uint64_t{0};
  for (auto _ : state) {
    functions.store_quads(plane.data(), places, lanes, batch.in, 15);
    functions.load_quads(plane.data(), places, lanes, batch.out);
  }
}

// Source alpha over, as 32 layers do it.
void blend(benchmark::State& state, bool whole_block) {
  if (!choose(state)) return;
  const TexelFunctions& functions = texel_functions(*find_format(VK_FORMAT_R8G8B8A8_UNORM));
  std::vector<std::byte> plane(kTileTexels * 4);
  Batch batch;
  move_batch(batch, 0);
  for (auto& reg : batch.rgba) std::copy(batch.u, batch.u + 64, reg);
  uint16_t quads[16];
  for (uint16_t q = 0; q < 16; ++q) quads[q] = static_cast<uint16_t>(whole_block ? q : q * 32);
  const BlendEquation equation = {{{1, 0}, {0, 1}}, {{-1, 1}, {-1, 1}}, 15, false, false};
  for (auto _ : state) {
    functions.blend_quads(plane.data(), {quads, whole_block}, ~uint64_t{0}, batch.in, equation);
  }
}

// Vertex attributes, one behind the other.
void fetch(benchmark::State& state, VkFormat format) {
  if (!choose(state)) return;
  const FormatInfo& info = *find_format(format);
  std::vector<std::byte> memory(64 * info.texel_size);
  Batch batch;
  alignas(64) uint32_t offsets[64];
  for (uint32_t i = 0; i < 64; ++i) offsets[i] = i * info.texel_size;
  for (auto _ : state) texel_functions(info).load_gathered(memory.data(), offsets, ~uint64_t{0}, batch.out);
}

// Tiles of an image of 1280x704, one after the other.
struct TileBench {
  uint32_t texel_size, number = 0;
  uint64_t pitch;
  std::vector<std::byte> image, plane;
  explicit TileBench(benchmark::State& state)
      : texel_size(static_cast<uint32_t>(state.range(0))),
        pitch(uint64_t{1280} * texel_size),
        image(pitch * 704),
        plane(size_t{kTileTexels} * texel_size) {}
  TileArea next() {
    const uint32_t x = number % 20 * 64, y = number / 20 % 11 * 64;
    ++number;
    return {x, y, x + 64, y + 64};
  }
  void report(benchmark::State& state) const {
    state.SetBytesProcessed(state.iterations() * static_cast<int64_t>(plane.size()));
  }
};

void store_tiles(benchmark::State& state) {
  TileBench tiles(state);
  for (auto _ : state) store_tile(tiles.plane.data(), tiles.texel_size, tiles.next(), tiles.image.data(), tiles.pitch);
  tiles.report(state);
}
void load_tiles(benchmark::State& state) {
  TileBench tiles(state);
  for (auto _ : state) load_tile(tiles.image.data(), tiles.pitch, tiles.texel_size, tiles.next(), tiles.plane.data());
  tiles.report(state);
}

constexpr PackedTexel kSomeTexel = {std::byte{1}, std::byte{2}, std::byte{3}};
void clear_tiles(benchmark::State& state) {
  TileBench tiles(state);
  for (auto _ : state) fill_tile(tiles.plane.data(), tiles.texel_size, kSomeTexel);
  tiles.report(state);
}
void clear_image_tiles(benchmark::State& state) {
  TileBench tiles(state);
  for (auto _ : state) fill_image_area(tiles.image.data(), tiles.pitch, tiles.texel_size, tiles.next(), kSomeTexel);
  tiles.report(state);
}

constexpr auto kRepeat = VK_SAMPLER_ADDRESS_MODE_REPEAT;
constexpr auto kMirror = VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
BENCHMARK_CAPTURE(sample, rgba8_linear_repeat, VK_FORMAT_R8G8B8A8_UNORM, VK_FILTER_LINEAR, kRepeat)->DenseRange(0, 2);
BENCHMARK_CAPTURE(sample, rgba8_linear_to_edge, VK_FORMAT_R8G8B8A8_UNORM, VK_FILTER_LINEAR,
                  VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE)
    ->DenseRange(0, 2);
BENCHMARK_CAPTURE(sample, rgba8_linear_mirror, VK_FORMAT_R8G8B8A8_UNORM, VK_FILTER_LINEAR, kMirror)->DenseRange(0, 2);
BENCHMARK_CAPTURE(sample, rgba8_trilinear, VK_FORMAT_R8G8B8A8_UNORM, VK_FILTER_LINEAR, kRepeat, 9)->DenseRange(0, 2);
BENCHMARK_CAPTURE(sample, rgba8_nearest, VK_FORMAT_R8G8B8A8_UNORM, VK_FILTER_NEAREST, kRepeat)->DenseRange(0, 2);
BENCHMARK_CAPTURE(sample, rgba32f_linear, VK_FORMAT_R32G32B32A32_SFLOAT, VK_FILTER_LINEAR, kRepeat)->DenseRange(0, 2);
BENCHMARK_CAPTURE(store_and_load, rgba8, VK_FORMAT_R8G8B8A8_UNORM, false)->DenseRange(0, 2);
BENCHMARK_CAPTURE(store_and_load, rgba32f, VK_FORMAT_R32G32B32A32_SFLOAT, false)->DenseRange(0, 2);
BENCHMARK_CAPTURE(store_and_load, depth, VK_FORMAT_D32_SFLOAT, false)->DenseRange(0, 2);
BENCHMARK_CAPTURE(store_and_load, rgba8_sparse, VK_FORMAT_R8G8B8A8_UNORM, false, true)->DenseRange(0, 2);
BENCHMARK_CAPTURE(store_and_load, rgba8_block, VK_FORMAT_R8G8B8A8_UNORM, true)->DenseRange(0, 2);
BENCHMARK_CAPTURE(store_and_load, rgba32f_block, VK_FORMAT_R32G32B32A32_SFLOAT, true)->DenseRange(0, 2);
BENCHMARK_CAPTURE(store_and_load, depth_block, VK_FORMAT_D32_SFLOAT, true)->DenseRange(0, 2);
BENCHMARK_CAPTURE(fetch, rgba32f, VK_FORMAT_R32G32B32A32_SFLOAT)->DenseRange(0, 2);
BENCHMARK_CAPTURE(fetch, rgb32f, VK_FORMAT_R32G32B32_SFLOAT)->DenseRange(0, 2);
BENCHMARK_CAPTURE(fetch, rg32f, VK_FORMAT_R32G32_SFLOAT)->DenseRange(0, 2);
BENCHMARK_CAPTURE(blend, quads, false)->DenseRange(0, 2);
BENCHMARK_CAPTURE(blend, block, true)->DenseRange(0, 2);
BENCHMARK(store_tiles)->Arg(4)->Arg(16);
BENCHMARK(load_tiles)->Arg(4)->Arg(16);
BENCHMARK(clear_tiles)->Arg(4)->Arg(16);
BENCHMARK(clear_image_tiles)->Arg(4)->Arg(16);

}  // namespace
}  // namespace lapilli

BENCHMARK_MAIN();
