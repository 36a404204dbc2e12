// Index fetch and primitive assembly. Specification: chapter "Drawing Commands", Primitive Topologies and Programmable
// Primitive Shading.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/draw_call.h"

namespace lapilli {

// Vertices of a draw between two primitive restarts: positions [first, first + count) in the index buffer, or vertex
// numbers.
struct VertexRun {
  uint32_t first = 0;
  uint32_t count = 0;
};

bool is_triangle_topology(VkPrimitiveTopology topology);

// Complete triangles in a run.
uint32_t triangle_count(VkPrimitiveTopology topology, uint32_t vertices);

// Positions, within a run, of the vertices of triangle `i`; the provoking vertex comes first, the winding is kept.
struct TrianglePositions {
  uint32_t v[3];
};
TrianglePositions triangle_positions(VkPrimitiveTopology topology, uint32_t i);

// The index at a position of the index buffer, as 32 bits; 0 outside of the buffer (robustBufferAccess).
uint32_t read_index(const IndexBuffer& indices, uint64_t position);

// The runs of a draw: one, or as many as primitive restart makes.
void split_runs(const DrawCall& draw, std::vector<VertexRun>& runs);

}  // namespace lapilli
