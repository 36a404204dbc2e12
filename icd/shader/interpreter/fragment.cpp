// Ops: interpolation, depth test, and the colours of the tile.
// Specification: "Basic Polygon Rasterization" (barycentric coordinates), "Depth Test".
#include <cstring>

#include "base/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shader/interpreter/fragment.cpp"
#include <hwy/foreach_target.h>

#include "image/compare-inl.h"
#include "image/texel.h"
#include "shader/interpreter/handlers.h"
#include "shader/interpreter/machine-inl.h"
#include "shader/interpreter/perspective-inl.h"
#include "shader/interpreter/planes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {
namespace {

// The four lanes of a quad. By reference: a vector of 256 bits is no argument or result of functions on all targets.
typedef double QuadD __attribute__((vector_size(32)));
typedef float QuadF __attribute__((vector_size(16)));

HWY_INLINE void store_floats(const QuadF& floats, float* lanes) { std::memcpy(lanes, &floats, sizeof floats); }

HWY_INLINE bool is_block_of_one(const FragmentBatch& batch) { return batch.one_triangle && batch.whole_block; }

// Calls a Body with E_1 and E_2 of all lanes: lanes(e1, e2, triangle, to) for vectors of one triangle's block,
// quad(e1, e2, triangle, to) for one quad. The edge functions are exact, however their parts are added.
template <class Body>
struct FromEdges {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    of_batch(*frame->fragments, reinterpret_cast<float*>(reg(frame, op->dst)));
    return op + 1;
  }
  static HWY_INLINE void of_batch(const FragmentBatch& batch, float* d) {
    if (is_block_of_one(batch)) return block(*batch.triangle[0], batch.x[0], batch.y[0], d);
    for (int i = 0; i < kLanes / 4; ++i) {
      const TriangleSetup& t = *batch.triangle[i];
      const double x0 = batch.x[i], y0 = batch.y[i];
      const QuadD x = QuadD{0, 1, 0, 1} + x0;
      const QuadD y = QuadD{0, 0, 1, 1} + y0;
      const QuadD e1 = x * t.edge_a[1] + (y * t.edge_b[1] + t.edge_c[1]);
      const QuadD e2 = x * t.edge_a[2] + (y * t.edge_b[2] + t.edge_c[2]);
      Body::quad(e1, e2, t, d + 4 * i);
    }
  }
  static HWY_INLINE void block(const TriangleSetup& t, uint32_t x, uint32_t y, float* d) {
    BlockEdge edge1(t.edge_a[1], t.edge_b[1], t.edge_c[1], x, y);
    BlockEdge edge2(t.edge_a[2], t.edge_b[2], t.edge_c[2], x, y);
    for (int i = 0; i < kVectorsPerBatch; ++i) Body::lanes(edge1.next(), edge2.next(), t, d + i * kVectorLanes);
  }
};

// λ1 and λ2, rounded once.
struct Linear {
  static HWY_INLINE void lanes(D e1, D e2, const TriangleSetup& t, float* d) {
    const D inverse_area2 = broadcast(t.inverse_area2);
    store(to_float(e1 * inverse_area2), d);
    store(to_float(e2 * inverse_area2), d + kLanes);
  }
  static HWY_INLINE void quad(const QuadD& e1, const QuadD& e2, const TriangleSetup& t, float* d) {
    store_floats(__builtin_convertvector(e1 * t.inverse_area2, QuadF), d);
    store_floats(__builtin_convertvector(e2 * t.inverse_area2, QuadF), d + kLanes);
  }
};
struct op_frag_linear {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    of_batch(*frame->fragments, reinterpret_cast<float*>(reg(frame, op->dst)));
    return op + 1;
  }
  static HWY_INLINE void of_batch(const FragmentBatch& batch, float* d) {
    if (batch.lane_triangles == nullptr) return FromEdges<Linear>::of_batch(batch, d);
    const LaneTriangles& triangles = *batch.lane_triangles;
    for (int i = 0; i < kVectorsPerBatch; ++i) {
      constexpr int kPerRow = 16 / kVectorLanes;
      const D x = load_d(kLaneX) + broadcast(static_cast<double>(i % kPerRow * (kVectorLanes / 2)));
      const D y = load_d(kLaneY) + broadcast(static_cast<double>(i / kPerRow * 2));
      const int lane = i * kVectorLanes;
      const D inverse_area2 = of_lanes(triangles, triangles.inverse_area2, lane);
      for (int e = 0; e < 2; ++e) {
        const D edge =
            x * of_lanes(triangles, triangles.edge_a[e], lane) +
            (y * of_lanes(triangles, triangles.edge_b[e], lane) + of_lanes(triangles, triangles.edge_c[e], lane));
        store(to_float(edge * inverse_area2), d + e * kLanes + lane);
      }
    }
  }
};

// The same at other places; lane by lane, for it is rare.
struct op_frag_linear_at {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const FragmentBatch& batch = *frame->fragments;
    const float* const right = reinterpret_cast<const float*>(reg(frame, op->a));
    const float* const down = reinterpret_cast<const float*>(reg(frame, op->b));
    float* const d = reinterpret_cast<float*>(reg(frame, op->dst));
    for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
      const double dx = static_cast<double>(right[lane]), dy = static_cast<double>(down[lane]);
      for (uint32_t e = 0; e < 2; ++e) {
        float& lambda = d[e * kLanes + lane];
        if (const LaneTriangles* const by_lane = batch.lane_triangles) {
          const uint32_t t = by_lane->by_lane ? lane : by_lane->slot[lane];
          const double x = kLaneX[lane % 16], y = lane / 16 * 2 + kLaneY[lane % 16];  // in the block
          const double a = by_lane->edge_a[e][t], b = by_lane->edge_b[e][t];
          lambda = at(a, b, x * a + (y * b + by_lane->edge_c[e][t]), dx, dy, by_lane->inverse_area2[t]);
        } else {
          const TriangleSetup& t = *batch.triangle[lane / 4];
          const double x = batch.x[lane / 4] + kLaneX[lane % 4], y = batch.y[lane / 4] + kLaneY[lane % 4];
          const double a = t.edge_a[e + 1], b = t.edge_b[e + 1];
          lambda = at(a, b, x * a + (y * b + t.edge_c[e + 1]), dx, dy, t.inverse_area2);
        }
      }
    }
    return op + 1;
  }
  static float at(double a, double b, double edge, double dx, double dy, double inverse_area2) {
    return static_cast<float>((edge + (a * dx + b * dy)) * inverse_area2);
  }
};

struct Depth {
  static HWY_INLINE void lanes(D e1, D e2, const TriangleSetup& t, float* d) { store(depth_at(e1, e2, t.depth), d); }
  static HWY_INLINE void quad(const QuadD& e1, const QuadD& e2, const TriangleSetup& t, float* d) {
    const DepthPlane& plane = t.depth;
    QuadF depth = __builtin_convertvector((e1 * plane.k1 + e2 * plane.k2) + plane.z0, QuadF);
    const QuadF low = QuadF{} + plane.min;
    const QuadF high = QuadF{} + plane.max;
    depth = depth < low ? low : depth;
    depth = depth > high ? high : depth;
    store_floats(depth, d);
  }
};
using op_frag_depth = FromEdges<Depth>;

// Quads of one vector, whose numbers come from many triangles.
constexpr int kQuadsPerVector = kVectorLanes / 4;

HWY_INLINE InverseW inverse_w_of(const TriangleSetup& t) {
  return {broadcast(t.inverse_w[0]), broadcast(t.inverse_w[1]), broadcast(t.inverse_w[2])};
}
// Of the lanes from `lane` on.
HWY_INLINE InverseW inverse_w_of(const FragmentBatch& batch, int lane) {
  if (batch.one_triangle) return inverse_w_of(*batch.triangle[0]);
  if (const LaneTriangles* const t = batch.lane_triangles) {
    return {of_lanes(*t, t->inverse_w[0], lane), of_lanes(*t, t->inverse_w[1], lane),
            of_lanes(*t, t->inverse_w[2], lane)};
  }
  const float* w[kQuadsPerVector];
  for (int quad = 0; quad < kQuadsPerVector; ++quad) w[quad] = batch.triangle[lane / 4 + quad]->inverse_w;
  return {spread_to_quads(w, 0), spread_to_quads(w, 1), spread_to_quads(w, 2)};
}
// Drawn without perspective, and covering the whole batch.
HWY_INLINE bool is_affine(const TriangleSetup& t, uint64_t covered) {
  return covered == ~uint64_t{0} && t.inverse_w[0] == 1 && t.inverse_w[1] == 1 && t.inverse_w[2] == 1;
}

struct op_frag_perspective {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const uint32_t* const a = reg_u(frame, op->a);
    const uint32_t* const b = reg_u(frame, op->b);
    uint32_t* const d = reg_out(frame, op->dst);
    for (int i = 0; i < kLanes; i += kVectorLanes) {
      const Corrected at = correct_perspective(load<F>(a + i), load<F>(b + i), inverse_w_of(*frame->fragments, i));
      store(at.l1, d + i);
      store(at.l2, d + kLanes + i);
      store(at.inverse_w, d + 2 * kLanes + i);
    }
    return op + 1;
  }
};

// Varyings of one vector of lanes, from the coordinates there. `plane`: the first of one triangle's.
HWY_INLINE void interpolate_one(const float* plane, uint32_t count, F l1, F l2, uint32_t* d) {
  for (; count > 0; --count, plane += 3, d += kLanes) {
    store(fma(l2, broadcast(plane[2]), fma(l1, broadcast(plane[1]), broadcast(plane[0]))), d);
  }
}
HWY_INLINE void interpolate_lanes(const FragmentBatch& batch, int lane, const Op* op, F l1, F l2, uint32_t* d) {
  if (batch.one_triangle) return interpolate_one(batch.triangle[0]->varyings + 3 * op->imm, op->c, l1, l2, d);
  if (const LaneTriangles* const t = batch.lane_triangles) {
    for (uint32_t k = op->imm; k < op->imm + op->c; ++k, d += kLanes) {
      const F sum = fma(l1, of_lanes(*t, t->varyings[k][1], lane), of_lanes(*t, t->varyings[k][0], lane));
      store(fma(l2, of_lanes(*t, t->varyings[k][2], lane), sum), d);
    }
    return;
  }
  const float* planes[kQuadsPerVector];
  for (int quad = 0; quad < kQuadsPerVector; ++quad)
    planes[quad] = batch.triangle[lane / 4 + quad]->varyings + 3 * op->imm;
  for (uint32_t k = 0; k < 3u * op->c; k += 3, d += kLanes) {
    const F sum = fma(l1, spread_to_quads(planes, k + 1), spread_to_quads(planes, k));
    store(fma(l2, spread_to_quads(planes, k + 2), sum), d);
  }
}

struct op_interpolate {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const uint32_t* const a = reg_u(frame, op->a);
    const uint32_t* const b = reg_u(frame, op->b);
    uint32_t* const d = reg_out(frame, op->dst);
    for (int i = 0; i < kLanes; i += kVectorLanes) {
      interpolate_lanes(*frame->fragments, i, op, load<F>(a + i), load<F>(b + i), d + i);
    }
    return op + 1;
  }
};

// frag_linear, frag_perspective and interpolate in one; in a block of one triangle nothing between them is in memory.
struct op_interpolate_perspective {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const FragmentBatch& batch = *frame->fragments;
    uint32_t* const d = reg_out(frame, op->dst);
    if (is_block_of_one(batch)) {
      const TriangleSetup& t = *batch.triangle[0];
      if (t.coordinates != nullptr) return kept_block(t, batch, op, frame, d);
      const Varyings varyings = {t.varyings + 3 * op->imm, op->c, d};
      of_block(t, batch, frame, varyings);
      return op + 1;
    }
    alignas(64) float linear[2 * kLanes];
    op_frag_linear::of_batch(batch, linear);
    for (int i = 0; i < kLanes; i += kVectorLanes) {
      const Corrected at =
          correct_perspective(load<F>(linear + i), load<F>(linear + kLanes + i), inverse_w_of(batch, i));
      interpolate_lanes(batch, i, op, at.l1, at.l2, d + i);
    }
    return op + 1;
  }

 private:
  // What is done with the coordinates at lanes i …
  struct Varyings {
    const float* plane;
    uint32_t count;
    uint32_t* d;
    HWY_INLINE void operator()(int i, const Corrected& at) const { interpolate_one(plane, count, at.l1, at.l2, d + i); }
  };
  struct Keep {
    float (*lambda)[kBatchLanes];
    HWY_INLINE void operator()(int i, const Corrected& at) const {
      store(at.l1, lambda[0] + i);
      store(at.l2, lambda[1] + i);
    }
  };

  template <class Then>
  static HWY_INLINE void of_block(const TriangleSetup& t, const FragmentBatch& batch, Frame* frame, const Then& then) {
    is_affine(t, frame->lanes) ? block<true>(t, batch, then) : block<false>(t, batch, then);
  }
  template <bool kAffine, class Then>
  static HWY_INLINE void block(const TriangleSetup& t, const FragmentBatch& batch, const Then& then) {
    BlockEdge edge1(t.edge_a[1], t.edge_b[1], t.edge_c[1], batch.x[0], batch.y[0]);
    BlockEdge edge2(t.edge_a[2], t.edge_b[2], t.edge_c[2], batch.x[0], batch.y[0]);
    const D inverse_area2 = broadcast(t.inverse_area2);
    const InverseW w = inverse_w_of(t);
    for (int i = 0; i < kLanes; i += kVectorLanes) {
      const F l1 = to_float(edge1.next() * inverse_area2);
      const F l2 = to_float(edge2.next() * inverse_area2);
      then(i, kAffine ? correct_affine(l1, l2) : correct_perspective(l1, l2, w));
    }
  }
  // Of a triangle that lies where others do.
  static HWY_INLINE const Op* kept_block(const TriangleSetup& t, const FragmentBatch& batch, const Op* op, Frame* frame,
                                         uint32_t* d) {
    const uint32_t number = batch.quad_in_tile[0] / kBatchQuads;
    float(*const lambda)[kBatchLanes] = t.coordinates->lambda[number];
    if ((t.coordinates->known >> number & 1) == 0) {
      of_block(t, batch, frame, Keep{lambda});
      t.coordinates->known |= uint64_t{1} << number;
    }
    const float* plane = t.varyings + 3 * op->imm;
    for (uint32_t k = 0; k < op->c; ++k, plane += 3, d += kLanes) {
      const F a0 = broadcast(plane[0]), d1 = broadcast(plane[1]), d2 = broadcast(plane[2]);
      for (int i = 0; i < kLanes; i += kVectorLanes)
        store(fma(load<F>(lambda[1] + i), d2, fma(load<F>(lambda[0] + i), d1, a0)), d + i);
    }
    return op + 1;
  }
};

struct op_interpolate_flat {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const FragmentBatch& batch = *frame->fragments;
    float* const d = reinterpret_cast<float*>(reg(frame, op->dst));
    for (int i = 0; i < kLanes; i += kVectorLanes) {
      if (const LaneTriangles* const t = batch.lane_triangles) {
        for (uint32_t k = 0; k < op->c; ++k)
          store(of_lanes(*t, t->varyings[op->imm + k][0], i), d + k * kBatchLanes + i);
        continue;
      }
      const float* planes[kQuadsPerVector];
      for (int quad = 0; quad < kQuadsPerVector; ++quad) planes[quad] = batch.triangle[i / 4 + quad]->varyings;
      for (uint32_t result = 0; result < op->c; ++result) {
        const uint32_t k = (op->imm + result) * 3;
        const F value = batch.one_triangle ? broadcast(planes[0][k]) : spread_to_quads(planes, k);
        store(value, d + result * kBatchLanes + i);
      }
    }
    return op + 1;
  }
};

HWY_INLINE QuadPlaces places_of(const FragmentBatch& batch) { return {batch.quad_in_tile, batch.whole_block}; }

struct op_depth_test {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const FragmentBatch& batch = *frame->fragments;
    alignas(64) float stored[kLanes];
    float* const depth[4] = {stored, nullptr, nullptr, nullptr};
    frame->depth->load_quads(batch.planes.depth, places_of(batch), frame->write, depth);
    const float* const z = reinterpret_cast<const float*>(reg_u(frame, op->a));
    uint64_t passed = 0;
    for (int i = 0; i < kVectorsPerBatch; ++i) {
      const int at = i * kVectorLanes;
      passed |= bits_of(compare_depth(op->imm & 7, load<F>(z + at), load<F>(stored + at))) << at;
    }
    frame->write &= passed;
    frame->exec = whole_quads(frame->write);
    if (frame->write == 0) return op + static_cast<int32_t>(op->imm2);
    if ((op->imm & 8) != 0) {
      const float* const out[4] = {z, nullptr, nullptr, nullptr};
      frame->depth->store_quads(batch.planes.depth, places_of(batch), frame->write, out, 1);
    }
    return op + 1;
  }
};

struct op_count_samples {
  static HWY_INLINE const Op* run(const Op* op, Frame* frame) {
    uint64_t* const counter = frame->fragments->samples_passed;
    if (counter != nullptr) *counter += static_cast<uint64_t>(__builtin_popcountll(frame->write));
    return op + 1;
  }
};

struct op_load_color {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const FragmentBatch& batch = *frame->fragments;
    float* registers[4];
    for (uint32_t i = 0; i < 4; ++i) registers[i] = reinterpret_cast<float*>(reg(frame, op->dst + i));
    frame->colors[op->imm]->load_quads(batch.planes.color[op->imm], places_of(batch), frame->write, registers);
    return op + 1;
  }
};

// The registers of an op's list; null where there is none.
struct ListedColor {
  const float* registers[4];
  HWY_INLINE ListedColor(const Op* op, Frame* frame) {
    const uint16_t* const list = frame->lists + op->a;
    for (uint32_t i = 0; i < 4; ++i) {
      registers[i] = list[i] == kNoOperand ? nullptr : reinterpret_cast<const float*>(reg(frame, list[i]));
    }
  }
};

struct op_store_color {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const FragmentBatch& batch = *frame->fragments;
    const ListedColor color(op, frame);
    frame->colors[op->imm]->store_quads(batch.planes.color[op->imm], places_of(batch), frame->write, color.registers,
                                        op->imm2);
    return op + 1;
  }
};

struct op_blend_color {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const FragmentBatch& batch = *frame->fragments;
    const ListedColor color(op, frame);
    frame->colors[op->imm]->blend_quads(batch.planes.color[op->imm], places_of(batch), frame->write, color.registers,
                                        frame->blends[op->imm2]);
    return op + 1;
  }
};

const HandlerEntry kEntries[] = {
    LAPILLI_FAT(frag_linear, false), LAPILLI_FAT(frag_linear_at, false), LAPILLI_FAT(frag_perspective, false),
    LAPILLI_FAT(frag_depth, true),   LAPILLI_FAT(interpolate, true),     LAPILLI_FAT(interpolate_flat, true),
    LAPILLI_FAT(depth_test, false),  LAPILLI_CONTROL(count_samples),     LAPILLI_FAT(load_color, false),
    LAPILLI_FAT(store_color, false), LAPILLI_FAT(blend_color, false),    LAPILLI_FAT(interpolate_perspective, true),
};

}  // namespace

HandlerList fragment_handlers() { return kEntries; }

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lapilli {
const PerTarget<ListHandlers> kFragmentHandlers = LAPILLI_PER_TARGET(fragment_handlers);
}  // namespace lapilli
#endif
