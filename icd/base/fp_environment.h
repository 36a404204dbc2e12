// The floating-point control register while the driver computes: threads inherit the application's, which may flush
// denormals, round elsewhere or trap.
#pragma once

#include <cstdint>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace lapilli {

// Round to nearest even, denormals kept, all exceptions masked, from construction to destruction; then the control and
// the sticky flags are as they were. Call the code that computes as a function that is not inlined (every per-target
// table entry is): a compiler may move arithmetic across the change within one function.
class FpEnvironment {
 public:
  FpEnvironment() : saved_(read()) { write(kDefault); }
  ~FpEnvironment() { write(saved_); }
  FpEnvironment(const FpEnvironment&) = delete;
  FpEnvironment& operator=(const FpEnvironment&) = delete;

 private:
#if defined(__x86_64__)
  // MXCSR: all six exception masks set, all else 0.
  using State = std::uint32_t;
  static constexpr State kDefault = 0x1F80;
  static State read() { return _mm_getcsr(); }
  static void write(State state) {
    asm volatile("" ::: "memory");
    _mm_setcsr(state);
    asm volatile("" ::: "memory");
  }
#elif defined(__aarch64__)
  // FPCR 0 is the default in all respects; FPSR holds the sticky flags.
  struct State {
    std::uint64_t control;
    std::uint64_t status;
  };
  static constexpr State kDefault = {0, 0};
  static State read() {
    State state;
    asm volatile("mrs %0, fpcr" : "=r"(state.control));
    asm volatile("mrs %0, fpsr" : "=r"(state.status));
    return state;
  }
  static void write(State state) {
    asm volatile("msr fpcr, %0" ::"r"(state.control) : "memory");
    asm volatile("msr fpsr, %0" ::"r"(state.status) : "memory");
  }
#else
#error "FpEnvironment is written for x86-64 and aarch64"
#endif

  const State saved_;
};

}  // namespace lapilli
