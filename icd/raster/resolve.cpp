// Deferred shading: what is seen in a tile is shaded, draw by draw, in batches of many triangles.
#include <algorithm>
#include <bit>

#include "raster/tile_worker.h"

namespace lapilli {
namespace {

// A block with more triangles is taken apart quad by quad.
constexpr int kMostPartsOfABlock = 4;
// From so many quads of a draw on, a block with several triangles is a batch of its own where the program lets it be.
constexpr uint32_t kQuadsWorthLanes = 6;

constexpr size_t kVaryingsAhead = 8;  // triangles
void prefetch_varyings(const TileTriangle& triangle) {
  for (const uint32_t first : triangle.varyings) __builtin_prefetch(triangle.chunk->varyings.data() + first);
}

}  // namespace

void TileWorker::resolve() {
  if (!visibility_.pending()) return;
  collect_pending();
  visibility_.forget_pixels();
  if (pending_.empty()) return;
  const auto draw_of = [&](const Pending& each) { return visibility_.triangle(each.triangle).draw; };
  const uint32_t draws = static_cast<uint32_t>(deferred_draws_.size());
  uint32_t first_draw = draws, last_draw = 0;
  for (const Pending& each : pending_) {
    first_draw = std::min(first_draw, draw_of(each));
    last_draw = std::max(last_draw, draw_of(each));
  }
  if (first_draw == last_draw) return shade(*deferred_draws_[first_draw].call, pending_);

  // Counted, then scattered. The scatter moves each draw's start to its end.
  draw_end_.assign(last_draw - first_draw + 2, 0);
  for (const Pending& each : pending_) ++draw_end_[draw_of(each) - first_draw + 1];
  for (size_t i = 1; i < draw_end_.size(); ++i) draw_end_[i] += draw_end_[i - 1];
  sorted_.resize(pending_.size());
  for (const Pending& each : pending_) sorted_[draw_end_[draw_of(each) - first_draw]++] = each;
  uint32_t begin = 0;
  for (uint32_t draw = first_draw; draw <= last_draw; ++draw) {
    const uint32_t end = draw_end_[draw - first_draw];
    if (begin != end) shade(*deferred_draws_[draw].call, std::span(sorted_).subspan(begin, end - begin));
    begin = end;
  }
}

// Fills pending_ and makes room for the colours.
void TileWorker::collect_pending() {
  pending_.clear();
  storage_.overwrite_colors(visibility_.whole());
  for_each_bit(visibility_.whole(), [&](uint32_t block) {
    pending_.push_back({valid_[block], visibility_.whole_block(block), static_cast<uint8_t>(block), kManyQuads});
  });
  const LaneNumberFunctions& functions = lane_number_functions();
  uint64_t full = 0, partly = 0;  // blocks; partly: something else is seen too
  for_each_bit(visibility_.mixed(), [&](uint32_t block) {
    const uint32_t* const seen = visibility_.pixels(block);
    uint64_t rest = valid_[block] & ~functions.equal(seen, Visibility::kNobody);
    if (rest == 0) return;  // nobody is seen
    (rest == valid_[block] ? full : partly) |= uint64_t{1} << block;
    while (rest != 0) {
      const uint32_t triangle = seen[std::countr_zero(rest)];
      const uint32_t draw = visibility_.triangle(triangle).draw;
      const bool last = draw + 1 == deferred_draws_.size();
      const uint32_t first = deferred_draws_[draw].first;
      const uint32_t end = last ? visibility_.next_number() : deferred_draws_[draw + 1].first;
      const uint64_t pixels = functions.between(seen, first, end) & rest;
      if (end - first == 1 || (functions.equal(seen, triangle) & pixels) == pixels) {
        pending_.push_back({pixels, triangle, static_cast<uint8_t>(block), kManyQuads});
      } else if (count_quads(live_quads(pixels)) >= kQuadsWorthLanes &&
                 deferred_draws_[draw].call->state->programs->pixels_alone) {
        pending_.push_back({pixels, triangle, static_cast<uint8_t>(block), kManyTriangles});
      } else {
        collect_quads(block, pixels);
      }
      rest &= ~pixels;
    }
  });
  storage_.overwrite_colors(full);
  storage_.fetch_colors(partly);
}

// Pixels of one draw, quad by quad.
void TileWorker::collect_quads(uint32_t block, uint64_t rest) {
  const uint32_t* const seen = visibility_.pixels(block);
  for (int part = 0; part < kMostPartsOfABlock && rest != 0; ++part) {
    const uint32_t triangle = seen[std::countr_zero(rest)];
    const uint64_t pixels = lane_number_functions().equal(seen, triangle) & rest;
    pending_.push_back({pixels, triangle, static_cast<uint8_t>(block), kManyQuads});
    rest &= ~pixels;
  }
  while (rest != 0) {
    const uint32_t quad = static_cast<uint32_t>(std::countr_zero(rest)) / 4;
    const uint32_t* const lanes = seen + 4 * quad;
    const uint32_t triangle = seen[std::countr_zero(rest)];
    uint64_t pixels = 0;
    for (uint32_t i = 0; i < 4; ++i) pixels |= uint64_t{lanes[i] == triangle} << i;
    pixels &= rest >> (4 * quad);
    pending_.push_back({pixels, triangle, static_cast<uint8_t>(block), static_cast<uint8_t>(quad)});
    rest &= ~(pixels << (4 * quad));
  }
}

void TileWorker::shade(const DrawCall& draw, std::span<const Pending> pending) {
  packer_.begin_draw(draw, false);
  for (size_t i = 0; i < pending.size(); ++i) {
    if (i + kVaryingsAhead < pending.size())
      prefetch_varyings(visibility_.triangle(pending[i + kVaryingsAhead].triangle));
    const Pending& each = pending[i];
    if (each.quad == kManyTriangles) {
      set_up_lanes(visibility_, visibility_.pixels(each.block), each.pixels,
                   tile_x_ + column_of_bit(each.block) * kBlockSize, tile_y_ + row_of_bit(each.block) * kBlockSize,
                   draw.state->programs->varyings, lane_triangles_);
      packer_.add_lanes(lane_triangles_, each.block, each.pixels);
      continue;
    }
    keep_pending_setups();
    const TriangleSetup& setup = setups_.of(visibility_.triangle(each.triangle));
    if (each.quad == kManyQuads) {
      packer_.add(setup, each.block, each.pixels);
    } else {
      packer_.add_quad(setup, each.block, each.quad, each.pixels);
    }
  }
  if (draw.ledger == nullptr) return;
  uint64_t shaded = 0;
  for (const Pending& each : pending) shaded += static_cast<uint64_t>(std::popcount(each.pixels));
  // They were entered as hidden when they were covered; sums wrap.
  add_to_ledger(draw.ledger, Removal::hidden, uint64_t{0} - shaded,
                uint64_t{0} - shaded * lane_cost(*draw.state->programs->fragment));
}

}  // namespace lapilli
