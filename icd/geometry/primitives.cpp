// Which vertices make which triangle.
#include "geometry/primitives.h"

#include <cstring>

namespace lapilli {

bool is_triangle_topology(VkPrimitiveTopology topology) {
  return topology == VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST || topology == VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP ||
         topology == VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN;
}

uint32_t triangle_count(VkPrimitiveTopology topology, uint32_t vertices) {
  if (topology == VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST) return vertices / 3;
  return vertices < 3 ? 0 : vertices - 2;
}

TrianglePositions triangle_positions(VkPrimitiveTopology topology, uint32_t i) {
  switch (topology) {
    case VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP:
      return {{i, i + 1 + i % 2, i + 2 - i % 2}};
    case VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN:
      return {{i + 1, i + 2, 0}};
    default:
      return {{3 * i, 3 * i + 1, 3 * i + 2}};
  }
}

uint32_t read_index(const IndexBuffer& indices, uint64_t position) {
  const uint64_t size = indices.type == VK_INDEX_TYPE_UINT16 ? 2 : 4;
  if (position >= indices.size / size) return 0;
  uint32_t index = 0;
  std::memcpy(&index, indices.data + position * size, size);  // little endian: the low bytes come first
  return index;
}

void split_runs(const DrawCall& draw, std::vector<VertexRun>& runs) {
  runs.clear();
  if (draw.indices.data == nullptr || !draw.state->raster.primitive_restart) {
    runs.push_back({draw.first, draw.count});
    return;
  }
  const uint32_t restart = draw.indices.type == VK_INDEX_TYPE_UINT16 ? 0xFFFFu : 0xFFFFFFFFu;
  VertexRun run{draw.first, 0};
  for (uint32_t i = 0; i < draw.count; ++i) {
    const uint64_t position = uint64_t{draw.first} + i;
    if (read_index(draw.indices, position) != restart) {
      ++run.count;
      continue;
    }
    if (run.count > 0) runs.push_back(run);
    run = {static_cast<uint32_t>(position + 1), 0};
  }
  if (run.count > 0) runs.push_back(run);
}

}  // namespace lapilli
