// The executable form of a Code, and how to run it. No executable memory: a program is data.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "shader/batch.h"
#include "shader/ir.h"
#include "shader/resources.h"

namespace lapilli {

struct Program;  // interpreter/program_impl or program.cpp: ops with their handlers for the chosen SIMD target

struct ProgramDeleter {
  void operator()(Program* program) const;
};
using ProgramPtr = std::unique_ptr<Program, ProgramDeleter>;

// Runs the passes (dead code, folding, forwarding, scheduling), allocates registers and resolves handlers for the SIMD
// target in force (base/simd_dispatch.h). Fails with VK_ERROR_OUT_OF_HOST_MEMORY, or VK_ERROR_UNKNOWN where the program
// needs more than the limits.
Result<ProgramPtr> assemble(Code code);

std::string disassemble(const Program& program);
uint32_t register_count(const Program& program);  // of 256 bytes each
// Of the section that runs once per draw, and of one batch in which every op runs once; in the unit of ops.def.
uint32_t once_cost(const Program& program);
uint32_t lane_cost(const Program& program);
const Code& source(
    const Program& program);  // after the passes; tables (attributes, resources, workgroup size) as built

// Of one pass or dispatch. `expired` is set when the time limit of an endless loop has passed; the queue then reports
// VK_ERROR_DEVICE_LOST.
struct ExecutionLimits {
  std::chrono::steady_clock::time_point deadline = std::chrono::steady_clock::time_point::max();
  std::atomic<bool> expired{false};
  const uint64_t serial = next_serial();  // tells one pass or dispatch from all others; never 0

  bool read_clock();  // whether the time has passed; sets `expired`

 private:
  static uint64_t next_serial();
};

// The registers of one worker for one program and one draw. Constants are written when the program changes; what is
// the same in a whole draw is computed before the first batch after prepare().
class Execution {
 public:
  Execution();
  ~Execution();
  Execution(const Execution&) = delete;
  Execution& operator=(const Execution&) = delete;

  // Binds program and resources; keeps its memory for the next call. False: out of memory. What a ResourceTable says
  // may not change while a pass (one ExecutionLimits) runs: to prepare the same again costs nothing.
  bool prepare(const Program& program, const ResourceTable& resources, ExecutionLimits* limits);
  // For batches of several draws: only these lanes get what is the same in a whole draw, of the resources prepared
  // last. After it, all that a batch to be run has, prepare() begins anew.
  void prepare_lanes(uint32_t first, uint32_t end);
  // Run one batch. `lanes`: lanes with a vertex, invocation or covered sample. Fragments: helper lanes are the other
  // lanes of covered quads.
  void run_vertices(const VertexBatch& batch, uint64_t lanes);
  void run_fragments(const FragmentBatch& batch, uint64_t lanes);
  // A whole workgroup, barriers and all: in batches of 64 invocations, in order up to the next barrier.
  void run_workgroup(const uint32_t workgroup[3], const uint32_t num_workgroups[3]);
  // For tests: the register that holds `reg` of the source code after a run is not defined; use store_output /
  // store_buffer.

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lapilli
