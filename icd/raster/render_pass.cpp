// The passes: what all tiles have in common, and the sets of bins that they are drawn from.
#include "raster/render_pass.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <vector>

#include "geometry/front_end.h"
#include "image/copy.h"
#include "raster/tile_worker.h"

namespace lapilli {
namespace {

PixelRect draw_area(const PassTarget& target) {
  const auto limit = [](int64_t v, uint32_t most) { return static_cast<int32_t>(std::clamp<int64_t>(v, 0, most)); };
  const VkRect2D& area = target.render_area;
  return {limit(area.offset.x, target.width), limit(area.offset.y, target.height),
          limit(int64_t{area.offset.x} + area.extent.width, target.width),
          limit(int64_t{area.offset.y} + area.extent.height, target.height)};
}

}  // namespace

struct Renderer::State {
  explicit State(ThreadPool& p) : pool(p), front_end(p), workers(new TileWorker[p.size()]) {}

  void begin_pass(const PassTarget& target, std::span<const DrawCall> draws, ExecutionLimits& limits);

  ThreadPool& pool;
  FrontEnd front_end;
  std::unique_ptr<TileWorker[]> workers;  // as many as the pool has; large, and not to be cleared

  // The pass at hand.
  std::vector<PassAttachment> attachments;
  TilePass pass;
};

Renderer::Renderer(ThreadPool& pool) : state_(std::make_unique<State>(pool)) {}
Renderer::~Renderer() = default;

void Renderer::State::begin_pass(const PassTarget& target, std::span<const DrawCall> draws, ExecutionLimits& limits) {
  attachments.clear();
  const auto add_attachment = [&](const AttachmentTarget& attachment, uint32_t index, bool is_depth) {
    if (attachment.data == nullptr) return;
    attachments.push_back({&attachment, index, is_depth, pack_clear_value(*attachment.format, attachment.clear)});
  };
  for (uint32_t i = 0; i < target.color.size(); ++i) add_attachment(target.color[i], i, false);
  add_attachment(target.depth, 0, true);
  pass.draws = draws;
  pass.attachments = attachments;
  pass.samples = target.samples;
  pass.area = draw_area(target);
  pass.grid = {(target.width + kTileSize - 1) / kTileSize, (target.height + kTileSize - 1) / kTileSize};
  pass.limits = &limits;
  pass.defer = !keeps(Removal::hidden);
  pass.judge_blocks = !keeps(Removal::blocks);
}

VkResult Renderer::render(const PassTarget& target, std::span<const DrawCall> draws, ExecutionLimits& limits) {
  State& state = *state_;
  state.begin_pass(target, draws, limits);
  if (state.pass.area.empty()) return VK_SUCCESS;
  for (TileWorker& worker : std::span(state.workers.get(), state.pool.size())) {
    if (!worker.begin_pass(state.pass)) return VK_ERROR_OUT_OF_HOST_MEMORY;
  }

  state.front_end.begin(draws, state.pass.grid, state.pass.area, limits);
  std::atomic<bool> out_of_memory{false};
  BinSet set;
  for (bool first = true; first || !set.last; first = false) {
    if (!state.front_end.next(set)) return VK_ERROR_OUT_OF_HOST_MEMORY;
    state.pool.parallel_for(state.pass.grid.count(), [&](size_t tile, unsigned worker) {
      if (!state.workers[worker].draw_tile(static_cast<uint32_t>(tile), set, first)) {
        out_of_memory.store(true, std::memory_order_relaxed);
      }
    });
    if (limits.expired.load(std::memory_order_relaxed)) return VK_ERROR_DEVICE_LOST;
    if (out_of_memory.load(std::memory_order_relaxed)) return VK_ERROR_OUT_OF_HOST_MEMORY;
  }
  return VK_SUCCESS;
}

}  // namespace lapilli
