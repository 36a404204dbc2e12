// The loop over tiles: load or clear, draw what the bins list, store.
#include "raster/render_pass.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <new>
#include <vector>

#include "geometry/front_end.h"
#include "image/copy.h"
#include "image/tile.h"
#include "raster/coverage.h"
#include "raster/quad_packer.h"

namespace lapilli {
namespace {

struct alignas(64) PlaneMemory {
  std::byte bytes[kTileTexels * 16];  // the largest texel has 16 bytes
};

// Triangles whose quads wait in the packer.
struct ShadedTriangles {
  static constexpr uint32_t kCount = 64;
  TriangleSetup setup[kCount];
  float varyings[kCount][3 * kMaxVaryingComponents];
  uint32_t used = 0;
};

// What one thread needs to work on a tile.
struct TileWorker {
  ShadedTriangles shaded;
  QuadPacker packer;
  std::vector<PlaneMemory> planes;  // one for each attachment of the pass
  BlockCoverage blocks[kBlocksPerTile * kBlocksPerTile];
};

// An attachment with its place in the tile storage and its clear value packed.
struct PassAttachment {
  const AttachmentTarget* target = nullptr;
  uint32_t color_index = 0;
  bool is_depth = false;
  PackedTexel clear = {};
};

PixelRect draw_area(const PassTarget& target) {
  const auto limit = [](int64_t v, uint32_t most) { return static_cast<int32_t>(std::clamp<int64_t>(v, 0, most)); };
  const VkRect2D& area = target.render_area;
  return {limit(area.offset.x, target.width), limit(area.offset.y, target.height),
          limit(int64_t{area.offset.x} + area.extent.width, target.width),
          limit(int64_t{area.offset.y} + area.extent.height, target.height)};
}

TileArea to_tile_area(const PixelRect& rect) {
  return {static_cast<uint32_t>(rect.x0), static_cast<uint32_t>(rect.y0), static_cast<uint32_t>(rect.x1),
          static_cast<uint32_t>(rect.y1)};
}

}  // namespace

struct Renderer::State {
  explicit State(ThreadPool& p) : pool(p), front_end(p), workers(p.size()) {}

  void draw_tile(uint32_t tile, TileWorker& worker, const BinSet& set, bool first_set);
  void draw_triangles(uint32_t tile, TileWorker& worker, const BinSet& set);
  void load(const TileArea& area, TileWorker& worker, bool first_set);
  void store(const TileArea& area, TileWorker& worker, bool last_set);

  ThreadPool& pool;
  FrontEnd front_end;
  std::vector<TileWorker> workers;

  // The pass at hand.
  std::span<const DrawCall> draws;
  std::vector<PassAttachment> attachments;
  PixelRect area;
  TileGrid grid;
  ExecutionLimits* limits = nullptr;
  std::atomic<bool> out_of_memory{false};
};

Renderer::Renderer(ThreadPool& pool) : state_(std::make_unique<State>(pool)) {}
Renderer::~Renderer() = default;

VkResult Renderer::render(const PassTarget& target, std::span<const DrawCall> draws, ExecutionLimits& limits) {
  State& state = *state_;
  state.draws = draws;
  state.limits = &limits;
  state.area = draw_area(target);
  if (state.area.empty()) return VK_SUCCESS;
  state.grid = {(target.width + kTileSize - 1) / kTileSize, (target.height + kTileSize - 1) / kTileSize};
  state.out_of_memory = false;

  state.attachments.clear();
  const auto add_attachment = [&](const AttachmentTarget& attachment, uint32_t index, bool is_depth) {
    if (attachment.data == nullptr) return;
    state.attachments.push_back({&attachment, index, is_depth, pack_clear_value(*attachment.format, attachment.clear)});
  };
  for (uint32_t i = 0; i < target.color.size(); ++i) add_attachment(target.color[i], i, false);
  add_attachment(target.depth, 0, true);
  for (TileWorker& worker : state.workers) {
    if (worker.planes.size() < state.attachments.size()) worker.planes.resize(state.attachments.size());
  }

  state.front_end.begin(draws, state.grid, state.area, limits);
  BinSet set;
  for (bool first = true; first || !set.last; first = false) {
    if (!state.front_end.next(set)) return VK_ERROR_OUT_OF_HOST_MEMORY;
    state.pool.parallel_for(state.grid.count(), [&](size_t tile, unsigned worker) {
      state.draw_tile(static_cast<uint32_t>(tile), state.workers[worker], set, first);
    });
    if (limits.expired.load(std::memory_order_relaxed)) return VK_ERROR_DEVICE_LOST;
    if (state.out_of_memory.load(std::memory_order_relaxed)) return VK_ERROR_OUT_OF_HOST_MEMORY;
  }
  return VK_SUCCESS;
}

void Renderer::State::draw_tile(uint32_t tile, TileWorker& worker, const BinSet& set, bool first_set) {
  constexpr int32_t kSize = static_cast<int32_t>(kTileSize);
  const int32_t tile_x = static_cast<int32_t>(tile % grid.columns) * kSize;
  const int32_t tile_y = static_cast<int32_t>(tile / grid.columns) * kSize;
  const PixelRect rect = intersect(area, {tile_x, tile_y, tile_x + kSize, tile_y + kSize});
  if (rect.empty()) return;
  const TileArea tile_area = to_tile_area(rect);

  const bool touched = std::any_of(set.chunks.begin(), set.chunks.end(),
                                   [&](const BinChunk& chunk) { return !chunk.tile(tile).empty(); });
  if (!touched) {
    if (!first_set) return;
    for (const PassAttachment& attachment : attachments) {
      const AttachmentTarget& target = *attachment.target;
      if (target.load_op != VK_ATTACHMENT_LOAD_OP_CLEAR) continue;
      fill_image_area(target.data, target.row_pitch, target.format->texel_size, tile_area, attachment.clear);
    }
    return;
  }
  load(tile_area, worker, first_set);
  draw_triangles(tile, worker, set);
  store(tile_area, worker, set.last);
}

void Renderer::State::load(const TileArea& tile_area, TileWorker& worker, bool first_set) {
  for (size_t i = 0; i < attachments.size(); ++i) {
    const AttachmentTarget& target = *attachments[i].target;
    std::byte* plane = worker.planes[i].bytes;
    if (first_set && target.load_op == VK_ATTACHMENT_LOAD_OP_CLEAR) {
      fill_tile(plane, target.format->texel_size, attachments[i].clear);
    } else {
      // "Don't care" loads too: what the tile held before would depend on which thread worked on what.
      load_tile(target.data, target.row_pitch, target.format->texel_size, tile_area, plane);
    }
  }
}

void Renderer::State::store(const TileArea& tile_area, TileWorker& worker, bool last_set) {
  for (size_t i = 0; i < attachments.size(); ++i) {
    const AttachmentTarget& target = *attachments[i].target;
    if (last_set && target.store_op == VK_ATTACHMENT_STORE_OP_DONT_CARE) continue;
    store_tile(worker.planes[i].bytes, target.format->texel_size, tile_area, target.data, target.row_pitch);
  }
}

void Renderer::State::draw_triangles(uint32_t tile, TileWorker& worker, const BinSet& set) {
  const uint32_t tile_x = tile % grid.columns * kTileSize;
  const uint32_t tile_y = tile / grid.columns * kTileSize;
  TilePlanes planes;
  for (size_t i = 0; i < attachments.size(); ++i) {
    std::byte*& plane = attachments[i].is_depth ? planes.depth : planes.color[attachments[i].color_index];
    plane = worker.planes[i].bytes;
  }
  worker.packer.begin_tile(planes, tile_x, tile_y);
  for (const BinChunk& chunk : set.chunks) {
    for (const uint32_t reference : chunk.tile(tile)) {
      const BinTriangle& triangle = chunk.triangles[reference];
      if (!worker.packer.begin_draw(draws[chunk.run_of(triangle).draw], *limits)) {
        out_of_memory.store(true, std::memory_order_relaxed);
        return;
      }
      const uint32_t blocks = cover_tile(make_edges(chunk, triangle), triangle.bounds(), static_cast<int32_t>(tile_x),
                                         static_cast<int32_t>(tile_y), worker.blocks);
      if (blocks == 0) continue;
      ShadedTriangles& shaded = worker.shaded;
      if (shaded.used == ShadedTriangles::kCount) {
        worker.packer.flush();
        shaded.used = 0;
      }
      TriangleSetup& setup = shaded.setup[shaded.used];
      setup = make_triangle_setup(chunk, triangle);
      setup.varyings = shaded.varyings[shaded.used++];
      make_varying_planes(chunk, triangle, shaded.varyings[shaded.used - 1]);
      for (uint32_t i = 0; i < blocks; ++i) worker.packer.add(setup, worker.blocks[i]);
    }
    if (limits->expired.load(std::memory_order_relaxed)) break;
  }
  worker.packer.flush();
}

}  // namespace lapilli
