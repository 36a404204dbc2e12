// The geometry of a pass: draws are cut into chunks of primitives, which all threads work on; their order is kept by
// index.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/thread_pool.h"
#include "geometry/bins.h"
#include "geometry/primitives.h"
#include "geometry/vertex_stage.h"

namespace lapilli {

class FrontEnd {
 public:
  explicit FrontEnd(ThreadPool& pool);

  // Starts a pass. `area`: pixels that may be drawn to, inside [0, 64*columns) x [0, 64*rows).
  void begin(std::span<const DrawCall> draws, const TileGrid& grid, const PixelRect& area, ExecutionLimits& limits);
  // Makes the next set of bins; it is valid until the next call. Its memory is bounded: a pass with many triangles has
  // many sets. False: out of memory. A pass without a triangle gives one empty set.
  bool next(BinSet& set);

 private:
  // Consecutive triangles of one run of one instance of one draw.
  struct WorkItem {
    uint32_t draw, instance;
    VertexRun run;
    uint32_t first_triangle, triangles;
  };
  struct Chunk {
    uint32_t first_item, last_item;  // [first, last) in items_
  };

  void enter_draw();
  bool plan_chunk();
  bool take_triangles(uint32_t most, WorkItem& item);
  void fill(const Chunk& plan, VertexStage& stage, BinChunk& out);

  ThreadPool& pool_;
  std::span<const DrawCall> draws_;
  TileGrid grid_;
  PixelRect area_;
  ExecutionLimits* limits_ = nullptr;
  uint32_t chunk_triangles_ = 0;

  // Where the next work item starts.
  uint32_t draw_ = 0, instance_ = 0, run_ = 0, triangle_ = 0;
  std::vector<VertexRun> runs_;

  std::vector<WorkItem> items_;
  std::vector<Chunk> plans_;
  std::vector<BinChunk> chunks_;
  std::vector<VertexStage> stages_;  // one per worker
};

}  // namespace lapilli
