// Worker threads that share the indices of one loop at a time: each begins with a part of its own, and who has none
// left takes from the others.
#pragma once

#include <pthread.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>

namespace lapilli {

// ThreadPool pool(4);
// pool.parallel_for(tile_count, [&](std::size_t tile, unsigned worker) { draw(tile, scratch[worker]); });
//
// The states of one loop:  closed ─open─▶ open ─out of indices─▶ closed, workers inside ─last one leaves─▶ closed
// A worker that wakes up too late finds the loop closed and never sees it.
class ThreadPool {
 public:
  // The caller of parallel_for is one of `workers` (at least 1); the others are threads with all signals blocked.
  // start() or the first loop makes them, as many as the system gives. `spin`: how long threads wait awake before they
  // sleep.
  explicit ThreadPool(unsigned workers, std::chrono::nanoseconds spin = {});
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  // Workers that a loop may have.
  unsigned size() const { return size_; }

  // Makes the threads if they are not there yet; not during a loop.
  void start();

  // Calls body(index, worker) once for each index below count (< 2^32), in no fixed order, and returns when all calls
  // have returned. A worker's indices are neighbours, and mostly those that it had in the last loop of as many: what
  // lies beside each other, or stays in a core's cache, should have neighbouring indices. worker is 0 … size() - 1 and
  // belongs to one thread during the loop; the caller is worker 0. Bodies run with FpEnvironment's defaults, may not
  // throw, and may not call parallel_for of the same pool. One loop at a time.
  template <class Body>
  void parallel_for(std::size_t count, Body&& body) {
    using Plain = std::remove_reference_t<Body>;
    run(count, &call<Plain>, const_cast<void*>(static_cast<const void*>(&body)));
  }

 private:
  using Call = void (*)(void* body, std::size_t index, unsigned worker);
  template <class Plain>
  static void call(void* body, std::size_t index, unsigned worker) {
    (*static_cast<Plain*>(body))(index, worker);
  }

  struct alignas(64) Worker {
    // Indices [low half, high half) that nobody has taken: the worker takes the first, others the last.
    std::atomic<std::uint64_t> left{0};
    ThreadPool* pool = nullptr;
    unsigned number = 0;
    pthread_t thread = {};  // but for worker 0
  };

  void run(std::size_t count, Call entry, void* body);
  void work(unsigned worker);
  bool join_open_loop();
  void leave_loop();
  void serve(unsigned worker);
  static void* thread_main(void* worker);

  // state_: kOpen, kQuit and the number of workers inside the loop.
  static constexpr std::uint32_t kOpen = 1u << 31;
  static constexpr std::uint32_t kQuit = 1u << 30;
  alignas(64) std::atomic<std::uint32_t> state_{0};
  // The number of the last loop that its last worker has left, for a caller that was not the last.
  alignas(64) std::atomic<std::uint32_t> finished_loop_{0};

  // The loop. Written while it is closed and nobody is inside.
  Call call_ = nullptr;
  void* body_ = nullptr;
  std::uint32_t loop_number_ = 0;

  std::atomic<bool> busy_{false};
  const unsigned size_;
  const std::chrono::nanoseconds spin_;
  unsigned running_ = 1;               // workers that are there, the caller among them
  std::unique_ptr<Worker[]> workers_;  // made with the threads
};

}  // namespace lapilli
