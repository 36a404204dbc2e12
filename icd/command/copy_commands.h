// Copies, fills and clears. Specification: chapters "Copy Commands", "Clear Commands".
#pragma once

#include <span>

#include "command/command.h"
#include "object/buffer.h"
#include "object/image.h"

namespace lapilli::cmd {

struct CopyBuffer : CommandOf<CommandKind::kCopyBuffer> {
  Buffer* source = nullptr;
  Buffer* target = nullptr;
  std::span<const VkBufferCopy> regions;
};
struct CopyImage : CommandOf<CommandKind::kCopyImage> {
  Image* source = nullptr;
  Image* target = nullptr;
  std::span<const VkImageCopy> regions;
};
struct CopyBufferToImage : CommandOf<CommandKind::kCopyBufferToImage> {
  Buffer* source = nullptr;
  Image* target = nullptr;
  std::span<const VkBufferImageCopy> regions;
};
struct CopyImageToBuffer : CommandOf<CommandKind::kCopyImageToBuffer> {
  Image* source = nullptr;
  Buffer* target = nullptr;
  std::span<const VkBufferImageCopy> regions;
};
struct BlitImage : CommandOf<CommandKind::kBlitImage> {
  Image* source = nullptr;
  Image* target = nullptr;
  std::span<const VkImageBlit> regions;
  VkFilter filter = VK_FILTER_NEAREST;
};

struct UpdateBuffer : CommandOf<CommandKind::kUpdateBuffer> {
  Buffer* target = nullptr;
  uint64_t offset = 0;  // bytes
  std::span<const std::byte> data;
};
struct FillBuffer : CommandOf<CommandKind::kFillBuffer> {
  Buffer* target = nullptr;
  uint64_t offset = 0;  // bytes
  uint64_t size = 0;    // bytes, or VK_WHOLE_SIZE
  uint32_t word = 0;
};

// vkCmdClearColorImage and vkCmdClearDepthStencilImage.
struct ClearImage : CommandOf<CommandKind::kClearImage> {
  Image* image = nullptr;
  VkClearValue value = {};
  std::span<const VkImageSubresourceRange> ranges;
};
struct ClearAttachments : CommandOf<CommandKind::kClearAttachments> {
  std::span<const VkClearAttachment> attachments;
  std::span<const VkClearRect> rectangles;
};

}  // namespace lapilli::cmd
