// VkQueue: a thread that executes submissions in order. Specification: chapters "Devices and Queues", "Command
// Buffers".
#pragma once

#include <condition_variable>
#include <string>
#include <thread>

#include "queue/command_executor.h"

namespace lapilli {

// One batch of vkQueueSubmit. The queue uses them again and again, so that their lists keep their memory.
struct Submission {
  std::vector<Semaphore*> waits;
  std::vector<const CommandBuffer*> commands;
  std::vector<Semaphore*> signals;
  Fence* fence = nullptr;           // signalled after the last batch of a call
  std::vector<std::string> labels;  // of the queue, outermost first
  Submission* next = nullptr;
};

// First in, first out. Owns what it holds.
class SubmissionList {
 public:
  SubmissionList() = default;
  ~SubmissionList();
  SubmissionList(const SubmissionList&) = delete;
  SubmissionList& operator=(const SubmissionList&) = delete;

  bool empty() const { return first_ == nullptr; }
  void push(Submission* submission);
  Submission* pop();                   // null if it is empty
  void append(SubmissionList& other);  // which is empty then

 private:
  Submission* first_ = nullptr;
  Submission* last_ = nullptr;
};

struct Queue : Handle<Queue, VkQueue> {
  Queue(const HostMemory& memory, DeviceContext& owner, ThreadPool& workers);
  ~Queue();

  // Makes the queue's thread and those of the pool, if they are not there: work will come soon. Throws std::bad_alloc.
  void start();
  // Throws std::bad_alloc, then nothing is submitted.
  VkResult submit(std::span<const VkSubmitInfo> batches, Fence* fence);
  VkResult bind_sparse(std::span<const VkBindSparseInfo> batches, Fence* fence);
  VkResult wait_idle();

  void begin_label(const char* name);
  void end_label();

 private:
  template <class Batch, class Fill>
  VkResult push(std::span<const Batch> batches, Fence* fence, const Fill& fill);
  void make_thread();
  Submission& add_to(SubmissionList& list);
  void work();
  Submission* next(Submission* finished);
  void wait_for(const std::vector<Semaphore*>& semaphores);
  void execute(const Submission& submission);
  void finish(Submission& submission);

  DeviceContext& device_;
  CommandExecutor executor_;
  std::condition_variable wake_;
  std::atomic<bool> work_to_do_{false};  // submissions, or to quit: what the thread looks at while it spins
  // Guarded by device_.sync.mutex.
  SubmissionList submitted_;
  SubmissionList unused_;
  std::vector<std::string> labels_;
  bool quit_ = false;
  uint64_t pending_ = 0;  // submissions not yet finished
  std::thread thread_;    // made by start() or the first submission
};

}  // namespace lapilli
