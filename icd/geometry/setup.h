// From the vertex program's outputs to BinTriangles: viewport transformation, snapping, clipping, facing and culling.
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
  bool front_is_clockwise;
  bool keep_clockwise, keep_counterclockwise;  // on the screen (y down); the others are culled
  bool clip_depth;
  bool depth_bias;
  float bias_constant, bias_clamp, bias_slope;
  std::span<const Interpolation> varyings;
  uint32_t clip_distances, cull_distances;  // slots behind the varyings
};
SetupState make_setup_state(const DrawState& draw, const PixelRect& area);

// Starts the triangles of a draw.
void begin_run(const SetupState& state, uint32_t draw_index, BinChunk& chunk);

// --- vertices

// The x of a BinVertex that did not come out inside of the guard band and the depth range; its y then tells why, as
// OutCode bits: a triangle whose vertices have one in common has no pixel.
constexpr int32_t kNotInside = INT32_MIN;
enum OutCode : int32_t {
  kOutNear = 1,
  kOutFar = 2,
  kOutInvalid = 4,   // not finite, or a NaN as a clip distance: every triangle with it is dropped
  kOutDistance = 8,  // and the bits above: a clip or cull distance that is negative, in the order of their slots
};

// A vertex as the vertex program gave it.
struct ClipPosition {
  float x, y, z, w;
};

// What clipping needs of a list's vertices.
struct ClipInputs {
  BinArray<ClipPosition> positions;
  BinArray<float> distances;  // [vertex][SetupState::clip_distances]
};

// Transforms the first `lanes` lanes of a vertex program's outputs ([slot][kBatchLanes]) and appends them to the
// chunk's vertices, with their varyings, and to `inputs`. For all SIMD targets the same bits as
// x / w * half_width + centre_x … lane by lane.
void append_vertices(const SetupState& state, const float* outputs, uint32_t lanes, BinChunk& chunk,
                     ClipInputs& inputs);

// --- triangles

// Triangles of consecutive runs with the same state.
struct TriangleList {
  static constexpr uint32_t kPadding = 16;  // triangles; what they say does not matter, but must lie in the arrays

  const uint32_t* corners = nullptr;  // three each, [0] the provoking vertex; from first_vertex on
  const uint32_t* runs = nullptr;     // in BinChunk::runs
  uint32_t count = 0;
  uint32_t first_vertex = 0;           // in BinChunk::vertices
  const ClipInputs* inputs = nullptr;  // from first_vertex on
  uint32_t* removed = nullptr;         // [run]: counts triangles that left nothing; null: nobody asks
};

// Appends what is left of the triangles after clipping and culling. Those without a pixel centre in `rect` are left out
// unless LAPILLI_KEEP says otherwise; for small ones the test is exact.
void append_triangles(const SetupState& state, const TriangleList& list, BinChunk& chunk);
// One that has vertices which are not inside: appends none, one or several.
void clip_and_append(const SetupState& state, const TriangleList& list, uint32_t index, BinChunk& chunk);

// --- chunks

// Empties it; keeps its memory, or gives it back.
void clear_chunk(BinChunk& chunk);
void release_chunk(BinChunk& chunk);
// Sorts the triangles into tiles.
void finish_chunk(const TileGrid& grid, BinChunk& chunk);
// Bytes that it has allocated.
uint64_t memory_of(const BinChunk& chunk);

}  // namespace lapilli
