// From a binned triangle to its edge functions, its depth plane and its attribute planes.
#include <algorithm>
#include <cmath>

#include "geometry/bins.h"

namespace lapilli {
namespace {

struct Corners {
  const BinVertex& p;
  const BinVertex& q;
  const BinVertex& r;
};

Corners corners_of(const BinChunk& chunk, const BinTriangle& triangle) {
  return {chunk.vertices[triangle.v[0]], chunk.vertices[triangle.v[1]], chunk.vertices[triangle.v[2]]};
}

// Depth bias: o = clamp(m * slope + r * constant). Chapter "Rasterization", Depth Bias; r for a float depth buffer.
double depth_bias(const BinRun& run, const EdgeFunctions& edges, const DepthPlane& plane, const Corners& corners) {
  const double dzdx = static_cast<double>(edges[1].a) * plane.k1 + static_cast<double>(edges[2].a) * plane.k2;
  const double dzdy = static_cast<double>(edges[1].b) * plane.k1 + static_cast<double>(edges[2].b) * plane.k2;
  const double slope = std::sqrt(dzdx * dzdx + dzdy * dzdy);
  const double largest = std::max({std::fabs(corners.p.z), std::fabs(corners.q.z), std::fabs(corners.r.z)});
  const double unit = largest > 0 ? std::ldexp(1.0, std::ilogb(largest) - 23) : 0.0;
  double bias = slope * static_cast<double>(run.bias_slope) + unit * static_cast<double>(run.bias_constant);
  const double limit = static_cast<double>(run.bias_clamp);
  if (limit > 0) bias = std::min(bias, limit);
  if (limit < 0) bias = std::max(bias, limit);
  return std::isnan(bias) ? 0.0 : bias;
}

double inverse_area2(const EdgeFunctions& edges) {
  return 1.0 / static_cast<double>(edges[0].c + edges[1].c + edges[2].c);
}

}  // namespace

CoverageEdges make_edges(const BinChunk& chunk, const BinTriangle& triangle) {
  const EdgeFunctions edges = make_edge_functions(chunk, triangle);
  CoverageEdges out;
  for (size_t i = 0; i < 3; ++i) {
    // a and b are multiples of 256, so floor(c / 256) decides the same.
    out.a[i] = static_cast<int32_t>(edges[i].a >> 8);
    out.b[i] = static_cast<int32_t>(edges[i].b >> 8);
    out.c[i] = (edges[i].c - (edges[i].owns ? 0 : 1)) >> 8;
  }
  return out;
}

DepthPlane make_depth_plane(const BinChunk& chunk, const BinTriangle& triangle, const EdgeFunctions& edges) {
  const auto [p, q, r] = corners_of(chunk, triangle);
  const BinRun& run = chunk.run_of(triangle);
  const double inverse = inverse_area2(edges);
  DepthPlane plane = {p.z, (q.z - p.z) * inverse, (r.z - p.z) * inverse, run.min_depth, run.max_depth};
  if (run.depth_bias) plane.z0 += depth_bias(run, edges, plane, {p, q, r});
  return plane;
}

TriangleSetup make_triangle_setup(const BinChunk& chunk, const BinTriangle& triangle) {
  const auto [p, q, r] = corners_of(chunk, triangle);
  const EdgeFunctions edges = make_edge_functions(chunk, triangle);
  TriangleSetup setup;
  for (size_t i = 0; i < 3; ++i) {
    setup.edge_a[i] = static_cast<double>(edges[i].a);
    setup.edge_b[i] = static_cast<double>(edges[i].b);
    setup.edge_c[i] = static_cast<double>(edges[i].c);
  }
  setup.inverse_area2 = inverse_area2(edges);
  setup.depth = make_depth_plane(chunk, triangle, edges);
  setup.inverse_w[0] = p.inverse_w;
  setup.inverse_w[1] = q.inverse_w;
  setup.inverse_w[2] = r.inverse_w;
  setup.varyings = nullptr;
  setup.front_facing = triangle.front_facing() ? ~0u : 0u;
  setup.coordinates = nullptr;
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
