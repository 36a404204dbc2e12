// The ops that read memory, on scalars: what runs once per draw. Lane ops have their scalar form beside the others
// (machine-inl.h, Once).
#include <algorithm>
#include <cstring>

#include "base/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shader/interpreter/once.cpp"
#include <hwy/foreach_target.h>

#include "shader/interpreter/handlers.h"
#include "shader/interpreter/machine-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {
namespace {

// `count` words from `offset` on; 0 for each that is not inside.
void read_words(const std::byte* data, uint64_t size, uint64_t offset, uint32_t count, uint32_t* to) {
  for (uint32_t i = 0; i < count; ++i, offset += 4) {
    to[i] = 0;
    if (offset + 4 <= size) std::memcpy(to + i, data + offset, 4);
  }
}

BufferRange once_buffer(const Op* op, Frame* frame) {
  return op->b == kNoOperand ? frame->buffers[op->imm] : buffer_at(*frame, op->imm, frame->scalars[op->b]);
}

struct once_load_uniform {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const BufferRange& buffer = frame->buffers[op->imm];
    read_words(buffer.data, buffer.size, op->imm2, op->c, frame->scalars + op->dst);
    return op + 1;
  }
};

struct once_load_buffer {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const BufferRange buffer = once_buffer(op, frame);
    const uint64_t offset = uint64_t{frame->scalars[op->a]} + op->imm2;
    read_words(buffer.data, buffer.size, offset, op->c, frame->scalars + op->dst);
    return op + 1;
  }
};

struct once_buffer_size {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    frame->scalars[op->dst] = static_cast<uint32_t>(std::min<uint64_t>(once_buffer(op, frame).size, 0xFFFFFFFFu));
    return op + 1;
  }
};

struct once_load_push {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const ResourceTable& resources = *frame->resources;
    read_words(resources.push_constants, resources.push_constant_bytes, op->imm2, op->c, frame->scalars + op->dst);
    return op + 1;
  }
};

struct once_load_push_indexed {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const ResourceTable& resources = *frame->resources;
    read_words(resources.push_constants, resources.push_constant_bytes, uint64_t{frame->scalars[op->a]} + op->imm2,
               op->c, frame->scalars + op->dst);
    return op + 1;
  }
};

// Blend constants: there is no other built-in that is the same in all of a draw.
struct once_builtin {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const uint32_t c = op->imm - static_cast<uint32_t>(BuiltIn::blend_constant_r);
    std::memcpy(frame->scalars + op->dst, &frame->fragments->blend_constants[c], 4);
    return op + 1;
  }
};

#define LAPILLI_ONCE_FAT(name) LAPILLI_ONCE(name, Fat<once_##name, false>)
const HandlerEntry kEntries[] = {
    LAPILLI_ONCE_FAT(load_uniform),      LAPILLI_ONCE_FAT(load_buffer), LAPILLI_ONCE_FAT(buffer_size),
    LAPILLI_ONCE_FAT(load_push_indexed), LAPILLI_ONCE_FAT(load_push),   LAPILLI_ONCE_FAT(builtin),
};

}  // namespace

HandlerList once_handlers() { return kEntries; }

void spread_scalars(std::span<const Spread> list, Frame* frame) {
  for (const Spread& each : list) {
    const U value = broadcast(frame->scalars[each.scalar]);
    uint32_t* const d = reg_out(frame, each.reg);
    for (int i = 0; i < kLanes; i += kVectorLanes) store(value, d + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lapilli {
const PerTarget<ListHandlers> kOnceHandlers = LAPILLI_PER_TARGET(once_handlers);
const PerTarget<SpreadScalars> kSpread = LAPILLI_PER_TARGET(spread_scalars);
}  // namespace lapilli
#endif
