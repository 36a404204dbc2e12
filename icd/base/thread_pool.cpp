// The pool's threads, and how a loop opens and closes.
#include "base/thread_pool.h"

#include <signal.h>

#include <cassert>
#include <new>

#include "base/fp_environment.h"
#include "base/spin.h"

namespace lapilli {
namespace {

constexpr std::uint64_t kFirst = 1, kEnd = std::uint64_t{1} << 32;  // one of Worker::left's halves

// Takes an index from the front or from the back; false if there is none.
bool take(std::atomic<std::uint64_t>& left, bool front, std::size_t& index) {
  std::uint64_t range = left.load(std::memory_order_relaxed);
  std::uint64_t rest;
  do {
    if (static_cast<std::uint32_t>(range) == range >> 32) return false;
    rest = front ? range + kFirst : range - kEnd;
  } while (!left.compare_exchange_weak(range, rest, std::memory_order_relaxed));
  index = front ? static_cast<std::uint32_t>(range) : rest >> 32;
  return true;
}

}  // namespace

ThreadPool::ThreadPool(unsigned workers, std::chrono::nanoseconds spin) : size_(workers), spin_(spin) {}

void ThreadPool::start() {
  if (size_ == 1 || workers_ != nullptr) return;
  workers_.reset(new (std::nothrow) Worker[size_]);
  if (workers_ == nullptr) return;
  // Threads inherit the mask: no signal of the application can arrive on one before it has blocked it.
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  for (unsigned number = 1; number < size_; ++number) {
    Worker& worker = workers_[number];
    worker.pool = this;
    worker.number = number;
    if (pthread_create(&worker.thread, nullptr, &thread_main, &worker) != 0) break;
    running_ = number + 1;
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

ThreadPool::~ThreadPool() {
  state_.fetch_or(kQuit, std::memory_order_release);
  state_.notify_all();
  for (unsigned worker = 1; worker < running_; ++worker) {
    pthread_join(workers_[worker].thread, nullptr);
  }
}

void* ThreadPool::thread_main(void* argument) {
  const auto* worker = static_cast<const Worker*>(argument);
#if defined(__linux__)
  pthread_setname_np(pthread_self(), "lapilli-worker");
#endif
  const FpEnvironment environment;
  worker->pool->serve(worker->number);
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
  std::size_t index;
  while (take(workers_[worker].left, true, index)) call_(body_, index, worker);
  for (unsigned i = 1; i < running_; ++i) {
    std::atomic<std::uint64_t>& others = workers_[(worker + i) % running_].left;
    while (take(others, false, index)) call_(body_, index, worker);
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
  assert(count < kEnd);
  if (count > 1) start();
  if (running_ == 1 || count == 1) {
    for (std::size_t index = 0; index < count; ++index) entry(body, index, 0);
    busy_.store(false, std::memory_order_release);
    return;
  }

  for (std::uint64_t i = 0; i < running_; ++i) {
    const std::uint64_t first = count * i / running_, end = count * (i + 1) / running_;
    workers_[i].left.store(first | end << 32, std::memory_order_relaxed);
  }
  call_ = entry;
  body_ = body;
  const std::uint32_t number = ++loop_number_;
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
