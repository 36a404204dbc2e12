// Ops: interpolation, depth test, and the colours of the tile.
// Specification: "Basic Polygon Rasterization" (barycentric coordinates), "Depth Test".
#include <cstring>

#include "base/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shader/interpreter/fragment.cpp"
#include <hwy/foreach_target.h>

#include "image/texel.h"
#include "shader/fixed_function.h"
#include "shader/interpreter/handlers.h"
#include "shader/interpreter/machine-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {
namespace {

// The four lanes of a quad.
typedef double QuadD __attribute__((vector_size(32)));
typedef float QuadF __attribute__((vector_size(16)));

// By reference: a vector of 256 bits is no argument or result of functions on all targets.
HWY_INLINE void store_floats(const QuadD& value, float* lanes) {
  const QuadF floats = __builtin_convertvector(value, QuadF);
  std::memcpy(lanes, &floats, sizeof floats);
}

// An edge function of a triangle over its area. Exact however it is summed, but for the last product.
struct Edge {
  double a, b, c, inverse_area2;
  QuadD steps;  // from a quad's first lane to all four

  HWY_INLINE void load_from(const TriangleSetup& triangle, int edge) {
    a = triangle.edge_a[edge];
    b = triangle.edge_b[edge];
    c = triangle.edge_c[edge];
    inverse_area2 = triangle.inverse_area2;
    steps = QuadD{0, a, b, a + b};
  }
  HWY_INLINE void value(double x, double y, QuadD& e) const { e = steps + (a * x + b * y + c); }
  // λ, not rounded to float yet.
  HWY_INLINE void at(double x, double y, QuadD& lambda) const {
    value(x, y, lambda);
    lambda *= inverse_area2;
  }
};

HWY_INLINE void spread(float x, float* lanes) {
  const QuadF quad = {x, x, x, x};
  std::memcpy(lanes, &quad, sizeof quad);
}

struct op_frag_linear {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const FragmentBatch& batch = *frame->fragments;
    float* d = reinterpret_cast<float*>(reg(frame, op->dst));
    const TriangleSetup* triangle = nullptr;
    Edge edge1 = {}, edge2 = {};
    for (int quad = 0; quad < kLanes / 4; ++quad, d += 4) {
      if (batch.triangle[quad] != triangle) {
        triangle = batch.triangle[quad];
        edge1.load_from(*triangle, 1);
        edge2.load_from(*triangle, 2);
      }
      QuadD l1, l2;
      edge1.at(batch.x[quad], batch.y[quad], l1);
      edge2.at(batch.x[quad], batch.y[quad], l2);
      store_floats(l1, d);
      store_floats(l2, d + kLanes);
    }
    return op + 1;
  }
};

struct op_frag_depth {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const FragmentBatch& batch = *frame->fragments;
    float* d = reinterpret_cast<float*>(reg(frame, op->dst));
    const TriangleSetup* triangle = nullptr;
    Edge edge1 = {}, edge2 = {};
    for (int quad = 0; quad < kLanes / 4; ++quad, d += 4) {
      if (batch.triangle[quad] != triangle) {
        triangle = batch.triangle[quad];
        edge1.load_from(*triangle, 1);
        edge2.load_from(*triangle, 2);
      }
      QuadD e1, e2;
      edge1.value(batch.x[quad], batch.y[quad], e1);
      edge2.value(batch.x[quad], batch.y[quad], e2);
      const QuadD z = (e1 * triangle->depth.k1 + e2 * triangle->depth.k2) + triangle->depth.z0;
      QuadF depth = __builtin_convertvector(z, QuadF);
      const QuadF low = QuadF{} + triangle->depth.min;
      const QuadF high = QuadF{} + triangle->depth.max;
      depth = depth < low ? low : depth;
      depth = depth > high ? high : depth;
      std::memcpy(d, &depth, sizeof depth);
    }
    return op + 1;
  }
};

struct op_frag_perspective {
  // The interpolated 1/w, and λ_i / w_i over it.
  static HWY_INLINE void vector(F l1, F l2, F iw0, F iw1, F iw2, uint32_t* d) {
    const F t0 = (broadcast(1.0f) - l1 - l2) * iw0;
    const F t1 = l1 * iw1;
    const F t2 = l2 * iw2;
    const F sum = t0 + t1 + t2;
    store(t1 / sum, d);
    store(t2 / sum, d + kLanes);
    store(sum, d + 2 * kLanes);
  }
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const FragmentBatch& batch = *frame->fragments;
    const uint32_t* const a = reg_u(frame, op->a);
    const uint32_t* const b = reg_u(frame, op->b);
    uint32_t* const d = reg_out(frame, op->dst);
    if (batch.one_triangle) {
      const float* const w = batch.triangle[0]->inverse_w;
      for (int i = 0; i < kLanes; i += kVectorLanes) {
        vector(load<F>(a + i), load<F>(b + i), broadcast(w[0]), broadcast(w[1]), broadcast(w[2]), d + i);
      }
      return op + 1;
    }
    alignas(64) float w[3][kLanes];
    for (int quad = 0; quad < kLanes / 4; ++quad) {
      for (int corner = 0; corner < 3; ++corner) spread(batch.triangle[quad]->inverse_w[corner], w[corner] + quad * 4);
    }
    for (int i = 0; i < kLanes; i += kVectorLanes) {
      vector(load<F>(a + i), load<F>(b + i), load<F>(w[0] + i), load<F>(w[1] + i), load<F>(w[2] + i), d + i);
    }
    return op + 1;
  }
};

// verify() lets no instruction have more.
constexpr uint32_t kMostResults = 16;

struct op_interpolate {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const FragmentBatch& batch = *frame->fragments;
    const uint32_t* const a = reg_u(frame, op->a);
    const uint32_t* const b = reg_u(frame, op->b);
    uint32_t* d = reg_out(frame, op->dst);
    if (batch.one_triangle) {
      const float* plane = batch.triangle[0]->varyings + op->imm * 3;
      for (uint32_t result = 0; result < op->c; ++result, plane += 3, d += kLanes) {
        const F a0 = broadcast(plane[0]);
        const F d1 = broadcast(plane[1]);
        const F d2 = broadcast(plane[2]);
        for (int i = 0; i < kLanes; i += kVectorLanes) {
          store(fma(load<F>(b + i), d2, fma(load<F>(a + i), d1, a0)), d + i);
        }
      }
      return op + 1;
    }
    // All coefficients first: what was just stored in small pieces is slow to load in large ones.
    const uint32_t count = op->c;
    alignas(64) float planes[3 * kMostResults][kLanes];
    for (int quad = 0; quad < kLanes / 4; ++quad) {
      const float* const varyings = batch.triangle[quad]->varyings + op->imm * 3;
      for (uint32_t k = 0; k < 3 * count; ++k) spread(varyings[k], planes[k] + quad * 4);
    }
    for (uint32_t result = 0; result < count; ++result, d += kLanes) {
      const float* const a0 = planes[3 * result];
      const float* const d1 = planes[3 * result + 1];
      const float* const d2 = planes[3 * result + 2];
      for (int i = 0; i < kLanes; i += kVectorLanes) {
        store(fma(load<F>(b + i), load<F>(d2 + i), fma(load<F>(a + i), load<F>(d1 + i), load<F>(a0 + i))), d + i);
      }
    }
    return op + 1;
  }
};

struct op_interpolate_flat {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const FragmentBatch& batch = *frame->fragments;
    float* d = reinterpret_cast<float*>(reg(frame, op->dst));
    for (uint32_t result = 0; result < op->c; ++result, d += kLanes) {
      const uint32_t index = (op->imm + result) * 3;
      if (batch.one_triangle) {
        const F value = broadcast(batch.triangle[0]->varyings[index]);
        for (int i = 0; i < kLanes; i += kVectorLanes) store(value, d + i);
        continue;
      }
      for (int quad = 0; quad < kLanes / 4; ++quad) spread(batch.triangle[quad]->varyings[index], d + quad * 4);
    }
    return op + 1;
  }
};

// VkCompareOp of the fragment's depth a and the stored one b.
M compare(uint32_t how, F a, F b) {
  switch (how) {
    case 0:  // VK_COMPARE_OP_NEVER
      return no_lanes();
    case 1:  // VK_COMPARE_OP_LESS
      return lt(a, b);
    case 2:  // VK_COMPARE_OP_EQUAL
      return eq(a, b);
    case 3:  // VK_COMPARE_OP_LESS_OR_EQUAL
      return le(a, b);
    case 4:  // VK_COMPARE_OP_GREATER
      return gt(a, b);
    case 5:  // VK_COMPARE_OP_NOT_EQUAL
      return ne(a, b);
    case 6:  // VK_COMPARE_OP_GREATER_OR_EQUAL
      return ge(a, b);
    default:  // VK_COMPARE_OP_ALWAYS
      return all_lanes();
  }
}

// All lanes of the quads that have one in `lanes`.
uint64_t whole_quads(uint64_t lanes) {
  const uint64_t pairs = lanes | lanes >> 1;
  return ((pairs | pairs >> 2) & 0x1111111111111111) * 15;
}

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
      passed |= bits_of(compare(op->imm & 7, load<F>(z + at), load<F>(stored + at))) << at;
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
                                        blend_equation(op->imm2));
    return op + 1;
  }
};

const HandlerEntry kEntries[] = {
    LAPILLI_FAT(frag_linear, false), LAPILLI_FAT(frag_perspective, false), LAPILLI_FAT(frag_depth, true),
    LAPILLI_FAT(interpolate, true),  LAPILLI_FAT(interpolate_flat, true),  LAPILLI_FAT(depth_test, false),
    LAPILLI_CONTROL(count_samples),  LAPILLI_FAT(load_color, false),       LAPILLI_FAT(store_color, false),
    LAPILLI_FAT(blend_color, false),
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
