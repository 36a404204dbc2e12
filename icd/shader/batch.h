// What a batch of 64 lanes gets as input besides registers: filled by geometry/ (vertices), raster/ (fragments) and
// compute dispatch, read by the interpreter's ops. Plain structs of arrays.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "image/tile.h"
#include "shader/ir.h"
#include "shader/resources.h"

namespace lapilli {

constexpr uint32_t kBatchLanes = 64;
constexpr uint32_t kBatchQuads = 16;

constexpr uint32_t kMaxVertexBindings = 16;
constexpr uint32_t kMaxVertexAttributes = 16;
constexpr uint32_t kMaxColorAttachments = 8;

constexpr uint32_t kMaxWorkgroupInvocations = 1024;
constexpr uint32_t kMaxWorkgroupBatches = kMaxWorkgroupInvocations / kBatchLanes;
constexpr uint32_t kMaxSharedBytes = 65536;  // of a workgroup

// All lanes of the quads that have one in `lanes`.
inline uint64_t whole_quads(uint64_t lanes) { return live_quads(lanes) * 15; }

struct VertexBinding {
  const std::byte* data = nullptr;
  uint64_t size = 0;    // bytes; an attribute that does not lie inside reads as 0 0 0 1 (robustBufferAccess)
  uint32_t stride = 0;  // bytes
  bool per_instance = false;
};

struct VertexBatch {
  alignas(64) uint32_t vertex_index[kBatchLanes];    // with vertexOffset / firstVertex added; all 64 initialized
  alignas(64) uint32_t instance_index[kBatchLanes];  // with firstInstance added
  uint32_t draw_parameters[3] = {};                  // BuiltIn::base_vertex …: of one draw, if the program reads them
  const VertexBinding* bindings = nullptr;
  float* outputs = nullptr;  // [slot][kBatchLanes], slots as in ir.h (kSlotPosition …), 64-byte aligned
};

// Depth of a triangle in framebuffer space: z(x, y) = (E_1 * k1 + E_2 * k2) + z0 in double with the edge functions of
// TriangleSetup, rounded once to float, then clamped. Depth bias is in z0.
struct DepthPlane {
  double z0, k1, k2;  // at vertex 0; (z_i - z_0) / area2
  float min, max;     // clamp range (the viewport's minDepth, maxDepth, in order)
};

// Perspective-correct barycentric coordinates 1 and 2 in the blocks of a tile: of the triangles that lie where the one
// before them did, layer upon layer.
struct TileCoordinates {
  uint64_t known = 0;  // blocks, by bit
  alignas(64) float lambda[64][2][kBatchLanes];
};

// A triangle ready for shading. Framebuffer positions are 24.8 fixed point; edge i is opposite vertex i:
// E_i(x, y) = a_i*x + b_i*y + c_i for a pixel centre at (256x+128, 256y+128), positive inside, sum = area2 everywhere.
// All of them are integers below 2^53 in magnitude, so doubles hold and add them exactly.
struct TriangleSetup {
  double edge_a[3];      // change of E_i for one pixel in x
  double edge_b[3];      // change of E_i for one pixel in y
  double edge_c[3];      // E_i at the centre of framebuffer pixel (0, 0), without the fill-rule bias
  double inverse_area2;  // 1 / (E_0 + E_1 + E_2)
  DepthPlane depth;
  float inverse_w[3];            // 1 / w_clip of the vertices
  const float* varyings;         // [component][3]: a0, a1 - a0, a2 - a0; flat components: provoking vertex's bits, 0, 0
  uint32_t front_facing;         // 0 or ~0
  TileCoordinates* coordinates;  // those of the tile that is drawn, for whole blocks; null: nobody has the same
};

// Planes of one tile (image/tile.h): quad q of the tile holds texels 4q .. 4q+3; quads are counted block by block.
struct TilePlanes {
  std::byte* color[kMaxColorAttachments] = {};
  std::byte* depth = nullptr;
};

// The triangles of a batch where each lane may have its own: the pixels of one block, for programs that look at no
// other lanes (FragmentPlan::pixels_alone). Arrays by the triangle's number; edges 1 and 2 are those of TriangleSetup,
// edge_c at the block's first pixel.
struct LaneTriangles {
  static constexpr uint32_t kMostShared = 16;
  bool by_lane;                            // lane i has triangle i; else slot[i], below kMostShared
  alignas(64) uint32_t slot[kBatchLanes];  // all initialized
  alignas(64) double edge_a[2][kBatchLanes], edge_b[2][kBatchLanes], edge_c[2][kBatchLanes];
  alignas(64) double inverse_area2[kBatchLanes];
  alignas(64) float inverse_w[3][kBatchLanes];
  alignas(64) uint32_t front_facing[kBatchLanes];
  alignas(64) float varyings[kMaxVaryingComponents][3][kBatchLanes];
};

struct FragmentBatch {
  const TriangleSetup* triangle[kBatchQuads];  // not null without lane_triangles; unused quads repeat a used one
  alignas(64) uint16_t x[kBatchQuads];         // framebuffer pixel of the quad's lane 0 (both even)
  alignas(64) uint16_t y[kBatchQuads];
  alignas(64) uint16_t quad_in_tile[kBatchQuads];
  bool one_triangle = false;  // triangle[i] are all the same
  // The 16 quads are those of one 8x8 block, in order and all used: quad_in_tile[i] == quad_in_tile[0] + i, a multiple
  // of 16 the first.
  bool whole_block = false;
  const LaneTriangles* lane_triangles = nullptr;  // instead of `triangle`; of a whole block, and no lane is a helper
  TilePlanes planes;
  float blend_constants[4] = {};
  uint64_t* samples_passed = nullptr;  // occlusion counter of this worker
};

struct ComputeBatch {
  uint32_t workgroup[3] = {};
  uint32_t num_workgroups[3] = {};
  uint32_t first_invocation = 0;  // local index of lane 0
};

}  // namespace lapilli
