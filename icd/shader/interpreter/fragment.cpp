// Ops: interpolation, depth test, and the colours of the tile.
// Specification: "Basic Polygon Rasterization" (barycentric coordinates), "Depth Test".
#include "base/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shader/interpreter/fragment.cpp"
#include <hwy/foreach_target.h>

#include "image/texel.h"
#include "shader/interpreter/handlers.h"
#include "shader/interpreter/machine-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {
namespace {

// Edge functions at all pixels of the batch, times 1/area2: λ1 and λ2, not rounded to float yet. The edge functions are
// exact however they are summed, so that both ways give the same.
struct Barycentrics {
  alignas(64) double lambda[2][kLanes];
};

void one_triangle_barycentrics(const FragmentBatch& batch, Barycentrics& out) {
  alignas(64) int32_t x[kLanes];
  alignas(64) int32_t y[kLanes];
  for (int quad = 0; quad < kLanes / 4; ++quad) {
    for (int lane = 0; lane < 4; ++lane) {
      x[quad * 4 + lane] = batch.x[quad] + (lane & 1);
      y[quad * 4 + lane] = batch.y[quad] + (lane >> 1);
    }
  }
  const TriangleSetup& triangle = *batch.triangle[0];
  const D inverse_area2 = broadcast(triangle.inverse_area2);
  for (int edge = 1; edge < 3; ++edge) {
    const D a = broadcast(triangle.edge_a[edge]);
    const D b = broadcast(triangle.edge_b[edge]);
    const D c = broadcast(triangle.edge_c[edge]);
    for (int i = 0; i < kLanes; i += kVectorLanes) {
      const D value = a * to_double(load<I>(x + i)) + b * to_double(load<I>(y + i)) + c;
      store_d(value * inverse_area2, out.lambda[edge - 1] + i);
    }
  }
}

// Not inlined: g++ 12 drops the stores of the loop when it inlines this into the ops (RenderPass tests show it).
HWY_NOINLINE void barycentrics(const FragmentBatch& batch, Barycentrics& out) {
  if (batch.one_triangle) return one_triangle_barycentrics(batch, out);
  for (int edge = 1; edge < 3; ++edge) {
    double* lambda = out.lambda[edge - 1];
    for (int quad = 0; quad < kLanes / 4; ++quad, lambda += 4) {
      const TriangleSetup& triangle = *batch.triangle[quad];
      const double a = triangle.edge_a[edge];
      const double b = triangle.edge_b[edge];
      const double corner = a * batch.x[quad] + b * batch.y[quad] + triangle.edge_c[edge];
      lambda[0] = corner * triangle.inverse_area2;
      lambda[1] = (corner + a) * triangle.inverse_area2;
      lambda[2] = (corner + b) * triangle.inverse_area2;
      lambda[3] = (corner + a + b) * triangle.inverse_area2;
    }
  }
}

struct op_frag_linear {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    Barycentrics at;
    barycentrics(*frame->fragments, at);
    uint32_t* const d = reg_out(frame, op->dst);
    for (int i = 0; i < kLanes; i += kVectorLanes) {
      store(to_float(load_d(at.lambda[0] + i)), d + i);
      store(to_float(load_d(at.lambda[1] + i)), d + kLanes + i);
    }
    return op + 1;
  }
};

// The value `get` gives of each quad's triangle, in all 64 lanes.
template <class Get>
void spread(const FragmentBatch& batch, uint32_t index, float* lanes) {
  for (int quad = 0; quad < kLanes / 4; ++quad, lanes += 4) {
    const float value = Get::of(*batch.triangle[quad], index);
    lanes[0] = lanes[1] = lanes[2] = lanes[3] = value;
  }
}
struct GetVarying {
  static HWY_INLINE float of(const TriangleSetup& triangle, uint32_t index) { return triangle.varyings[index]; }
};
struct GetInverseW {
  static HWY_INLINE float of(const TriangleSetup& triangle, uint32_t index) { return triangle.inverse_w[index]; }
};
struct GetMinDepth {
  static HWY_INLINE float of(const TriangleSetup& triangle, uint32_t) { return triangle.min_depth; }
};
struct GetMaxDepth {
  static HWY_INLINE float of(const TriangleSetup& triangle, uint32_t) { return triangle.max_depth; }
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
    for (uint32_t corner = 0; corner < 3; ++corner) spread<GetInverseW>(batch, corner, w[corner]);
    for (int i = 0; i < kLanes; i += kVectorLanes) {
      vector(load<F>(a + i), load<F>(b + i), load<F>(w[0] + i), load<F>(w[1] + i), load<F>(w[2] + i), d + i);
    }
    return op + 1;
  }
};

struct op_frag_depth {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const FragmentBatch& batch = *frame->fragments;
    Barycentrics at;
    barycentrics(batch, at);
    uint32_t* const d = reg_out(frame, op->dst);
    if (batch.one_triangle) {
      const TriangleSetup& triangle = *batch.triangle[0];
      for (int i = 0; i < kLanes; i += kVectorLanes) {
        const D z = broadcast(triangle.z[0]) + load_d(at.lambda[0] + i) * broadcast(triangle.z[1]) +
                    load_d(at.lambda[1] + i) * broadcast(triangle.z[2]);
        store(min(max(to_float(z), broadcast(triangle.min_depth)), broadcast(triangle.max_depth)), d + i);
      }
      return op + 1;
    }
    for (int lane = 0; lane < kLanes; ++lane) {
      const TriangleSetup& triangle = *batch.triangle[lane / 4];
      at.lambda[0][lane] = triangle.z[0] + at.lambda[0][lane] * triangle.z[1] + at.lambda[1][lane] * triangle.z[2];
    }
    alignas(64) float limits[2][kLanes];
    spread<GetMinDepth>(batch, 0, limits[0]);
    spread<GetMaxDepth>(batch, 0, limits[1]);
    for (int i = 0; i < kLanes; i += kVectorLanes) {
      const F z = to_float(load_d(at.lambda[0] + i));
      store(min(max(z, load<F>(limits[0] + i)), load<F>(limits[1] + i)), d + i);
    }
    return op + 1;
  }
};

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
    for (uint32_t result = 0; result < op->c; ++result, d += kLanes) {
      alignas(64) float plane[3][kLanes];
      for (uint32_t k = 0; k < 3; ++k) spread<GetVarying>(batch, (op->imm + result) * 3 + k, plane[k]);
      for (int i = 0; i < kLanes; i += kVectorLanes) {
        const F first = fma(load<F>(a + i), load<F>(plane[1] + i), load<F>(plane[0] + i));
        store(fma(load<F>(b + i), load<F>(plane[2] + i), first), d + i);
      }
    }
    return op + 1;
  }
};

struct op_interpolate_flat {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const FragmentBatch& batch = *frame->fragments;
    for (uint32_t result = 0; result < op->c; ++result) {
      float* const d = reinterpret_cast<float*>(reg(frame, op->dst + result));
      spread<GetVarying>(batch, (op->imm + result) * 3, d);
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

struct op_depth_test {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const FragmentBatch& batch = *frame->fragments;
    alignas(64) float stored[kLanes];
    float* const depth[4] = {stored, nullptr, nullptr, nullptr};
    frame->depth->load_quads(batch.planes.depth, batch.quad_in_tile, frame->write, depth);
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
      frame->depth->store_quads(batch.planes.depth, batch.quad_in_tile, frame->write, out, 1);
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
    frame->colors[op->imm]->load_quads(batch.planes.color[op->imm], batch.quad_in_tile, frame->write, registers);
    return op + 1;
  }
};

struct op_store_color {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const FragmentBatch& batch = *frame->fragments;
    const uint16_t* const list = frame->lists + op->a;
    const float* registers[4];
    for (uint32_t i = 0; i < 4; ++i) {
      registers[i] = list[i] == kNoOperand ? nullptr : reinterpret_cast<const float*>(reg(frame, list[i]));
    }
    frame->colors[op->imm]->store_quads(batch.planes.color[op->imm], batch.quad_in_tile, frame->write, registers,
                                        op->imm2);
    return op + 1;
  }
};

const HandlerEntry kEntries[] = {
    LAPILLI_FAT(frag_linear, false), LAPILLI_FAT(frag_perspective, false), LAPILLI_FAT(frag_depth, true),
    LAPILLI_FAT(interpolate, true),  LAPILLI_FAT(interpolate_flat, true),  LAPILLI_FAT(depth_test, false),
    LAPILLI_CONTROL(count_samples),  LAPILLI_FAT(load_color, false),       LAPILLI_FAT(store_color, false),
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
