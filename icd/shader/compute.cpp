// Compute dispatch: workgroups are cut into chunks, chunks go to threads; a workgroup runs on one of them.
#include "shader/compute.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <new>

namespace lapilli {
namespace {

// Chunks for each worker: enough that none waits long for the last one.
constexpr uint64_t kChunksPerWorker = 256;

struct Worker {
  Execution execution;
  bool prepared = false;
};

bool expired(const ExecutionLimits* limits) {
  return limits != nullptr && limits->expired.load(std::memory_order_relaxed);
}

void run_workgroup(Execution& execution, uint64_t number, const uint32_t groups[3]) {
  const uint64_t row = number / groups[0];
  const uint32_t workgroup[3] = {static_cast<uint32_t>(number % groups[0]), static_cast<uint32_t>(row % groups[1]),
                                 static_cast<uint32_t>(row / groups[1])};
  execution.run_workgroup(workgroup, groups);
}

}  // namespace

bool dispatch(ThreadPool& pool, const Program& program, const ResourceTable& resources, const uint32_t groups[3],
              ExecutionLimits* limits) {
  // At most 65535^3 workgroups (VkPhysicalDeviceLimits::maxComputeWorkGroupCount).
  const uint64_t total = uint64_t{groups[0]} * groups[1] * groups[2];
  if (total == 0) return true;

  const std::unique_ptr<Worker[]> workers(new (std::nothrow) Worker[pool.size()]);
  if (workers == nullptr) return false;
  const uint64_t chunk = (total - 1) / (pool.size() * kChunksPerWorker) + 1;
  const size_t chunks = static_cast<size_t>((total - 1) / chunk + 1);
  std::atomic<bool> out_of_memory{false};
  pool.parallel_for(chunks, [&](size_t index, unsigned number) {
    Worker& worker = workers[number];
    if (!worker.prepared) {
      worker.prepared = worker.execution.prepare(program, resources, limits);
      if (!worker.prepared) out_of_memory.store(true, std::memory_order_relaxed);
    }
    if (!worker.prepared) return;
    const uint64_t first = index * chunk;
    const uint64_t end = std::min(first + chunk, total);
    for (uint64_t group = first; group < end && !expired(limits); ++group) {
      run_workgroup(worker.execution, group, groups);
    }
  });
  return !out_of_memory.load(std::memory_order_relaxed);
}

}  // namespace lapilli
