// Index fetch and primitive assembly. Specification: chapter "Drawing Commands", Primitive Topologies and Programmable
// Primitive Shading.
#pragma once

#include <cstdint>
#include <span>

#include "geometry/draw_call.h"

namespace lapilli {

// Vertices of a draw between two primitive restarts: positions [first, first + count) in the index buffer, or vertex
// numbers.
struct VertexRun {
  uint64_t first = 0;
  uint32_t count = 0;
};

bool is_triangle_topology(VkPrimitiveTopology topology);

// Complete triangles in a run.
uint32_t triangle_count(VkPrimitiveTopology topology, uint32_t vertices);

// The runs of a draw, one after the other: one, or as many as primitive restart makes. `position`: where to go on,
// relative to draw.first; 0 at the start. False: there are no more.
bool next_run(const DrawCall& draw, uint32_t& position, VertexRun& run);

// The indices at positions [first, first + out.size()) of the index buffer, as 32 bits; 0 outside of the buffer
// (robustBufferAccess).
void read_indices(const IndexBuffer& indices, uint64_t first, std::span<uint32_t> out);

// Vertex indices (vertexOffset or firstVertex included) of triangles [first, first + out.size() / 3) of a run, three
// for each; the provoking vertex comes first, the winding is kept.
void assemble_triangles(const DrawCall& draw, const VertexRun& run, uint32_t first, std::span<uint32_t> out);

}  // namespace lapilli
