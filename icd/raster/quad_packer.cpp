// A batch is full at 16 quads; it is run early if a pixel comes again, or the draw or tile changes.
#include "raster/quad_packer.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstring>

namespace lapilli {
namespace {

constexpr uint32_t kBlockQuadColumns = kBlockSize / 2;
// From so many quads on, one triangle's in a block are a batch of their own: scalar coefficients and straight loads are
// worth more than full lanes.
constexpr uint32_t kQuadsWorthABatch = 12;

typedef uint16_t EightQuads __attribute__((vector_size(16)));
// From the block's first pixel and quad to its 16 quads.
constexpr EightQuads kQuadX[2] = {{0, 2, 4, 6, 0, 2, 4, 6}, {0, 2, 4, 6, 0, 2, 4, 6}};
constexpr EightQuads kQuadY[2] = {{0, 0, 0, 0, 2, 2, 2, 2}, {4, 4, 4, 4, 6, 6, 6, 6}};
constexpr EightQuads kQuadNumber[2] = {{0, 1, 2, 3, 4, 5, 6, 7}, {8, 9, 10, 11, 12, 13, 14, 15}};

void number_quads(uint16_t* quads, uint32_t first, const EightQuads (&steps)[2]) {
  for (int half = 0; half < 2; ++half) {
    const EightQuads values = steps[half] + static_cast<uint16_t>(first);
    std::memcpy(quads + 8 * half, &values, sizeof values);
  }
}

constexpr uint32_t first_quad_of_block(uint32_t block) { return first_texel_of_block(block) / 4; }

}  // namespace

void QuadPacker::begin_pass(ExecutionLimits& limits) {
  limits_ = &limits;
  out_of_memory_ = false;
}

void QuadPacker::begin_tile(const TilePlanes& planes, uint32_t tile_x, uint32_t tile_y) {
  batch_.planes = planes;
  block_batch_.planes = planes;
  block_batch_.one_triangle = block_batch_.whole_block = true;
  tile_x_ = tile_x;
  tile_y_ = tile_y;
}

void QuadPacker::begin_draw(const DrawCall& draw, bool count_samples) {
  if (draw_ != nullptr && share_fragments(*draw_, draw)) return;
  flush();
  draw_ = &draw;
  prepared_ = false;
  uint64_t* const counter = count_samples && draw.samples_passed != nullptr ? &samples_passed_ : nullptr;
  for (FragmentBatch* batch : {&batch_, &block_batch_}) {
    batch->samples_passed = counter;
    std::copy_n(draw.state->blend_constants, 4, batch->blend_constants);
  }
}

void QuadPacker::end_tile() {
  flush();
  draw_ = nullptr;
}

void QuadPacker::add(const TriangleSetup& triangle, uint32_t block, uint64_t pixels) {
  const uint64_t quads = live_quads(pixels);
  if (count_quads(quads) >= kQuadsWorthABatch) return add_block(triangle, block, pixels);
  for_each_bit(quads, [&](uint32_t lane) { add_quad(triangle, block, lane / 4, pixels >> lane & 0xF); });
}

void QuadPacker::add_quad(const TriangleSetup& triangle, uint32_t block, uint32_t quad, uint64_t pixels) {
  const uint32_t in_tile = first_quad_of_block(block) + quad;
  LastQuad& last = quad_last_[in_tile];
  if (last.batch == batch_number_ && (last.pixels & pixels) != 0) flush();
  last.pixels = static_cast<uint32_t>(pixels) | (last.batch == batch_number_ ? last.pixels : 0);
  last.batch = batch_number_;
  block_last_[block] = batch_number_;
  batch_.triangle[count_] = &triangle;
  batch_.x[count_] = static_cast<uint16_t>(tile_x_ + column_of_bit(block) * kBlockSize + quad % kBlockQuadColumns * 2);
  batch_.y[count_] = static_cast<uint16_t>(tile_y_ + row_of_bit(block) * kBlockSize + quad / kBlockQuadColumns * 2);
  batch_.quad_in_tile[count_] = static_cast<uint16_t>(in_tile);
  lanes_ |= pixels << (4 * count_);
  if (++count_ == kBatchQuads) flush();
}

void QuadPacker::add_block(const TriangleSetup& triangle, uint32_t block, uint64_t pixels) {
  if (block_batch_.triangle[0] != &triangle) std::fill_n(block_batch_.triangle, kBatchQuads, &triangle);
  run_block(block, pixels);
}

void QuadPacker::add_lanes(const LaneTriangles& triangles, uint32_t block, uint64_t pixels) {
  block_batch_.one_triangle = false;
  block_batch_.lane_triangles = &triangles;
  run_block(block, pixels);
  block_batch_.one_triangle = true;
  block_batch_.lane_triangles = nullptr;
}

void QuadPacker::run_block(uint32_t block, uint64_t pixels) {
  if (block_last_[block] == batch_number_) flush();
  number_quads(block_batch_.x, tile_x_ + column_of_bit(block) * kBlockSize, kQuadX);
  number_quads(block_batch_.y, tile_y_ + row_of_bit(block) * kBlockSize, kQuadY);
  number_quads(block_batch_.quad_in_tile, first_quad_of_block(block), kQuadNumber);
  run(block_batch_, pixels);
}

void QuadPacker::flush() {
  if (count_ == 0) return;
  batch_.one_triangle = true;
  for (uint32_t q = 1; q < count_; ++q) batch_.one_triangle &= batch_.triangle[q] == batch_.triangle[0];
  for (uint32_t q = count_; q < kBatchQuads; ++q) {
    batch_.triangle[q] = batch_.triangle[0];
    batch_.x[q] = batch_.x[0];
    batch_.y[q] = batch_.y[0];
    batch_.quad_in_tile[q] = batch_.quad_in_tile[0];
  }
  run(batch_, lanes_);
  count_ = 0;
  lanes_ = 0;
  if (++batch_number_ == 0) {
    std::fill(std::begin(quad_last_), std::end(quad_last_), LastQuad{});
    std::fill(std::begin(block_last_), std::end(block_last_), 0);
    batch_number_ = 1;
  }
}

void QuadPacker::run(FragmentBatch& batch, uint64_t lanes) {
  const Program& program = *draw_->state->programs->fragment;
  if (!prepared_ && !execution_.prepare(program, *draw_->resources, limits_)) {
    out_of_memory_ = true;
    return;
  }
  prepared_ = true;
  samples_passed_ = 0;
  execution_.run_fragments(batch, lanes);
  if (samples_passed_ != 0) {
    std::atomic_ref(*draw_->samples_passed).fetch_add(samples_passed_, std::memory_order_relaxed);
  }
  if (draw_->ledger != nullptr) {
    const bool helpers = batch.lane_triangles == nullptr;
    const uint64_t executed = static_cast<uint64_t>(std::popcount(helpers ? whole_quads(lanes) : lanes));
    add_fragments_to_ledger(draw_->ledger, executed, executed * lane_cost(program));
  }
}

}  // namespace lapilli
