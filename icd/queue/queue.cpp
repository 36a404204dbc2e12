// The queue's thread.
#include "queue/queue.h"

#include <pthread.h>
#include <signal.h>

#include <exception>

#include "base/fp_environment.h"
#include "base/log.h"
#include "base/spin.h"
#include "object/debug_utils.h"

namespace lapilli {
namespace {

// Signals belong to the application's own threads; the new thread inherits the mask.
template <class Function>
std::thread start_thread_without_signals(Function function) {
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread thread;
  try {
    thread = std::thread(function);
  } catch (const std::exception&) {
    // The system has no thread or no memory left to give: the same to the application, which keeps its signals.
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (!thread.joinable()) throw std::bad_alloc();
  return thread;
}

template <class T, class H>
void assign(std::vector<T*>& list, const H* handles, uint32_t count) {
  list.clear();
  for (uint32_t i = 0; i < count; ++i) list.push_back(std::remove_const_t<T>::from(handles[i]));
}

}  // namespace

SubmissionList::~SubmissionList() {
  while (Submission* submission = pop()) delete submission;
}

void SubmissionList::push(Submission* submission) {
  submission->next = nullptr;
  (last_ != nullptr ? last_->next : first_) = submission;
  last_ = submission;
}

Submission* SubmissionList::pop() {
  Submission* const submission = first_;
  if (submission == nullptr) return nullptr;
  first_ = submission->next;
  if (first_ == nullptr) last_ = nullptr;
  return submission;
}

void SubmissionList::append(SubmissionList& other) {
  if (other.empty()) return;
  (last_ != nullptr ? last_->next : first_) = other.first_;
  last_ = other.last_;
  other.first_ = other.last_ = nullptr;
}

Queue::Queue(const HostMemory& memory, DeviceContext& owner, ThreadPool& workers)
    : Handle(memory), device_(owner), executor_(owner, workers) {}

Queue::~Queue() {
  if (!thread_.joinable()) return;
  {
    const std::scoped_lock lock(device_.sync.mutex);
    quit_ = true;
    work_to_do_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void Queue::make_thread() {
  if (!thread_.joinable()) thread_ = start_thread_without_signals([this] { work(); });
}

void Queue::start() {
  const std::scoped_lock lock(device_.sync.mutex);
  make_thread();
}

Submission& Queue::add_to(SubmissionList& list) {
  Submission* submission = unused_.pop();
  if (submission == nullptr) submission = new Submission;
  list.push(submission);
  submission->fence = nullptr;
  submission->labels = labels_;
  return *submission;
}

// fill(submission, batch) for each batch; a call without batches has an empty one, for the fence.
template <class Batch, class Fill>
VkResult Queue::push(std::span<const Batch> batches, Fence* fence, const Fill& fill) {
  if (device_.lost) return VK_ERROR_DEVICE_LOST;
  {
    const std::scoped_lock lock(device_.sync.mutex);
    make_thread();
    SubmissionList added;
    Submission* last = nullptr;
    uint64_t count = 0;
    try {
      do {
        last = &add_to(added);
        fill(*last, batches.empty() ? Batch{} : batches[count]);
      } while (++count < batches.size());
    } catch (...) {
      unused_.append(added);
      throw;
    }
    last->fence = fence;
    submitted_.append(added);
    pending_ += count;
    work_to_do_.store(true, std::memory_order_relaxed);
  }
  wake_.notify_one();
  return VK_SUCCESS;
}

VkResult Queue::submit(std::span<const VkSubmitInfo> batches, Fence* fence) {
  return push(batches, fence, [](Submission& submission, const VkSubmitInfo& batch) {
    assign(submission.waits, batch.pWaitSemaphores, batch.waitSemaphoreCount);
    assign(submission.commands, batch.pCommandBuffers, batch.commandBufferCount);
    assign(submission.signals, batch.pSignalSemaphores, batch.signalSemaphoreCount);
  });
}

// No resource can be sparse, so that only the semaphores and the fence are left.
VkResult Queue::bind_sparse(std::span<const VkBindSparseInfo> batches, Fence* fence) {
  return push(batches, fence, [](Submission& submission, const VkBindSparseInfo& batch) {
    assign(submission.waits, batch.pWaitSemaphores, batch.waitSemaphoreCount);
    submission.commands.clear();
    assign(submission.signals, batch.pSignalSemaphores, batch.signalSemaphoreCount);
  });
}

VkResult Queue::wait_idle() {
  std::unique_lock lock(device_.sync.mutex);
  device_.sync.changed.wait(lock, [this] { return pending_ == 0; });
  return device_.lost ? VK_ERROR_DEVICE_LOST : VK_SUCCESS;
}

void Queue::work() {
#if defined(__linux__)
  pthread_setname_np(pthread_self(), "lapilli-queue");
#endif
  const FpEnvironment environment;
  executor_.pool.start();
  Submission* submission = nullptr;
  while ((submission = next(submission)) != nullptr) {
    wait_for(submission->waits);
    execute(*submission);
  }
}

// Reports the one that is done and waits for another; null: the queue is destroyed.
Submission* Queue::next(Submission* finished) {
  if (finished != nullptr) {
    {
      const std::scoped_lock lock(device_.sync.mutex);
      finish(*finished);
      work_to_do_.store(quit_ || !submitted_.empty(), std::memory_order_relaxed);
    }
    device_.sync.changed.notify_all();
  }
  const auto has_work = [this] { return work_to_do_.load(std::memory_order_relaxed); };
  spin_until(has_work, device_.physical_device.environment.spin);
  std::unique_lock lock(device_.sync.mutex);
  wake_.wait(lock, has_work);
  return submitted_.pop();
}

void Queue::wait_for(const std::vector<Semaphore*>& semaphores) {
  if (semaphores.empty()) return;
  std::unique_lock lock(device_.sync.mutex);
  for (Semaphore* semaphore : semaphores) {
    device_.sync.changed.wait(lock, [&] { return device_.lost || semaphore->signaled; });
    semaphore->signaled = false;
  }
}

void Queue::execute(const Submission& submission) {
  std::vector<VkDebugUtilsLabelEXT> labels;
  VkResult result = VK_SUCCESS;
  try {
    for (const std::string& name : submission.labels) {
      labels.push_back({VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT, nullptr, name.c_str(), {}});
    }
    const ThreadLabels open(labels, executor_.labels);
    for (const CommandBuffer* commands : submission.commands) {
      if (device_.lost || result != VK_SUCCESS) break;
      result = executor_.run(*commands);
    }
    executor_.print_ledger();
  } catch (const std::bad_alloc&) {
    log_error("out of memory on the queue");
    result = VK_ERROR_OUT_OF_HOST_MEMORY;
  }
  if (result == VK_SUCCESS) return;
  // The submission was accepted long ago: all that is left to say is that the device is lost.
  const std::scoped_lock lock(device_.sync.mutex);
  device_.lost = true;
}

// Also on a lost device: nobody may wait for ever. The caller holds the lock.
void Queue::finish(Submission& submission) {
  for (Semaphore* semaphore : submission.signals) semaphore->signaled = true;
  if (submission.fence != nullptr) submission.fence->signaled = true;
  --pending_;
  unused_.push(&submission);
}

void Queue::begin_label(const char* name) {
  const std::scoped_lock lock(device_.sync.mutex);
  labels_.emplace_back(name);
}

void Queue::end_label() {
  const std::scoped_lock lock(device_.sync.mutex);
  if (!labels_.empty()) labels_.pop_back();
}

}  // namespace lapilli
