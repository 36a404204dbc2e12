// Which vertices make which triangle.
#include "geometry/primitives.h"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace lapilli {
namespace {

template <class T>
T index_at(const IndexBuffer& indices, uint64_t position) {
  T index;
  std::memcpy(&index, indices.data + position * sizeof(T), sizeof(T));
  return index;
}

// Indices of the buffer that lie inside of it, from `first` on, `most` at most.
template <class T>
uint32_t indices_inside(const IndexBuffer& indices, uint64_t first, uint64_t most) {
  const uint64_t all = indices.size / sizeof(T);
  return static_cast<uint32_t>(first < all ? std::min(all - first, most) : 0);
}

template <class T>
void read(const IndexBuffer& indices, uint64_t first, std::span<uint32_t> out) {
  const uint32_t inside = indices_inside<T>(indices, first, out.size());
  if constexpr (sizeof(T) == sizeof(uint32_t)) {
    if (inside > 0) std::memcpy(out.data(), indices.data + first * sizeof(T), inside * sizeof(T));
  } else {
    for (uint32_t i = 0; i < inside; ++i) out[i] = index_at<T>(indices, first + i);
  }
  std::fill(out.begin() + inside, out.end(), 0u);
}

// Vertices from the start of a run to the next restart, `most` at most. Restart is the largest index; what lies outside
// of the buffer is 0 and thus none.
template <class T>
uint32_t run_length(const IndexBuffer& indices, uint64_t first, uint32_t most) {
  const uint32_t inside = indices_inside<T>(indices, first, most);
  for (uint32_t i = 0; i < inside; ++i) {
    if (index_at<T>(indices, first + i) == static_cast<T>(~T{0})) return i;
  }
  return most;
}

// Vertex indices at consecutive positions of a run.
void read_vertices(const DrawCall& draw, const VertexRun& run, uint64_t position, std::span<uint32_t> out) {
  if (draw.indices.data == nullptr) {
    std::iota(out.begin(), out.end(), static_cast<uint32_t>(run.first + position));
    return;
  }
  read_indices(draw.indices, run.first + position, out);
  const uint32_t offset = static_cast<uint32_t>(draw.vertex_offset);
  if (offset == 0) return;
  for (uint32_t& index : out) index += offset;
}

}  // namespace

bool is_triangle_topology(VkPrimitiveTopology topology) {
  return topology == VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST || topology == VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP ||
         topology == VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN;
}

uint32_t triangle_count(VkPrimitiveTopology topology, uint32_t vertices) {
  if (topology == VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST) return vertices / 3;
  return vertices < 3 ? 0 : vertices - 2;
}

bool next_run(const DrawCall& draw, uint32_t& position, VertexRun& run) {
  if (position >= draw.count) return false;
  const uint32_t left = draw.count - position;
  run = {uint64_t{draw.first} + position, left};
  if (draw.indices.data != nullptr && draw.state->raster.primitive_restart) {
    run.count = draw.indices.type == VK_INDEX_TYPE_UINT16 ? run_length<uint16_t>(draw.indices, run.first, left)
                                                          : run_length<uint32_t>(draw.indices, run.first, left);
  }
  position = run.count < left ? position + run.count + 1 : draw.count;
  return true;
}

void read_indices(const IndexBuffer& indices, uint64_t first, std::span<uint32_t> out) {
  if (indices.type == VK_INDEX_TYPE_UINT16) {
    read<uint16_t>(indices, first, out);
  } else {
    read<uint32_t>(indices, first, out);
  }
}

// Strips and fans: their vertices are read to the end of `out` and spread from there; the triangle that is written
// never reaches what the next one reads.
void assemble_triangles(const DrawCall& draw, const VertexRun& run, uint32_t first, std::span<uint32_t> out) {
  const uint32_t count = static_cast<uint32_t>(out.size() / 3);
  switch (draw.state->raster.topology) {
    case VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP: {
      const std::span<uint32_t> strip = out.last(count + 2);
      read_vertices(draw, run, first, strip);
      for (uint32_t i = 0; i < count; ++i) {
        const bool odd = (first + i) % 2 != 0;
        const uint32_t v[3] = {strip[i], strip[i + (odd ? 2 : 1)], strip[i + (odd ? 1 : 2)]};
        std::copy_n(v, 3, &out[3 * i]);
      }
      return;
    }
    case VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN: {
      uint32_t centre;
      read_vertices(draw, run, 0, {&centre, 1});
      const std::span<uint32_t> rim = out.last(count + 1);
      read_vertices(draw, run, uint64_t{first} + 1, rim);
      for (uint32_t i = 0; i < count; ++i) {
        const uint32_t v[3] = {rim[i], rim[i + 1], centre};
        std::copy_n(v, 3, &out[3 * i]);
      }
      return;
    }
    default:
      read_vertices(draw, run, uint64_t{first} * 3, out);
  }
}

}  // namespace lapilli
