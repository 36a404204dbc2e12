// VkQueue: a thread that executes submissions in order. Specification: chapters "Devices and Queues", "Command
// Buffers".
#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <thread>

#include "queue/command_executor.h"

namespace lapilli {

// One batch of vkQueueSubmit.
struct Submission {
  std::vector<Semaphore*> waits;
  std::vector<const CommandBuffer*> commands;
  std::vector<Semaphore*> signals;
  Fence* fence = nullptr;           // signalled after the last batch of a call
  std::vector<std::string> labels;  // of the queue, outermost first
};

struct Queue : Handle<Queue, VkQueue> {
  Queue(const HostMemory& memory, DeviceContext& owner, ThreadPool& workers);
  ~Queue();

  // Throws std::bad_alloc, then nothing is submitted.
  VkResult submit(std::span<const VkSubmitInfo> batches, Fence* fence);
  VkResult bind_sparse(std::span<const VkBindSparseInfo> batches, Fence* fence);
  VkResult wait_idle();

  void begin_label(const char* name);
  void end_label();

 private:
  VkResult push(std::deque<Submission> submissions);
  void work();
  void wait_for(const std::vector<Semaphore*>& semaphores);
  void execute(const Submission& submission);
  void finish(const Submission& submission);

  DeviceContext& device_;
  CommandExecutor executor_;
  std::mutex mutex_;  // of the members below
  std::condition_variable wake_;
  std::deque<Submission> submissions_;
  std::vector<std::string> labels_;
  bool quit_ = false;
  uint64_t pending_ = 0;  // submissions not yet finished; guarded by device_.sync.mutex
  std::thread thread_;
};

}  // namespace lapilli
