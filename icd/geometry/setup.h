// From three vertices to a BinTriangle: snapping, facing and culling, edge functions, depth and attribute differences.
// Specification: chapter "Rasterization", Polygons; "Fixed-Function Vertex Post-Processing", Controlling the Viewport.
#pragma once

#include <cstdint>
#include <span>

#include "geometry/bins.h"
#include "geometry/clip.h"

namespace lapilli {

// What is the same for all triangles of a draw.
struct SetupState {
  ClipSpace clip_space;
  // Framebuffer x = x/w * half_width + centre_x, in float32, multiply then add; likewise y.
  float half_width, half_height, centre_x, centre_y;
  double depth_scale, depth_offset;  // z_f = z/w * scale + offset
  float min_depth, max_depth;        // clamp range of the interpolated depth
  PixelRect rect;                    // scissor, viewport rectangle, render area: pixels that may be written
  bool cull_front, cull_back, front_is_clockwise;
  bool clip_depth;
  bool depth_bias;
  float bias_constant, bias_clamp, bias_slope;
  std::span<const Interpolation> varyings;
  uint32_t draw;
};
SetupState make_setup_state(const DrawCall& draw, uint32_t draw_index, const PixelRect& area);

enum class VertexClass : uint8_t { inside, needs_clipping, dropped };

// A vertex after the vertex program and the viewport transformation.
struct PostVertex {
  float clip[4];
  VertexClass kind;
};

// Transforms one lane of a vertex program's outputs ([slot][kBatchLanes]) and appends it to the chunk's vertices, with
// its varyings; x, y, z and 1/w have no meaning unless it is inside.
PostVertex append_vertex(const SetupState& state, const float* outputs, BinChunk& chunk);

// Appends what is left of a triangle after clipping and culling: none, one or several triangles of the last run.
// [0] is the provoking vertex; `index`: in the chunk's vertices.
struct TriangleVertices {
  const PostVertex* vertex[3];
  uint32_t index[3];
};
void set_up_triangle(const SetupState& state, const TriangleVertices& vertices, BinChunk& chunk);

// Starts the triangles of a draw.
void begin_run(const SetupState& state, BinChunk& chunk);
// Empties it; keeps its memory.
void clear_chunk(BinChunk& chunk);
// Sorts the triangles into tiles.
void finish_chunk(const TileGrid& grid, BinChunk& chunk);

}  // namespace lapilli
