// The queue's thread.
#include "queue/queue.h"

#include <pthread.h>
#include <signal.h>

#include <system_error>

#include "base/fp_environment.h"
#include "base/log.h"
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
  } catch (const std::system_error&) {
    // The system has no thread left to give: a lack of memory as far as the application can tell.
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (!thread.joinable()) throw std::bad_alloc();
  return thread;
}

template <class T, class H>
void append(std::vector<T*>& list, const H* handles, uint32_t count) {
  for (uint32_t i = 0; i < count; ++i) list.push_back(std::remove_const_t<T>::from(handles[i]));
}

}  // namespace

Queue::Queue(const HostMemory& memory, DeviceContext& owner, ThreadPool& workers)
    : Handle(memory), device_(owner), executor_(owner, workers) {
  thread_ = start_thread_without_signals([this] { work(); });
}

Queue::~Queue() {
  {
    const std::scoped_lock lock(mutex_);
    quit_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

VkResult Queue::submit(std::span<const VkSubmitInfo> batches, Fence* fence) {
  std::deque<Submission> submissions;
  for (const VkSubmitInfo& batch : batches) {
    Submission& submission = submissions.emplace_back();
    append(submission.waits, batch.pWaitSemaphores, batch.waitSemaphoreCount);
    append(submission.commands, batch.pCommandBuffers, batch.commandBufferCount);
    append(submission.signals, batch.pSignalSemaphores, batch.signalSemaphoreCount);
  }
  if (submissions.empty()) submissions.emplace_back();
  submissions.back().fence = fence;
  return push(std::move(submissions));
}

// No resource can be sparse, so that only the semaphores and the fence are left.
VkResult Queue::bind_sparse(std::span<const VkBindSparseInfo> batches, Fence* fence) {
  std::deque<Submission> submissions;
  for (const VkBindSparseInfo& batch : batches) {
    Submission& submission = submissions.emplace_back();
    append(submission.waits, batch.pWaitSemaphores, batch.waitSemaphoreCount);
    append(submission.signals, batch.pSignalSemaphores, batch.signalSemaphoreCount);
  }
  if (submissions.empty()) submissions.emplace_back();
  submissions.back().fence = fence;
  return push(std::move(submissions));
}

VkResult Queue::push(std::deque<Submission> submissions) {
  if (device_.lost) return VK_ERROR_DEVICE_LOST;
  {
    const std::scoped_lock lock(mutex_);
    for (Submission& submission : submissions) submission.labels = labels_;
    const size_t before = submissions_.size();
    try {
      for (Submission& submission : submissions) submissions_.push_back(std::move(submission));
    } catch (...) {
      submissions_.resize(before);
      throw;
    }
    const std::scoped_lock sync(device_.sync.mutex);
    pending_ += submissions.size();
  }
  wake_.notify_one();
  return VK_SUCCESS;
}

VkResult Queue::wait_idle() {
  std::unique_lock lock(device_.sync.mutex);
  device_.sync.changed.wait(lock, [this] { return pending_ == 0; });
  return device_.lost ? VK_ERROR_DEVICE_LOST : VK_SUCCESS;
}

void Queue::work() {
  const FpEnvironment environment;
  for (;;) {
    Submission submission;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return quit_ || !submissions_.empty(); });
      if (submissions_.empty()) return;
      submission = std::move(submissions_.front());
      submissions_.pop_front();
    }
    wait_for(submission.waits);
    execute(submission);
    finish(submission);
  }
}

void Queue::wait_for(const std::vector<Semaphore*>& semaphores) {
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
  } catch (const std::bad_alloc&) {
    log_error("out of memory on the queue");
    result = VK_ERROR_OUT_OF_HOST_MEMORY;
  }
  if (result == VK_SUCCESS) return;
  // The submission was accepted long ago: all that is left to say is that the device is lost.
  const std::scoped_lock lock(device_.sync.mutex);
  device_.lost = true;
}

// Also on a lost device: nobody may wait for ever.
void Queue::finish(const Submission& submission) {
  const std::scoped_lock lock(device_.sync.mutex);
  for (Semaphore* semaphore : submission.signals) semaphore->signaled = true;
  if (submission.fence != nullptr) submission.fence->signaled = true;
  --pending_;
  device_.sync.changed.notify_all();
}

void Queue::begin_label(const char* name) {
  const std::scoped_lock lock(mutex_);
  labels_.emplace_back(name);
}

void Queue::end_label() {
  const std::scoped_lock lock(mutex_);
  if (!labels_.empty()) labels_.pop_back();
}

}  // namespace lapilli
