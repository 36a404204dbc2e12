// Facing, culling and bounds of many triangles at a time, compiled once per SIMD target.
#include "base/simd_targets.h"
#include "geometry/setup.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/setup_lanes.cpp"
#include <hwy/foreach_target.h>
//
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstring>

#include "base/lanes-inl.h"
#include "base/simd_dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {
namespace {

struct Point {
  I x, y;
};

HWY_INLINE Point gather_point(const BinVertex* vertices, U slot) {
  const U offset = shift_left<4>(slot) + shift_left<3>(slot);
  static_assert(sizeof(BinVertex) == 24);
  return {as_i(gather32(vertices, offset + broadcast(uint32_t{offsetof(BinVertex, x)}), all_lanes())),
          as_i(gather32(vertices, offset + broadcast(uint32_t{offsetof(BinVertex, y)}), all_lanes()))};
}

HWY_INLINE Point select(M m, Point yes, Point no) { return {select(m, yes.x, no.x), select(m, yes.y, no.y)}; }
HWY_INLINE M no_lanes_unless(bool condition) { return condition ? all_lanes() : no_lanes(); }
HWY_INLINE I ones_where(M m) { return as_i(mask_to_u(m)); }

// Pixels [x0, x1) x [y0, y1).
struct Bounds {
  I x0, y0, x1, y1;
};

// Triangles of at most this many 24.8 units a side have edge functions that fit 32 bits.
constexpr int32_t kSmallExtent = 1 << 13;

// Sign bits of the edge function from -> to at the four pixel centres from (x, y) on, right and down: set outside, with
// the top-left rule. All in 24.8; a small triangle, clockwise on the screen (y down).
struct Outside {
  I at00, at10, at01, at11;
};
HWY_INLINE void add_edge(Point from, Point to, Point centre, Outside& outside) {
  const I dx = to.x - from.x;
  const I dy = to.y - from.y;
  const M owns = lt(dy, zero_i()) | (eq(dy, zero_i()) & gt(dx, zero_i()));
  const I at00 = dx * (centre.y - from.y) - dy * (centre.x - from.x) + select(owns, zero_i(), broadcast(-1));
  const I step_x = as_i(shift_left<8>(as_u(dy)));  // to be subtracted
  const I step_y = as_i(shift_left<8>(as_u(dx)));
  outside.at00 = outside.at00 | at00;
  outside.at10 = outside.at10 | (at00 - step_x);
  outside.at01 = outside.at01 | (at00 + step_y);
  outside.at11 = outside.at11 | (at00 + step_y - step_x);
}

// Of small triangles with bounds of at most 2x2 pixels: those that cover none of them.
HWY_INLINE M covers_nothing(Point p, Point q, Point r, const Bounds& bounds) {
  const I half = broadcast(128);
  const Point centre = {as_i(shift_left<8>(as_u(bounds.x0))) + half, as_i(shift_left<8>(as_u(bounds.y0))) + half};
  Outside outside = {zero_i(), zero_i(), zero_i(), zero_i()};
  add_edge(q, r, centre, outside);
  add_edge(r, p, centre, outside);
  add_edge(p, q, centre, outside);
  const I one_column = ones_where(lt(bounds.x1 - bounds.x0, broadcast(2)));
  const I one_row = ones_where(lt(bounds.y1 - bounds.y0, broadcast(2)));
  const I everywhere =
      outside.at00 & (outside.at10 | one_column) & (outside.at01 | one_row) & (outside.at11 | one_column | one_row);
  return lt(everywhere, zero_i());
}

// What became of kVectorLanes triangles. Bits are lanes.
struct Triangles {
  uint32_t kept;     // as they are in `words`
  uint32_t unclear;  // have a vertex that is not inside
  alignas(64) BinTriangle words[kVectorLanes];
};

HWY_INLINE void set_up(const SetupState& state, const TriangleList& list, uint32_t first, bool keep_all,
                       const BinChunk& chunk, Triangles& out) {
  U slot[3];
  load_interleaved<3>(list.corners + 3 * size_t{first}, slot);
  const BinVertex* const vertices = chunk.vertices.data() + list.first_vertex;
  const Point p = gather_point(vertices, slot[0]);
  const Point v1 = gather_point(vertices, slot[1]);
  const Point v2 = gather_point(vertices, slot[2]);
  const I none = broadcast(kNotInside);
  const M unclear = eq(p.x, none) | eq(v1.x, none) | eq(v2.x, none);

  // Twice the area is exact in double, and keeps its sign as a float.
  const F area =
      to_float(to_double(v1.x - p.x) * to_double(v2.y - p.y) - to_double(v2.x - p.x) * to_double(v1.y - p.y));
  const M clockwise = gt(area, zero_f());
  const M turn = lt(area, zero_f());
  M kept = (clockwise & no_lanes_unless(state.keep_clockwise)) | (turn & no_lanes_unless(state.keep_counterclockwise));
  kept = and_not(unclear, kept);

  const I min_x = min(min(p.x, v1.x), v2.x), max_x = max(max(p.x, v1.x), v2.x);
  const I min_y = min(min(p.y, v1.y), v2.y), max_y = max(max(p.y, v1.y), v2.y);
  const PixelRect& rect = state.rect;
  // Pixels whose centres may lie in the triangle: ceil(min - 0.5) .. floor(max - 0.5).
  Bounds bounds = {max(shift_right<8>(min_x + broadcast(127)), broadcast(rect.x0)),
                   max(shift_right<8>(min_y + broadcast(127)), broadcast(rect.y0)),
                   min(shift_right<8>(max_x + broadcast(128)), broadcast(rect.x1)),
                   min(shift_right<8>(max_y + broadcast(128)), broadcast(rect.y1))};
  const Point q = select(turn, v2, v1);
  const Point r = select(turn, v1, v2);
  if (keep_all) {
    bounds.x0 = min(bounds.x0, broadcast(rect.x1 - 1));
    bounds.y0 = min(bounds.y0, broadcast(rect.y1 - 1));
    bounds.x1 = max(bounds.x1, bounds.x0 + broadcast(1));
    bounds.y1 = max(bounds.y1, bounds.y0 + broadcast(1));
  } else {
    kept = kept & lt(bounds.x0, bounds.x1) & lt(bounds.y0, bounds.y1);
    const I limit = broadcast(kSmallExtent);
    const M small = kept & lt(max_x - min_x, limit) & lt(max_y - min_y, limit) &
                    le(bounds.x1 - bounds.x0, broadcast(2)) & le(bounds.y1 - bounds.y0, broadcast(2));
    if (any(small)) kept = and_not(small & covers_nothing(p, q, r, bounds), kept);
  }

  const uint32_t lanes =
      list.count - first >= kVectorLanes ? (1u << kVectorLanes) - 1 : (1u << (list.count - first)) - 1;
  out.kept = static_cast<uint32_t>(bits_of(kept)) & lanes;
  out.unclear = static_cast<uint32_t>(bits_of(unclear)) & lanes;
  const U base = broadcast(list.first_vertex);
  const M front = state.front_is_clockwise ? clockwise : ~clockwise;
  const U run =
      load_unaligned<U>(list.runs + first) | (mask_to_u(front) & broadcast(uint32_t{BinTriangle::kFrontFacing}));
  const U words[4] = {(slot[0] + base) | shift_left<16>(select(turn, slot[2], slot[1]) + base),
                      (select(turn, slot[1], slot[2]) + base) | shift_left<16>(run),
                      as_u(bounds.x0) | shift_left<16>(as_u(bounds.y0)),
                      as_u(bounds.x1) | shift_left<16>(as_u(bounds.y1))};
  static_assert(sizeof(BinTriangle) == 16 && offsetof(BinTriangle, run) == 6 && offsetof(BinTriangle, x1) == 12);
  store_interleaved<4>(words, out.words);
}

}  // namespace

void triangle_lanes(const SetupState& state, const TriangleList& list, BinChunk& chunk) {
  static_assert(TriangleList::kPadding >= kVectorLanes);
  const bool keep_all = keeps(Removal::triangles);
  Triangles triangles;
  for (uint32_t first = 0; first < list.count; first += kVectorLanes) {
    set_up(state, list, first, keep_all, chunk, triangles);
    const size_t before = chunk.triangles.size();
    chunk.triangles.reserve(before + kVectorLanes);
    if (triangles.unclear == 0) {
      // Every one is copied; what is left out is overwritten by the next.
      BinTriangle* out = chunk.triangles.data() + before;
      for (int lane = 0; lane < kVectorLanes; ++lane) {
        std::memcpy(static_cast<void*>(out), &triangles.words[lane], sizeof(BinTriangle));
        out += triangles.kept >> lane & 1;
      }
      chunk.triangles.resize(static_cast<size_t>(out - chunk.triangles.data()));
    }
    for (uint32_t left = triangles.unclear == 0 ? 0 : triangles.kept | triangles.unclear; left != 0; left &= left - 1) {
      const uint32_t lane = static_cast<uint32_t>(std::countr_zero(left));
      const size_t size = chunk.triangles.size();
      if ((triangles.kept >> lane & 1) != 0) {
        chunk.triangles.push_back(triangles.words[lane]);
      } else {
        clip_and_append(state, list, first + lane, chunk);
      }
      if (chunk.triangles.size() > size) triangles.kept |= 1u << lane;
    }
    if (list.removed == nullptr) continue;
    const uint32_t lanes = std::min<uint32_t>(kVectorLanes, list.count - first);
    for (uint32_t lane = 0; lane < lanes; ++lane) list.removed[list.runs[first + lane]] += ~triangles.kept >> lane & 1;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lapilli {

void append_triangles(const SetupState& state, const TriangleList& list, BinChunk& chunk) {
  using SetUp = void(const SetupState&, const TriangleList&, BinChunk&);
  static constexpr PerTarget<SetUp> kTable = LAPILLI_PER_TARGET(triangle_lanes);
  if (list.count == 0 || chunk.vertices.empty()) return;
  if (!state.rect.empty()) return for_target(kTable)(state, list, chunk);
  for (uint32_t i = 0; list.removed != nullptr && i < list.count; ++i) ++list.removed[list.runs[i]];
}

}  // namespace lapilli
#endif
