// From a binned triangle to its edge functions, its depth plane and its attribute planes.
#include <algorithm>
#include <cmath>

#include "geometry/bins.h"

namespace lapilli {
namespace {

// An edge function through q -> r, positive on the side of p, for pixel centres: a*x + b*y + c in 1/65536 square
// pixels.
struct Edge {
  int64_t a, b, c;
  // Top-left rule: a centre on the edge belongs to the triangle if the interior lies at greater x, or the edge is
  // horizontal and the interior lies at greater y.
  bool owns;
};

Edge make_edge(const BinVertex& q, const BinVertex& r) {
  const int64_t dx = int64_t{r.x} - q.x;
  const int64_t dy = int64_t{r.y} - q.y;
  return {-dy * 256, dx * 256, dx * (128 - int64_t{q.y}) - dy * (128 - int64_t{q.x}), dy < 0 || (dy == 0 && dx > 0)};
}

struct Corners {
  const BinVertex& p;
  const BinVertex& q;
  const BinVertex& r;
};

Corners corners_of(const BinChunk& chunk, const BinTriangle& triangle) {
  return {chunk.vertices[triangle.v[0]], chunk.vertices[triangle.v[1]], chunk.vertices[triangle.v[2]]};
}

// Depth bias: o = clamp(m * slope + r * constant). Chapter "Rasterization", Depth Bias; r for a float depth buffer.
double depth_bias(const BinRun& run, const TriangleSetup& setup, const Corners& corners) {
  const double dzdx = setup.edge_a[1] * setup.depth.k1 + setup.edge_a[2] * setup.depth.k2;
  const double dzdy = setup.edge_b[1] * setup.depth.k1 + setup.edge_b[2] * setup.depth.k2;
  const double slope = std::sqrt(dzdx * dzdx + dzdy * dzdy);
  const double largest = std::max({std::fabs(corners.p.z), std::fabs(corners.q.z), std::fabs(corners.r.z)});
  const double unit = largest > 0 ? std::ldexp(1.0, std::ilogb(largest) - 23) : 0.0;
  double bias = slope * static_cast<double>(run.bias_slope) + unit * static_cast<double>(run.bias_constant);
  const double limit = static_cast<double>(run.bias_clamp);
  if (limit > 0) bias = std::min(bias, limit);
  if (limit < 0) bias = std::max(bias, limit);
  return std::isnan(bias) ? 0.0 : bias;
}

}  // namespace

CoverageEdges make_edges(const BinChunk& chunk, const BinTriangle& triangle) {
  const auto [p, q, r] = corners_of(chunk, triangle);
  const Edge edges[3] = {make_edge(q, r), make_edge(r, p), make_edge(p, q)};
  CoverageEdges out;
  for (int i = 0; i < 3; ++i) {
    // a and b are multiples of 256, so floor(c / 256) decides the same.
    out.a[i] = static_cast<int32_t>(edges[i].a >> 8);
    out.b[i] = static_cast<int32_t>(edges[i].b >> 8);
    out.c[i] = (edges[i].c - (edges[i].owns ? 0 : 1)) >> 8;
  }
  return out;
}

TriangleSetup make_triangle_setup(const BinChunk& chunk, const BinTriangle& triangle) {
  const auto [p, q, r] = corners_of(chunk, triangle);
  const Edge edges[3] = {make_edge(q, r), make_edge(r, p), make_edge(p, q)};
  TriangleSetup setup;
  for (int i = 0; i < 3; ++i) {
    setup.edge_a[i] = static_cast<double>(edges[i].a);
    setup.edge_b[i] = static_cast<double>(edges[i].b);
    setup.edge_c[i] = static_cast<double>(edges[i].c);
  }
  setup.inverse_area2 = 1.0 / static_cast<double>(edges[0].c + edges[1].c + edges[2].c);
  const BinRun& run = chunk.run_of(triangle);
  setup.depth = {p.z, (q.z - p.z) * setup.inverse_area2, (r.z - p.z) * setup.inverse_area2, run.min_depth,
                 run.max_depth};
  if (run.depth_bias) setup.depth.z0 += depth_bias(run, setup, {p, q, r});
  setup.inverse_w[0] = p.inverse_w;
  setup.inverse_w[1] = q.inverse_w;
  setup.inverse_w[2] = r.inverse_w;
  setup.varyings = nullptr;
  setup.front_facing = triangle.front_facing() ? ~0u : 0u;
  return setup;
}

void make_varying_planes(const BinChunk& chunk, const BinTriangle& triangle, float* planes) {
  const auto [p, q, r] = corners_of(chunk, triangle);
  const float* const all = chunk.varyings.data();
  const std::span<const Interpolation> modes = chunk.run_of(triangle).varyings;
  for (size_t k = 0; k < modes.size(); ++k, planes += 3) {
    const float a0 = all[p.varyings + k];
    const bool flat = modes[k] == Interpolation::flat;
    planes[0] = a0;
    planes[1] = flat ? 0 : all[q.varyings + k] - a0;
    planes[2] = flat ? 0 : all[r.varyings + k] - a0;
  }
}

}  // namespace lapilli
