// Set-ups of many triangles at a time: corners and attributes are brought together one by one, edges made with vectors.
#include "raster/lane_triangles.h"

#include <algorithm>
#include <bit>

#include "base/simd_dispatch.h"
#include "base/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/lane_triangles.cpp"
#include <hwy/foreach_target.h>

#include "base/lanes-inl.h"

#ifndef LAPILLI_RASTER_LANE_TRIANGLES_ONCE
#define LAPILLI_RASTER_LANE_TRIANGLES_ONCE
namespace lapilli {

// 24.8 fixed point, by vertex and triangle.
struct LaneCorners {
  alignas(64) int32_t x[3][kBatchLanes], y[3][kBatchLanes];
};

}  // namespace lapilli
#endif

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {

// As make_edge_function and make_triangle_setup have it; every value but the last is an exact integer, and no zero is
// negative.
void make_lane_edges(const LaneCorners& corners, uint32_t count, int32_t x, int32_t y, LaneTriangles& out) {
  const I centre_x = broadcast(256 * x + 128), centre_y = broadcast(256 * y + 128);
  for (uint32_t i = 0; i < count; i += kVectorLanes) {
    const I px[3] = {load<I>(corners.x[0] + i), load<I>(corners.x[1] + i), load<I>(corners.x[2] + i)};
    const I py[3] = {load<I>(corners.y[0] + i), load<I>(corners.y[1] + i), load<I>(corners.y[2] + i)};
    D dx[2], dy[2];
    for (int e = 0; e < 2; ++e) {
      const int from = e == 0 ? 2 : 0, to = e == 0 ? 0 : 1;
      dx[e] = to_double(px[to] - px[from]);
      dy[e] = to_double(py[to] - py[from]);
      const D at_centre = dx[e] * to_double(centre_y - py[from]) - dy[e] * to_double(centre_x - px[from]);
      store_d(dy[e] * broadcast(-256.0), out.edge_a[e] + i);
      store_d(dx[e] * broadcast(256.0), out.edge_b[e] + i);
      store_d(at_centre + broadcast(0.0), out.edge_c[e] + i);
    }
    store_d(broadcast(1.0) / (dx[0] * dy[1] - dx[1] * dy[0]), out.inverse_area2 + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lapilli {
namespace {

// Puts a triangle's corners and what does not depend on its edges to place `at`.
void take_triangle(const TileTriangle& seen, uint32_t at, std::span<const Interpolation> modes, LaneCorners& corners,
                   LaneTriangles& out) {
  const float* values[3];
  for (size_t v = 0; v < 3; ++v) {
    corners.x[v][at] = seen.x[v];
    corners.y[v][at] = seen.y[v];
    out.inverse_w[v][at] = seen.inverse_w[v];
    values[v] = seen.chunk->varyings.data() + seen.varyings[v];
  }
  out.front_facing[at] = seen.front_facing;
  for (size_t k = 0; k < modes.size(); ++k) {
    const float a0 = values[0][k];
    const bool flat = modes[k] == Interpolation::flat;
    out.varyings[k][0][at] = a0;
    out.varyings[k][1][at] = flat ? 0 : values[1][k] - a0;
    out.varyings[k][2][at] = flat ? 0 : values[2][k] - a0;
  }
}

}  // namespace

void set_up_lanes(const Visibility& visibility, const uint32_t* numbers, uint64_t pixels, uint32_t x, uint32_t y,
                  std::span<const Interpolation> modes, LaneTriangles& out) {
  const LaneNumberFunctions& functions = lane_number_functions();
  LaneCorners corners = {};
  // A triangle once, while there are few.
  uint32_t count = 0;
  std::fill_n(out.slot, kBatchLanes, 0u);
  uint64_t rest = pixels;
  for (; rest != 0 && count < LaneTriangles::kMostShared; ++count) {
    const uint32_t number = numbers[std::countr_zero(rest)];
    const uint64_t its = functions.equal(numbers, number) & rest;
    functions.fill_lanes(out.slot, its, count);
    take_triangle(visibility.triangle(number), count, modes, corners, out);
    rest &= ~its;
  }
  out.by_lane = rest != 0;
  if (out.by_lane) {
    count = kBatchLanes;
    for_each_bit(pixels,
                 [&](uint32_t lane) { take_triangle(visibility.triangle(numbers[lane]), lane, modes, corners, out); });
  }
  using MakeLaneEdges = void(const LaneCorners&, uint32_t, int32_t, int32_t, LaneTriangles&);
  static constexpr PerTarget<MakeLaneEdges> kTable = LAPILLI_PER_TARGET(make_lane_edges);
  for_target(kTable)(corners, count, static_cast<int32_t>(x), static_cast<int32_t>(y), out);
}

}  // namespace lapilli
#endif
