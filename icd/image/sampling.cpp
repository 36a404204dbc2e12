// Sampled 2D images: level of detail, the levels that a batch needs, and the choice of the level reader.
#include "image/sampling.h"

#include <array>
#include <bit>
#include <utility>

#include "base/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "image/sampling.cpp"
#include <hwy/foreach_target.h>

#include "base/lane_math-inl.h"
#include "image/sampling-inl.h"
#include "image/sampling_general-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {
namespace {

constexpr int kQuads = kLanes / 4;

using LevelFunction = void (*)(const LevelJob&, uint64_t lanes, float* const rgba[4]);

// Null where the general way is taken: formats that one does not draw to are not hot.
struct FormatReaders {
  LevelFunction nearest = nullptr;
  LevelFunction linear = nullptr;          // any wrapping
  LevelFunction linear_repeat = nullptr;   // both axes repeat
  LevelFunction linear_to_edge = nullptr;  // both axes clamp to the edge
};

template <size_t kFormat>
constexpr FormatReaders readers_of() {
  FormatReaders readers;
  if constexpr (kFormats[kFormat].has(kSampled) && kFormats[kFormat].is_target()) {
    using Reader = LevelReader<kFormat>;
    readers.nearest = Reader::nearest;
    if constexpr (kFormats[kFormat].has(kFilterable)) {
      readers.linear = Reader::template linear<WrapAny>;
      readers.linear_repeat = Reader::template linear<WrapRepeat>;
      readers.linear_to_edge = Reader::template linear<WrapClampToEdge>;
    }
  }
  return readers;
}

template <size_t... kIndices>
constexpr std::array<FormatReaders, sizeof...(kIndices)> make_readers(std::index_sequence<kIndices...>) {
  return {readers_of<kIndices>()...};
}
constexpr std::array<FormatReaders, kFormatCount> kReaders = make_readers(std::make_index_sequence<kFormatCount>());

bool mirrors_once(const SamplerState& sampler) {
  constexpr VkSamplerAddressMode kOnce = VK_SAMPLER_ADDRESS_MODE_MIRROR_CLAMP_TO_EDGE;
  return sampler.address_u == kOnce || sampler.address_v == kOnce;
}

// A filter that the format does not offer falls back to the nearest texel.
LevelFunction level_function(const TextureView& view, const SamplerState& sampler, VkFilter filter, bool plain) {
  const FormatReaders& readers = kReaders[view.format->index];
  const bool nearest = filter == VK_FILTER_NEAREST || !view.format->has(kFilterable);
  if (!plain || readers.nearest == nullptr || mirrors_once(sampler)) return nearest ? general_nearest : general_linear;
  if (nearest) return readers.nearest;
  if (sampler.address_u == sampler.address_v && !sampler.unnormalized) {
    if (sampler.address_u == VK_SAMPLER_ADDRESS_MODE_REPEAT) return readers.linear_repeat;
    if (sampler.address_u == VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE) return readers.linear_to_edge;
  }
  return readers.linear;
}

bool can_sample(const TextureView* view, const SamplerState* sampler) {
  return view != nullptr && sampler != nullptr && view->level_count != 0 && view->format->has(kSampled);
}

LevelJob make_job(const TextureView& view, const SamplerState& sampler, const SampleOperands& operands) {
  return {&view.levels[0], &sampler,           operands.u,        operands.v,
          view.format,     operands.reference, operands.offset_x, operands.offset_y};
}

uint64_t lanes_equal(const int32_t* values, int32_t value) {
  uint64_t word = 0;
  for (int vector = 0; vector < kVectorsPerBatch; ++vector) {
    const uint64_t bits = bits_of(eq(load<I>(values + vector * kVectorLanes), broadcast(value)));
    word |= bits << (vector * kVectorLanes);
  }
  return word;
}

void fill_lanes(F value, uint64_t lanes, float* target) {
  for (int vector = 0; vector < kVectorsPerBatch; ++vector) {
    store_where(mask_of(lanes, vector), value, target + vector * kVectorLanes);
  }
}

void write_zero(uint64_t lanes, float* const rgba[4]) {
  for (int c = 0; c < 4; ++c) fill_lanes(zero_f(), lanes, rgba[c]);
}

void write_swizzled(const TextureView& view, const Registers& texels, uint64_t lanes, float* const rgba[4]) {
  for (size_t c = 0; c < 4; ++c) {
    switch (view.swizzle[c]) {
      case Swizzle::zero:
        fill_lanes(zero_f(), lanes, rgba[c]);
        break;
      case Swizzle::one:
        fill_lanes(view.format->is_integer() ? as_f(broadcast(1u)) : broadcast(1.0f), lanes, rgba[c]);
        break;
      default:
        copy_lanes(texels.lane[static_cast<size_t>(view.swizzle[c])], lanes, rgba[c]);
    }
  }
}

// Lanes whose texel is in the level, and where that lies.
uint64_t texel_offsets(const FormatInfo& format, const TextureLevel& level, const FetchOperands& operands,
                       uint64_t lanes, uint32_t* offsets) {
  uint64_t inside = 0;
  for (int first = 0; first < kLanes; first += kVectorLanes) {
    const I x = load<I>(operands.x + first), y = load<I>(operands.y + first);
    const M here = index_inside(x, broadcast(level.width)) & index_inside(y, broadcast(level.height));
    const I texel_size = broadcast(static_cast<int32_t>(format.texel_size));
    store(as_u(y * broadcast(level.row_pitch) + x * texel_size), offsets + first);
    inside |= bits_of(here) << first;
  }
  return inside & lanes;
}

void lod_from_derivatives(const TextureView& view, const SamplerState& sampler, const float* u, const float* v,
                          float* lod) {
  const float width = sampler.unnormalized ? 1.0f : static_cast<float>(view.levels[0].width);
  const float height = sampler.unnormalized ? 1.0f : static_cast<float>(view.levels[0].height);
  // One lane for each quad.
  alignas(64) float result[kQuads];
  for (int quad = 0; quad < kQuads; quad += kVectorLanes) {
    U us[4], vs[4];  // of the quads' first, right, lower and last lanes
    load_interleaved<4>(u + 4 * quad, us);
    load_interleaved<4>(v + 4 * quad, vs);
    const F du_dx = (as_f(us[1]) - as_f(us[0])) * broadcast(width);
    const F dv_dx = (as_f(vs[1]) - as_f(vs[0])) * broadcast(height);
    const F du_dy = (as_f(us[2]) - as_f(us[0])) * broadcast(width);
    const F dv_dy = (as_f(vs[2]) - as_f(vs[0])) * broadcast(height);
    const F x_squared = fma(du_dx, du_dx, dv_dx * dv_dx);
    const F y_squared = fma(du_dy, du_dy, dv_dy * dv_dy);
    const F squared = max(x_squared, y_squared);
    const F lambda = broadcast(0.5f) * log2(squared);
    store(select(unordered(x_squared, y_squared), zero_f(), lambda), result + quad);
  }
  for (int first = 0; first < kLanes; first += kVectorLanes) {
    const float* quads[kVectorLanes / 4];
    for (int quad = 0; quad < kVectorLanes / 4; ++quad) quads[quad] = result + first / 4 + quad;
    store(spread_to_quads(quads, 0), lod + first);
  }
}

// What each lane reads.
struct LevelPlan {
  alignas(64) int32_t fine[kLanes];    // level
  alignas(64) int32_t coarse[kLanes];  // the next level, for lanes between two
  alignas(64) float delta[kLanes];     // weight of the coarser one
  uint64_t magnified = 0;              // lanes with lambda ≤ 0
  uint64_t between = 0;                // lanes with delta > 0
};

// Of each lane, before the sampler clamps it.
void find_lods(const TextureView& view, const SamplerState& sampler, const SampleOperands& operands, float* lods) {
  alignas(64) float derived[kLanes];
  const bool implicit = operands.lod_source == LodSource::derivatives;
  if (implicit) lod_from_derivatives(view, sampler, operands.u, operands.v, derived);
  for (int first = 0; first < kLanes; first += kVectorLanes) {
    const F operand = operands.lod != nullptr ? load<F>(operands.lod + first) : zero_f();
    const F base = implicit ? load<F>(derived + first) : operand;
    const F shader_bias = implicit ? operand : zero_f();
    const F bias = clamp_or_low(broadcast(sampler.lod_bias) + shader_bias, broadcast(-kMaxSamplerLodBias),
                                broadcast(kMaxSamplerLodBias));
    const F sum = base + bias;
    store(select(is_nan(sum), zero_f(), sum), lods + first);
  }
}

// The finer level and the weight of the next one, of a level of detail between the levels of the view.
HWY_API F split_levels(const SamplerState& sampler, F d, F& delta) {
  if (sampler.mipmap_mode == VK_SAMPLER_MIPMAP_MODE_NEAREST) {
    delta = zero_f();
    return ceil(d + broadcast(0.5f)) - broadcast(1.0f);
  }
  const F fine = floor(d);
  delta = d - fine;
  return fine;
}

HWY_API F clamp_lod(const SamplerState& sampler, F lod) {
  return min(max(lod, broadcast(sampler.min_lod)), broadcast(sampler.max_lod));
}

void plan_levels(const TextureView& view, const SamplerState& sampler, const SampleOperands& operands,
                 LevelPlan& plan) {
  alignas(64) float lods[kLanes];
  find_lods(view, sampler, operands, lods);
  const F last = broadcast(static_cast<float>(view.level_count - 1));
  for (int vector = 0; vector < kVectorsPerBatch; ++vector) {
    const int first = vector * kVectorLanes;
    const F lambda = clamp_lod(sampler, load<F>(lods + first));
    plan.magnified |= bits_of(le(lambda, zero_f())) << first;
    F delta;
    const I fine = truncate_in_range(split_levels(sampler, clamp_or_low(lambda, zero_f(), last), delta));
    store(fine, plan.fine + first);
    store(min(fine + broadcast(1), truncate_in_range(last)), plan.coarse + first);
    store(delta, plan.delta + first);
    plan.between |= bits_of(lt(zero_f(), delta)) << first;
  }
}

// Each level that some of the lanes read, for those lanes.
void read_levels(const TextureView& view, LevelFunction function, LevelJob job, const int32_t* levels, uint64_t lanes,
                 float* const rgba[4]) {
  while (lanes != 0) {
    const int32_t level = levels[std::countr_zero(lanes)];
    const uint64_t here = lanes & lanes_equal(levels, level);
    job.level = &view.levels[static_cast<size_t>(level)];
    function(job, here, rgba);
    lanes &= ~here;
  }
}

// With one filter: the finer level, and where delta says so the mix with the coarser one.
void read_mixed(const TextureView& view, LevelFunction function, const LevelJob& job, const LevelPlan& plan,
                uint64_t lanes, float* const rgba[4]) {
  read_levels(view, function, job, plan.fine, lanes, rgba);
  const uint64_t between = lanes & plan.between;
  if (between == 0) return;
  Registers coarser;
  if (between != ~uint64_t{0}) {
    for (auto& reg : coarser.lane) fill_lanes(zero_f(), ~uint64_t{0}, reg);
  }
  read_levels(view, function, job, plan.coarse, between, coarser.rgba);
  for (int c = 0; c < 4; ++c) {
    for (int first = 0; first < kLanes; first += kVectorLanes) {
      const F fine = load<F>(rgba[c] + first);
      const F mixed = fma(load<F>(plan.delta + first), load<F>(coarser.lane[c] + first) - fine, fine);
      store_where(mask_of(between, first / kVectorLanes), mixed, rgba[c] + first);
    }
  }
}

void sample_2d(const TextureView* view, const SamplerState* sampler, const SampleOperands& operands,
               float* const rgba[4]) {
  if (!can_sample(view, sampler)) return write_zero(operands.lanes, rgba);
  const bool plain = operands.reference == nullptr && operands.offset_x == nullptr;
  const LevelFunction magnify = level_function(*view, *sampler, sampler->mag_filter, plain);
  const LevelFunction minify = level_function(*view, *sampler, sampler->min_filter, plain);
  LevelJob job = make_job(*view, *sampler, operands);
  const bool one_way = view->level_count == 1 && magnify == minify;
  if (one_way && view->identity_swizzle) return magnify(job, operands.lanes, rgba);

  Registers texels;  // rgba may be the registers of u and v
  if (one_way) {
    magnify(job, operands.lanes, texels.rgba);
  } else {
    LevelPlan plan;
    plan_levels(*view, *sampler, operands, plan);
    const uint64_t magnified = magnify == minify ? 0 : operands.lanes & plan.magnified;
    // Nearly always the whole batch reads one level, or the same two.
    const int32_t level = plan.fine[std::countr_zero(operands.lanes) % kLanes];
    const bool one_level = (operands.lanes & (plan.between | ~lanes_equal(plan.fine, level))) == 0;
    if (one_level && view->identity_swizzle && (magnified == 0 || magnified == operands.lanes)) {
      job.level = &view->levels[static_cast<size_t>(level)];
      return (magnified != 0 ? magnify : minify)(job, operands.lanes, rgba);
    }
    read_mixed(*view, magnify, job, plan, magnified, texels.rgba);
    read_mixed(*view, minify, job, plan, operands.lanes & ~magnified, texels.rgba);
  }
  write_swizzled(*view, texels, operands.lanes, rgba);
}

void gather_2d(const TextureView* view, const SamplerState* sampler, const SampleOperands& operands, uint32_t component,
               float* const texels[4]) {
  if (!can_sample(view, sampler)) return write_zero(operands.lanes, texels);
  const LevelJob job = make_job(*view, *sampler, operands);
  Footprints where;
  find_footprints(job, true, operands.lanes, where);
  constexpr int kOrder[] = {2, 3, 1, 0};
  for (int i = 0; i < 4; ++i) {
    Registers texel, swizzled;
    read_tap(job, where, kOrder[i], operands.lanes, texel);
    write_swizzled(*view, texel, operands.lanes, swizzled.rgba);
    copy_lanes(swizzled.lane[component & 3], operands.lanes, texels[i]);
  }
}

void query_lod_2d(const TextureView* view, const SamplerState* sampler, const SampleOperands& operands, float* level,
                  float* lod) {
  if (!can_sample(view, sampler)) {
    fill_lanes(zero_f(), operands.lanes, level);
    return fill_lanes(zero_f(), operands.lanes, lod);
  }
  alignas(64) float lods[kLanes];
  find_lods(*view, *sampler, operands, lods);
  const F last = broadcast(static_cast<float>(view->level_count - 1));
  for (int vector = 0; vector < kVectorsPerBatch; ++vector) {
    const int first = vector * kVectorLanes;
    const F lambda = load<F>(lods + first);
    F delta;
    const F fine = split_levels(*sampler, clamp_or_low(clamp_lod(*sampler, lambda), zero_f(), last), delta);
    store_where(mask_of(operands.lanes, vector), fine + delta, level + first);
    store_where(mask_of(operands.lanes, vector), lambda, lod + first);
  }
}

void fetch_2d(const TextureView* view, const FetchOperands& operands, float* const rgba[4]) {
  if (view == nullptr || view->level_count == 0) return write_zero(operands.lanes, rgba);
  const TexelFunctions& format = kTexelTable[view->format->index];
  Registers texels = {};
  for (uint32_t i = 0; i < view->level_count; ++i) {
    const TextureLevel& level = view->levels[i];
    uint64_t here = i == 0 ? operands.lanes : 0;
    if (operands.level != nullptr) here = operands.lanes & lanes_equal(operands.level, static_cast<int32_t>(i));
    if (here == 0) continue;
    alignas(64) uint32_t offsets[kLanes];
    const uint64_t inside = texel_offsets(*view->format, level, operands, here, offsets);
    if (here == ~uint64_t{0} && inside == here && view->identity_swizzle)
      return format.load_gathered(level.data, offsets, inside, rgba);
    Registers read;
    format.load_gathered(level.data, offsets, inside, read.rgba);
    for (int c = 0; c < 4; ++c) copy_lanes(read.lane[c], inside, texels.lane[c]);
  }
  write_swizzled(*view, texels, operands.lanes, rgba);
}

uint64_t find_texels_2d(const TextureView& view, const FetchOperands& operands, uint32_t* byte_offsets) {
  return texel_offsets(*view.format, view.levels[0], operands, operands.lanes, byte_offsets);
}

void store_2d(const TextureView* view, const FetchOperands& operands, const float* const rgba[4]) {
  if (view == nullptr || view->level_count == 0) return;
  const TexelFunctions& format = kTexelTable[view->format->index];
  if (format.store_scattered == nullptr) return;
  alignas(64) uint32_t offsets[kLanes];
  const uint64_t inside = texel_offsets(*view->format, view->levels[0], operands, operands.lanes, offsets);
  format.store_scattered(view->levels[0].data, offsets, inside, rgba);
}

void size_2d(const TextureView* view, const int32_t* level, uint64_t lanes, int32_t* const size_and_levels[3]) {
  for (; lanes != 0; lanes &= lanes - 1) {
    const int lane = std::countr_zero(lanes);
    const uint32_t index = level != nullptr ? static_cast<uint32_t>(level[lane]) : 0;
    const bool present = view != nullptr && index < view->level_count;
    size_and_levels[0][lane] = present ? view->levels[index].width : 0;
    size_and_levels[1][lane] = present ? view->levels[index].height : 0;
    size_and_levels[2][lane] = view != nullptr ? static_cast<int32_t>(view->level_count) : 0;
  }
}

}  // namespace

extern const SamplingFunctions kSampling;
const SamplingFunctions kSampling = {sample_2d, fetch_2d,     store_2d, find_texels_2d,
                                     gather_2d, query_lod_2d, size_2d,  lod_from_derivatives};

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lapilli {
namespace {

constexpr PerTarget<const SamplingFunctions> kTables = LAPILLI_PER_TARGET(kSampling);

}  // namespace

const SamplingFunctions& sampling_functions() { return for_target(kTables); }
const SamplingFunctions& sampling_functions(SimdTarget target) { return for_target(kTables, target); }

}  // namespace lapilli
#endif
