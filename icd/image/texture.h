// Images and samplers as plain structs: how an image lies in memory, and what a shader needs to read it.
// Specification: chapters "Resource Creation" (images), "Samplers", "Image Operations".
#pragma once

#include <vulkan/vulkan_core.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/result.h"
#include "image/format.h"

namespace lapilli {

// Limits of VkPhysicalDeviceLimits and VkImageFormatProperties.
inline constexpr uint32_t kMaxImageDimension2D = 8192;  // texels; 1D images and framebuffers too
inline constexpr uint32_t kMaxImageDimension3D = 512;
inline constexpr uint32_t kMaxImageLayers = 2048;
inline constexpr uint32_t kMaxImageSamples = 8;
inline constexpr uint32_t kMaxMipLevels = 14;                  // 8192 … 1
inline constexpr uint64_t kMaxImageBytes = uint64_t{1} << 32;  // VkImageFormatProperties::maxResourceSize
// Of image memory and of every row, in bytes: two tiles of the rasterizer never share a cache line.
inline constexpr uint64_t kImageAlignment = 64;

struct ImageExtent {
  uint32_t width = 0;  // texels
  uint32_t height = 0;
  uint32_t depth = 1;
  uint32_t mip_levels = 1;
  uint32_t layers = 1;
  uint32_t samples = 1;
};

// One mip level, in every layer and sample.
struct LevelLayout {
  uint32_t width = 0;  // texels
  uint32_t height = 0;
  uint32_t depth = 0;
  uint64_t offset = 0;       // bytes from the start of the layer
  uint64_t row_pitch = 0;    // bytes from row to row
  uint64_t slice_pitch = 0;  // bytes from one slice in depth to the next
  uint64_t size = 0;         // bytes of the level
};

// Row-major; sample planes, in them layers, in them mip levels, each level a box of slices of rows.
struct ImageLayout {
  const FormatInfo* format = nullptr;
  ImageExtent extent;
  std::array<LevelLayout, kMaxMipLevels> levels;
  uint64_t layer_pitch = 0;   // bytes from layer to layer
  uint64_t sample_pitch = 0;  // bytes from sample to sample
  uint64_t size = 0;          // bytes of the whole image
  uint64_t alignment = kImageAlignment;
};

// VK_ERROR_FORMAT_NOT_SUPPORTED for an unknown format, VK_ERROR_OUT_OF_DEVICE_MEMORY for more than kMaxImageBytes,
// VK_ERROR_UNKNOWN for an extent that is zero or above the limits, or more mip levels than it has.
Result<ImageLayout> make_layout(VkFormat format, const ImageExtent& extent);

// Levels of a full mip chain: floor(log2(largest side)) + 1.
uint32_t full_mip_chain(uint32_t width, uint32_t height, uint32_t depth);

// Byte offset of the first texel of a slice. All arguments must be inside the image.
inline uint64_t texel_offset(const ImageLayout& layout, uint32_t level, uint32_t layer, uint32_t slice = 0,
                             uint32_t sample = 0) {
  return layout.sample_pitch * sample + layout.layer_pitch * layer + layout.levels[level].offset +
         layout.levels[level].slice_pitch * slice;
}

// What a component of a view is taken from: VkComponentSwizzle without IDENTITY.
enum class Swizzle : uint8_t { r, g, b, a, zero, one };

struct TextureLevel {
  std::byte* data = nullptr;  // first texel
  int32_t width = 0;          // texels
  int32_t height = 0;
  int32_t row_pitch = 0;  // bytes
  // Bytes from `data` to any texel fit 31 bits: 8192 rows of at most 8192 * 16 bytes.
};

// An image view as the sampler sees it. Level 0 is the view's base level. Zero levels: reads give 0.
struct TextureView {
  const FormatInfo* format = nullptr;
  uint32_t level_count = 0;
  uint32_t layer_count = 0;
  uint64_t layer_pitch = 0;  // bytes
  std::array<TextureLevel, kMaxMipLevels> levels;
  std::array<Swizzle, 4> swizzle = {Swizzle::r, Swizzle::g, Swizzle::b, Swizzle::a};
  bool identity_swizzle = true;
};

// A row of texels in a buffer; at most kMaxTexelBufferElements of those that fit `bytes`.
inline constexpr uint32_t kMaxTexelBufferElements = 1u << 26;
TextureView make_texel_buffer(const FormatInfo& format, std::byte* data, uint64_t bytes);

// `image` is the image's first byte. The range may use VK_REMAINING_MIP_LEVELS and VK_REMAINING_ARRAY_LAYERS;
// VK_ERROR_UNKNOWN if it does not lie in the image or the view's format has another texel size.
Result<TextureView> make_view(const ImageLayout& layout, std::byte* image, VkFormat format,
                              const VkComponentMapping& mapping, const VkImageSubresourceRange& range);

struct SamplerState {
  VkFilter mag_filter = VK_FILTER_NEAREST;
  VkFilter min_filter = VK_FILTER_NEAREST;
  VkSamplerMipmapMode mipmap_mode = VK_SAMPLER_MIPMAP_MODE_NEAREST;
  VkSamplerAddressMode address_u = VK_SAMPLER_ADDRESS_MODE_REPEAT;
  VkSamplerAddressMode address_v = VK_SAMPLER_ADDRESS_MODE_REPEAT;
  VkSamplerAddressMode address_w = VK_SAMPLER_ADDRESS_MODE_REPEAT;
  float lod_bias = 0;
  float min_lod = 0;
  float max_lod = 0;
  std::array<uint32_t, 4> border = {};  // bits of R G B A as the shader sees them
  bool compare = false;
  VkCompareOp compare_op = VK_COMPARE_OP_NEVER;
  bool unnormalized = false;  // coordinates are in texels
};

// Largest |lod_bias| (VkPhysicalDeviceLimits::maxSamplerLodBias).
inline constexpr float kMaxSamplerLodBias = 15.0f;

// VK_ERROR_UNKNOWN for what is not offered: anisotropy, cubic filters.
Result<SamplerState> make_sampler(const VkSamplerCreateInfo& info);

}  // namespace lapilli
