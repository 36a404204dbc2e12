// Ops: control flow and masks; and the loop that runs a program.
#include "base/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shader/interpreter/control.cpp"
#include <hwy/foreach_target.h>

#include "shader/interpreter/handlers.h"
#include "shader/interpreter/machine-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {
namespace {

struct op_branch {
  static HWY_INLINE const Op* run(const Op* op, Frame* frame) {
    frame->masks[op->imm] |= frame->exec;
    return op + 1;
  }
};

struct op_enter {
  static HWY_INLINE const Op* run(const Op* op, Frame* frame) {
    const uint64_t lanes = frame->masks[op->imm];
    frame->masks[op->imm] = 0;
    frame->exec = lanes;
    return lanes == 0 ? op + static_cast<int32_t>(op->imm2) : op + 1;
  }
};

struct op_loop {
  static HWY_INLINE const Op* run(const Op* op, Frame* frame) {
    if (frame->masks[op->imm] == 0) return op + 1;
    if (HWY_UNLIKELY(frame->loop_budget == 0)) return out_of_budget(op, frame);
    --frame->loop_budget;
    return op + static_cast<int32_t>(op->imm2);
  }
  static HWY_NOINLINE const Op* out_of_budget(const Op* op, Frame* frame) {
    return time_is_up(frame) ? frame->last : op + static_cast<int32_t>(op->imm2);
  }
};

struct op_jump_if_none {
  static HWY_INLINE const Op* run(const Op* op, Frame* frame) {
    return frame->exec == 0 ? op + static_cast<int32_t>(op->imm) : op + 1;
  }
};

struct op_kill {
  static HWY_INLINE const Op* run(const Op* op, Frame* frame) {
    frame->write &= ~frame->exec;
    frame->exec = 0;
    return op + 1;
  }
};

struct op_barrier {
  static HWY_INLINE const Op* run(const Op* op, Frame* frame) {
    frame->resume = op + 1;
    return frame->last;
  }
};

// Ops that read a condition as a word of lanes.
template <class Then>
struct Condition {
  static HWY_INLINE uint64_t bits(U condition, int index) { return bits_not_zero(condition) << (index * kVectorLanes); }
#if LAPILLI_TAIL_CALLS
  static void from_register(const Op* op, Frame* frame, LAPILLI_ACCUMULATOR) {
    const std::byte* const a = reg(frame, op->a);
#define LAPILLI_DO(i) | bits(load<U>(a + i * 4 * kVectorLanes), i)
    Then::run(op, frame, 0 LAPILLI_EACH(LAPILLI_DO));
#undef LAPILLI_DO
    LAPILLI_NEXT(op + 1);
  }
  static void from_accumulator(const Op* op, Frame* frame, LAPILLI_ACCUMULATOR) {
#define LAPILLI_DO(i) | bits(x##i, i)
    Then::run(op, frame, 0 LAPILLI_EACH(LAPILLI_DO));
#undef LAPILLI_DO
    LAPILLI_NEXT(op + 1);
  }
#else
  static HWY_INLINE uint64_t all_bits(const std::byte* a) {
    uint64_t lanes = 0;
    for (int i = 0; i < kVectorsPerBatch; ++i) lanes |= bits(load<U>(a + i * 4 * kVectorLanes), i);
    return lanes;
  }
  static const Op* from_register(const Op* op, Frame* frame) {
    Then::run(op, frame, all_bits(reg(frame, op->a)));
    return op + 1;
  }
  static const Op* from_accumulator(const Op* op, Frame* frame) {
    Then::run(op, frame, all_bits(reinterpret_cast<const std::byte*>(frame->accumulator)));
    return op + 1;
  }
#endif
};

struct BranchIf {
  static HWY_INLINE void run(const Op* op, Frame* frame, uint64_t condition) {
    frame->masks[op->imm] |= frame->exec & condition;
    frame->masks[op->imm2] |= frame->exec & ~condition;
  }
};
struct BranchWhere {
  static HWY_INLINE void run(const Op* op, Frame* frame, uint64_t condition) {
    frame->masks[op->imm] |= frame->exec & condition;
  }
};
struct Demote {
  static HWY_INLINE void run(const Op*, Frame* frame, uint64_t condition) {
    frame->write &= ~(frame->exec & condition);
  }
};

// set: one blend for each vector, by the bits of exec.
struct Set {
  static HWY_INLINE U blend(uint64_t exec, int index, U value, const std::byte* d) {
    return select(mask_of(exec, index), value, load<U>(d));
  }
#if LAPILLI_TAIL_CALLS
  template <int kForm>
  static void handler(const Op* op, Frame* frame, LAPILLI_ACCUMULATOR) {
    const std::byte* const a = reg(frame, op->a);
    std::byte* const d = reg(frame, op->dst);
    const uint64_t exec = frame->exec;
#define LAPILLI_DO(i)                                                                \
  {                                                                                  \
    constexpr int at = i * 4 * kVectorLanes;                                         \
    x##i = blend(exec, i, kForm == kFromRegisters ? load<U>(a + at) : x##i, d + at); \
    store(x##i, d + at);                                                             \
  }
    LAPILLI_EACH(LAPILLI_DO)
#undef LAPILLI_DO
    LAPILLI_NEXT(op + 1);
  }
#else
  template <int kForm>
  static const Op* handler(const Op* op, Frame* frame) {
    const std::byte* const accumulator = reinterpret_cast<const std::byte*>(frame->accumulator);
    const std::byte* const a = kForm == kFromRegisters ? reg(frame, op->a) : accumulator;
    std::byte* const d = reg(frame, op->dst);
    for (int i = 0; i < kVectorsPerBatch; ++i) {
      const int at = i * 4 * kVectorLanes;
      const U value = blend(frame->exec, i, load<U>(a + at), d + at);
      store(value, d + at);
      store(value, frame->accumulator + i * kVectorLanes);
    }
    return op + 1;
  }
#endif
};

// store_output: a move to the batch's outputs.
struct StoreOutput {
#if LAPILLI_TAIL_CALLS
  template <int kForm>
  static void handler(const Op* op, Frame* frame, LAPILLI_ACCUMULATOR) {
    const std::byte* const a = reg(frame, op->a);
    float* const d = frame->vertices->outputs + op->imm * kBatchLanes;
#define LAPILLI_DO(i) store(kForm == kFromRegisters ? load<U>(a + i * 4 * kVectorLanes) : x##i, d + i * kVectorLanes);
    LAPILLI_EACH(LAPILLI_DO)
#undef LAPILLI_DO
    LAPILLI_NEXT(op + 1);
  }
#else
  template <int kForm>
  static const Op* handler(const Op* op, Frame* frame) {
    const std::byte* const accumulator = reinterpret_cast<const std::byte*>(frame->accumulator);
    const std::byte* const a = kForm == kFromRegisters ? reg(frame, op->a) : accumulator;
    float* const d = frame->vertices->outputs + op->imm * kBatchLanes;
    for (int i = 0; i < kLanes; i += kVectorLanes) store(load<U>(a + 4 * i), d + i);
    return op + 1;
  }
#endif
};

#define LAPILLI_ENTRY(name, form, function) \
  HandlerEntry { Opcode::name, form, reinterpret_cast<Handler>(&function) }

const HandlerEntry kEntries[] = {
    LAPILLI_CONTROL(branch),
    LAPILLI_CONTROL(enter),
    LAPILLI_CONTROL(loop),
    LAPILLI_CONTROL(jump_if_none),
    LAPILLI_CONTROL(kill),
    LAPILLI_CONTROL(barrier),
    LAPILLI_ENTRY(end, kStore, end_handler),
    LAPILLI_ENTRY(branch_if, kStore, Condition<BranchIf>::from_register),
    LAPILLI_ENTRY(branch_if, kStore | kAccumulatorIsA, Condition<BranchIf>::from_accumulator),
    LAPILLI_ENTRY(branch_where, kStore, Condition<BranchWhere>::from_register),
    LAPILLI_ENTRY(branch_where, kStore | kAccumulatorIsA, Condition<BranchWhere>::from_accumulator),
    LAPILLI_ENTRY(demote, kStore, Condition<Demote>::from_register),
    LAPILLI_ENTRY(demote, kStore | kAccumulatorIsA, Condition<Demote>::from_accumulator),
    LAPILLI_ENTRY(set, kStore, Set::handler<kFromRegisters>),
    LAPILLI_ENTRY(set, kStore | kAccumulatorIsA, Set::handler<kAccumulatorIsA>),
    LAPILLI_ENTRY(store_output, kStore, StoreOutput::handler<kFromRegisters>),
    LAPILLI_ENTRY(store_output, kStore | kAccumulatorIsA, StoreOutput::handler<kAccumulatorIsA>),
};

}  // namespace

HandlerList control_handlers() { return kEntries; }
void run_program(const Op* first, Frame* frame) { run_ops(first, frame); }

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lapilli {
const PerTarget<ListHandlers> kControlHandlers = LAPILLI_PER_TARGET(control_handlers);
const PerTarget<Run> kRun = LAPILLI_PER_TARGET(run_program);
}  // namespace lapilli
#endif
