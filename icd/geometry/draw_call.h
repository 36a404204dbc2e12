// A draw with all of its state flattened: what queue/ hands to geometry/ and raster/. Immutable once made.
// What consecutive draws have in common is in blocks that they share: where two draws point to the same block nothing
// in it differs, so that what was made from it for one serves the other too. Specification: chapters "Drawing
// Commands", "Rasterization".
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <cstdint>

#include "base/removals.h"
#include "shader/batch.h"
#include "shader/stage.h"

namespace lapilli {

struct IndexBuffer {
  const std::byte* data = nullptr;  // null: not an indexed draw
  uint64_t size = 0;                // bytes; an index outside reads as 0
  VkIndexType type = VK_INDEX_TYPE_UINT16;
};

struct RasterState {
  VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  bool primitive_restart = false;
  bool depth_clamp = false;
  bool rasterizer_discard = false;
  VkPolygonMode polygon_mode = VK_POLYGON_MODE_FILL;
  VkCullModeFlags cull_mode = VK_CULL_MODE_NONE;
  VkFrontFace front_face = VK_FRONT_FACE_COUNTER_CLOCKWISE;
  bool depth_bias = false;
  float depth_bias_constant = 0, depth_bias_clamp = 0, depth_bias_slope = 0;
  float line_width = 1;
};

// What the pipeline and the dynamic state say.
struct DrawState {
  const GraphicsPrograms* programs = nullptr;
  RasterState raster;
  VkViewport viewport = {};
  VkRect2D scissor = {};
  float blend_constants[4] = {};
};

// Most draws that are rendered at once: an index of a draw fits 16 bits.
constexpr uint32_t kMaxDraws = 1u << 16;

struct DrawCall {
  const DrawState* state = nullptr;
  const VertexBinding* bindings = nullptr;  // as many as the vertex program's attributes name
  const ResourceTable* resources = nullptr;
  IndexBuffer indices;
  uint32_t first = 0;         // firstIndex or firstVertex
  uint32_t count = 0;         // indexCount or vertexCount
  int32_t vertex_offset = 0;  // added to an index
  uint32_t first_instance = 0;
  uint32_t instance_count = 1;
  uint32_t draw_index = 0;             // of those of an indirect command
  uint64_t* samples_passed = nullptr;  // occlusion query result, null: none active
  DrawLedger* ledger = nullptr;        // null: nobody asks
};

// Whether nothing can tell fragments of the two apart, so that they may share a batch.
inline bool share_fragments(const DrawCall& a, const DrawCall& b) {
  if (&a == &b) return true;
  if (a.state != b.state || a.samples_passed != b.samples_passed || a.ledger != nullptr) return false;
  return a.resources == b.resources || !a.state->programs->fragment_reads_resources;
}

}  // namespace lapilli
