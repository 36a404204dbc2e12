// Ops: built-ins, vertex attributes, and differences within a quad.
// Specification: "Built-In Variables", "Vertex Input Address Calculation", "Derivative Operations".
#include <algorithm>
#include <bit>
#include <cstring>

#include "base/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shader/interpreter/inputs.cpp"
#include <hwy/foreach_target.h>

#include "image/texel.h"
#include "shader/interpreter/handlers.h"
#include "shader/interpreter/machine-inl.h"
#include "shader/interpreter/planes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {
namespace {

// Components of local and global invocation IDs. Specification: "LocalInvocationIndex".
U local_index(const ComputeBatch& batch, int i) {
  return broadcast(batch.first_invocation + static_cast<uint32_t>(i)) + lane_numbers();
}
U local_id(const Frame& frame, int i, uint32_t axis) {
  const U index = local_index(*frame.invocations, i);
  const U size_x = broadcast(frame.workgroup_size[0]);
  const U size_y = broadcast(frame.workgroup_size[1]);
  if (axis == 0) return frame.workgroup_size[1] * frame.workgroup_size[2] == 1 ? index : remainder(index, size_x);
  if (axis == 1) return remainder(divide(index, size_x), size_y);
  return divide(index, size_x * size_y);
}

void fragment_builtin(const FragmentBatch& batch, BuiltIn which, std::byte* d) {
  // The four lanes of a quad.
  typedef float QuadF __attribute__((vector_size(16)));
  typedef uint32_t QuadU __attribute__((vector_size(16)));
  if (which == BuiltIn::front_facing && batch.lane_triangles != nullptr) {
    const LaneTriangles& triangles = *batch.lane_triangles;
    const float* const facing = reinterpret_cast<const float*>(triangles.front_facing);
    for (int i = 0; i < kLanes; i += kVectorLanes) store(of_lanes(triangles, facing, i), d + i * 4);
    return;
  }
  for (int quad = 0; quad < kLanes / 4; ++quad, d += 16) {
    const float x = static_cast<float>(batch.x[quad]);
    const float y = static_cast<float>(batch.y[quad]);
    const QuadF columns = QuadF{x, x, x, x} + QuadF{0.5f, 1.5f, 0.5f, 1.5f};
    const QuadF rows = QuadF{y, y, y, y} + QuadF{0.5f, 0.5f, 1.5f, 1.5f};
    const uint32_t facing = which == BuiltIn::front_facing ? batch.triangle[quad]->front_facing : 0;
    const QuadU facings = {facing, facing, facing, facing};
    const void* const source = which == BuiltIn::frag_coord_x   ? static_cast<const void*>(&columns)
                               : which == BuiltIn::frag_coord_y ? static_cast<const void*>(&rows)
                                                                : static_cast<const void*>(&facings);
    std::memcpy(d, source, 16);
  }
}

uint32_t below(BuiltIn a, BuiltIn first) { return static_cast<uint32_t>(a) - static_cast<uint32_t>(first); }

// Vector i of the others.
U builtin_vector(const Frame& frame, BuiltIn which, int i) {
  switch (which) {
    case BuiltIn::vertex_index:
      return load<U>(frame.vertices->vertex_index + i);
    case BuiltIn::instance_index:
      return load<U>(frame.vertices->instance_index + i);
    case BuiltIn::frag_coord_x:
    case BuiltIn::frag_coord_y:
    case BuiltIn::front_facing:
      break;  // by quads, in op_builtin
    case BuiltIn::local_invocation_x:
    case BuiltIn::local_invocation_y:
    case BuiltIn::local_invocation_z:
      return local_id(frame, i, below(which, BuiltIn::local_invocation_x));
    case BuiltIn::local_invocation_index:
      return local_index(*frame.invocations, i);
    case BuiltIn::workgroup_x:
    case BuiltIn::workgroup_y:
    case BuiltIn::workgroup_z:
      return broadcast(frame.invocations->workgroup[below(which, BuiltIn::workgroup_x)]);
    case BuiltIn::num_workgroups_x:
    case BuiltIn::num_workgroups_y:
    case BuiltIn::num_workgroups_z:
      return broadcast(frame.invocations->num_workgroups[below(which, BuiltIn::num_workgroups_x)]);
    case BuiltIn::global_invocation_x:
    case BuiltIn::global_invocation_y:
    case BuiltIn::global_invocation_z: {
      const uint32_t axis = below(which, BuiltIn::global_invocation_x);
      return broadcast(frame.invocations->workgroup[axis] * frame.workgroup_size[axis]) + local_id(frame, i, axis);
    }
    case BuiltIn::blend_constant_r:
    case BuiltIn::blend_constant_g:
    case BuiltIn::blend_constant_b:
    case BuiltIn::blend_constant_a:
      return as_u(broadcast(frame.fragments->blend_constants[below(which, BuiltIn::blend_constant_r)]));
    case BuiltIn::helper_invocation:
      return mask_to_u(~mask_of(frame.lanes, i / kVectorLanes));
    case BuiltIn::base_vertex:
    case BuiltIn::base_instance:
    case BuiltIn::draw_index:
      return broadcast(frame.vertices->draw_parameters[below(which, BuiltIn::base_vertex)]);
    case BuiltIn::lane_index:
      return broadcast(static_cast<uint32_t>(i)) + lane_numbers();
    case BuiltIn::kCount:
      break;
  }
  return zero_u();
}

struct op_builtin {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    uint32_t* const d = reg_out(frame, op->dst);
    const BuiltIn which = static_cast<BuiltIn>(op->imm);
    if (which == BuiltIn::frag_coord_x || which == BuiltIn::frag_coord_y || which == BuiltIn::front_facing) {
      fragment_builtin(*frame->fragments, which, reg(frame, op->dst));
      return op + 1;
    }
    for (int i = 0; i < kLanes; i += kVectorLanes) store(builtin_vector(*frame, which, i), d + i);
    return op + 1;
  }
};

struct op_fetch {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const Attribute& attribute = frame->attributes[op->imm];
    const VertexBinding& binding = frame->vertices->bindings[attribute.binding];
    const uint32_t* const indices =
        binding.per_instance ? frame->vertices->instance_index : frame->vertices->vertex_index;
    float* registers[4] = {};
    for (uint32_t i = 0; i < op->c; ++i) registers[i] = reinterpret_cast<float*>(reg(frame, op->dst + i));

    const uint64_t needed = uint64_t{attribute.offset} + attribute.texel_size;
    uint64_t inside = 0;  // lanes whose attribute lies in the buffer
    alignas(64) uint32_t offsets[kLanes];
    if (binding.size >= needed) {
      const uint64_t room = binding.size - needed;
      const uint64_t last = binding.stride == 0 ? 0xFFFFFFFFu : std::min<uint64_t>(room / binding.stride, 0xFFFFFFFFu);
      if (binding.stride != 0 && room >= 0x80000000u) return far(op, frame, last, registers);
      for (int i = 0; i < kVectorsPerBatch; ++i) {
        const U index = load<U>(indices + i * kVectorLanes);
        inside |= bits_of(le(index, broadcast(static_cast<uint32_t>(last)))) << (i * kVectorLanes);
        store(index * broadcast(binding.stride), offsets + i * kVectorLanes);
      }
    }
    const std::byte* const first = inside != 0 ? binding.data + attribute.offset : nullptr;
    attribute.texels->load_gathered(first, offsets, inside & frame->exec, registers);
    return op + 1;
  }

  // Buffers of 2 GiB and more, beyond the offsets of load_gathered: lane by lane.
  static HWY_NOINLINE const Op* far(const Op* op, Frame* frame, uint64_t last, float* const registers[4]) {
    const Attribute& attribute = frame->attributes[op->imm];
    const VertexBinding& binding = frame->vertices->bindings[attribute.binding];
    const uint32_t* const indices =
        binding.per_instance ? frame->vertices->instance_index : frame->vertices->vertex_index;
    alignas(64) float lanes[4][kLanes];
    float* const one[4] = {lanes[0], lanes[1], lanes[2], lanes[3]};
    alignas(64) const uint32_t offsets[kLanes] = {};
    for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
      const bool inside = indices[lane] <= last && (frame->exec >> lane & 1) != 0;
      const uint64_t at = inside ? uint64_t{indices[lane]} * binding.stride : 0;
      attribute.texels->load_gathered(binding.data + attribute.offset + at, offsets, inside ? uint64_t{1} << lane : 0,
                                      one);
      for (uint32_t i = 0; i < op->c; ++i) registers[i][lane] = lanes[i][lane];
    }
    return op + 1;
  }
};

// Lanes of odd columns, of lower rows.
M right_lanes() { return mask_of(0xAAAAAAAAAAAAAAAA, 0); }
M lower_lanes() { return mask_of(0xCCCCCCCCCCCCCCCC, 0); }

LAPILLI_OP1(ddx_fine, select(right_lanes(), a - as_f(swap_columns(as_u(a))), as_f(swap_columns(as_u(a))) - a))
LAPILLI_OP1(ddy_fine, select(lower_lanes(), a - as_f(swap_rows(as_u(a))), as_f(swap_rows(as_u(a))) - a))

struct op_ddx_coarse {
  static HWY_INLINE F run(F a) {
    const F fine = op_ddx_fine::run(a);
    return select(lower_lanes(), as_f(swap_rows(as_u(fine))), fine);
  }
};
struct op_ddy_coarse {
  static HWY_INLINE F run(F a) {
    const F fine = op_ddy_fine::run(a);
    return select(right_lanes(), as_f(swap_columns(as_u(fine))), fine);
  }
};

const HandlerEntry kEntries[] = {
    LAPILLI_FAT(builtin, true),           LAPILLI_FAT(fetch, true),
    LAPILLI_COLD_LANES(ddx_fine, F(F)),   LAPILLI_COLD_LANES(ddy_fine, F(F)),
    LAPILLI_COLD_LANES(ddx_coarse, F(F)), LAPILLI_COLD_LANES(ddy_coarse, F(F)),
};

}  // namespace

HandlerList input_handlers() { return kEntries; }

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lapilli {
const PerTarget<ListHandlers> kInputHandlers = LAPILLI_PER_TARGET(input_handlers);
}  // namespace lapilli
#endif
