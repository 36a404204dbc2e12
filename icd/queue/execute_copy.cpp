// Copies between buffers and images. A region that does not lie in its resources is skipped.
// Specification: chapters "Copy Commands", "Clear Commands" (fill and update).
#include <algorithm>
#include <cstring>

#include "base/log.h"
#include "queue/command_executor.h"

namespace lapilli {
namespace {

void report_outside(const char* what) { log_error("%s: a region does not lie in its buffer or image", what); }

bool inside(const BufferMemory& memory, uint64_t offset, uint64_t size) {
  return offset <= memory.size && size <= memory.size - offset;
}

ConstImageMemory source_of(Image& image) { return {&image.layout, image.data}; }
ConstBufferMemory source_of(Buffer& buffer) {
  const BufferMemory memory = buffer.bytes();
  return {memory.data, memory.size};
}
ImageMemory target_of(Image& image) { return image.texels(); }
BufferMemory target_of(Buffer& buffer) { return buffer.bytes(); }

// `copy` is one of image/copy.h; nothing happens where memory is missing.
template <class C, class Copy>
void copy_regions(const C& command, const char* what, Copy copy) {
  const auto source = source_of(*command.source);
  const auto target = target_of(*command.target);
  if (source.data == nullptr || target.data == nullptr) return report_outside(what);
  for (const auto& region : command.regions) {
    if (!copy(source, target, region)) report_outside(what);
  }
}

}  // namespace

void execute(CommandExecutor&, const cmd::CopyBuffer& command) {
  const BufferMemory source = command.source->bytes();
  const BufferMemory target = command.target->bytes();
  for (const VkBufferCopy& region : command.regions) {
    if (!inside(source, region.srcOffset, region.size) || !inside(target, region.dstOffset, region.size)) {
      report_outside("vkCmdCopyBuffer");
      continue;
    }
    std::memmove(target.data + region.dstOffset, source.data + region.srcOffset, region.size);
  }
}

void execute(CommandExecutor&, const cmd::CopyImage& command) { copy_regions(command, "vkCmdCopyImage", copy_image); }

void execute(CommandExecutor&, const cmd::CopyBufferToImage& command) {
  copy_regions(command, "vkCmdCopyBufferToImage", copy_buffer_to_image);
}

void execute(CommandExecutor&, const cmd::CopyImageToBuffer& command) {
  copy_regions(command, "vkCmdCopyImageToBuffer", copy_image_to_buffer);
}

void execute(CommandExecutor&, const cmd::UpdateBuffer& command) {
  const BufferMemory target = command.target->bytes();
  if (!inside(target, command.offset, command.data.size())) return report_outside("vkCmdUpdateBuffer");
  std::copy(command.data.begin(), command.data.end(), target.data + command.offset);
}

void execute(CommandExecutor&, const cmd::FillBuffer& command) {
  // Whole words; what is left of VK_WHOLE_SIZE is not filled.
  const BufferMemory target = command.target->bytes(command.offset, command.size);
  PackedTexel texel = {};
  std::memcpy(texel.data(), &command.word, sizeof(command.word));
  fill_texels(target.data, target.size / sizeof(command.word), sizeof(command.word), texel);
}

}  // namespace lapilli
