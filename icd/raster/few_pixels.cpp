// Triangles of a few pixels in one block: covered and depth tested pixel by pixel, without what pays for whole blocks
// only.
#include <bit>

#include "raster/tile_worker.h"

namespace lapilli {
namespace {

bool passes(VkCompareOp compare, float z, float stored) {
  switch (compare) {
    case VK_COMPARE_OP_NEVER:
      return false;
    case VK_COMPARE_OP_LESS:
      return z < stored;
    case VK_COMPARE_OP_EQUAL:
      return z == stored;
    case VK_COMPARE_OP_LESS_OR_EQUAL:
      return z <= stored;
    case VK_COMPARE_OP_GREATER:
      return z > stored;
    case VK_COMPARE_OP_NOT_EQUAL:
      return z != stored;
    case VK_COMPARE_OP_GREATER_OR_EQUAL:
      return z >= stored;
    default:
      return true;
  }
}

// As op frag_depth has it.
float depth_of(double e1, double e2, const DepthPlane& plane) {
  const float z = static_cast<float>((e1 * plane.k1 + e2 * plane.k2) + plane.z0);
  const float above = z < plane.min ? plane.min : z;
  return plane.max < above ? plane.max : above;
}

}  // namespace

// Sets the covered ones; the edges at them are those of `edges` 1 and 2. Pixels are in framebuffer space.
void FewPixels::cover(const EdgeFunctions& edges, const PixelRect& rect) {
  // 1 less where a centre on the edge is outside.
  int64_t row[3];
  for (size_t i = 0; i < 3; ++i) row[i] = edges[i].a * rect.x0 + edges[i].b * rect.y0 + edges[i].c - !edges[i].owns;
  count = 0;
  for (int32_t y = rect.y0; y < rect.y1; ++y) {
    int64_t e[3] = {row[0], row[1], row[2]};
    for (int32_t x = rect.x0; x < rect.x1; ++x) {
      if ((e[0] | e[1] | e[2]) >= 0) {
        pixel[count++] = {
            static_cast<uint8_t>(bit_of(static_cast<uint32_t>(x) % kBlockSize, static_cast<uint32_t>(y) % kBlockSize)),
            static_cast<double>(e[1] + !edges[1].owns), static_cast<double>(e[2] + !edges[2].owns)};
      }
      for (size_t i = 0; i < 3; ++i) e[i] += edges[i].a;
    }
    for (size_t i = 0; i < 3; ++i) row[i] += edges[i].b;
  }
}

// `rect`: the triangle's bounds from the tile's origin.
void TileWorker::draw_few_pixels(const BinChunk& chunk, uint32_t index, const PixelRect& rect) {
  const BinTriangle& triangle = chunk.triangles[index];
  const int32_t x = static_cast<int32_t>(tile_x_);
  const int32_t y = static_cast<int32_t>(tile_y_);
  const EdgeFunctions edges = make_edge_functions(chunk, triangle);
  FewPixels few;
  few.cover(edges, {rect.x0 + x, rect.y0 + y, rect.x1 + x, rect.y1 + y});
  if (few.count == 0) return;
  triangle_ = {&chunk, index, 0, nullptr, false};
  const uint32_t block =
      bit_of(static_cast<uint32_t>(rect.x0) / kBlockSize, static_cast<uint32_t>(rect.y0) / kBlockSize);
  if (draw_.tallies) draw_.covered += few.count;
  if (draw_.early_depth) few.count = test_few_depths(block, few, make_depth_plane(chunk, triangle, edges));
  if (few.count == 0) return;
  if (draw_.tallies) draw_.passed += few.count;
  switch (draw_.shading) {
    case Shading::none:
      return;
    case Shading::deferred:
      for (uint32_t i = 0; i < few.count; ++i) visibility_.cover_pixel(block, few.pixel[i].bit, number());
      return;
    case Shading::in_order: {
      uint64_t pixels = 0;
      for (uint32_t i = 0; i < few.count; ++i) pixels |= uint64_t{1} << few.pixel[i].bit;
      return shade_in_order(block, pixels);
    }
  }
}

// Keeps the pixels that pass, and returns how many.
uint32_t TileWorker::test_few_depths(uint32_t block, FewPixels& few, const DepthPlane& plane) {
  float* const stored = depths_of(block);
  uint32_t passed = 0;
  for (uint32_t i = 0; i < few.count; ++i) {
    const FewPixels::Pixel& pixel = few.pixel[i];
    const float z = depth_of(pixel.e1, pixel.e2, plane);
    float& old = stored[pixel.bit];
    if (!passes(draw_.compare, z, old)) continue;
    few.pixel[passed++] = pixel;
    if (!draw_.depth_write) continue;
    old = z == z ? z : std::bit_cast<float>(0x7FC00000u);
    depth_.include(block, z);
  }
  return passed;
}

}  // namespace lapilli
