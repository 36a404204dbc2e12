// What triangle setup does per draw, and for triangles that have to be clipped. The oracle in conformance/ states the
// rules independently.
#include "geometry/setup.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

namespace lapilli {
namespace {

int32_t snap(double pixels) { return static_cast<int32_t>(std::lrint(pixels * 256.0)); }

// Twice the signed area in 1/65536 square pixels; positive: clockwise on the screen (y down).
int64_t area2(const BinVertex& p, const BinVertex& q, const BinVertex& r) {
  return int64_t{q.x - p.x} * (r.y - p.y) - int64_t{r.x - p.x} * (q.y - p.y);
}

// Pixels whose centres may lie in the triangle: ceil(min - 0.5) .. floor(max - 0.5).
PixelRect pixel_bounds(const BinVertex& p, const BinVertex& q, const BinVertex& r) {
  const auto [min_x, max_x] = std::minmax({p.x, q.x, r.x});
  const auto [min_y, max_y] = std::minmax({p.y, q.y, r.y});
  return {(min_x + 127) >> 8, (min_y + 127) >> 8, ((max_x - 128) >> 8) + 1, ((max_y - 128) >> 8) + 1};
}

// Bounds for a triangle without a pixel in `rect`: pixels of it that the triangle does not touch.
PixelRect nearest_pixel(const PixelRect& bounds, const PixelRect& rect) {
  const int32_t x0 = std::clamp(bounds.x0, rect.x0, rect.x1 - 1);
  const int32_t y0 = std::clamp(bounds.y0, rect.y0, rect.y1 - 1);
  return {x0, y0, std::clamp(bounds.x1, x0 + 1, rect.x1), std::clamp(bounds.y1, y0 + 1, rect.y1)};
}

// The triangle of three of the chunk's vertices, unless it has no pixel.
void append_triangle(const SetupState& state, const uint32_t (&index)[3], uint32_t run, bool front, BinChunk& chunk) {
  const BinVertex& p = chunk.vertices[index[0]];
  const BinVertex& q = chunk.vertices[index[1]];
  const BinVertex& r = chunk.vertices[index[2]];
  const int64_t area = area2(p, q, r);
  if (area == 0) return;
  PixelRect bounds = intersect(pixel_bounds(p, q, r), state.rect);
  if (bounds.empty()) {
    if (!keeps(Removal::triangles) || state.rect.empty()) return;
    bounds = nearest_pixel(bounds, state.rect);
  }
  const bool turn = area < 0;
  chunk.triangles.push_back({{static_cast<uint16_t>(index[0]), static_cast<uint16_t>(index[turn ? 2 : 1]),
                              static_cast<uint16_t>(index[turn ? 1 : 2])},
                             static_cast<uint16_t>(run | (front ? BinTriangle::kFrontFacing : 0u)),
                             static_cast<uint16_t>(bounds.x0),
                             static_cast<uint16_t>(bounds.y0),
                             static_cast<uint16_t>(bounds.x1),
                             static_cast<uint16_t>(bounds.y1)});
}

// A varying at a corner of the clipped polygon. Flat ones are the provoking vertex's.
float mix(const ClipPoint& point, const float* const (&values)[3], uint32_t k, Interpolation mode) {
  if (mode == Interpolation::flat) return values[0][k];
  const double* weight = mode == Interpolation::linear ? point.screen_weight : point.weight;
  double sum = 0;
  for (uint32_t i = 0; i < 3; ++i) {
    // A weight of 0 keeps an infinite attribute of a vertex that was clipped away out of the sum.
    if (weight[i] != 0) sum += weight[i] * static_cast<double>(values[i][k]);
  }
  return static_cast<float>(sum);
}

// Appends a corner of the clipped polygon to the chunk's vertices; returns its index.
uint32_t append_corner(const SetupState& state, const ClipPoint& point, const uint32_t (&vertices)[3],
                       BinChunk& chunk) {
  const double w = point.position[3];
  BinVertex corner;
  // A vertex itself lies where triangles that need no clipping have it: in float32, as append_vertices() does.
  // Clipping is exact up to rounding only: what it left outside is moved to the border.
  const bool is_vertex = std::ranges::count(point.weight, 0.0) == 2;
  const auto on_screen = [&](double position, float half_size, float centre) {
    const double pixels =
        is_vertex ? static_cast<double>(static_cast<float>(position) / static_cast<float>(w) * half_size + centre)
                  : position / w * static_cast<double>(half_size) + static_cast<double>(centre);
    return snap(std::clamp(pixels, -kGuardBand, kGuardBand));
  };
  corner.x = on_screen(point.position[0], state.half_width, state.centre_x);
  corner.y = on_screen(point.position[1], state.half_height, state.centre_y);
  double z = point.position[2] / w;
  if (state.clip_depth) z = std::clamp(z, 0.0, 1.0);
  corner.z = z * state.depth_scale + state.depth_offset;
  corner.inverse_w = static_cast<float>(1.0 / w);
  corner.varyings = static_cast<uint32_t>(chunk.varyings.size());
  const size_t count = state.varyings.size();
  chunk.varyings.resize(chunk.varyings.size() + count);
  const float* values[3];
  for (int i = 0; i < 3; ++i) values[i] = chunk.varyings.data() + chunk.vertices[vertices[i]].varyings;
  for (uint32_t k = 0; k < count; ++k) {
    chunk.varyings[corner.varyings + k] = mix(point, values, k, state.varyings[k]);
  }
  chunk.vertices.push_back(corner);
  return static_cast<uint32_t>(chunk.vertices.size() - 1);
}

// Pixels whose centre lies in [offset, offset + extent); extent may be negative.
void viewport_range(float offset, float extent, int32_t& first, int32_t& last) {
  const double a = static_cast<double>(offset);
  const double b = a + static_cast<double>(extent);
  const auto pixel = [](double edge) {
    return static_cast<int32_t>(std::clamp(std::ceil(edge - 0.5), -2147480000.0, 2147480000.0));
  };
  first = pixel(std::min(a, b));
  last = pixel(std::max(a, b));
}

}  // namespace

PixelRect intersect(const PixelRect& a, const PixelRect& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

SetupState make_setup_state(const DrawState& bound, const PixelRect& area) {
  const VkViewport& viewport = bound.viewport;
  SetupState state{};
  state.half_width = viewport.width / 2;
  state.half_height = viewport.height / 2;
  state.centre_x = viewport.x + state.half_width;
  state.centre_y = viewport.y + state.half_height;
  state.clip_space = {static_cast<double>(state.half_width), static_cast<double>(state.centre_x),
                      static_cast<double>(state.half_height), static_cast<double>(state.centre_y),
                      !bound.raster.depth_clamp};
  state.clip_depth = !bound.raster.depth_clamp;
  const double min_depth = static_cast<double>(viewport.minDepth);
  const double max_depth = static_cast<double>(viewport.maxDepth);
  state.depth_scale = max_depth - min_depth;
  state.depth_offset = min_depth;
  state.min_depth = bound.raster.depth_clamp ? std::min(viewport.minDepth, viewport.maxDepth) : 0.0f;
  state.max_depth = bound.raster.depth_clamp ? std::max(viewport.minDepth, viewport.maxDepth) : 1.0f;

  PixelRect inside;
  viewport_range(viewport.x, viewport.width, inside.x0, inside.x1);
  viewport_range(viewport.y, viewport.height, inside.y0, inside.y1);
  const int64_t scissor_x1 = int64_t{bound.scissor.offset.x} + bound.scissor.extent.width;
  const int64_t scissor_y1 = int64_t{bound.scissor.offset.y} + bound.scissor.extent.height;
  const PixelRect scissor = {bound.scissor.offset.x, bound.scissor.offset.y,
                             static_cast<int32_t>(std::min<int64_t>(scissor_x1, INT32_MAX)),
                             static_cast<int32_t>(std::min<int64_t>(scissor_y1, INT32_MAX))};
  state.rect = intersect(intersect(inside, scissor), area);

  const bool keep_front = (bound.raster.cull_mode & VK_CULL_MODE_FRONT_BIT) == 0;
  const bool keep_back = (bound.raster.cull_mode & VK_CULL_MODE_BACK_BIT) == 0;
  state.front_is_clockwise = bound.raster.front_face == VK_FRONT_FACE_CLOCKWISE;
  const bool draws = !bound.raster.rasterizer_discard;
  state.keep_clockwise = draws && (state.front_is_clockwise ? keep_front : keep_back);
  state.keep_counterclockwise = draws && (state.front_is_clockwise ? keep_back : keep_front);
  state.depth_bias = bound.raster.depth_bias;
  state.bias_constant = bound.raster.depth_bias_constant;
  state.bias_clamp = bound.raster.depth_bias_clamp;
  state.bias_slope = bound.raster.depth_bias_slope;
  state.varyings = bound.programs->varyings;
  state.clip_distances = bound.programs->clip_distances;
  state.cull_distances = bound.programs->cull_distances;
  return state;
}

void begin_run(const SetupState& state, uint32_t draw_index, BinChunk& chunk) {
  assert(chunk.runs.size() < BinTriangle::kFrontFacing);
  chunk.runs.push_back({draw_index, state.varyings, state.min_depth, state.max_depth, state.depth_bias,
                        state.bias_constant, state.bias_clamp, state.bias_slope});
}

void clip_and_append(const SetupState& state, const TriangleList& list, uint32_t index, BinChunk& chunk) {
  const uint32_t* const slots = list.corners + 3 * size_t{index};
  uint32_t vertices[3];
  int32_t in_common = ~0, any = 0;
  for (int v = 0; v < 3; ++v) {
    vertices[v] = list.first_vertex + slots[v];
    const BinVertex& vertex = chunk.vertices[vertices[v]];
    const int32_t code = vertex.x == kNotInside ? vertex.y : 0;
    in_common &= code;
    any |= code;
  }
  if (in_common != 0 || (any & kOutInvalid) != 0 || state.rect.empty()) return;

  float positions[3][4];
  UserPlanes user{state.clip_distances, {}};
  for (uint32_t v = 0; v < 3; ++v) {
    const ClipPosition& position = list.inputs->positions[slots[v]];
    std::memcpy(positions[v], &position, sizeof position);
    user.distances[v] = list.inputs->distances.data() + size_t{slots[v]} * user.count;
  }
  ClipPoint polygon[kMaxClippedVertices];
  const uint32_t count = clip_triangle(state.clip_space, positions, user, polygon);
  uint32_t corners[kMaxClippedVertices];
  for (uint32_t i = 0; i < count; ++i) corners[i] = append_corner(state, polygon[i], vertices, chunk);

  const auto part = [&](uint32_t i) {
    return area2(chunk.vertices[corners[0]], chunk.vertices[corners[i - 1]], chunk.vertices[corners[i]]);
  };
  int64_t area = 0;
  for (uint32_t i = 2; i < count; ++i) area += part(i);
  if (area == 0 || !(area > 0 ? state.keep_clockwise : state.keep_counterclockwise)) return;
  const bool front = (area > 0) == state.front_is_clockwise;
  for (uint32_t i = 2; i < count; ++i) {
    // Snapping can turn a sliver of the fan around; what it covers belongs to its neighbours.
    if (count > 3 && (part(i) > 0) != (area > 0)) continue;
    append_triangle(state, {corners[0], corners[i - 1], corners[i]}, list.runs[index], front, chunk);
  }
}

}  // namespace lapilli
