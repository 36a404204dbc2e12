// Buffers, sampled images and descriptor sets with their memory. Specification: Resource Creation; Resource
// Descriptors.
#pragma once

#include <cstddef>
#include <span>
#include <variant>
#include <vector>

#include "common/context.h"

namespace lapilli::samples {

// A buffer in host-visible, coherent memory that stays mapped.
class Buffer {
 public:
  Buffer() = default;
  Buffer(const Context& context, VkDeviceSize size, VkBufferUsageFlags usage);
  // Filled with the bytes of `values`.
  template <typename T>
  Buffer(const Context& context, std::span<const T> values, VkBufferUsageFlags usage)
      : Buffer(context, values.size_bytes(), usage) {
    write(std::as_bytes(values));
  }

  VkBuffer get() const { return buffer_.get(); }
  VkDeviceSize size() const { return size_; }
  void* data() const { return data_; }
  void write(std::span<const std::byte> bytes);

 private:
  DeviceMemory memory_;  // outlives the buffer bound to it
  RawBuffer buffer_;
  VkDeviceSize size_ = 0;
  void* data_ = nullptr;
};

struct ImageShape {
  uint32_t mip_levels = 1;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
};

// An optimally tiled 2D image with one layer and a view of all of it.
class Image {
 public:
  Image() = default;
  Image(const Context& context, VkExtent2D extent, VkFormat format, VkImageUsageFlags usage,
        const ImageShape& shape = {});

  VkImage get() const { return image_.get(); }
  VkImageView view() const { return view_.get(); }
  VkExtent2D extent() const { return extent_; }

 private:
  DeviceMemory memory_;
  RawImage image_;
  ImageView view_;
  VkExtent2D extent_ = {};
};

VkImageAspectFlags aspect_of(VkFormat format);

// An R8G8B8A8_UNORM image with `texels` (rows top down, 4 bytes each), ready to be sampled by fragment shaders.
Image upload_texture(const Context& context, VkExtent2D extent, std::span<const std::byte> texels);

// The same filter for both directions, no mip levels.
Sampler create_sampler(const Context& context, VkFilter filter, VkSamplerAddressMode address_mode);

// One descriptor: a buffer (uniform or storage) or a combined image sampler; its binding is its place in the list.
struct BufferBinding {
  VkDescriptorType type;
  VkShaderStageFlags stages;
  const Buffer* buffer;
};
struct ImageBinding {
  VkShaderStageFlags stages;
  const Image* image;  // in SHADER_READ_ONLY_OPTIMAL
  const Sampler* sampler;
};
using Binding = std::variant<BufferBinding, ImageBinding>;

// A descriptor set with its own layout and pool. What it names must outlive its use.
class DescriptorSet {
 public:
  DescriptorSet() = default;
  DescriptorSet(const Context& context, std::span<const Binding> bindings);

  VkDescriptorSet get() const { return set_; }
  VkDescriptorSetLayout layout() const { return layout_.get(); }

 private:
  DescriptorSetLayout layout_;
  DescriptorPool pool_;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
};

}  // namespace lapilli::samples
