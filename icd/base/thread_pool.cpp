// The pool's threads, and how a loop opens and closes.
#include "base/thread_pool.h"

#include <signal.h>

#include <cassert>
#include <new>

#include "base/fp_environment.h"
#include "base/spin.h"

namespace lapilli {

ThreadPool::ThreadPool(unsigned workers, std::chrono::nanoseconds spin) : size_(workers), spin_(spin) {}

void ThreadPool::start_threads() {
  threads_.reset(new (std::nothrow) Thread[size_ - 1]);
  if (threads_ == nullptr) return;
  // Threads inherit the mask: no signal of the application can arrive on one before it has blocked it.
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  for (unsigned worker = 1; worker < size_; ++worker) {
    Thread& thread = threads_[worker - 1];
    thread.pool = this;
    thread.worker = worker;
    if (pthread_create(&thread.handle, nullptr, &thread_main, &thread) != 0) break;
    running_ = worker + 1;
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

ThreadPool::~ThreadPool() {
  state_.fetch_or(kQuit, std::memory_order_release);
  state_.notify_all();
  for (unsigned worker = 1; worker < running_; ++worker) {
    pthread_join(threads_[worker - 1].handle, nullptr);
  }
}

void* ThreadPool::thread_main(void* argument) {
  const auto* thread = static_cast<const Thread*>(argument);
#if defined(__linux__)
  pthread_setname_np(pthread_self(), "lapilli-worker");
#endif
  const FpEnvironment environment;
  thread->pool->serve(thread->worker);
  return nullptr;
}

void ThreadPool::serve(unsigned worker) {
  for (;;) {
    std::uint32_t state = 0;
    spin_until(
        [&] {
          state = state_.load(std::memory_order_relaxed);
          return (state & (kOpen | kQuit)) != 0;
        },
        spin_);
    if ((state & kQuit) != 0) return;
    if ((state & kOpen) == 0) {
      state_.wait(state, std::memory_order_relaxed);
    } else if (join_open_loop()) {
      work(worker);
      leave_loop();
    }
  }
}

bool ThreadPool::join_open_loop() {
  std::uint32_t state = state_.load(std::memory_order_relaxed);
  while ((state & kOpen) != 0) {
    // Acquires what the caller wrote before it opened the loop.
    if (state_.compare_exchange_weak(state, state + 1, std::memory_order_acquire, std::memory_order_relaxed)) {
      return true;
    }
  }
  return false;
}

void ThreadPool::work(unsigned worker) {
  for (;;) {
    const std::size_t index = next_index_.fetch_add(1, std::memory_order_relaxed);
    if (index >= count_) break;
    call_(body_, index, worker);
  }
  state_.fetch_and(~kOpen, std::memory_order_relaxed);
}

void ThreadPool::leave_loop() {
  // While we are inside, the caller cannot start the next loop and change the number.
  const std::uint32_t number = loop_number_;
  const std::uint32_t before = state_.fetch_sub(1, std::memory_order_acq_rel);
  if ((before & ~kQuit) == 1) {
    finished_loop_.store(number, std::memory_order_release);
    finished_loop_.notify_all();
  }
}

void ThreadPool::run(std::size_t count, Call entry, void* body) {
  if (count == 0) return;
  const FpEnvironment environment;
  [[maybe_unused]] const bool was_busy = busy_.exchange(true, std::memory_order_acquire);
  assert(!was_busy && "parallel_for within parallel_for, or from two threads");
  if (size_ > 1 && count > 1 && threads_ == nullptr) start_threads();
  if (running_ == 1 || count == 1) {
    for (std::size_t index = 0; index < count; ++index) entry(body, index, 0);
    busy_.store(false, std::memory_order_release);
    return;
  }

  count_ = count;
  call_ = entry;
  body_ = body;
  const std::uint32_t number = ++loop_number_;
  next_index_.store(0, std::memory_order_relaxed);
  state_.store(kOpen | 1, std::memory_order_release);
  state_.notify_all();

  work(0);
  leave_loop();
  // The last to leave, perhaps this thread, says so; nobody touches the pool's loop after that.
  const auto finished = [&] { return finished_loop_.load(std::memory_order_acquire) == number; };
  if (!spin_until(finished, spin_)) {
    std::uint32_t last;
    while ((last = finished_loop_.load(std::memory_order_acquire)) != number) {
      finished_loop_.wait(last, std::memory_order_acquire);
    }
  }
  busy_.store(false, std::memory_order_release);
}

}  // namespace lapilli
