// Edge functions and depth of one triangle over the lanes of a block. Per-target header.
// E is an exact integer in double wherever it is evaluated, so that any order of adding its parts gives the same bits.
#if defined(LAPILLI_SHADER_PLANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LAPILLI_SHADER_PLANES_INL_H
#undef LAPILLI_SHADER_PLANES_INL_H
#else
#define LAPILLI_SHADER_PLANES_INL_H
#endif

#include "base/lanes_gather-inl.h"
#include "shader/batch.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {

// Pixels from a quad's first lane, for up to four quads in a row of a block.
alignas(64) inline constexpr double kLaneX[16] = {0, 1, 0, 1, 2, 3, 2, 3, 4, 5, 4, 5, 6, 7, 6, 7};
alignas(64) inline constexpr double kLaneY[16] = {0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1};
static_assert(kVectorLanes <= 16, "a vector lies in one row of a block's quads");

// An edge function over a block, one vector after the other.
class BlockEdge {
 public:
  HWY_INLINE BlockEdge(double edge_a, double edge_b, double edge_c, uint32_t x, uint32_t y)
      : row_step_(broadcast(2 * edge_b)), a_(edge_a) {
    const double at_origin = edge_a * x + edge_b * y + edge_c;
    row_ = broadcast(at_origin) + (broadcast(edge_a) * load_d(kLaneX) + broadcast(edge_b) * load_d(kLaneY));
  }
  HWY_INLINE D next() {
    constexpr int kVectorsPerRow = 16 / kVectorLanes;
    constexpr int kColumns = kVectorLanes / 2;  // of a vector, which has two rows
    const D here = column_ == 0 ? row_ : row_ + broadcast(a_ * (column_ * kColumns));
    column_ = (column_ + 1) % kVectorsPerRow;
    if (column_ == 0) row_ = row_ + row_step_;
    return here;
  }

 private:
  D row_, row_step_;
  double a_;
  int column_ = 0;
};

// What the triangles of lanes i … have in one of LaneTriangles' arrays.
HWY_INLINE F of_lanes(const LaneTriangles& triangles, const float* table, int i) {
  return triangles.by_lane ? load<F>(table + i) : lookup16(table, load<U>(triangles.slot + i));
}
HWY_INLINE D of_lanes(const LaneTriangles& triangles, const double* table, int i) {
  return triangles.by_lane ? load_d(table + i) : lookup16(table, load<U>(triangles.slot + i));
}

// Its clamp, as frag_depth has it: a NaN stays one.
HWY_API F clamp_depth(F z, const DepthPlane& plane) { return min(max(z, broadcast(plane.min)), broadcast(plane.max)); }
HWY_API F depth_at(D e1, D e2, const DepthPlane& plane) {
  const D z = (e1 * broadcast(plane.k1) + e2 * broadcast(plane.k2)) + broadcast(plane.z0);
  return clamp_depth(to_float(z), plane);
}

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#endif  // per target
