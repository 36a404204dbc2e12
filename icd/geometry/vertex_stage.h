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
  // Starts a list of triangles, whose vertices are counted from 0 on.
  void begin_list();
  // From here on vertices belong to draws with these bindings and resources; run() has been called for those before.
  // False: out of memory.
  bool begin(const DrawCall& draw, ExecutionLimits& limits);
  // The same for other resources only, of a program that reads none once per vertex: batches go on.
  void change_resources(const DrawCall& draw);
  // Turns vertex indices (firstVertex or vertexOffset included) into their numbers in the list. A vertex that was there
  // before since begin() is not run again unless another one has taken its place in the table. `instance`:
  // firstInstance included. At most kMostVertices in a list. Returns how many are new.
  uint32_t add(uint32_t instance, std::span<uint32_t> vertices);
  // The same for vertices that are known to be distinct.
  void add_distinct(uint32_t instance, std::span<uint32_t> vertices);
  // Runs the vertices that were added since begin() and appends them to the chunk.
  void run(const SetupState& state, BinChunk& chunk);
  const ClipInputs& inputs() const { return inputs_; }  // of the list

  static constexpr uint32_t kMostVertices = 1u << 14;

 private:
  void make_table();

  struct alignas(64) Line {
    float value[16];
  };

  // The slots from `first` on, up to the next one's, are of draws with these resources.
  struct Part {
    const ResourceTable* resources;
    uint32_t first;
  };
  void prepare_lanes(uint32_t first, uint32_t lanes, size_t& part);

  const DrawCall* draw_ = nullptr;
  ExecutionLimits* limits_ = nullptr;
  Execution execution_;
  BinArray<Part> parts_;  // since begin()
  uint32_t first_ = 0;    // in the list, of the vertices since begin()
  // Of those: vertex and instance index. With a table there is room for kMostVertices.
  BinArray<uint32_t> vertex_, instance_;
  // By the low bits of a vertex index: the slot (place in vertex_) that it may have. What vertex_ says of it decides,
  // so that nothing has to be cleared. Made with the first indexed draw.
  std::vector<uint16_t> last_slot_;
  uint32_t instance_first_ = 0;  // slot from which on all have the present instance and resources
  ClipInputs inputs_;            // of the list
  VertexBatch batch_{};
  std::vector<Line> outputs_;  // [slot][64 lanes]
};

}  // namespace lapilli
