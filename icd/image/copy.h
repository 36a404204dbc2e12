// Copies between buffers and images, between images, and clears of images, on the host's memory.
// Specification: chapters "Copy Commands", "Clear Commands". Every function checks its region first and returns false,
// having written nothing, if the region does not lie in the resources.
#pragma once

#include <vulkan/vulkan_core.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "image/texture.h"

namespace lapilli {

// An image with its memory.
template <class Byte>
struct ImageMemoryOf {
  const ImageLayout* layout = nullptr;
  Byte* data = nullptr;  // layout->size bytes
};
using ImageMemory = ImageMemoryOf<std::byte>;
using ConstImageMemory = ImageMemoryOf<const std::byte>;

// Buffer memory from the buffer's first byte; `size` bytes may be accessed.
template <class Byte>
struct BufferMemoryOf {
  Byte* data = nullptr;
  uint64_t size = 0;
};
using BufferMemory = BufferMemoryOf<std::byte>;
using ConstBufferMemory = BufferMemoryOf<const std::byte>;

[[nodiscard]] bool copy_buffer_to_image(ConstBufferMemory source, ImageMemory target, const VkBufferImageCopy& region);
[[nodiscard]] bool copy_image_to_buffer(ConstImageMemory source, BufferMemory target, const VkBufferImageCopy& region);
// Images of the same texel size and sample count. Layers of a 2D image and slices of a 3D image may stand for each
// other.
[[nodiscard]] bool copy_image(ConstImageMemory source, ImageMemory target, const VkImageCopy& region);

// The bytes of one texel, as many as its format has.
using PackedTexel = std::array<std::byte, 16>;

// Colour formats take clear.color as their components' kind says, depth formats clear.depthStencil.depth. UNORM:
// clamped to [0, 1], NaN as 0, rounded to the nearest, half to even; a NaN stored as a float is 0x7FC00000.
PackedTexel pack_clear_value(const FormatInfo& format, const VkClearValue& clear);

// Writes `texel` to the whole of each level and layer of the range, all samples.
[[nodiscard]] bool clear_image(ImageMemory target, const VkImageSubresourceRange& range, const PackedTexel& texel);

// Writes `count` texels of `texel_size` bytes.
void fill_texels(std::byte* target, uint64_t count, uint32_t texel_size, const PackedTexel& texel);

}  // namespace lapilli
