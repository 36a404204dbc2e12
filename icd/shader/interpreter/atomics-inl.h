// Atomic operations on a word for each lane, for one SIMD target: what `atomic` and ops on images share. Per-target
// header. Specification: SPIR-V, "Atomic Instructions".
#if defined(LAPILLI_SHADER_ATOMICS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LAPILLI_SHADER_ATOMICS_INL_H
#undef LAPILLI_SHADER_ATOMICS_INL_H
#else
#define LAPILLI_SHADER_ATOMICS_INL_H
#endif

#include <algorithm>
#include <atomic>
#include <bit>

#include "shader/interpreter/machine-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {

// The words that lanes work on; those of lanes without one are null. All are aligned.
struct AtomicLanes {
  uint32_t* word[kBatchLanes];
  const uint32_t* value;       // null: load
  const uint32_t* comparator;  // null but for compare_exchange
  uint32_t* old;               // the results: what the word was; 0 where there is none
  bool shared;                 // the words belong to this thread alone
};

// What a word becomes.
template <AtomicOp kOp>
HWY_INLINE uint32_t combined(uint32_t old, uint32_t value, uint32_t comparator) {
  const auto a = static_cast<int32_t>(old), b = static_cast<int32_t>(value);
  switch (kOp) {
    case AtomicOp::compare_exchange:
      return old == comparator ? value : old;
    case AtomicOp::add:
      return old + value;
    case AtomicOp::smin:
      return a < b ? old : value;
    case AtomicOp::smax:
      return a < b ? value : old;
    case AtomicOp::umin:
      return std::min(old, value);
    case AtomicOp::umax:
      return std::max(old, value);
    case AtomicOp::bit_and:
      return old & value;
    case AtomicOp::bit_or:
      return old | value;
    case AtomicOp::bit_xor:
      return old ^ value;
    default:
      return value;  // exchange
  }
}

template <AtomicOp kOp>
HWY_INLINE uint32_t change_word(uint32_t* at, uint32_t value, uint32_t comparator) {
  const std::atomic_ref<uint32_t> word(*at);
  if constexpr (kOp == AtomicOp::load) return word.load(std::memory_order_acquire);
  if constexpr (kOp == AtomicOp::add) return word.fetch_add(value, std::memory_order_acq_rel);
  uint32_t old = word.load(std::memory_order_relaxed);
  while (!word.compare_exchange_weak(old, combined<kOp>(old, value, comparator), std::memory_order_acq_rel)) {
  }
  return old;
}

template <AtomicOp kOp>
HWY_NOINLINE void change_lanes(const AtomicLanes& lanes) {
  for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
    uint32_t* const word = lanes.word[lane];
    lanes.old[lane] = 0;
    if (word == nullptr) continue;
    const uint32_t value = lanes.value != nullptr ? lanes.value[lane] : 0;
    const uint32_t comparator = lanes.comparator != nullptr ? lanes.comparator[lane] : 0;
    if (lanes.shared) {
      lanes.old[lane] = *word;
      if (kOp != AtomicOp::load) *word = combined<kOp>(*word, value, comparator);
    } else {
      lanes.old[lane] = change_word<kOp>(word, value, comparator);
    }
  }
}

// Lane by lane, in order.
HWY_INLINE void change_lanes(AtomicOp op, const AtomicLanes& lanes) {
  static constexpr void (*kChange[])(const AtomicLanes&) = {
      change_lanes<AtomicOp::load>,   change_lanes<AtomicOp::exchange>, change_lanes<AtomicOp::compare_exchange>,
      change_lanes<AtomicOp::add>,    change_lanes<AtomicOp::smin>,     change_lanes<AtomicOp::smax>,
      change_lanes<AtomicOp::umin>,   change_lanes<AtomicOp::umax>,     change_lanes<AtomicOp::bit_and>,
      change_lanes<AtomicOp::bit_or>, change_lanes<AtomicOp::bit_xor>};
  static_assert(std::size(kChange) == static_cast<size_t>(AtomicOp::kCount));
  kChange[static_cast<size_t>(op)](lanes);
}

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#endif  // per target
