// Waiting awake for what comes within microseconds, where to sleep and be woken would take longer.
#pragma once

#include <chrono>
#include <thread>

namespace lapilli {

inline void pause_briefly() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

// Asks `done` again and again until it is true or about `limit` has passed; the last answer. Every microsecond or two
// the core goes to another thread that wants it.
template <class Done>
bool spin_until(const Done& done, std::chrono::nanoseconds limit) {
  using Clock = std::chrono::steady_clock;
  if (done()) return true;
  if (limit.count() <= 0) return false;
  const Clock::time_point end = Clock::now() + limit;
  do {
    for (int i = 0; i < 32; ++i) {
      pause_briefly();
      if (done()) return true;
    }
    std::this_thread::yield();
  } while (Clock::now() < end);
  return done();
}

}  // namespace lapilli
