// One thread's work on a tile: coverage, early depth and visibility in the order of the API, then shading.
#pragma once

#include <span>
#include <vector>

#include "raster/lane_triangles.h"
#include "raster/quad_packer.h"
#include "raster/setup_ring.h"
#include "raster/small_triangle.h"
#include "raster/tile_depth.h"
#include "raster/tile_storage.h"
#include "raster/visibility.h"

namespace lapilli {

// The pass at hand, for all threads.
struct TilePass {
  std::span<const DrawCall> draws;
  std::span<const PassAttachment> attachments;
  uint32_t samples = 1;
  PixelRect area;  // pixels that are loaded, drawn to and stored
  TileGrid grid;
  ExecutionLimits* limits = nullptr;
  bool defer = true, judge_blocks = true;  // what LAPILLI_KEEP does not switch off
};

class TileWorker {
 public:
  // False: out of memory.
  bool begin_pass(const TilePass& pass);
  bool draw_tile(uint32_t tile, const BinSet& set, bool first_set);

 private:
  // What happens to the pixels of a draw that pass.
  enum class Shading : uint8_t { none, in_order, deferred };
  struct CurrentDraw {
    const DrawCall* call = nullptr;
    const BinRun* run = nullptr;
    Shading shading = Shading::none;
    bool early_depth = false, late_depth = false, depth_write = false;
    bool counts = false;    // samples that pass are counted here, not by the program
    bool tallies = false;   // somebody wants the numbers below
    bool by_pixel = false;  // tiny triangles are drawn pixel by pixel
    VkCompareOp compare = VK_COMPARE_OP_ALWAYS;
    uint64_t covered = 0, passed = 0;  // pixels
    uint64_t judged_blocks = 0;        // without a depth test of their own
  };
  struct CurrentTriangle {
    const BinChunk* chunk = nullptr;
    uint32_t index = 0;
    uint32_t number = 0;                    // in visibility_; 0: not there
    const TriangleSetup* shaded = nullptr;  // for batches; null: not made
    bool has_setup = false;                 // setup_ is its
  };
  // Pixels of one triangle in one block that are seen.
  struct Pending {
    uint64_t pixels;  // of the block, or of the quad in bits 0 to 3
    uint32_t triangle;
    uint8_t block;
    uint8_t quad;  // of the block, or one of these
  };
  static constexpr uint8_t kManyQuads = 0xFF;
  static constexpr uint8_t kManyTriangles = 0xFE;  // of the same draw; `triangle` is one of them

  void draw_triangles(uint32_t tile, const BinSet& set);
  void list_triangles(uint32_t tile, const BinSet& set);
  void begin_draw(const BinRun& run);
  void end_draw();
  void report_draw();
  void begin_depth();
  void set_up_group(size_t first, size_t count);
  void draw_triangle();
  void draw_small(uint32_t place);
  void draw_tiny(uint32_t place);
  double depth_at_first_vertex(uint32_t place) const;
  void count_covered(const TileCoverage::Blocks& blocks);
  BlockVerdicts judge_blocks(const PixelRect& rect);
  void cover_blocks(uint64_t blocks);
  void draw_block(uint32_t block, uint64_t pixels, bool always);
  uint64_t test_depth(uint32_t block, uint64_t pixels);
  void shade_in_order(uint32_t block, uint64_t pixels);
  // The block's 64 depths, made if they are not there yet.
  float* depths_of(uint32_t block) {
    return depth_.owner(block) == TileDepth::kPlane ? depth_.plane(block) : make_depths(block);
  }
  float* make_depths(uint32_t block);
  const TriangleSetup& setup();
  void keep_pending_setups();
  uint32_t number() { return triangle_.number != 0 ? triangle_.number : add_number(); }
  uint32_t add_number();
  void store();

  void resolve();
  void collect_pending();
  void collect_quads(uint32_t block, uint64_t pixels);
  void shade(const DrawCall& draw, std::span<const Pending> pending);

  const TilePass* pass_ = nullptr;
  const BlockDepthFunctions* block_depth_ = nullptr;
  const SmallTriangleFunctions* small_triangles_ = nullptr;
  TileStorage storage_;
  TileDepth depth_;
  Visibility visibility_;
  SetupRing setups_;
  uint32_t first_pending_ = 0;  // what setups_ had made when nothing was pending in packer_
  QuadPacker packer_;

  // The tile.
  uint32_t tile_x_ = 0, tile_y_ = 0;
  PixelRect tile_rect_;      // what of it lies in the area, from the tile's origin
  uint64_t valid_[64] = {};  // the same by block
  size_t depth_attachment_ = 0;
  bool depth_begun_ = false;  // depth_ holds this tile

  CurrentDraw draw_;
  CurrentTriangle triangle_;
  TriangleSetup setup_;
  TriangleDepth triangle_depth_;
  TriangleGroup group_;
  const BinRun* tiny_run_ = nullptr;  // whose depth range group_.tiny_depth has
  TileCoverage coverage_;
  BlockRanges triangle_ranges_;
  LaneTriangles lane_triangles_;

  struct Listed {
    const BinChunk* chunk;
    uint32_t index;  // in chunk->triangles
  };
  std::vector<Listed> listed_;
  // A draw, and those after it that may share batches with it.
  struct DeferredDraw {
    const DrawCall* call;
    uint32_t first;  // number of a triangle; the others follow
  };
  std::vector<DeferredDraw> deferred_draws_;  // TileTriangle::draw
  std::vector<Pending> pending_, sorted_;
  std::vector<uint32_t> draw_end_;
};

}  // namespace lapilli
