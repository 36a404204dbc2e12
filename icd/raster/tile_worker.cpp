// From bins to visible pixels: what happens to a triangle in a tile before it is shaded.
#include "raster/tile_worker.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstring>
#include <limits>
#include <new>

namespace lapilli {
namespace {

constexpr int32_t kTile = static_cast<int32_t>(kTileSize);
constexpr int32_t kBlock = static_cast<int32_t>(kBlockSize);
// What a depth test of a block would cost as ops, in the unit of the ledger.
uint64_t depth_test_cost() {
  return uint64_t{kBatchLanes} * (op_info(Opcode::frag_depth).cost + op_info(Opcode::depth_test).cost);
}

constexpr size_t kTrianglesPerLook = 1024;  // at the time limit
constexpr DepthRange kAnyDepth = {-std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity()};

}  // namespace

bool TileWorker::begin_pass(const TilePass& pass) {
  pass_ = &pass;
  block_depth_ = &block_depth_functions();
  small_triangles_ = &small_triangle_functions();
  packer_.begin_pass(*pass.limits);
  depth_attachment_ = 0;
  while (depth_attachment_ < pass.attachments.size() && !pass.attachments[depth_attachment_].is_depth) {
    ++depth_attachment_;
  }
  try {
    storage_.reserve(pass.attachments, pass.samples);
  } catch (const std::bad_alloc&) {
    return false;
  }
  return true;
}

bool TileWorker::draw_tile(uint32_t tile, const BinSet& set, bool first_set) {
  tile_x_ = tile % pass_->grid.columns * kTileSize;
  tile_y_ = tile / pass_->grid.columns * kTileSize;
  const int32_t x = static_cast<int32_t>(tile_x_);
  const int32_t y = static_cast<int32_t>(tile_y_);
  const PixelRect rect = intersect(pass_->area, {x, y, x + kTile, y + kTile});
  if (rect.empty()) return true;
  const bool touched = std::any_of(set.chunks.begin(), set.chunks.end(),
                                   [&](const BinChunk& chunk) { return !chunk.tile(tile).empty(); });
  if (!touched && !first_set) return true;

  const TileArea area = {static_cast<uint32_t>(rect.x0), static_cast<uint32_t>(rect.y0), static_cast<uint32_t>(rect.x1),
                         static_cast<uint32_t>(rect.y1)};
  tile_rect_ = {rect.x0 - x, rect.y0 - y, rect.x1 - x, rect.y1 - y};
  storage_.begin_tile(area, first_set, set.last);
  depth_begun_ = false;
  try {
    if (touched) draw_triangles(tile, set);
  } catch (const std::bad_alloc&) {
    return false;
  }
  store();
  return !packer_.out_of_memory();
}

void TileWorker::draw_triangles(uint32_t tile, const BinSet& set) {
  if (tile_rect_ == PixelRect{0, 0, kTile, kTile}) {
    std::fill(std::begin(valid_), std::end(valid_), kAllBits);
  } else {
    for (uint32_t block = 0; block < 64; ++block) valid_[block] = pixels_in_rect(tile_rect_, block);
  }
  visibility_.begin_tile();
  setups_.begin_tile();
  first_pending_ = 0;
  deferred_draws_.clear();
  draw_ = {};
  TilePlanes planes;
  for (size_t i = 0; i < pass_->attachments.size(); ++i) {
    const PassAttachment& attachment = pass_->attachments[i];
    (attachment.is_depth ? planes.depth : planes.color[attachment.color_index]) = storage_.plane(i, 0);
  }
  packer_.begin_tile(planes, tile_x_, tile_y_);
  list_triangles(tile, set);
  for (size_t first = 0; first < listed_.size(); first += TriangleGroup::kMost) {
    const size_t count = std::min<size_t>(listed_.size() - first, TriangleGroup::kMost);
    set_up_group(first, count);
    for (uint32_t place = 0; place < count; ++place) {
      const auto& [chunk, index] = listed_[first + place];
      const BinRun& run = chunk->run_of(chunk->triangles[index]);
      if (&run != draw_.run) begin_draw(run);
      triangle_ = {chunk, index, 0, nullptr, false};
      if (draw_.by_pixel && (group_.tiny >> place & 1) != 0) {
        draw_tiny(place);
      } else {
        (group_.small >> place & 1) != 0 ? draw_small(place) : draw_triangle();
      }
    }
    if (first % kTrianglesPerLook == 0 && pass_->limits->read_clock()) break;
  }
  end_draw();
  resolve();
  packer_.end_tile();
}

// The tile's triangles of all chunks. Few of a chunk lie in one tile: without reading ahead each would wait for memory.
void TileWorker::list_triangles(uint32_t tile, const BinSet& set) {
  listed_.clear();
  for (const BinChunk& chunk : set.chunks) {
    for (const uint32_t index : chunk.tile(tile)) {
      __builtin_prefetch(&chunk.triangles[index]);
      listed_.push_back({&chunk, index});
    }
  }
}

// Reads the next group's vertices ahead.
void TileWorker::set_up_group(size_t first, size_t count) {
  const size_t next_end = std::min(listed_.size(), first + 2 * TriangleGroup::kMost);
  for (size_t i = first + TriangleGroup::kMost; i < next_end; ++i) {
    const auto& [chunk, index] = listed_[i];
    for (const uint16_t v : chunk->triangles[index].v) __builtin_prefetch(&chunk->vertices[v]);
  }
  for (uint32_t place = 0; place < count; ++place) {
    const auto& [chunk, index] = listed_[first + place];
    group_.put(place, *chunk, chunk->triangles[index]);
  }
  tiny_run_ = nullptr;
  small_triangles_->set_up(group_, static_cast<uint32_t>(count), tile_x_, tile_y_, tile_rect_);
}

void TileWorker::begin_draw(const BinRun& run) {
  const DrawCall& call = pass_->draws[run.draw];
  if (draw_.call == &call) {
    draw_.run = &run;
    return;
  }
  end_draw();
  const GraphicsPrograms& programs = *call.state->programs;
  draw_ = {};
  draw_.call = &call;
  draw_.run = &run;
  draw_.early_depth = programs.early_depth;
  draw_.late_depth = programs.depth_test && !programs.early_depth;
  draw_.depth_write = programs.depth_write;
  draw_.compare = programs.depth_compare;
  if (!programs.fragment_reads_nothing || draw_.late_depth) {
    draw_.shading = programs.deferrable && pass_->defer ? Shading::deferred : Shading::in_order;
  }
  draw_.counts = draw_.shading != Shading::in_order && call.samples_passed != nullptr;
  draw_.tallies = draw_.counts || call.ledger != nullptr;
  draw_.by_pixel = draw_.shading != Shading::in_order && !draw_.tallies && !run.depth_bias;
  if (programs.depth_test) begin_depth();
}

void TileWorker::end_draw() {
  // The raster's depth tests have to see what the program's have stored.
  if (draw_.late_depth) packer_.flush();
  if (draw_.tallies) report_draw();
}

void TileWorker::report_draw() {
  const DrawCall& call = *draw_.call;
  if (draw_.counts && draw_.passed != 0) {
    std::atomic_ref(*call.samples_passed).fetch_add(draw_.passed, std::memory_order_relaxed);
  }
  if (call.ledger == nullptr) return;
  add_to_ledger(call.ledger, Removal::blocks, draw_.judged_blocks, draw_.judged_blocks * depth_test_cost());
  if (draw_.shading == Shading::none) return;
  // What deferred shading runs all the same it subtracts later.
  const uint64_t hidden = draw_.covered - (draw_.shading == Shading::in_order ? draw_.passed : 0);
  add_to_ledger(call.ledger, Removal::hidden, hidden, hidden * lane_cost(*call.state->programs->fragment));
}

void TileWorker::begin_depth() {
  if (depth_begun_ || depth_attachment_ == pass_->attachments.size()) return;
  depth_begun_ = true;
  float* const plane = reinterpret_cast<float*>(storage_.plane(depth_attachment_, 0));
  if (storage_.begins_cleared(depth_attachment_)) {
    float clear;
    std::memcpy(&clear, &pass_->attachments[depth_attachment_].clear, sizeof clear);
    depth_.begin_cleared(plane, clear);
  } else {
    storage_.fetch_all(depth_attachment_);
    depth_.begin_loaded(plane, valid_);
  }
}

// --- one triangle ---------------------------------------------------------------------------------------------------

void TileWorker::draw_triangle() {
  const BinTriangle& triangle = triangle_.chunk->triangles[triangle_.index];
  const int32_t x = static_cast<int32_t>(tile_x_);
  const int32_t y = static_cast<int32_t>(tile_y_);
  PixelRect rect = intersect({triangle.x0 - x, triangle.y0 - y, triangle.x1 - x, triangle.y1 - y}, tile_rect_);
  if (rect.empty()) return;
  // A block is whole if all of it that can be seen is covered.
  if (rect.x0 == tile_rect_.x0) rect.x0 &= -kBlock;
  if (rect.y0 == tile_rect_.y0) rect.y0 &= -kBlock;
  if (rect.x1 == tile_rect_.x1) rect.x1 = (rect.x1 + kBlock - 1) & -kBlock;
  if (rect.y1 == tile_rect_.y1) rect.y1 = (rect.y1 + kBlock - 1) & -kBlock;
  if (!coverage_.begin(make_edges(*triangle_.chunk, triangle), x, y, rect)) return;
  const TileCoverage::Blocks blocks = coverage_.blocks();
  if (blocks.touched == 0) return;
  if (draw_.call->ledger != nullptr) count_covered(blocks);
  BlockVerdicts verdicts{0, kAllBits};
  if (draw_.early_depth) {
    verdicts = judge_blocks(rect);
    if (draw_.tallies) {
      draw_.judged_blocks += static_cast<uint64_t>(std::popcount((verdicts.never | verdicts.always) & blocks.touched));
    }
  }
  const uint64_t seen = blocks.touched & ~verdicts.never;
  const uint64_t whole = seen & blocks.inside & verdicts.always;
  if (whole != 0) cover_blocks(whole);
  for_each_bit(seen & ~whole, [&](uint32_t block) {
    const bool inside = (blocks.inside >> block & 1) != 0;
    const uint64_t pixels = inside ? valid_[block] : coverage_.pixels(block) & valid_[block];
    if (pixels != 0) draw_block(block, pixels, (verdicts.always >> block & 1) != 0);
  });
}

// A small one, block by block.
void TileWorker::draw_small(uint32_t place) {
  const PixelRect rect = {group_.x0[place], group_.y0[place], group_.x1[place], group_.y1[place]};
  const bool deferred = draw_.shading == Shading::deferred;
  DrawSmallTriangle* const draw = small_triangles_->draw[draw_.compare];
  SmallTarget target;
  target.write_depth = draw_.depth_write;
  target.z0 = draw_.early_depth ? depth_at_first_vertex(place) : 0;
  target.min_depth = draw_.run->min_depth;
  target.max_depth = draw_.run->max_depth;
  target.number = visibility_.next_number();
  const uint32_t first_x = static_cast<uint32_t>(rect.x0) & -kBlockSize, end_x = static_cast<uint32_t>(rect.x1);
  const uint32_t first_y = static_cast<uint32_t>(rect.y0) & -kBlockSize, end_y = static_cast<uint32_t>(rect.y1);
  for (uint32_t y = first_y; y < end_y; y += kBlockSize) {
    for (uint32_t x = first_x; x < end_x; x += kBlockSize) {
      const uint32_t block = bit_of(x / kBlockSize, y / kBlockSize);
      if (draw_.early_depth) target.depths = depths_of(block);
      if (deferred) target.numbers = visibility_.mixed_pixels(block);
      const SmallDrawn drawn = draw(group_, place, x, y, pixels_in_rect(rect, block), target);
      if (draw_.tallies) {
        draw_.covered += static_cast<uint64_t>(std::popcount(drawn.covered));
        draw_.passed += static_cast<uint64_t>(std::popcount(drawn.passed));
      }
      if (drawn.passed == 0) continue;
      if (draw_.early_depth && draw_.depth_write) depth_.touch(block);
      if (deferred) number();
      if (draw_.shading == Shading::in_order) shade_in_order(block, drawn.passed);
    }
  }
}

// A tiny one, pixel by pixel: most cover one or two.
void TileWorker::draw_tiny(uint32_t place) {
  if (tiny_run_ != draw_.run) {
    tiny_run_ = draw_.run;
    small_triangles_->cover_tiny(group_, TriangleGroup::kMost, tiny_run_->min_depth, tiny_run_->max_depth);
  }
  for (uint32_t left = group_.tiny_covered[place]; left != 0; left &= left - 1) {
    const uint32_t pixel = static_cast<uint32_t>(std::countr_zero(left));
    const uint32_t x = static_cast<uint32_t>(group_.x0[place]) + pixel % 2;
    const uint32_t y = static_cast<uint32_t>(group_.y0[place]) + pixel / 2;
    const uint32_t block = bit_of(x / kBlockSize, y / kBlockSize), lane = bit_of(x % kBlockSize, y % kBlockSize);
    if (draw_.early_depth) {
      const float depth = group_.tiny_depth[pixel][place];
      float& stored = depths_of(block)[lane];
      if (!passes(draw_.compare, depth, stored)) continue;
      if (draw_.depth_write) {
        stored = depth;
        depth_.touch(block);
      }
    }
    if (draw_.shading == Shading::deferred) visibility_.mixed_pixels(block)[lane] = number();
  }
}

// With bias.
double TileWorker::depth_at_first_vertex(uint32_t place) const {
  if (!draw_.run->depth_bias) return group_.z[0][place];
  const BinTriangle& triangle = triangle_.chunk->triangles[triangle_.index];
  return make_depth_plane(*triangle_.chunk, triangle, make_edge_functions(*triangle_.chunk, triangle)).z0;
}

void TileWorker::count_covered(const TileCoverage::Blocks& blocks) {
  for_each_bit(blocks.touched, [&](uint32_t block) {
    const uint64_t pixels = coverage_.pixels(block) & valid_[block];
    draw_.covered += static_cast<uint64_t>(std::popcount(pixels));
  });
}

BlockVerdicts TileWorker::judge_blocks(const PixelRect& rect) {
  triangle_depth_ = triangle_depth(setup());
  if (!pass_->judge_blocks) return {};
  const DepthBounds bounds = depth_bounds(triangle_depth_, tile_x_, tile_y_);
  if (!bounds.known) return {};
  if (judge(draw_.compare, range_in_rect(bounds, rect), depth_.range()).never != 0) return {kAllBits, 0};
  return judge(draw_.compare, bounds, depth_.ranges(), triangle_ranges_);
}

// Whole blocks that are known to pass.
void TileWorker::cover_blocks(uint64_t blocks) {
  if (draw_.early_depth && draw_.depth_write) depth_.cover(blocks, number(), triangle_ranges_);
  if (draw_.tallies) {
    for_each_bit(blocks, [&](uint32_t b) { draw_.passed += static_cast<uint64_t>(std::popcount(valid_[b])); });
  }
  switch (draw_.shading) {
    case Shading::none:
      return;
    case Shading::deferred:
      return visibility_.cover(blocks, number());
    case Shading::in_order:
      for_each_bit(blocks, [&](uint32_t block) { shade_in_order(block, valid_[block]); });
  }
}

// Pixels of a block; `always`: known to pass.
void TileWorker::draw_block(uint32_t block, uint64_t pixels, bool always) {
  if (draw_.early_depth && (!always || draw_.depth_write)) {
    pixels = test_depth(block, pixels);
    if (pixels == 0) return;
  }
  if (draw_.tallies) draw_.passed += static_cast<uint64_t>(std::popcount(pixels));
  switch (draw_.shading) {
    case Shading::none:
      return;
    case Shading::deferred:
      if (pixels == valid_[block]) return visibility_.cover(uint64_t{1} << block, number());
      return visibility_.cover_pixels(block, pixels, number());
    case Shading::in_order:
      return shade_in_order(block, pixels);
  }
}

uint64_t TileWorker::test_depth(uint32_t block, uint64_t pixels) {
  const uint32_t x = tile_x_ + column_of_bit(block) * kBlockSize;
  const uint32_t y = tile_y_ + row_of_bit(block) * kBlockSize;
  float* const stored = depths_of(block);
  DepthRange range;
  const uint64_t passed =
      block_depth_->test[draw_.compare](triangle_depth_, x, y, pixels, draw_.depth_write, stored, range);
  if (draw_.depth_write && passed != 0) depth_.set_range(block, range);
  return passed;
}

void TileWorker::shade_in_order(uint32_t block, uint64_t pixels) {
  if (draw_.late_depth) {
    depths_of(block);
    if (draw_.depth_write) depth_.set_range(block, kAnyDepth);
  }
  if (visibility_.pending()) resolve();
  packer_.begin_draw(*draw_.call, true);
  storage_.fetch_colors(uint64_t{1} << block);
  if (triangle_.shaded == nullptr) {
    const BinTriangle& triangle = triangle_.chunk->triangles[triangle_.index];
    keep_pending_setups();
    triangle_.shaded = &setups_.make_in_order(*triangle_.chunk, triangle, triangle_.has_setup ? &setup_ : nullptr);
  }
  packer_.add(*triangle_.shaded, block, pixels);
}

float* TileWorker::make_depths(uint32_t block) {
  const uint32_t owner = depth_.owner(block);
  if (owner == TileDepth::kCleared) return depth_.fill(block);
  const TileTriangle& triangle = visibility_.triangle(owner);
  const TriangleSetup setup = make_triangle_setup(*triangle.chunk, triangle.chunk->triangles[triangle.index]);
  float* const depths = depth_.plane(block);
  block_depth_->depth(triangle_depth(setup), tile_x_ + column_of_bit(block) * kBlockSize,
                      tile_y_ + row_of_bit(block) * kBlockSize, depths);
  depth_.set_in_plane(block);
  return depths;
}

const TriangleSetup& TileWorker::setup() {
  if (!triangle_.has_setup) {
    setup_ = make_triangle_setup(*triangle_.chunk, triangle_.chunk->triangles[triangle_.index]);
    triangle_.has_setup = true;
  }
  return setup_;
}

// Called before a set-up is made: pending quads may not lose theirs to it.
void TileWorker::keep_pending_setups() {
  if (packer_.has_pending() && setups_.made() - first_pending_ < SetupRing::kMostWhilePending) return;
  packer_.flush();
  first_pending_ = setups_.made();
}

uint32_t TileWorker::add_number() {
  if (deferred_draws_.empty() || !share_fragments(*deferred_draws_.back().call, *draw_.call)) {
    deferred_draws_.push_back({draw_.call, visibility_.next_number()});
  }
  const uint32_t draw = static_cast<uint32_t>(deferred_draws_.size() - 1);
  const BinChunk& chunk = *triangle_.chunk;
  const BinTriangle& triangle = chunk.triangles[triangle_.index];
  triangle_.number = visibility_.next_number();
  TileTriangle& seen = visibility_.add();
  seen.chunk = &chunk;
  seen.index = triangle_.index;
  seen.draw = draw;
  seen.setup = 0;
  seen.front_facing = triangle.front_facing() ? ~0u : 0u;
  for (size_t v = 0; v < 3; ++v) {
    const BinVertex& vertex = chunk.vertices[triangle.v[v]];
    __builtin_prefetch(chunk.varyings.data() + vertex.varyings);
    seen.x[v] = vertex.x;
    seen.y[v] = vertex.y;
    seen.inverse_w[v] = vertex.inverse_w;
    seen.varyings[v] = vertex.varyings;
  }
  return triangle_.number;
}

// --- the end of the tile --------------------------------------------------------------------------------------------

void TileWorker::store() {
  storage_.store_colors();
  if (depth_attachment_ == pass_->attachments.size() || !storage_.stores(depth_attachment_)) return;
  const uint64_t changed = depth_begun_ ? depth_.changed() : 0;
  for_each_bit(changed, [&](uint32_t block) { depths_of(block); });
  storage_.store(depth_attachment_, changed);
}

}  // namespace lapilli
