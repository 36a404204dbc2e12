// Triangle setup. The rules of snapping and coverage are those of setup.h; the oracle in conformance/ states them
// independently.
#include "geometry/setup.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace lapilli {
namespace {

// A corner of the polygon that is rasterized: a vertex, or a point made by clipping.
struct Corner {
  int32_t x, y;  // 24.8
  double z;
  double inverse_w;
  const ClipPoint* mix;  // null: vertex `index` itself
  uint32_t index;
};

int32_t snap(double pixels) { return static_cast<int32_t>(std::lrint(pixels * 256.0)); }

// Twice the signed area in 1/65536 square pixels; positive: clockwise on the screen (y down).
int64_t area2(const Corner& p, const Corner& q, const Corner& r) {
  return int64_t{q.x - p.x} * (r.y - p.y) - int64_t{r.x - p.x} * (q.y - p.y);
}

// Depth bias: o = clamp(m * slope + r * constant). Chapter "Rasterization", Depth Bias; r for a float depth buffer.
double depth_bias(const SetupState& state, const TriangleSetup& setup) {
  const double dzdx = (setup.edge_a[1] * setup.z[1] + setup.edge_a[2] * setup.z[2]) * setup.inverse_area2;
  const double dzdy = (setup.edge_b[1] * setup.z[1] + setup.edge_b[2] * setup.z[2]) * setup.inverse_area2;
  const double slope = std::sqrt(dzdx * dzdx + dzdy * dzdy);
  const double largest =
      std::max({std::fabs(setup.z[0]), std::fabs(setup.z[0] + setup.z[1]), std::fabs(setup.z[0] + setup.z[2])});
  const double unit = largest > 0 ? std::ldexp(1.0, std::ilogb(largest) - 23) : 0.0;
  double bias = slope * static_cast<double>(state.bias_slope) + unit * static_cast<double>(state.bias_constant);
  const double limit = static_cast<double>(state.bias_clamp);
  if (limit > 0) bias = std::min(bias, limit);
  if (limit < 0) bias = std::max(bias, limit);
  return std::isnan(bias) ? 0.0 : bias;
}

// E(x, y) = a*x + b*y + c through q -> r, positive on the side of p, for pixel centres.
void set_edge(BinTriangle& triangle, int i, const Corner& q, const Corner& r) {
  const int64_t dx = int64_t{r.x} - q.x;
  const int64_t dy = int64_t{r.y} - q.y;
  const int64_t c = dx * (128 - int64_t{q.y}) - dy * (128 - int64_t{q.x});
  triangle.setup.edge_a[i] = static_cast<double>(-dy * 256);
  triangle.setup.edge_b[i] = static_cast<double>(dx * 256);
  triangle.setup.edge_c[i] = static_cast<double>(c);
  // Top-left rule: a centre on the edge belongs to the triangle if the interior lies at greater x, or the edge is
  // horizontal and the interior lies at greater y. a and b are multiples of 256, so floor(c / 256) decides the same.
  const bool owns_edge = dy < 0 || (dy == 0 && dx > 0);
  triangle.edges.a[i] = static_cast<int32_t>(-dy);
  triangle.edges.b[i] = static_cast<int32_t>(dx);
  triangle.edges.c[i] = (c - (owns_edge ? 0 : 1)) >> 8;
}

float component(const Corner& corner, const PostVertex* const (&vertices)[3], uint32_t k, Interpolation mode) {
  const size_t offset = size_t{kSlotVaryings + k} * kBatchLanes;
  if (corner.mix == nullptr) return vertices[corner.index]->outputs[offset];
  const double* weight = mode == Interpolation::linear ? corner.mix->screen_weight : corner.mix->weight;
  double sum = 0;
  for (uint32_t i = 0; i < 3; ++i) {
    // A weight of 0 keeps an infinite attribute of a vertex that was clipped away out of the sum.
    if (weight[i] != 0) sum += weight[i] * static_cast<double>(vertices[i]->outputs[offset]);
  }
  return static_cast<float>(sum);
}

void append_varyings(const SetupState& state, const Corner (&corners)[3], const PostVertex* const (&vertices)[3],
                     std::vector<float>& varyings) {
  for (uint32_t k = 0; k < state.varyings.size(); ++k) {
    const Interpolation mode = state.varyings[k];
    if (mode == Interpolation::flat) {
      varyings.push_back(vertices[0]->outputs[size_t{kSlotVaryings + k} * kBatchLanes]);
      varyings.push_back(0);
      varyings.push_back(0);
      continue;
    }
    const float a0 = component(corners[0], vertices, k, mode);
    varyings.push_back(a0);
    varyings.push_back(component(corners[1], vertices, k, mode) - a0);
    varyings.push_back(component(corners[2], vertices, k, mode) - a0);
  }
}

// Pixels whose centres may lie in the triangle: ceil(min - 0.5) .. floor(max - 0.5).
PixelRect pixel_bounds(const Corner (&corners)[3]) {
  const auto [min_x, max_x] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
  const auto [min_y, max_y] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
  return {(min_x + 127) >> 8, (min_y + 127) >> 8, ((max_x - 128) >> 8) + 1, ((max_y - 128) >> 8) + 1};
}

void append_triangle(const SetupState& state, Corner p, Corner q, Corner r, bool front,
                     const PostVertex* const (&vertices)[3], BinChunk& chunk) {
  int64_t area = area2(p, q, r);
  if (area == 0) return;
  if (area < 0) {
    std::swap(q, r);
    area = -area;
  }
  const Corner corners[3] = {p, q, r};
  const PixelRect bounds = intersect(pixel_bounds(corners), state.rect);
  if (bounds.empty()) return;

  BinTriangle& triangle = chunk.triangles.emplace_back();
  triangle.bounds = bounds;
  triangle.draw = state.draw;
  set_edge(triangle, 0, q, r);
  set_edge(triangle, 1, r, p);
  set_edge(triangle, 2, p, q);
  TriangleSetup& setup = triangle.setup;
  setup.inverse_area2 = 1.0 / static_cast<double>(area);
  setup.z[0] = p.z;
  setup.z[1] = q.z - p.z;
  setup.z[2] = r.z - p.z;
  if (state.depth_bias) setup.z[0] += depth_bias(state, setup);
  setup.min_depth = state.min_depth;
  setup.max_depth = state.max_depth;
  for (int i = 0; i < 3; ++i) setup.inverse_w[i] = static_cast<float>(corners[i].inverse_w);
  setup.varyings = nullptr;
  setup.front_facing = front ? ~0u : 0u;
  append_varyings(state, corners, vertices, chunk.varyings);
}

Corner corner_of(const SetupState& state, const ClipPoint& point) {
  const double w = point.position[3];
  Corner corner;
  // Clipping is exact up to rounding only: what it left outside is moved to the border.
  const auto clamped = [](double pixels) { return std::clamp(pixels, -kGuardBand, kGuardBand); };
  corner.x = snap(clamped(state.clip_space.scale_x * (point.position[0] / w) + state.clip_space.offset_x));
  corner.y = snap(clamped(state.clip_space.scale_y * (point.position[1] / w) + state.clip_space.offset_y));
  double z = point.position[2] / w;
  if (state.clip_depth) z = std::clamp(z, 0.0, 1.0);
  corner.z = z * state.depth_scale + state.depth_offset;
  corner.inverse_w = 1.0 / w;
  corner.mix = &point;
  corner.index = 0;
  return corner;
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

SetupState make_setup_state(const DrawCall& draw, uint32_t draw_index, const PixelRect& area) {
  const VkViewport& viewport = draw.viewport;
  SetupState state{};
  state.half_width = viewport.width / 2;
  state.half_height = viewport.height / 2;
  state.centre_x = viewport.x + state.half_width;
  state.centre_y = viewport.y + state.half_height;
  state.clip_space = {static_cast<double>(state.half_width), static_cast<double>(state.centre_x),
                      static_cast<double>(state.half_height), static_cast<double>(state.centre_y),
                      !draw.raster.depth_clamp};
  state.clip_depth = !draw.raster.depth_clamp;
  const double min_depth = static_cast<double>(viewport.minDepth);
  const double max_depth = static_cast<double>(viewport.maxDepth);
  state.depth_scale = max_depth - min_depth;
  state.depth_offset = min_depth;
  state.min_depth = draw.raster.depth_clamp ? std::min(viewport.minDepth, viewport.maxDepth) : 0.0f;
  state.max_depth = draw.raster.depth_clamp ? std::max(viewport.minDepth, viewport.maxDepth) : 1.0f;

  PixelRect inside;
  viewport_range(viewport.x, viewport.width, inside.x0, inside.x1);
  viewport_range(viewport.y, viewport.height, inside.y0, inside.y1);
  const int64_t scissor_x1 = int64_t{draw.scissor.offset.x} + draw.scissor.extent.width;
  const int64_t scissor_y1 = int64_t{draw.scissor.offset.y} + draw.scissor.extent.height;
  const PixelRect scissor = {draw.scissor.offset.x, draw.scissor.offset.y,
                             static_cast<int32_t>(std::min<int64_t>(scissor_x1, INT32_MAX)),
                             static_cast<int32_t>(std::min<int64_t>(scissor_y1, INT32_MAX))};
  state.rect = intersect(intersect(inside, scissor), area);

  state.cull_front = (draw.raster.cull_mode & VK_CULL_MODE_FRONT_BIT) != 0;
  state.cull_back = (draw.raster.cull_mode & VK_CULL_MODE_BACK_BIT) != 0;
  state.front_is_clockwise = draw.raster.front_face == VK_FRONT_FACE_CLOCKWISE;
  state.depth_bias = draw.raster.depth_bias;
  state.bias_constant = draw.raster.depth_bias_constant;
  state.bias_clamp = draw.raster.depth_bias_clamp;
  state.bias_slope = draw.raster.depth_bias_slope;
  state.varyings = draw.programs->varyings;
  state.draw = draw_index;
  return state;
}

PostVertex post_transform(const SetupState& state, const float* outputs) {
  PostVertex vertex;
  for (size_t i = 0; i < 4; ++i) vertex.clip[i] = outputs[(kSlotPosition + i) * kBatchLanes];
  vertex.outputs = outputs;
  const auto [x, y, z, w] = vertex.clip;
  // x - x is 0 for finite values only.
  if ((x - x) + (y - y) + (z - z) + (w - w) != 0) {
    vertex.kind = VertexClass::dropped;
    return vertex;
  }
  vertex.kind = VertexClass::needs_clipping;
  if (!(w > 0) || (state.clip_depth && !(z >= 0 && z <= w))) return vertex;
  const float screen_x = x / w * state.half_width + state.centre_x;
  const float screen_y = y / w * state.half_height + state.centre_y;
  const float limit = static_cast<float>(kGuardBand);
  if (!(std::fabs(screen_x) <= limit && std::fabs(screen_y) <= limit)) return vertex;
  vertex.kind = VertexClass::inside;
  vertex.x = snap(static_cast<double>(screen_x));
  vertex.y = snap(static_cast<double>(screen_y));
  vertex.z = static_cast<double>(z) / static_cast<double>(w) * state.depth_scale + state.depth_offset;
  vertex.inverse_w = 1.0f / w;
  return vertex;
}

void set_up_triangle(const SetupState& state, const PostVertex* const (&vertices)[3], BinChunk& chunk) {
  if (state.rect.empty()) return;
  bool clip = false;
  for (const PostVertex* vertex : vertices) {
    if (vertex->kind == VertexClass::dropped) return;
    clip |= vertex->kind == VertexClass::needs_clipping;
  }

  Corner corners[kMaxClippedVertices];
  ClipPoint polygon[kMaxClippedVertices];
  uint32_t count = 3;
  if (clip) {
    float positions[3][4];
    for (int v = 0; v < 3; ++v) std::copy_n(vertices[v]->clip, 4, positions[v]);
    count = clip_triangle(state.clip_space, positions, polygon);
    for (uint32_t i = 0; i < count; ++i) corners[i] = corner_of(state, polygon[i]);
  } else {
    for (uint32_t i = 0; i < 3; ++i) {
      const PostVertex& vertex = *vertices[i];
      corners[i] = {vertex.x, vertex.y, vertex.z, static_cast<double>(vertex.inverse_w), nullptr, i};
    }
  }

  int64_t area = 0;
  for (uint32_t i = 2; i < count; ++i) area += area2(corners[0], corners[i - 1], corners[i]);
  if (area == 0) return;
  const bool front = (area > 0) == state.front_is_clockwise;
  if (front ? state.cull_front : state.cull_back) return;
  for (uint32_t i = 2; i < count; ++i) {
    // Snapping can turn a sliver of the fan around; what it covers belongs to its neighbours.
    const int64_t part = area2(corners[0], corners[i - 1], corners[i]);
    if (count > 3 && (part > 0) != (area > 0)) continue;
    append_triangle(state, corners[0], corners[i - 1], corners[i], front, vertices, chunk);
  }
}

}  // namespace lapilli
