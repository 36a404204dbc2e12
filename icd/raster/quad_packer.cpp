// A batch is full at 16 quads; it is run early if a quad comes again, or the draw or tile changes.
#include "raster/quad_packer.h"

#include <algorithm>
#include <atomic>
#include <bit>

namespace lapilli {
namespace {

constexpr uint32_t kBlockQuadColumns = kBlockSize / 2;

}  // namespace

void QuadPacker::begin_tile(const TilePlanes& planes, uint32_t tile_x, uint32_t tile_y) {
  batch_.planes = planes;
  batch_.samples_passed = &samples_passed_;
  tile_x_ = tile_x;
  tile_y_ = tile_y;
  draw_ = nullptr;
}

bool QuadPacker::begin_draw(const DrawCall& draw, ExecutionLimits& limits) {
  if (draw_ == &draw) return true;
  flush();
  draw_ = &draw;
  std::copy_n(draw.state->blend_constants, 4, batch_.blend_constants);
  return execution_.prepare(*draw.state->programs->fragment, *draw.resources, &limits);
}

void QuadPacker::add(const TriangleSetup& triangle, const BlockCoverage& block) {
  const uint32_t first = (block.block_y * kBlocksPerTile + block.block_x) * kBlockQuads;
  const uint32_t x = tile_x_ + block.block_x * kBlockSize;
  const uint32_t y = tile_y_ + block.block_y * kBlockSize;
  for (uint64_t rest = block.pixels; rest != 0;) {
    const uint32_t quad = static_cast<uint32_t>(std::countr_zero(rest)) / 4;
    rest &= ~(uint64_t{0xF} << (4 * quad));
    add_quad(triangle, first + quad, x + quad % kBlockQuadColumns * 2, y + quad / kBlockQuadColumns * 2,
             block.pixels >> (4 * quad) & 0xF);
  }
}

void QuadPacker::add_quad(const TriangleSetup& triangle, uint32_t quad, uint32_t x, uint32_t y, uint64_t pixels) {
  if (last_batch_[quad] == batch_number_) flush();
  last_batch_[quad] = batch_number_;
  batch_.triangle[count_] = &triangle;
  batch_.x[count_] = static_cast<uint16_t>(x);
  batch_.y[count_] = static_cast<uint16_t>(y);
  batch_.quad_in_tile[count_] = static_cast<uint16_t>(quad);
  lanes_ |= pixels << (4 * count_);
  if (++count_ == kBatchQuads) flush();
}

void QuadPacker::flush() {
  if (count_ == 0) return;
  batch_.one_triangle = true;
  batch_.whole_block = count_ == kBatchQuads && batch_.quad_in_tile[0] % kBlockQuads == 0;
  for (uint32_t q = 1; q < count_; ++q) {
    batch_.one_triangle &= batch_.triangle[q] == batch_.triangle[0];
    batch_.whole_block &= batch_.quad_in_tile[q] == batch_.quad_in_tile[0] + q;
  }
  for (uint32_t q = count_; q < kBatchQuads; ++q) {
    batch_.triangle[q] = batch_.triangle[0];
    batch_.x[q] = batch_.x[0];
    batch_.y[q] = batch_.y[0];
    batch_.quad_in_tile[q] = batch_.quad_in_tile[0];
  }
  samples_passed_ = 0;
  execution_.run_fragments(batch_, lanes_);
  if (draw_->samples_passed != nullptr) {
    std::atomic_ref(*draw_->samples_passed).fetch_add(samples_passed_, std::memory_order_relaxed);
  }
  count_ = 0;
  lanes_ = 0;
  if (++batch_number_ == 0) {
    std::fill(std::begin(last_batch_), std::end(last_batch_), 0);
    batch_number_ = 1;
  }
}

}  // namespace lapilli
