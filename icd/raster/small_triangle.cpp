// Coverage, depth test and visibility of a small triangle in a block, for every SIMD target.
#include "raster/small_triangle.h"

#include <cstdlib>

#include "base/simd_dispatch.h"
#include "base/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/small_triangle.cpp"
#include <hwy/foreach_target.h>

#include "shader/interpreter/planes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {
namespace {

// Pixels from a block's first one as 16-bit numbers, x in the low half.
alignas(64) constexpr uint32_t kLanePlaces[16] = {0, 1, 1 << 16,       (1 << 16) + 1,  //
                                                  2, 3, (1 << 16) + 2, (1 << 16) + 3,  //
                                                  4, 5, (1 << 16) + 4, (1 << 16) + 5,  //
                                                  6, 7, (1 << 16) + 6, (1 << 16) + 7};

// An edge function over a block, 1 less where a centre on the edge is outside.
struct SmallEdge {
  I first;
  int32_t a, b;

  HWY_INLINE SmallEdge(const SmallTriangle& t, int e, int32_t x, int32_t y) : a(-256 * t.dy[e]), b(256 * t.dx[e]) {
    const uint32_t steps = static_cast<uint16_t>(-t.dy[e]) | static_cast<uint32_t>(t.dx[e]) << 16;
    const U from_first = shift_left<8>(as_u(dot_of_halves(broadcast(steps), load<U>(kLanePlaces))));
    first = as_i(from_first) + broadcast(t.c[e] + t.bias[e] + a * x + b * y);
  }
  HWY_INLINE I vector(int i) const {
    constexpr int kPerRow = 16 / kVectorLanes;
    return first + broadcast(a * (i % kPerRow * (kVectorLanes / 2)) + b * (i / kPerRow * 2));
  }
};

template <int kCompare>
SmallDrawn draw(const SmallTriangle& t, int32_t x, int32_t y, uint64_t pixels, const SmallTarget& target) {
  const SmallEdge edge0(t, 0, x, y), edge1(t, 1, x, y), edge2(t, 2, x, y);
  const I bias1 = broadcast(t.bias[1]), bias2 = broadcast(t.bias[2]);
  SmallDrawn drawn;
  for (int i = 0; i < kVectorsPerBatch; ++i) {
    const int at = i * kVectorLanes;
    const uint64_t bits = pixels >> at & ((uint64_t{1} << kVectorLanes) - 1);
    if (bits == 0) continue;
    const I e1 = edge1.vector(i), e2 = edge2.vector(i);
    const uint64_t covered = bits & ~bits_of(lt(edge0.vector(i) | e1 | e2, zero_i()));
    if (covered == 0) continue;
    drawn.covered |= covered << at;
    uint64_t passed = covered;
    if (target.depths != nullptr) {
      const F z = depth_at(to_double(e1 - bias1), to_double(e2 - bias2), t.depth);
      const F stored = load<F>(target.depths + at);
      passed &= bits_of(compare_depth<kCompare>(z, stored));
      if (passed == 0) continue;
      if (target.write_depth) store(select(mask_of(passed, 0), canonical(z), stored), target.depths + at);
    }
    drawn.passed |= passed << at;
    if (target.numbers == nullptr) continue;
    uint32_t* const numbers = target.numbers + at;
    store(select(mask_of(passed, 0), broadcast(target.number), load<U>(numbers)), numbers);
  }
  return drawn;
}

}  // namespace

extern const SmallTriangleFunctions kSmallTriangles;
const SmallTriangleFunctions kSmallTriangles = {
    {draw<0>, draw<1>, draw<2>, draw<3>, draw<4>, draw<5>, draw<6>, draw<7>}};

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lapilli {

bool make_small_triangle(const BinChunk& chunk, const BinTriangle& triangle, uint32_t tile_x, uint32_t tile_y,
                         SmallTriangle& out) {
  const BinVertex& p = chunk.vertices[triangle.v[0]];
  const BinVertex& q = chunk.vertices[triangle.v[1]];
  const BinVertex& r = chunk.vertices[triangle.v[2]];
  const int32_t centre_x = static_cast<int32_t>(tile_x) * 256 + 128;
  const int32_t centre_y = static_cast<int32_t>(tile_y) * 256 + 128;
  constexpr int32_t kNear =
      1 << 15;  // 128 pixels; only with LAPILLI_KEEP=triangles one may lie further from its bounds
  if (std::abs(p.x - centre_x) > kNear || std::abs(p.y - centre_y) > kNear) return false;
  const auto extent = [](int32_t d) { return static_cast<uint32_t>(d + SmallTriangle::kMostExtent); };
  const uint32_t extents = extent(q.x - p.x) | extent(q.y - p.y) | extent(r.x - p.x) | extent(r.y - p.y) |
                           extent(r.x - q.x) | extent(r.y - q.y);
  if (extents >= 2 * SmallTriangle::kMostExtent) return false;
  const auto set_edge = [&](int e, const BinVertex& from, const BinVertex& to) {
    const int32_t dx = to.x - from.x, dy = to.y - from.y;
    out.dx[e] = dx;
    out.dy[e] = dy;
    out.c[e] = dx * (centre_y - from.y) - dy * (centre_x - from.x);
    out.bias[e] = dy < 0 || (dy == 0 && dx > 0) ? 0 : -1;
  };
  set_edge(0, q, r);
  set_edge(1, r, p);
  set_edge(2, p, q);
  const BinRun& run = chunk.run_of(triangle);
  const double inverse = 1.0 / (out.c[0] + out.c[1] + out.c[2]);
  out.depth = {p.z, (q.z - p.z) * inverse, (r.z - p.z) * inverse, run.min_depth, run.max_depth};
  if (run.depth_bias) out.depth = make_depth_plane(chunk, triangle, make_edge_functions(chunk, triangle));
  return true;
}

const SmallTriangleFunctions& small_triangle_functions() {
  static constexpr PerTarget<const SmallTriangleFunctions> kTables = LAPILLI_PER_TARGET(kSmallTriangles);
  return for_target(kTables);
}

}  // namespace lapilli
#endif
