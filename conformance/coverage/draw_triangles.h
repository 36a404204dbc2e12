// Draws triangles given in clip coordinates, each vertex with a flat colour, into an R8G8B8A8_UNORM image.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "harness/canvas.h"
#include "oracle/coverage.h"

namespace lapilli::conformance {

enum class Topology : uint8_t { kList, kStrip, kFan };
enum class Indices : uint8_t { kNone, k16, k32 };

struct TriangleDraw {
  std::vector<oracle::ClipVertex> vertices;
  std::vector<std::array<float, 4>> colors;  // one for each vertex, or empty: white; the provoking vertex decides
  std::vector<uint32_t> indices;             // used unless index_type is kNone
  Indices index_type = Indices::kNone;
  int32_t vertex_offset = 0;
  Topology topology = Topology::kList;
  bool primitive_restart = false;
  bool count = false;  // add 1/255 to every component for every fragment, instead of drawing the colour
  oracle::RasterState raster;
};

// All draws in one render pass over a black, transparent image.
std::vector<uint32_t> draw_triangles(const samples::Context& context, uint32_t width, uint32_t height,
                                     std::span<const TriangleDraw> draws);

// The triangles a draw assembles, provoking vertex first ("Primitive Topologies"), as indices into vertices.
std::vector<std::array<uint32_t, 3>> assemble(const TriangleDraw& draw);

// Whole framebuffer, depth range [0, 1], nothing culled.
oracle::RasterState full_state(uint32_t width, uint32_t height);

}  // namespace lapilli::conformance
