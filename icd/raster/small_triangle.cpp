// Set-up, coverage, depth test and visibility of small triangles, for every SIMD target.
#include "raster/small_triangle.h"

#include "base/simd_dispatch.h"
#include "base/simd_targets.h"
#include "raster/coverage.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/small_triangle.cpp"
#include <hwy/foreach_target.h>

#include "image/compare-inl.h"
#include "shader/interpreter/planes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {
namespace {

// All of a vector of triangles; the numbers of those that are not small may wrap. Returns which are.
HWY_INLINE M set_up_edges(TriangleGroup& group, uint32_t i, I centre_x, I centre_y) {
  const I px[3] = {load<I>(group.x[0] + i), load<I>(group.x[1] + i), load<I>(group.x[2] + i)};
  const I py[3] = {load<I>(group.y[0] + i), load<I>(group.y[1] + i), load<I>(group.y[2] + i)};
  const I half = broadcast(TriangleGroup::kMostExtent);
  U extents = zero_u();
  I area2 = zero_i();
  for (int e = 0; e < 3; ++e) {
    const int from = (e + 1) % 3, to = (e + 2) % 3;
    const I dx = px[to] - px[from], dy = py[to] - py[from];
    extents = extents | as_u(dx + half) | as_u(dy + half);
    const I at_centre = dx * (centre_y - py[from]) - dy * (centre_x - px[from]);
    const M owns = lt(dy, zero_i()) | (eq(dy, zero_i()) & gt(dx, zero_i()));
    const I less = select(owns, zero_i(), broadcast(-1));
    area2 = area2 + at_centre;
    store(at_centre + less, group.c[e] + i);
    store(less, group.less[e] + i);
    store((as_u(negate(dy)) & broadcast(0xFFFFu)) | shift_left<16>(as_u(dx)), group.steps[e] + i);
  }
  const D inverse = broadcast(1.0) / to_double(area2);
  const D z0 = load_d(group.z[0] + i);
  store_d((load_d(group.z[1] + i) - z0) * inverse, group.k1 + i);
  store_d((load_d(group.z[2] + i) - z0) * inverse, group.k2 + i);
  // Within 128 pixels of the tile's first one; with LAPILLI_KEEP=triangles one may lie further from its bounds.
  const I near = broadcast(1 << 15);
  const U distance = as_u(px[0] - centre_x + near) | as_u(py[0] - centre_y + near);
  return lt(extents, broadcast(uint32_t{2 * TriangleGroup::kMostExtent})) & lt(distance, broadcast(1u << 16));
}

struct Sizes {
  M small, tiny;
};
HWY_INLINE Sizes set_up_bounds(TriangleGroup& group, uint32_t i, I tile_x, I tile_y, const PixelRect& tile) {
  U words[2];
  load_interleaved<2>(group.bounds[i], words);
  const auto low = broadcast(0xFFFFu);
  const I x0 = max(as_i(words[0] & low) - tile_x, broadcast(tile.x0));
  const I y0 = max(as_i(shift_right<16>(words[0])) - tile_y, broadcast(tile.y0));
  const I x1 = min(as_i(words[1] & low) - tile_x, broadcast(tile.x1));
  const I y1 = min(as_i(shift_right<16>(words[1])) - tile_y, broadcast(tile.y1));
  store(x0, group.x0 + i);
  store(y0, group.y0 + i);
  store(x1, group.x1 + i);
  store(y1, group.y1 + i);
  static_assert(kBlockSize == 8);
  const I one = broadcast(1);
  const I columns = shift_right<3>(x1 - one) - shift_right<3>(x0) + one;
  const I rows = shift_right<3>(y1 - one) - shift_right<3>(y0) + one;
  const I three = broadcast(3);
  return {lt(x0, x1) & lt(y0, y1) & le(columns * rows, broadcast(TriangleGroup::kMostBlocks)),
          lt(x1 - x0, three) & lt(y1 - y0, three)};
}

void set_up(TriangleGroup& group, uint32_t count, uint32_t tile_x, uint32_t tile_y, const PixelRect& tile) {
  const int32_t x = static_cast<int32_t>(tile_x), y = static_cast<int32_t>(tile_y);
  uint64_t small = 0, tiny = 0;
  for (uint32_t i = 0; i < count; i += kVectorLanes) {
    const M fits = set_up_edges(group, i, broadcast(256 * x + 128), broadcast(256 * y + 128));
    const Sizes sizes = set_up_bounds(group, i, broadcast(x), broadcast(y), tile);
    small |= bits_of(fits & sizes.small) << i;
    tiny |= bits_of(sizes.tiny) << i;
  }
  group.small = static_cast<uint32_t>(small);
  group.tiny = static_cast<uint32_t>(small & tiny);
}

// An edge function, or one of each lane's triangle, at pixels of the tile.
HWY_INLINE I edge_at(U steps, I c, U places) { return as_i(shift_left<8>(as_u(dot_of_halves(steps, places)))) + c; }

// A vector of triangles, one of their four pixels after the other.
void cover_tiny(TriangleGroup& group, uint32_t count, float min_depth, float max_depth) {
  const DepthPlane range = {0, 0, 0, min_depth, max_depth};
  for (uint32_t i = 0; i < count; i += kVectorLanes) {
    const I x0 = load<I>(group.x0 + i), y0 = load<I>(group.y0 + i);
    const I two = broadcast(2);
    const M one_column = lt(load<I>(group.x1 + i) - x0, two), one_row = lt(load<I>(group.y1 + i) - y0, two);
    const D z0 = load_d(group.z[0] + i), k1 = load_d(group.k1 + i), k2 = load_d(group.k2 + i);
    U covered = zero_u();
    for (uint32_t p = 0; p < 4; ++p) {
      const U place = (as_u(x0) | shift_left<16>(as_u(y0))) + broadcast(p % 2 | p / 2 << 16);
      I e[3];
      for (int k = 0; k < 3; ++k) {
        e[k] = edge_at(load<U>(group.steps[k] + i), load<I>(group.c[k] + i), place);
      }
      M outside = lt(e[0] | e[1] | e[2], zero_i());
      if (p % 2 != 0) outside = outside | one_column;
      if (p / 2 != 0) outside = outside | one_row;
      covered = covered | select(outside, zero_u(), broadcast(1u << p));
      const D exact1 = to_double(e[1] - load<I>(group.less[1] + i));
      const D exact2 = to_double(e[2] - load<I>(group.less[2] + i));
      const F z = clamp_depth(to_float((exact1 * k1 + exact2 * k2) + z0), range);
      store(canonical(z), group.tiny_depth[p] + i);
    }
    store(covered, group.tiny_covered + i);
  }
}

// From a block's first pixel, as 16-bit numbers: x in the low half.
struct BlockPlaces {
  alignas(64) uint32_t of[kLanes];
};
constexpr BlockPlaces kPlaces = [] {
  BlockPlaces places{};
  for (uint32_t bit = 0; bit < 64; ++bit) places.of[bit] = column_of_bit(bit) | row_of_bit(bit) << 16;
  return places;
}();

HWY_INLINE I edge_at(const TriangleGroup& group, uint32_t t, int e, U places) {
  return edge_at(broadcast(group.steps[e][t]), broadcast(group.c[e][t]), places);
}

// With few branches: which rows a small triangle reaches, and whether it is seen, nobody could predict.
template <int kCompare>
SmallDrawn draw(const TriangleGroup& group, uint32_t t, uint32_t x, uint32_t y, uint64_t pixels,
                const SmallTarget& target) {
  const U first = broadcast(x | y << 16);
  const DepthPlane plane = {target.z0, group.k1[t], group.k2[t], target.min_depth, target.max_depth};
  const int first_vector = __builtin_ctzll(pixels) / kVectorLanes;
  const int last_vector = (63 - __builtin_clzll(pixels)) / kVectorLanes;
  SmallDrawn drawn;
  for (int i = first_vector; i <= last_vector; ++i) {
    const int at = i * kVectorLanes;
    if (kVectorLanes < 16 && (pixels >> at & ((uint64_t{1} << kVectorLanes) - 1)) == 0) continue;
    const U places = load<U>(kPlaces.of + at) + first;
    const I e1 = edge_at(group, t, 1, places), e2 = edge_at(group, t, 2, places);
    const M outside = lt(edge_at(group, t, 0, places) | e1 | e2, zero_i());
    M passed = and_not(outside, mask_of(pixels, i));
    drawn.covered |= bits_of(passed) << at;
    if (target.depths != nullptr) {
      const D exact1 = to_double(e1 - broadcast(group.less[1][t]));
      const D exact2 = to_double(e2 - broadcast(group.less[2][t]));
      const F z = depth_at(exact1, exact2, plane);
      const F stored = load<F>(target.depths + at);
      passed = passed & compare_depth<kCompare>(z, stored);
      if (target.write_depth) store(select(passed, canonical(z), stored), target.depths + at);
    }
    drawn.passed |= bits_of(passed) << at;
    if (target.numbers == nullptr) continue;
    uint32_t* const numbers = target.numbers + at;
    store(select(passed, broadcast(target.number), load<U>(numbers)), numbers);
  }
  return drawn;
}

}  // namespace

extern const SmallTriangleFunctions kSmallTriangles;
const SmallTriangleFunctions kSmallTriangles = {
    set_up, cover_tiny, {draw<0>, draw<1>, draw<2>, draw<3>, draw<4>, draw<5>, draw<6>, draw<7>}};

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lapilli {

const SmallTriangleFunctions& small_triangle_functions() {
  static constexpr PerTarget<const SmallTriangleFunctions> kTables = LAPILLI_PER_TARGET(kSmallTriangles);
  return for_target(kTables);
}

}  // namespace lapilli
#endif
