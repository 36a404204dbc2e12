// Recording of copies, fills and clears.
#include "command/record.h"

namespace lapilli {
namespace {

template <class C, class Source, class Target, class Region>
C& record_regions(CommandBuffer& commands, Source* source, Target* target, std::span<const Region> regions) {
  C& command = commands.record<C>();
  command.source = source;
  command.target = target;
  command.regions = commands.copy(regions);
  return command;
}

}  // namespace

void record_copy_buffer(CommandBuffer& commands, Buffer* source, Buffer* target,
                        std::span<const VkBufferCopy> regions) {
  record_regions<cmd::CopyBuffer>(commands, source, target, regions);
}

void record_copy_image(CommandBuffer& commands, Image* source, Image* target, std::span<const VkImageCopy> regions) {
  record_regions<cmd::CopyImage>(commands, source, target, regions);
}

void record_copy_buffer_to_image(CommandBuffer& commands, Buffer* source, Image* target,
                                 std::span<const VkBufferImageCopy> regions) {
  record_regions<cmd::CopyBufferToImage>(commands, source, target, regions);
}

void record_copy_image_to_buffer(CommandBuffer& commands, Image* source, Buffer* target,
                                 std::span<const VkBufferImageCopy> regions) {
  record_regions<cmd::CopyImageToBuffer>(commands, source, target, regions);
}

void record_blit_image(CommandBuffer& commands, Image* source, Image* target, std::span<const VkImageBlit> regions,
                       VkFilter filter) {
  record_regions<cmd::BlitImage>(commands, source, target, regions).filter = filter;
}

void record_update_buffer(CommandBuffer& commands, Buffer* target, uint64_t offset, std::span<const std::byte> data) {
  auto& command = commands.record<cmd::UpdateBuffer>();
  command.target = target;
  command.offset = offset;
  command.data = commands.copy(data);
}

void record_fill_buffer(CommandBuffer& commands, Buffer* target, uint64_t offset, uint64_t size, uint32_t word) {
  auto& command = commands.record<cmd::FillBuffer>();
  command.target = target;
  command.offset = offset;
  command.size = size;
  command.word = word;
}

void record_clear_image(CommandBuffer& commands, Image* image, const VkClearValue& value,
                        std::span<const VkImageSubresourceRange> ranges) {
  auto& command = commands.record<cmd::ClearImage>();
  command.image = image;
  command.value = value;
  command.ranges = commands.copy(ranges);
}

void record_clear_attachments(CommandBuffer& commands, std::span<const VkClearAttachment> attachments,
                              std::span<const VkClearRect> rectangles) {
  auto& command = commands.record<cmd::ClearAttachments>();
  command.attachments = commands.copy(attachments);
  command.rectangles = commands.copy(rectangles);
}

}  // namespace lapilli
