// Vertex processing of one worker: collects the distinct vertices of some triangles, runs the vertex program over full
// batches, transforms the results to the framebuffer.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/setup.h"
#include "shader/program.h"

namespace lapilli {

class VertexStage {
 public:
  // Starts a list of triangles of draws with the same state, bindings and resources. False: out of memory.
  bool begin(const DrawCall& draw, ExecutionLimits& limits);
  // Turns vertex indices (firstVertex or vertexOffset included) into slots: consecutive numbers from 0 on. A vertex
  // that was there before is not run again unless it has been too long ago. `instance`: firstInstance included. At most
  // kMostVertices between begin() and run(). Returns how many are new.
  uint32_t add(uint32_t instance, std::span<uint32_t> vertices);
  // The same for vertices that are known to be distinct.
  void add_distinct(uint32_t instance, std::span<uint32_t> vertices);
  // Runs all vertices that were added and appends them to the chunk.
  void run(const SetupState& state, BinChunk& chunk);
  ClipPositions positions() const { return {positions_.data()}; }

  static constexpr uint32_t kMostVertices = 1u << 14;

 private:
  struct alignas(64) Line {
    float value[16];
  };

  const DrawCall* draw_ = nullptr;
  Execution execution_;
  // By slot: vertex and instance index.
  BinArray<uint32_t> vertex_, instance_;
  // By the low bits of a vertex index: the slot that it may be in. What `vertex_` says of the slot decides, so that
  // nothing has to be cleared.
  std::vector<uint16_t> last_slot_;
  uint32_t instance_first_ = 0;  // slot from which on all have the present instance
  BinArray<float> positions_;    // ClipPositions
  std::vector<Line> outputs_;    // [slot][64 lanes]
};

}  // namespace lapilli
