// Vertex processing of one worker: collects the distinct vertices of some primitives, runs the vertex program over full
// batches, transforms the results to the framebuffer.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/setup.h"
#include "shader/program.h"

namespace lapilli {

class VertexStage {
 public:
  // Starts a draw; vertices of earlier ones are forgotten. False: out of memory.
  bool begin(const DrawCall& draw, ExecutionLimits& limits);
  // Vertices added from here on belong to this instance (relative to firstInstance).
  void begin_instance(uint32_t instance);
  // Slot of the vertex with this index (vertexOffset or firstVertex included).
  uint32_t add(uint32_t vertex_index);
  // Runs all vertices that were added and appends them to the chunk.
  void run(const SetupState& state, BinChunk& chunk);
  const PostVertex& vertex(uint32_t slot) const { return vertices_[slot]; }
  // Of slot 0 in the chunk's vertices.
  uint32_t first_vertex() const { return first_vertex_; }

 private:
  struct Lookup {
    uint32_t index, stamp, slot;
  };
  struct alignas(64) Line {
    float value[16];
  };
  struct Key {
    uint32_t index, instance;
  };

  const DrawCall* draw_ = nullptr;
  Execution execution_;
  std::vector<Lookup> lookup_;  // open addressing; entries of other instances are told by their stamp
  uint32_t stamp_ = 0;
  uint32_t entries_ = 0;  // in use with the present stamp
  uint32_t instance_ = 0;
  std::vector<Key> keys_;  // by slot
  std::vector<PostVertex> vertices_;
  uint32_t first_vertex_ = 0;
  std::vector<Line> outputs_;  // [slot][64 lanes]
};

}  // namespace lapilli
