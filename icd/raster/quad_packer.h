// Packs covered quads of many triangles into batches of 16 and runs the fragment program over them.
#pragma once

#include <cstdint>

#include "geometry/draw_call.h"
#include "image/tile.h"
#include "raster/coverage.h"
#include "shader/program.h"

namespace lapilli {

// What one pixel sees stays in order: it is never twice in one batch, and batches run in the order of its quads.
class QuadPacker {
 public:
  void begin_pass(ExecutionLimits& limits);
  // Starts a tile: its storage and the framebuffer position of its first pixel.
  void begin_tile(const TilePlanes& planes, uint32_t tile_x, uint32_t tile_y);
  // From here on quads belong to `draw`. Runs what is pending of the draw before, unless it may share batches.
  // `count_samples`: the program counts.
  void begin_draw(const DrawCall& draw, bool count_samples);
  // Adds pixels of a block, by its bit. The triangle must stay where it is until nothing is pending any more.
  void add(const TriangleSetup& triangle, uint32_t block, uint64_t pixels);
  // Adds the pixels (not 0) of one quad of a block, as bits 0 to 3.
  void add_quad(const TriangleSetup& triangle, uint32_t block, uint32_t quad, uint64_t pixels);
  // Adds pixels of a block, each of its own triangle, and runs them.
  void add_lanes(const LaneTriangles& triangles, uint32_t block, uint64_t pixels);
  // Runs the pending quads.
  void flush();
  bool has_pending() const { return count_ != 0; }
  // Ends the draw and the tile.
  void end_tile();
  bool out_of_memory() const { return out_of_memory_; }

 private:
  void add_block(const TriangleSetup& triangle, uint32_t block, uint64_t pixels);
  void run_block(uint32_t block, uint64_t pixels);
  void run(FragmentBatch& batch, uint64_t lanes);

  ExecutionLimits* limits_ = nullptr;
  const DrawCall* draw_ = nullptr;  // or one that may share batches with it
  bool prepared_ = false;           // the draw's program
  bool out_of_memory_ = false;
  Execution execution_;
  FragmentBatch batch_{};
  FragmentBatch block_batch_{};  // of one block: of one triangle, or with lane_triangles
  uint32_t count_ = 0;           // quads in batch_
  uint64_t lanes_ = 0;           // covered pixels in batch_
  uint32_t tile_x_ = 0, tile_y_ = 0;
  uint64_t samples_passed_ = 0;
  // The number of the batch that a block and a quad of the tile were last put into, and which pixels of the quad.
  uint32_t batch_number_ = 1;
  uint32_t block_last_[64] = {};
  struct LastQuad {
    uint32_t batch = 0, pixels = 0;
  };
  LastQuad quad_last_[kTileQuads];
};

}  // namespace lapilli
