// How ops follow one another, for one SIMD target. Per-target header.
//
// The accumulator is a whole batch of 64 lanes in 4 or 8 vector registers. Each handler ends in a jump to the next, so
// that the accumulator is never in memory. Where 64 lanes do not fit the argument registers (128-bit vectors), and in
// builds that keep calls (sanitizers, no optimization), handlers return the next op to a loop, and the accumulator is
// Frame::accumulator. The bodies of the ops are the same. clang 14 has the loop too: it decides by the options of the
// whole file, not by the function's target, whether wide vectors are passed in registers, and a tail call that passes
// them on the stack overwrites its caller's frame.
#if defined(LAPILLI_SHADER_MACHINE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LAPILLI_SHADER_MACHINE_INL_H
#undef LAPILLI_SHADER_MACHINE_INL_H
#else
#define LAPILLI_SHADER_MACHINE_INL_H
#endif

#include <cstring>

#include "base/lanes-inl.h"
#include "base/lanes_leave-inl.h"
#include "shader/interpreter/op.h"

#undef LAPILLI_ACCUMULATOR
#undef LAPILLI_PASS
#undef LAPILLI_EACH
#undef LAPILLI_TAIL_CALLS
#undef LAPILLI_VECTOR_ARGUMENTS
#if defined(__OPTIMIZE__) && !defined(LAPILLI_SANITIZED) && !defined(__clang__)
#define LAPILLI_VECTOR_ARGUMENTS 1
#else
#define LAPILLI_VECTOR_ARGUMENTS 0
#endif
#if LAPILLI_VECTOR_ARGUMENTS && HWY_TARGET == HWY_AVX3
#define LAPILLI_TAIL_CALLS 1
#define LAPILLI_ACCUMULATOR U x0, U x1, U x2, U x3
#define LAPILLI_PASS x0, x1, x2, x3
#define LAPILLI_EACH(DO) DO(0) DO(1) DO(2) DO(3)
#elif LAPILLI_VECTOR_ARGUMENTS && HWY_TARGET == HWY_AVX2
#define LAPILLI_TAIL_CALLS 1
#define LAPILLI_ACCUMULATOR U x0, U x1, U x2, U x3, U x4, U x5, U x6, U x7
#define LAPILLI_PASS x0, x1, x2, x3, x4, x5, x6, x7
#define LAPILLI_EACH(DO) DO(0) DO(1) DO(2) DO(3) DO(4) DO(5) DO(6) DO(7)
#else
#define LAPILLI_TAIL_CALLS 0
#endif

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {

HWY_INLINE std::byte* reg(Frame* frame, uint32_t index) { return frame->registers() + index * kRegisterBytes; }
HWY_INLINE const uint32_t* reg_u(Frame* frame, uint32_t index) {
  return reinterpret_cast<const uint32_t*>(reg(frame, index));
}
HWY_INLINE uint32_t* reg_out(Frame* frame, uint32_t index) { return reinterpret_cast<uint32_t*>(reg(frame, index)); }

// Ops that work on the lanes of exec alone begin with this: what a batch before left in the other lanes may not be
// seen, for derivatives and implicit levels of detail read them.
HWY_INLINE void clear_idle_lanes(Frame* frame, uint32_t first, uint32_t count) {
  if (frame->exec == ~uint64_t{0}) return;
  std::memset(reg_out(frame, first), 0, count * kRegisterBytes);
}

template <class V, class W>
struct As;
template <class V>
struct As<V, V> {
  static HWY_INLINE V cast(V v) { return v; }
};
template <>
struct As<F, U> {
  static HWY_INLINE F cast(U v) { return as_f(v); }
};
template <>
struct As<I, U> {
  static HWY_INLINE I cast(U v) { return as_i(v); }
};
template <>
struct As<U, F> {
  static HWY_INLINE U cast(F v) { return as_u(v); }
};
template <>
struct As<U, I> {
  static HWY_INLINE U cast(I v) { return as_u(v); }
};

// Where operands come from: registers, or scalars, which fill a vector.
struct FromLanes {
  static HWY_INLINE U get(const std::byte* at) { return load<U>(at); }
};
struct FromScalars {
  static HWY_INLINE U get(const std::byte* at) { return broadcast(*reinterpret_cast<const uint32_t*>(at)); }
};

// One vector of a lane op: Body::run of its operands, which are the registers a, b, c or the accumulator x.
template <class Body, int kForm, class Signature, class From = FromLanes>
struct Step;
template <class Body, int kForm, class R, class A, class From>
struct Step<Body, kForm, R(A), From> {
  static HWY_INLINE U run(const std::byte* a, const std::byte*, const std::byte*, U x) {
    return As<U, R>::cast(Body::run(As<A, U>::cast((kForm & 6) == kAccumulatorIsA ? x : From::get(a))));
  }
};
template <class Body, int kForm, class R, class A, class B, class From>
struct Step<Body, kForm, R(A, B), From> {
  static HWY_INLINE U run(const std::byte* a, const std::byte* b, const std::byte*, U x) {
    return As<U, R>::cast(Body::run(As<A, U>::cast((kForm & 6) == kAccumulatorIsA ? x : From::get(a)),
                                    As<B, U>::cast((kForm & 6) == kAccumulatorIsB ? x : From::get(b))));
  }
};
template <class Body, int kForm, class R, class A, class B, class C, class From>
struct Step<Body, kForm, R(A, B, C), From> {
  static HWY_INLINE U run(const std::byte* a, const std::byte* b, const std::byte* c, U x) {
    return As<U, R>::cast(Body::run(As<A, U>::cast((kForm & 6) == kAccumulatorIsA ? x : From::get(a)),
                                    As<B, U>::cast((kForm & 6) == kAccumulatorIsB ? x : From::get(b)),
                                    As<C, U>::cast((kForm & 6) == kAccumulatorIsC ? x : From::get(c))));
  }
};

// A lane op on scalars: the same body, in one vector that holds the scalar in all lanes.
template <class Body, class Signature>
struct Once {
  static HWY_INLINE const Op* run(const Op* op, Frame* frame) {
    const std::byte* const scalars = reinterpret_cast<const std::byte*>(frame->scalars);
    const U result = Step<Body, kFromRegisters, Signature, FromScalars>::run(scalars + 4 * op->a, scalars + 4 * op->b,
                                                                             scalars + 4 * op->c, zero_u());
    frame->scalars[op->dst] = first_lane(result);
    return op + 1;
  }
};
template <class Body, class Signature>
struct BigOnce {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) { return Once<Body, Signature>::run(op, frame); }
};

#if LAPILLI_TAIL_CALLS

using Tail = void (*)(const Op*, Frame*, LAPILLI_ACCUMULATOR);
#define LAPILLI_NEXT(next)      \
  const Op* const after = next; \
  return reinterpret_cast<Tail>(after->handler)(after, frame, LAPILLI_PASS)

// Ops of 64 independent lanes, unrolled.
template <class Body, class Signature, int kForm>
struct Lane {
  static void handler(const Op* op, Frame* frame, LAPILLI_ACCUMULATOR) {
    const std::byte* const a = reg(frame, op->a);
    const std::byte* const b = reg(frame, op->b);
    const std::byte* const c = reg(frame, op->c);
    std::byte* const d = reg(frame, op->dst);
#define LAPILLI_DO(i)                                                       \
  {                                                                         \
    constexpr int at = i * 4 * kVectorLanes;                                \
    x##i = Step<Body, kForm, Signature>::run(a + at, b + at, c + at, x##i); \
    if constexpr ((kForm & kStore) != 0) store(x##i, d + at);               \
  }
    LAPILLI_EACH(LAPILLI_DO)
#undef LAPILLI_DO
    LAPILLI_NEXT(op + 1);
  }
};

// Leaves the accumulator alone.
template <class Body>
struct Control {
  static void handler(const Op* op, Frame* frame, LAPILLI_ACCUMULATOR) { LAPILLI_NEXT(Body::run(op, frame)); }
};

// A body that is called: it may need the stack. The result, if there is one, is loaded into the accumulator.
template <class Body, bool kResult>
struct Fat {
  static void handler(const Op* op, Frame* frame, LAPILLI_ACCUMULATOR) {
    const Op* const next = Body::run(op, frame);
    const std::byte* const d = reg(frame, op->dst);
#define LAPILLI_DO(i) x##i = kResult ? load<U>(d + i * 4 * kVectorLanes) : zero_u();
    LAPILLI_EACH(LAPILLI_DO)
#undef LAPILLI_DO
    LAPILLI_NEXT(next);
  }
};

#define LAPILLI_DO(i) , zero_u()
inline void run_ops(const Op* op, Frame* frame) {
  reinterpret_cast<Tail>(op->handler)(op, frame LAPILLI_EACH(LAPILLI_DO));
}
#undef LAPILLI_DO
// Functions with vectors as arguments leave the registers as they are, for callers that know; here nobody does.
inline void end_handler(const Op*, Frame*, LAPILLI_ACCUMULATOR) {
#define LAPILLI_DO(i) (void)x##i;
  LAPILLI_EACH(LAPILLI_DO)
#undef LAPILLI_DO
  clear_upper_lanes();
}

#else

using Tail = const Op* (*)(const Op*, Frame*);

template <class Body, class Signature, int kForm>
struct Lane {
  static const Op* handler(const Op* op, Frame* frame) {
    const std::byte* const a = reg(frame, op->a);
    const std::byte* const b = reg(frame, op->b);
    const std::byte* const c = reg(frame, op->c);
    std::byte* const d = reg(frame, op->dst);
    for (int i = 0; i < kLanes; i += kVectorLanes) {
      const int at = 4 * i;
      U x = load<U>(frame->accumulator + i);
      x = Step<Body, kForm, Signature>::run(a + at, b + at, c + at, x);
      store(x, frame->accumulator + i);
      if constexpr ((kForm & kStore) != 0) store(x, d + at);
    }
    return op + 1;
  }
};

template <class Body>
struct Control {
  static const Op* handler(const Op* op, Frame* frame) { return Body::run(op, frame); }
};

template <class Body, bool kResult>
struct Fat {
  static const Op* handler(const Op* op, Frame* frame) {
    const Op* const next = Body::run(op, frame);
    if constexpr (kResult) {
      const std::byte* const d = reg(frame, op->dst);
      for (int i = 0; i < kLanes; i += kVectorLanes) store(load<U>(d + 4 * i), frame->accumulator + i);
    }
    return next;
  }
};

inline void run_ops(const Op* op, Frame* frame) {
  while (op != nullptr) op = reinterpret_cast<Tail>(op->handler)(op, frame);
}
inline const Op* end_handler(const Op*, Frame*) { return nullptr; }

#endif

// A lane op that is too big to unroll: a loop over the vectors, always stored.
template <class Body, class Signature>
struct Loop {
  static HWY_NOINLINE const Op* run(const Op* op, Frame* frame) {
    const std::byte* a = reg(frame, op->a);
    const std::byte* b = reg(frame, op->b);
    const std::byte* c = reg(frame, op->c);
    std::byte* d = reg(frame, op->dst);
    for (int at = 0; at < 4 * kLanes; at += 4 * kVectorLanes) {
      store(Step<Body, kFromRegisters, Signature>::run(a + at, b + at, c + at, zero_u()), d + at);
    }
    return op + 1;
  }
};

// Bodies of lane ops, one line each.
#define LAPILLI_OP1(name, expression) \
  struct op_##name {                  \
    template <class A>                \
    static HWY_INLINE auto run(A a) { \
      return expression;              \
    }                                 \
  };
#define LAPILLI_OP2(name, expression)      \
  struct op_##name {                       \
    template <class A, class B>            \
    static HWY_INLINE auto run(A a, B b) { \
      return expression;                   \
    }                                      \
  };
#define LAPILLI_OP3(name, expression)           \
  struct op_##name {                            \
    template <class A, class B, class C>        \
    static HWY_INLINE auto run(A a, B b, C c) { \
      return expression;                        \
    }                                           \
  };

// Lines of a file's table. HOT: all forms of which the op has operands. COLD: loads all, stores.
#define LAPILLI_FORM(name, signature, form) \
  HandlerEntry { Opcode::name, form, reinterpret_cast<Handler>(&Lane<op_##name, signature, form>::handler) }
#define LAPILLI_ONCE(name, ...) \
  HandlerEntry { Opcode::name, kOnce, reinterpret_cast<Handler>(&__VA_ARGS__::handler) }
#define LAPILLI_HOT1(name, signature)                                                            \
  LAPILLI_ONCE(name, Control<Once<op_##name, signature>>), LAPILLI_FORM(name, signature, kKeep), \
      LAPILLI_FORM(name, signature, kStore), LAPILLI_FORM(name, signature, kAccumulatorIsA),     \
      LAPILLI_FORM(name, signature, kAccumulatorIsA | kStore)
#define LAPILLI_HOT2(name, signature)                                            \
  LAPILLI_HOT1(name, signature), LAPILLI_FORM(name, signature, kAccumulatorIsB), \
      LAPILLI_FORM(name, signature, kAccumulatorIsB | kStore)
#define LAPILLI_HOT3(name, signature)                                            \
  LAPILLI_HOT2(name, signature), LAPILLI_FORM(name, signature, kAccumulatorIsC), \
      LAPILLI_FORM(name, signature, kAccumulatorIsC | kStore)
// a and b of a fused multiply-add commute.
#define LAPILLI_HOT_FMA(name, signature)                                         \
  LAPILLI_HOT1(name, signature), LAPILLI_FORM(name, signature, kAccumulatorIsC), \
      LAPILLI_FORM(name, signature, kAccumulatorIsC | kStore)
#define LAPILLI_COLD(name, signature) \
  LAPILLI_COLD_LANES(name, signature), LAPILLI_ONCE(name, Fat<BigOnce<op_##name, signature>, false>)
// Without a scalar form.
#define LAPILLI_COLD_LANES(name, signature) \
  HandlerEntry { Opcode::name, kStore, reinterpret_cast<Handler>(&Fat<Loop<op_##name, signature>, true>::handler) }
// Bodies of whole ops: `static HWY_NOINLINE const Op* run(const Op*, Frame*)`. one_result: there may be exactly one.
#define LAPILLI_FAT(name, one_result) \
  HandlerEntry { Opcode::name, kStore, reinterpret_cast<Handler>(&Fat<op_##name, one_result>::handler) }
#define LAPILLI_CONTROL(name) \
  HandlerEntry { Opcode::name, kStore, reinterpret_cast<Handler>(&Control<op_##name>::handler) }

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#endif  // per target
