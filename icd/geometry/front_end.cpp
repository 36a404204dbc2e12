// Planning and filling of chunks.
#include "geometry/front_end.h"

#include <algorithm>
#include <atomic>
#include <new>

namespace lapilli {
namespace {

// A chunk is large enough to share the vertices of a few rows of a grid, and small enough for its vertices to be named
// with 16 bits even if all triangles are clipped.
constexpr uint32_t kChunkTriangles = 4096;
static_assert(kChunkTriangles * 3 <= VertexStage::kMostVertices);
static_assert(kChunkTriangles * (3 + kMaxClippedVertices - kMaxDistances) <= 1u << 16);
constexpr uint32_t kChunkTrianglesWithDistances = 3072;
static_assert(kChunkTrianglesWithDistances * (3 + kMaxClippedVertices) <= 1u << 16);
// Small passes are cut into about this many, so that there is work for all threads.
constexpr uint32_t kLeastChunks = 32;
constexpr uint32_t kLeastChunkTriangles = 256;
// What a work item costs beside its triangles, in triangles.
constexpr uint32_t kItemCost = 8;
// A triangle may be listed in every tile: large framebuffers get smaller chunks, so that a chunk's lists stay under 8
// MB.
constexpr uint32_t kMaxListEntries = 1u << 21;
// Planned at once.
constexpr size_t kMostPlans = 1024;
constexpr size_t kMostItems = 1u << 16;
// Vertices of a draw from which on the clock is read for each run.
constexpr uint32_t kWorthALook = 1u << 16;

bool has_effect(const DrawCall& draw) {
  const GraphicsPrograms& programs = *draw.state->programs;
  if (programs.vertices_store) return true;
  if (draw.state->raster.rasterizer_discard || programs.fragment == nullptr) return false;
  const bool counts = draw.samples_passed != nullptr;
  return !programs.fragment_reads_nothing || programs.depth_write || counts;
}

bool has_distinct_vertices(const DrawCall& draw) {
  return draw.indices.data == nullptr && draw.state->raster.topology == VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
}

uint64_t count_triangles(const DrawCall& draw) {
  uint64_t sum = 0;
  VertexRun run;
  for (uint32_t position = 0; next_run(draw, position, run);) {
    sum += triangle_count(draw.state->raster.topology, run.count);
  }
  return sum * draw.instance_count;
}

}  // namespace

struct FrontEnd::Worker {
  VertexStage stage;
  BinArray<uint32_t> corners, runs;  // TriangleList
  std::vector<uint32_t> removed;     // [run]
};

FrontEnd::FrontEnd(ThreadPool& pool) : pool_(pool) {
  for (unsigned i = 0; i < pool.size(); ++i) workers_.push_back(std::make_unique<Worker>());
}
FrontEnd::~FrontEnd() = default;

void FrontEnd::begin(std::span<const DrawCall> draws, const TileGrid& grid, const PixelRect& area,
                     ExecutionLimits& limits) {
  draws_ = draws;
  grid_ = grid;
  area_ = area;
  limits_ = &limits;
  uint64_t vertices = 0;
  bool distances = false;
  for (const DrawCall& draw : draws) {
    vertices += uint64_t{draw.count} * draw.instance_count;
    distances |= draw.state->programs->clip_distances != 0;
  }
  chunk_triangles_ = static_cast<uint32_t>(std::clamp<uint64_t>(
      vertices / 3 / kLeastChunks, kLeastChunkTriangles, distances ? kChunkTrianglesWithDistances : kChunkTriangles));
  chunk_triangles_ = std::min(chunk_triangles_, std::max(kMaxListEntries / std::max(grid.count(), 1u), 16u));
  plans_.clear();
  done_plans_ = 0;
  known_state_ = nullptr;
  draw_ = 0;
  enter_draw();
}

// Whether nobody can tell that the draw is missing.
bool FrontEnd::may_skip(const DrawCall& draw) {
  if (draw.instance_count == 0 || !has_effect(draw) || !is_triangle_topology(draw.state->raster.topology)) return true;
  if (known_state_ != draw.state) {
    known_state_ = draw.state;
    const SetupState state = make_setup_state(*draw.state, area_);
    state_has_no_pixel_ = (state.rect.empty() || !(state.keep_clockwise || state.keep_counterclockwise)) &&
                          !draw.state->programs->vertices_store && !keeps(Removal::triangles);
  }
  if (state_has_no_pixel_ && draw.ledger != nullptr) {
    add_to_ledger(draw.ledger, Removal::triangles, count_triangles(draw), 0);
  }
  return state_has_no_pixel_;
}

void FrontEnd::enter_draw() {
  while (draw_ < draws_.size() && may_skip(draws_[draw_])) ++draw_;
  instance_ = after_run_ = triangle_ = run_triangles_ = 0;
  has_triangles_ = false;
}

// Moves on to the next triangle that is not planned yet; false at the end of the pass.
bool FrontEnd::seek_triangle() {
  while (draw_ < draws_.size()) {
    if (triangle_ < run_triangles_) return true;
    const DrawCall& draw = draws_[draw_];
    // A run, or a look for restarts that found none, may be 2^32 indices long.
    if (draw.count >= kWorthALook && limits_->read_clock()) return false;
    if (next_run(draw, after_run_, run_)) {
      triangle_ = 0;
      run_triangles_ = triangle_count(draw.state->raster.topology, run_.count);
      has_triangles_ |= run_triangles_ > 0;
    } else if (has_triangles_ && ++instance_ < draw.instance_count) {
      after_run_ = 0;
    } else {  // a draw without a triangle may still have 2^32 instances
      ++draw_;
      enter_draw();
    }
  }
  return false;
}

bool FrontEnd::plan_chunk() {
  const uint32_t first_item = static_cast<uint32_t>(items_.size());
  for (uint32_t room = chunk_triangles_; room > 0 && seek_triangle();) {
    const uint32_t triangles = std::min(room, run_triangles_ - triangle_);
    items_.push_back({draw_, instance_, run_, triangle_, triangles});
    triangle_ += triangles;
    room -= std::min(room, triangles + kItemCost);
  }
  if (first_item == items_.size()) return false;
  plans_.push_back({first_item, static_cast<uint32_t>(items_.size())});
  return true;
}

void FrontEnd::plan() {
  items_.clear();
  plans_.clear();
  done_plans_ = 0;
  while (plans_.size() < kMostPlans && items_.size() < kMostItems && plan_chunk()) {
  }
  if (chunks_.size() < plans_.size()) chunks_.resize(plans_.size());
}

bool FrontEnd::next(BinSet& set) {
  if (done_plans_ == plans_.size()) plan();
  const size_t left = plans_.size() - done_plans_;
  // Who finds that there is room takes the next chunk and fills it whatever happens: the chunks that are filled are the
  // first ones.
  std::atomic<size_t> taken{0};
  std::atomic<uint64_t> bytes{0};
  std::atomic<bool> failed{false};
  pool_.parallel_for(left, [&](size_t, unsigned worker) {
    if (bytes.load(std::memory_order_relaxed) >= kSetBytes || limits_->read_clock()) return;
    const size_t i = taken.fetch_add(1, std::memory_order_relaxed);
    try {
      fill(plans_[done_plans_ + i], *workers_[worker], chunks_[i]);
    } catch (const std::bad_alloc&) {
      failed.store(true, std::memory_order_relaxed);
    }
    bytes.fetch_add(memory_of(chunks_[i]), std::memory_order_relaxed);
  });
  const size_t filled = taken.load(std::memory_order_relaxed);
  // A full set takes all the memory that there is for bins.
  if (filled < left) std::for_each(chunks_.begin() + static_cast<ptrdiff_t>(filled), chunks_.end(), release_chunk);
  done_plans_ += filled;
  set.chunks = std::span(chunks_).first(filled);
  set.last = done_plans_ == plans_.size() && !seek_triangle();
  return !failed.load(std::memory_order_relaxed);
}

void FrontEnd::fill(const Chunk& plan, Worker& worker, BinChunk& out) {
  clear_chunk(out);
  for (uint32_t first = plan.first_item; first < plan.last_item;) {
    uint32_t last = first + 1;
    while (last < plan.last_item && draws_[items_[first].draw].state == draws_[items_[last].draw].state) ++last;
    fill_list(std::span(items_).subspan(first, last - first), worker, out);
    first = last;
  }
  finish_chunk(grid_, out);
}

// Triangles of draws with the same state are set up together. Those that have bindings in common, too, share batches of
// vertices if the program reads resources once per draw at most, and with the same resources the vertices themselves
// where index and instance are the same, unless the program counts who comes or asks for the draw.
void FrontEnd::fill_list(std::span<const WorkItem> items, Worker& worker, BinChunk& out) {
  const SetupState state = make_setup_state(*draws_[items[0].draw].state, area_);
  TriangleList list;
  for (const WorkItem& item : items) list.count += item.triangles;
  worker.corners.resize((list.count + TriangleList::kPadding) * size_t{3});
  worker.runs.resize(list.count + TriangleList::kPadding);
  list.first_vertex = static_cast<uint32_t>(out.vertices.size());
  const size_t first_run = out.runs.size();

  VertexStage& stage = worker.stage;
  stage.begin_list();
  uint32_t done = 0;
  bool any_ledger = false;
  const DrawCall* before = nullptr;
  for (const WorkItem& item : items) {
    const DrawCall& draw = draws_[item.draw];
    if (before == nullptr || before->bindings != draw.bindings ||
        (before->resources != draw.resources && draw.state->programs->vertices_read_resources) ||
        (before != &draw && (draw.state->programs->vertices_store || draw.state->programs->vertices_read_draw))) {
      if (before != nullptr) stage.run(state, out);
      if (!stage.begin(draw, *limits_)) throw std::bad_alloc();
    } else if (before->resources != draw.resources) {
      stage.change_resources(draw);
    }
    if (before != &draw) begin_run(state, item.draw, out);
    before = &draw;
    any_ledger |= draw.ledger != nullptr;
    add_triangles(item, done, worker);
    std::fill_n(worker.runs.data() + done, item.triangles, static_cast<uint32_t>(out.runs.size() - 1));
    done += item.triangles;
  }
  stage.run(state, out);
  std::fill_n(worker.corners.data() + 3 * size_t{done}, 3 * TriangleList::kPadding, 0u);
  std::fill_n(worker.runs.data() + done, TriangleList::kPadding, 0u);

  list.corners = worker.corners.data();
  list.runs = worker.runs.data();
  list.inputs = &stage.inputs();
  if (any_ledger) {
    worker.removed.assign(out.runs.size(), 0);
    list.removed = worker.removed.data();
  }
  append_triangles(state, list, out);
  for (size_t i = first_run; any_ledger && i < out.runs.size(); ++i) {
    add_to_ledger(draws_[out.runs[i].draw].ledger, Removal::triangles, worker.removed[i], 0);
  }
}

// Assembles an item's triangles and adds their vertices; `first`: triangle of the list.
void FrontEnd::add_triangles(const WorkItem& item, uint32_t first, Worker& worker) const {
  const DrawCall& draw = draws_[item.draw];
  const std::span<uint32_t> vertices{worker.corners.data() + size_t{3} * first, size_t{3} * item.triangles};
  assemble_triangles(draw, item.run, item.first_triangle, vertices);
  const uint32_t instance = draw.first_instance + item.instance;
  size_t run = vertices.size();
  if (has_distinct_vertices(draw) || keeps(Removal::vertices)) {
    worker.stage.add_distinct(instance, vertices);
  } else {
    run = worker.stage.add(instance, vertices);
  }
  if (draw.ledger == nullptr) return;
  const uint64_t cost = lane_cost(*draw.state->programs->vertex);
  const uint64_t saved = vertices.size() - run;
  add_vertices_to_ledger(draw.ledger, run, run * cost);
  add_to_ledger(draw.ledger, Removal::vertices, saved, saved * cost);
}

}  // namespace lapilli
