// Packs covered quads of many triangles into batches of 16 and runs the fragment program over them, in order.
#pragma once

#include <cstdint>

#include "image/tile.h"
#include "raster/coverage.h"
#include "shader/program.h"

namespace lapilli {

class QuadPacker {
 public:
  // Starts a tile: its storage and the framebuffer position of its first pixel.
  void begin_tile(const TilePlanes& planes, uint32_t tile_x, uint32_t tile_y);
  // From here on quads belong to `draw`. Runs what is pending of the draw before. False: out of memory.
  bool begin_draw(const DrawCall& draw, ExecutionLimits& limits);
  // Adds the covered quads of a block. The triangle must stay where it is until the next flush.
  void add(const TriangleSetup& triangle, const BlockCoverage& block);
  // Runs the pending quads.
  void flush();

 private:
  void add_quad(const TriangleSetup& triangle, uint32_t quad, uint32_t x, uint32_t y, uint64_t pixels);

  const DrawCall* draw_ = nullptr;
  Execution execution_;
  FragmentBatch batch_{};
  uint32_t count_ = 0;  // quads in batch_
  uint64_t lanes_ = 0;  // covered pixels in batch_
  uint32_t tile_x_ = 0, tile_y_ = 0;
  uint64_t samples_passed_ = 0;
  // The number of the batch that a quad of the tile was last put into: a pixel is never twice in one batch.
  uint32_t batch_number_ = 1;
  uint32_t last_batch_[kTileQuads] = {};
};

}  // namespace lapilli
