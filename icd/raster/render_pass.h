// A whole render pass (one subpass) drawn: geometry is binned, then each tile is loaded, worked on in cache and stored
// once.
#pragma once

#include <vulkan/vulkan_core.h>

#include <memory>
#include <span>

#include "base/thread_pool.h"
#include "geometry/draw_call.h"
#include "image/format.h"

namespace lapilli {

// One image level and layer as the pass sees it: row-major, `row_pitch` bytes a row.
struct AttachmentTarget {
  std::byte* data = nullptr;  // null: unused
  const FormatInfo* format = nullptr;
  uint64_t row_pitch = 0;
  uint64_t sample_pitch = 0;  // bytes from one sample's image to the next one's
  VkAttachmentLoadOp load_op = VK_ATTACHMENT_LOAD_OP_LOAD;
  VkAttachmentStoreOp store_op = VK_ATTACHMENT_STORE_OP_STORE;
  VkClearValue clear = {};
};

struct PassTarget {
  uint32_t width = 0, height = 0;  // framebuffer size in pixels
  VkRect2D render_area = {};       // load and store ops and drawing apply to it only
  std::span<const AttachmentTarget> color;
  AttachmentTarget depth;
  uint32_t samples = 1;
};

// Memory that is kept between passes: bins, tile storage, registers of the workers. One per queue.
class Renderer {
 public:
  explicit Renderer(ThreadPool& pool);
  ~Renderer();
  // VK_SUCCESS, VK_ERROR_OUT_OF_HOST_MEMORY, or VK_ERROR_DEVICE_LOST when a shader ran past its time limit.
  VkResult render(const PassTarget& target, std::span<const DrawCall> draws, ExecutionLimits& limits);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lapilli
