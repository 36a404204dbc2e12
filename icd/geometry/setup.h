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
  int32_t x, y;  // 24.8 fixed point, if inside
  double z;      // framebuffer space, without depth bias
  float inverse_w;
  VertexClass kind;
  const float* outputs;  // varying component k is outputs[(kSlotVaryings + k) * kBatchLanes]
};
PostVertex post_transform(const SetupState& state, const float* outputs);

// Appends what is left of a triangle after clipping and culling: none, one or several triangles.
// vertices[0] is the provoking vertex. TriangleSetup::varyings is set by `finish_chunk`.
void set_up_triangle(const SetupState& state, const PostVertex* const (&vertices)[3], BinChunk& chunk);

// Sets the varying pointers and sorts the triangles into tiles.
void finish_chunk(const TileGrid& grid, std::span<const DrawCall> draws, BinChunk& chunk);

}  // namespace lapilli
