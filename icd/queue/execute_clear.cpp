// Clears of images, and of attachments inside a render pass. Specification: chapter "Clear Commands".
#include <algorithm>

#include "base/log.h"
#include "queue/command_executor.h"

namespace lapilli {

void execute(CommandExecutor&, const cmd::ClearImage& command) {
  const ImageMemory image = command.image->texels();
  const PackedTexel texel = pack_clear_value(*image.layout->format, command.value);
  for (const VkImageSubresourceRange& range : command.ranges) {
    if (image.data == nullptr || !clear_image(image, range, texel)) {
      log_error("a clear does not lie in its image");
    }
  }
}

void clear_rectangle(const ImageView& view, const VkRect2D& rectangle, uint32_t first_layer, uint32_t layers,
                     const VkClearValue& value) {
  const ImageLayout& layout = view.image->layout;
  const LevelLayout& level = layout.levels[view.range.baseMipLevel];
  const int64_t left = std::max<int64_t>(rectangle.offset.x, 0);
  const int64_t top = std::max<int64_t>(rectangle.offset.y, 0);
  const int64_t right = std::min<int64_t>(int64_t{rectangle.offset.x} + rectangle.extent.width, level.width);
  const int64_t bottom = std::min<int64_t>(int64_t{rectangle.offset.y} + rectangle.extent.height, level.height);
  if (left >= right || top >= bottom || view.image->data == nullptr) return;
  const PackedTexel texel = pack_clear_value(*view.format, value);
  const uint32_t texel_size = view.format->texel_size;
  const uint32_t end_layer =
      static_cast<uint32_t>(std::min<uint64_t>(uint64_t{first_layer} + layers, view.range.layerCount));
  for (uint32_t layer = first_layer; layer < end_layer; ++layer) {
    std::byte* base =
        view.image->data + texel_offset(layout, view.range.baseMipLevel, view.range.baseArrayLayer + layer);
    for (int64_t y = top; y < bottom; ++y) {
      std::byte* row = base + static_cast<uint64_t>(y) * level.row_pitch + static_cast<uint64_t>(left) * texel_size;
      fill_texels(row, static_cast<uint64_t>(right - left), texel_size, texel);
    }
  }
}

namespace {

// Null where the clear names an unused attachment.
const ImageView* attachment_of(const PassState& pass, const VkClearAttachment& clear) {
  const Subpass& subpass = pass.pass->subpasses[pass.subpass];
  uint32_t index = kUnusedAttachment;
  if ((clear.aspectMask & VK_IMAGE_ASPECT_COLOR_BIT) != 0) {
    if (clear.colorAttachment < subpass.color.size()) index = subpass.color[clear.colorAttachment];
  } else if ((clear.aspectMask & VK_IMAGE_ASPECT_DEPTH_BIT) != 0) {
    index = subpass.depth;
  }
  return index == kUnusedAttachment ? nullptr : pass.framebuffer->attachments[index];
}

}  // namespace

// Draws before it are rendered first; those after it load what it wrote.
void execute(CommandExecutor& executor, const cmd::ClearAttachments& command) {
  if (executor.pass.pass == nullptr) return;
  flush_pass(executor, false);
  for (const VkClearAttachment& clear : command.attachments) {
    const ImageView* view = attachment_of(executor.pass, clear);
    if (view == nullptr) continue;
    for (const VkClearRect& area : command.rectangles) {
      clear_rectangle(*view, area.rect, area.baseArrayLayer, area.layerCount, clear.clearValue);
    }
  }
}

}  // namespace lapilli
