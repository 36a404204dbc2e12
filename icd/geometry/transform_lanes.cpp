// The viewport transformation of a batch of vertices, compiled once per SIMD target.
#include "base/simd_targets.h"
#include "geometry/setup.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/transform_lanes.cpp"
#include <hwy/foreach_target.h>
//
#include <cmath>
#include <cstddef>
#include <cstring>

#include "base/lanes-inl.h"
#include "base/simd_dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {
namespace {

// Everything but the varyings, of kVectorLanes vertices. `varyings`: of the first one.
HWY_INLINE void transform(const SetupState& state, const float* outputs, uint32_t varyings, BinVertex* vertices,
                          ClipPosition* positions) {
  const F x = load<F>(outputs + (kSlotPosition + 0) * kBatchLanes);
  const F y = load<F>(outputs + (kSlotPosition + 1) * kBatchLanes);
  const F z = load<F>(outputs + (kSlotPosition + 2) * kBatchLanes);
  const F w = load<F>(outputs + (kSlotPosition + 3) * kBatchLanes);
  const U position[4] = {as_u(x), as_u(y), as_u(z), as_u(w)};
  store_interleaved<4>(position, positions);
  const M finite = is_finite(x) & is_finite(y) & is_finite(z) & is_finite(w);
  U code = select(finite, zero_u(), broadcast(uint32_t{kOutInvalid}));
  M inside = finite & gt(w, zero_f());
  if (state.clip_depth) {
    const M too_near = lt(z, zero_f());
    const M too_far = gt(z, w);
    code = code | select(too_near, broadcast(uint32_t{kOutNear}), zero_u()) |
           select(too_far, broadcast(uint32_t{kOutFar}), zero_u());
    inside = inside & ~too_near & ~too_far;
  }
  const F screen_x = x / w * broadcast(state.half_width) + broadcast(state.centre_x);
  const F screen_y = y / w * broadcast(state.half_height) + broadcast(state.centre_y);
  const F limit = broadcast(static_cast<float>(kGuardBand));
  inside = inside & le(abs(screen_x), limit) & le(abs(screen_y), limit);

  // Multiplying by 256 is exact.
  const F no_snap = zero_f();
  const U snapped_x = as_u(nearest_in_range(select(inside, screen_x, no_snap) * broadcast(256.0f)));
  const U snapped_y = as_u(nearest_in_range(select(inside, screen_y, no_snap) * broadcast(256.0f)));
  const D depth = to_double(z) / to_double(w) * broadcast(state.depth_scale) + broadcast(state.depth_offset);
  const U count = broadcast(static_cast<uint32_t>(state.varyings.size()));

  static_assert(sizeof(BinVertex) == 24 && offsetof(BinVertex, z) == 8 && offsetof(BinVertex, inverse_w) == 16);
  alignas(64) uint64_t screen[kVectorLanes], rest[kVectorLanes];
  alignas(64) double depths[kVectorLanes];
  const U screen_words[2] = {select(inside, snapped_x, broadcast(static_cast<uint32_t>(kNotInside))),
                             select(inside, snapped_y, code)};
  const U rest_words[2] = {as_u(broadcast(1.0f) / w), broadcast(varyings) + lane_numbers() * count};
  store_interleaved<2>(screen_words, screen);
  store_interleaved<2>(rest_words, rest);
  store_d(depth, depths);
  for (int lane = 0; lane < kVectorLanes; ++lane) {
    std::byte* const vertex = reinterpret_cast<std::byte*>(vertices + lane);
    std::memcpy(vertex, &screen[lane], 8);
    std::memcpy(vertex + 8, &depths[lane], 8);
    std::memcpy(vertex + 16, &rest[lane], 8);
  }
}

// `count` slots of kVectorLanes lanes, vertex by vertex.
template <uint32_t kCount>
void interleave(const float* slots, float* out) {
  U words[kCount];
  for (uint32_t k = 0; k < kCount; ++k) words[k] = load<U>(slots + k * kBatchLanes);
  store_interleaved<kCount>(words, out);
}
void transpose(const float* slots, uint32_t count, float* out) {
  switch (count) {
    case 0:
      return;
    case 1:
      return interleave<1>(slots, out);
    case 2:
      return interleave<2>(slots, out);
    case 3:
      return interleave<3>(slots, out);
    case 4:
      return interleave<4>(slots, out);
    default:
      break;
  }
  alignas(64) float four[kVectorLanes][4];
  for (uint32_t done = 0; done < count; done += 4) {
    const uint32_t first = done + 4 <= count ? done : count - 4;  // the last four overlap those before
    interleave<4>(slots + first * kBatchLanes, four[0]);
    for (int lane = 0; lane < kVectorLanes; ++lane) {
      std::memcpy(out + static_cast<uint32_t>(lane) * count + first, four[lane], 16);
    }
  }
}

}  // namespace

// There is room for whole vectors.
void transform_lanes(const SetupState& state, const float* outputs, uint32_t lanes, uint32_t first_varying,
                     BinVertex* vertices, float* varyings, ClipPosition* positions) {
  const uint32_t count = static_cast<uint32_t>(state.varyings.size());
  for (uint32_t lane = 0; lane < lanes; lane += kVectorLanes) {
    transform(state, outputs + lane, first_varying + lane * count, vertices + lane, positions + lane);
    transpose(outputs + kSlotVaryings * kBatchLanes + lane, count, varyings + lane * count);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lapilli {
namespace {

// Says of vertices with negative distances that they are not inside, and keeps the clip distances.
void append_distances(const SetupState& state, const float* outputs, uint32_t lanes, BinVertex* vertices,
                      BinArray<float>& distances) {
  const uint32_t clip = state.clip_distances, count = clip + state.cull_distances;
  const float* const slots = outputs + (kSlotVaryings + state.varyings.size()) * kBatchLanes;
  const size_t done = distances.size();
  distances.resize(done + size_t{lanes} * clip);
  float* kept = distances.data() + done;
  for (uint32_t lane = 0; lane < lanes; ++lane) {
    int32_t code = 0;
    for (uint32_t k = 0; k < count; ++k) {
      const float distance = slots[k * kBatchLanes + lane];
      if (distance < 0) code |= kOutDistance << k;
      if (k >= clip) continue;
      if (std::isnan(distance)) code |= kOutInvalid;
      *kept++ = distance;
    }
    if (code == 0) continue;
    BinVertex& vertex = vertices[lane];
    vertex.y = code | (vertex.x == kNotInside ? vertex.y : 0);
    vertex.x = kNotInside;
  }
}

}  // namespace

void append_vertices(const SetupState& state, const float* outputs, uint32_t lanes, BinChunk& chunk,
                     ClipInputs& inputs) {
  BinArray<ClipPosition>& positions = inputs.positions;
  using Transform = void(const SetupState&, const float*, uint32_t, uint32_t, BinVertex*, float*, ClipPosition*);
  static constexpr PerTarget<Transform> kTable = LAPILLI_PER_TARGET(transform_lanes);
  const size_t vertices = chunk.vertices.size(), varyings = chunk.varyings.size(), done = positions.size();
  const size_t count = state.varyings.size();
  chunk.vertices.reserve(vertices + kBatchLanes);
  chunk.varyings.reserve(varyings + kBatchLanes * count);
  positions.reserve(done + kBatchLanes);
  for_target(kTable)(state, outputs, lanes, static_cast<uint32_t>(varyings), chunk.vertices.data() + vertices,
                     chunk.varyings.data() + varyings, positions.data() + done);
  chunk.vertices.resize(vertices + lanes);
  chunk.varyings.resize(varyings + lanes * count);
  positions.resize(done + lanes);
  if (state.clip_distances + state.cull_distances != 0)
    append_distances(state, outputs, lanes, chunk.vertices.data() + vertices, inputs.distances);
}

}  // namespace lapilli
#endif
