// Planning and filling of chunks.
#include "geometry/front_end.h"

#include <algorithm>
#include <atomic>
#include <new>

namespace lapilli {
namespace {

constexpr uint32_t kChunkTriangles = 1024;
// 256 chunks of 1,024 triangles with a few varyings take about 64 to 100 MB.
constexpr uint32_t kChunksPerSet = 256;
// A triangle may be listed in every tile: large framebuffers get smaller chunks, so that a chunk's lists stay under 4
// MB.
constexpr uint32_t kMaxListEntries = 1u << 20;

bool draws_nothing(const DrawCall& draw) {
  return draw.state->raster.rasterizer_discard || draw.state->programs->fragment == nullptr ||
         !is_triangle_topology(draw.state->raster.topology) || draw.instance_count == 0;
}

}  // namespace

FrontEnd::FrontEnd(ThreadPool& pool) : pool_(pool), stages_(pool.size()) {}

void FrontEnd::begin(std::span<const DrawCall> draws, const TileGrid& grid, const PixelRect& area,
                     ExecutionLimits& limits) {
  draws_ = draws;
  grid_ = grid;
  area_ = area;
  limits_ = &limits;
  chunk_triangles_ = std::clamp(kMaxListEntries / std::max(grid.count(), 1u), 16u, kChunkTriangles);
  draw_ = 0;
  enter_draw();
}

// Moves on to the next draw with a triangle in it: one without may still have 2^32 instances.
void FrontEnd::enter_draw() {
  instance_ = run_ = triangle_ = 0;
  for (; draw_ < draws_.size(); ++draw_) {
    const DrawCall& draw = draws_[draw_];
    if (draws_nothing(draw)) continue;
    split_runs(draw, runs_);
    const auto has_triangle = [&](const VertexRun& run) {
      return triangle_count(draw.state->raster.topology, run.count) > 0;
    };
    if (std::any_of(runs_.begin(), runs_.end(), has_triangle)) return;
  }
}

// The next up to `most` triangles; false at the end of the pass.
bool FrontEnd::take_triangles(uint32_t most, WorkItem& item) {
  while (draw_ < draws_.size()) {
    if (run_ == runs_.size()) {
      run_ = 0;
      ++instance_;
    }
    if (instance_ >= draws_[draw_].instance_count) {
      ++draw_;
      enter_draw();
      continue;
    }
    const uint32_t all = triangle_count(draws_[draw_].state->raster.topology, runs_[run_].count);
    if (triangle_ == all) {
      ++run_;
      triangle_ = 0;
      continue;
    }
    item = {draw_, instance_, runs_[run_], triangle_, std::min(most, all - triangle_)};
    triangle_ += item.triangles;
    return true;
  }
  return false;
}

bool FrontEnd::plan_chunk() {
  Chunk plan{static_cast<uint32_t>(items_.size()), 0};
  uint32_t room = chunk_triangles_;
  WorkItem item;
  while (room > 0 && take_triangles(room, item)) {
    items_.push_back(item);
    room -= item.triangles;
  }
  plan.last_item = static_cast<uint32_t>(items_.size());
  if (plan.first_item == plan.last_item) return false;
  plans_.push_back(plan);
  return true;
}

bool FrontEnd::next(BinSet& set) {
  items_.clear();
  plans_.clear();
  while (plans_.size() < kChunksPerSet && plan_chunk()) {
  }
  if (chunks_.size() < plans_.size()) chunks_.resize(plans_.size());

  std::atomic<bool> failed{false};
  pool_.parallel_for(plans_.size(), [&](size_t i, unsigned worker) {
    try {
      fill(plans_[i], stages_[worker], chunks_[i]);
    } catch (const std::bad_alloc&) {
      failed.store(true, std::memory_order_relaxed);
    }
  });
  set.chunks = std::span(chunks_).first(plans_.size());
  set.last = draw_ >= draws_.size();
  return !failed.load(std::memory_order_relaxed);
}

void FrontEnd::fill(const Chunk& plan, VertexStage& stage, BinChunk& out) {
  clear_chunk(out);
  struct Slots {
    uint32_t v[3];
  };
  std::vector<Slots> triangles;

  for (uint32_t i = plan.first_item; i < plan.last_item;) {
    // All items of one draw share vertex batches.
    const uint32_t draw_index = items_[i].draw;
    const DrawCall& draw = draws_[draw_index];
    const SetupState state = make_setup_state(draw, draw_index, area_);
    if (!stage.begin(draw, *limits_)) throw std::bad_alloc();
    triangles.clear();
    uint32_t instance = 0;
    for (bool first = true; i < plan.last_item && items_[i].draw == draw_index; ++i, first = false) {
      const WorkItem& item = items_[i];
      if (first || item.instance != instance) stage.begin_instance(instance = item.instance);
      for (uint32_t t = item.first_triangle; t < item.first_triangle + item.triangles; ++t) {
        const TrianglePositions positions = triangle_positions(draw.state->raster.topology, t);
        Slots slots;
        for (int v = 0; v < 3; ++v) {
          uint32_t index = item.run.first + positions.v[v];
          if (draw.indices.data != nullptr) {
            index = read_index(draw.indices, uint64_t{item.run.first} + positions.v[v]) +
                    static_cast<uint32_t>(draw.vertex_offset);
          }
          slots.v[v] = stage.add(index);
        }
        triangles.push_back(slots);
      }
    }
    begin_run(state, out);
    stage.run(state, out);
    for (const Slots& slots : triangles) {
      TriangleVertices vertices;
      for (int v = 0; v < 3; ++v) {
        vertices.vertex[v] = &stage.vertex(slots.v[v]);
        vertices.index[v] = stage.first_vertex() + slots.v[v];
      }
      set_up_triangle(state, vertices, out);
    }
  }
  finish_chunk(grid_, out);
}

}  // namespace lapilli
