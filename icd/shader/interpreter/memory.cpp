// Ops: buffers, push constants and arrays of registers. Every component is checked against the bounds by itself.
// Specification: "Robust Buffer Access".
#include <algorithm>
#include <atomic>
#include <bit>
#include <cstring>

#include "base/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shader/interpreter/memory.cpp"
#include <hwy/foreach_target.h>

#include "base/lanes_gather-inl.h"
#include "shader/interpreter/atomics-inl.h"
#include "shader/interpreter/handlers.h"
#include "shader/interpreter/machine-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {
namespace {

void fill(uint32_t* lanes, uint32_t bits) {
  for (int i = 0; i < kLanes; i += kVectorLanes) store(broadcast(bits), lanes + i);
}

uint32_t read_word(const std::byte* at) {
  uint32_t word;
  std::memcpy(&word, at, 4);
  return word;
}

// The lanes of `lanes` whose value is that of the lowest of them.
uint64_t lanes_like_first(const uint32_t* values, uint64_t lanes) {
  const U first = broadcast(values[std::countr_zero(lanes)]);
  uint64_t same = 0;
  for (int i = 0; i < kVectorsPerBatch; ++i) {
    same |= bits_of(eq(load<U>(values + i * kVectorLanes), first)) << (i * kVectorLanes);
  }
  return same & lanes;
}

// values[i] == values[0] + 4 * i, without wrapping around.
bool consecutive_words(const uint32_t* values) {
  if (values[0] > 0xFFFFFFFFu - 4 * kBatchLanes) return false;
  uint64_t same = 0;
  for (int i = 0; i < kVectorsPerBatch; ++i) {
    const U expected =
        broadcast(values[0] + static_cast<uint32_t>(4 * i * kVectorLanes)) + shift_left<2>(lane_numbers());
    same |= bits_of(eq(load<U>(values + i * kVectorLanes), expected)) << (i * kVectorLanes);
  }
  return same == ~uint64_t{0};
}

// Results never overlap the registers of the operands (passes/allocate.cpp).

// Word at data + addresses[lane] + offset for each lane of `lanes`, 0 where it is not inside; other lanes stay.
void load_component(const BufferRange& buffer, const uint32_t* addresses, uint64_t offset, uint64_t lanes,
                    uint32_t* d) {
  const bool any_inside = buffer.size >= offset + 4;
  const uint64_t last = any_inside ? buffer.size - offset - 4 : 0;  // largest address that is inside
  const std::byte* const base = any_inside ? buffer.data + offset : nullptr;
  if (last >= 0x80000000u) {
    // gather32 takes 31 bits.
    for (uint64_t rest = lanes; rest != 0; rest &= rest - 1) {
      const int lane = std::countr_zero(rest);
      d[lane] = addresses[lane] <= last ? read_word(base + addresses[lane]) : 0;
    }
    return;
  }
  for (int i = 0; i < kVectorsPerBatch; ++i) {
    const int at = i * kVectorLanes;
    const M wanted = mask_of(lanes, i);
    const U address = load<U>(addresses + at);
    const M inside = any_inside ? wanted & le(address, broadcast(static_cast<uint32_t>(last))) : no_lanes();
    store(select(wanted, gather32(base, address, inside), load<U>(d + at)), d + at);
  }
}

template <size_t kWords>
void read_rows(const std::byte* base, const uint32_t* addresses, uint64_t lanes, uint32_t* d) {
  for (int i = 0; i < kVectorsPerBatch; ++i) {
    const int at = i * kVectorLanes;
    const M wanted = mask_of(lanes, i);
    U words[kWords];
    gather_words<kWords>(base, load<U>(addresses + at), wanted, words);
    for (size_t w = 0; w < kWords; ++w) {
      uint32_t* const to = d + w * kBatchLanes + at;
      store(select(wanted, words[w], load<U>(to)), to);
    }
  }
}

// Vectors of 2 to 4 components that all lie inside; false, and nothing is done, where one does not.
bool load_rows_of_words(const BufferRange& buffer, const uint32_t* addresses, uint64_t offset, uint32_t count,
                        uint64_t lanes, uint32_t* d) {
  const uint64_t needed = offset + 4 * count;
  if (buffer.size < needed) return false;
  const U last = broadcast(static_cast<uint32_t>(std::min<uint64_t>(buffer.size - needed, 0x7FFFFFFF)));
  uint64_t inside = 0;
  for (int i = 0; i < kVectorsPerBatch; ++i) {
    inside |= bits_of(le(load<U>(addresses + i * kVectorLanes), last)) << (i * kVectorLanes);
  }
  if ((lanes & ~inside) != 0) return false;
  const std::byte* const base = buffer.data + offset;
  if (count == 2) read_rows<2>(base, addresses, lanes, d);
  if (count == 3) read_rows<3>(base, addresses, lanes, d);
  if (count == 4) read_rows<4>(base, addresses, lanes, d);
  return true;
}

void load_words(const BufferRange& buffer, const uint32_t* addresses, uint64_t offset, uint32_t count, uint64_t lanes,
                uint32_t* d) {
  const uint32_t first = addresses[std::countr_zero(lanes)];
  const uint64_t first_byte = first + offset;
  if (lanes_like_first(addresses, lanes) == lanes) {
    for (uint32_t i = 0; i < count; ++i, d += kLanes) {
      const uint64_t at = first_byte + 4 * i;
      const uint32_t word = at + 4 <= buffer.size ? read_word(buffer.data + at) : 0;
      for (int v = 0; v < kVectorsPerBatch; ++v) {
        const int lane = v * kVectorLanes;
        store(select(mask_of(lanes, v), broadcast(word), load<U>(d + lane)), d + lane);
      }
    }
    return;
  }
  if (count == 1 && lanes == ~uint64_t{0} && consecutive_words(addresses) &&
      first_byte + kRegisterBytes <= buffer.size) {
    std::memcpy(d, buffer.data + first_byte, kRegisterBytes);
    return;
  }
  if (count >= 2 && count <= 4 && load_rows_of_words(buffer, addresses, offset, count, lanes, d)) return;
  for (uint32_t i = 0; i < count; ++i, d += kLanes) load_component(buffer, addresses, offset + 4 * i, lanes, d);
}

void store_words(const BufferRange& buffer, const uint32_t* addresses, uint64_t offset, uint64_t lanes,
                 const uint32_t* values) {
  const uint64_t first_byte = addresses[0] + offset;
  if (lanes == ~uint64_t{0} && consecutive_words(addresses) && first_byte + kRegisterBytes <= buffer.size) {
    std::memcpy(buffer.data + first_byte, values, kRegisterBytes);
    return;
  }
  for (uint64_t rest = lanes; rest != 0; rest &= rest - 1) {
    const int lane = std::countr_zero(rest);
    const uint64_t at = addresses[lane] + offset;
    if (at + 4 <= buffer.size) std::memcpy(buffer.data + at, &values[lane], 4);
  }
}

struct op_load_buffer {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const uint32_t* const addresses = reg_u(frame, op->a);
    uint32_t* const d = reg_out(frame, op->dst);
    uint64_t rest = frame->exec;
    clear_idle_lanes(frame, op->dst, op->c);
    if (rest == 0) return op + 1;
    if (op->b == kNoOperand) {
      load_words(frame->buffers[op->imm], addresses, op->imm2, op->c, rest, d);
      return op + 1;
    }
    const uint32_t* const indices = reg_u(frame, op->b);
    while (rest != 0) {
      const uint64_t lanes = lanes_like_first(indices, rest);
      const BufferRange buffer = buffer_at(*frame, op->imm, indices[std::countr_zero(rest)]);
      load_words(buffer, addresses, op->imm2, op->c, lanes, d);
      rest &= ~lanes;
    }
    return op + 1;
  }
};

struct op_store_buffer {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const uint32_t* const addresses = reg_u(frame, op->a);
    const uint32_t* const values = reg_u(frame, op->b);
    uint64_t rest = frame->exec & frame->write;
    if (op->c == kNoOperand) {
      store_words(frame->buffers[op->imm], addresses, op->imm2, rest, values);
      return op + 1;
    }
    const uint32_t* const indices = reg_u(frame, op->c);
    while (rest != 0) {
      const uint64_t lanes = lanes_like_first(indices, rest);
      store_words(buffer_at(*frame, op->imm, indices[std::countr_zero(rest)]), addresses, op->imm2, lanes, values);
      rest &= ~lanes;
    }
    return op + 1;
  }
};

void broadcast_words(const std::byte* data, uint64_t size, uint64_t offset, uint32_t count, uint32_t* d) {
  for (uint32_t i = 0; i < count; ++i, d += kLanes, offset += 4) {
    fill(d, offset + 4 <= size ? read_word(data + offset) : 0);
  }
}

struct op_load_uniform {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const BufferRange& buffer = frame->buffers[op->imm];
    broadcast_words(buffer.data, buffer.size, op->imm2, op->c, reg_out(frame, op->dst));
    return op + 1;
  }
};

struct op_load_push {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const ResourceTable& resources = *frame->resources;
    broadcast_words(resources.push_constants, resources.push_constant_bytes, op->imm2, op->c, reg_out(frame, op->dst));
    return op + 1;
  }
};

struct op_load_push_indexed {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const uint32_t* const addresses = reg_u(frame, op->a);
    uint32_t* const d = reg_out(frame, op->dst);
    clear_idle_lanes(frame, op->dst, op->c);
    // Read only.
    const ResourceTable& resources = *frame->resources;
    const BufferRange push = {const_cast<std::byte*>(resources.push_constants), resources.push_constant_bytes};
    if (frame->exec != 0) load_words(push, addresses, op->imm2, op->c, frame->exec, d);
    return op + 1;
  }
};

struct op_buffer_size {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    uint32_t* const d = reg_out(frame, op->dst);
    for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
      const uint32_t index = op->b == kNoOperand ? 0 : reg_u(frame, op->b)[lane];
      const uint64_t size = buffer_at(*frame, op->imm, index).size;
      d[lane] = static_cast<uint32_t>(std::min<uint64_t>(size, 0xFFFFFFFFu));
    }
    return op + 1;
  }
};

struct op_atomic {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const uint16_t* const list = frame->lists + op->a;
    const auto operand = [&](int i) { return list[i] == kNoOperand ? nullptr : reg_u(frame, list[i]); };
    const uint32_t* const addresses = operand(0);
    const uint32_t* const indices = operand(1);
    AtomicLanes lanes;
    lanes.value = operand(2);
    lanes.comparator = operand(3);
    lanes.old = reg_out(frame, op->dst);
    lanes.shared = frame->refs[op->imm].set == kSharedMemory;
    BufferRange buffer = frame->buffers[op->imm];
    for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
      lanes.word[lane] = nullptr;
      if (((frame->exec & frame->write) >> lane & 1) == 0) continue;
      if (indices != nullptr) buffer = buffer_at(*frame, op->imm, indices[lane]);
      if (uint64_t{addresses[lane]} + 4 > buffer.size) continue;
      std::byte* const at = buffer.data + addresses[lane];
      if (reinterpret_cast<uintptr_t>(at) % 4 == 0) lanes.word[lane] = reinterpret_cast<uint32_t*>(at);
    }
    change_lanes(static_cast<AtomicOp>(op->imm2), lanes);
    return op + 1;
  }
};

struct op_memory_barrier {
  static HWY_INLINE const Op* run(const Op* op, Frame*) {
    std::atomic_thread_fence(std::memory_order_acq_rel);
    return op + 1;
  }
};

// Arrays: b or c is the first register, imm the number of elements.
struct op_load_array {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const uint32_t* const indices = reg_u(frame, op->a);
    uint32_t* const d = reg_out(frame, op->dst);
    const std::byte* const elements = reg(frame, op->b);
    for (int i = 0; i < kLanes; i += kVectorLanes) {
      const U index = load<U>(indices + i);
      const U lane = lane_numbers() + broadcast(static_cast<uint32_t>(i));
      // In bytes. What overflows is not below the count.
      const U offset = shift_left<8>(index) + shift_left<2>(lane);
      store(gather32(elements, offset, lt(index, broadcast(op->imm))), d + i);
    }
    return op + 1;
  }
};

struct op_store_array {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const uint32_t* const indices = reg_u(frame, op->a);
    const uint32_t* const values = reg_u(frame, op->b);
    uint32_t* const elements = reg_out(frame, op->c);
    for (uint64_t rest = frame->exec; rest != 0; rest &= rest - 1) {
      const int lane = std::countr_zero(rest);
      if (indices[lane] < op->imm) elements[indices[lane] * kBatchLanes + static_cast<uint32_t>(lane)] = values[lane];
    }
    return op + 1;
  }
};

const HandlerEntry kEntries[] = {
    LAPILLI_FAT(load_buffer, true), LAPILLI_FAT(store_buffer, false),     LAPILLI_FAT(load_uniform, true),
    LAPILLI_FAT(load_push, true),   LAPILLI_FAT(load_push_indexed, true), LAPILLI_FAT(buffer_size, true),
    LAPILLI_FAT(load_array, true),  LAPILLI_FAT(store_array, false),      LAPILLI_CONTROL(memory_barrier),
    LAPILLI_FAT(atomic, true),
};

}  // namespace

HandlerList memory_handlers() { return kEntries; }

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lapilli {
const PerTarget<ListHandlers> kMemoryHandlers = LAPILLI_PER_TARGET(memory_handlers);
}  // namespace lapilli
#endif
