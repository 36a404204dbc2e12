// Compute dispatch: workgroups over all threads. Specification: chapter "Dispatching Commands".
#pragma once

#include "base/thread_pool.h"
#include "shader/program.h"

namespace lapilli {

// Runs groups[0] x groups[1] x groups[2] workgroups. False: out of memory.
bool dispatch(ThreadPool& pool, const Program& program, const ResourceTable& resources, const uint32_t groups[3],
              ExecutionLimits* limits);

}  // namespace lapilli
