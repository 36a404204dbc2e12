// The geometry of a pass: draws are cut into chunks of primitives, which all threads work on; their order is kept by
// index.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/thread_pool.h"
#include "geometry/bins.h"
#include "geometry/primitives.h"
#include "geometry/vertex_stage.h"

namespace lapilli {

// Bins of a set: it ends with the chunk that exceeds this. Each set costs a load and a store of the tiles.
constexpr uint64_t kSetBytes = 48u << 20;

class FrontEnd {
 public:
  explicit FrontEnd(ThreadPool& pool);
  ~FrontEnd();

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
  struct Worker;

  void plan();
  bool plan_chunk();
  bool seek_triangle();
  void enter_draw();
  bool may_skip(const DrawCall& draw);
  void fill(const Chunk& plan, Worker& worker, BinChunk& out);
  void fill_list(std::span<const WorkItem> items, Worker& worker, BinChunk& out);
  void add_triangles(const WorkItem& item, uint32_t first, Worker& worker) const;

  ThreadPool& pool_;
  std::span<const DrawCall> draws_;
  TileGrid grid_;
  PixelRect area_;
  ExecutionLimits* limits_ = nullptr;
  uint32_t chunk_triangles_ = 0;

  // Where the next work item starts: a triangle of a run of an instance of a draw.
  uint32_t draw_ = 0, instance_ = 0;
  uint32_t after_run_ = 0;  // next_run's position
  VertexRun run_;
  uint32_t triangle_ = 0, run_triangles_ = 0;
  bool has_triangles_ = false;  // the draw, as far as it is known
  // The state asked for last: whether none of its triangles has a pixel.
  const DrawState* known_state_ = nullptr;
  bool state_has_no_pixel_ = false;

  std::vector<WorkItem> items_;
  std::vector<Chunk> plans_;
  size_t done_plans_ = 0;
  std::vector<BinChunk> chunks_;
  std::vector<std::unique_ptr<Worker>> workers_;
};

}  // namespace lapilli
