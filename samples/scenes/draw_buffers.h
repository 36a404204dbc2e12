// The vertex and index buffer of one indexed draw.
#pragma once

#include <span>

#include "common/resources.h"

namespace lapilli::samples {

class DrawBuffers {
 public:
  DrawBuffers() = default;
  template <typename Vertex>
  DrawBuffers(const Context& context, std::span<const Vertex> vertices, std::span<const uint32_t> indices)
      : vertices_(context, vertices, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT),
        indices_(context, indices, VK_BUFFER_USAGE_INDEX_BUFFER_BIT),
        count_(static_cast<uint32_t>(indices.size())) {}

  void draw(VkCommandBuffer commands) const {
    const VkDeviceSize offset = 0;
    VkBuffer vertices = vertices_.get();
    vkCmdBindVertexBuffers(commands, 0, 1, &vertices, &offset);
    vkCmdBindIndexBuffer(commands, indices_.get(), 0, VK_INDEX_TYPE_UINT32);
    vkCmdDrawIndexed(commands, count_, 1, 0, 0, 0);
  }

 private:
  Buffer vertices_;
  Buffer indices_;
  uint32_t count_ = 0;
};

}  // namespace lapilli::samples
