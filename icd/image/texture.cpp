// Memory layout of images, and the translation of views and samplers to what the sampling code reads.
#include "image/texture.h"

#include <algorithm>
#include <bit>
#include <string>

namespace lapilli {
namespace {

uint64_t align_up(uint64_t bytes) { return (bytes + kImageAlignment - 1) & ~(kImageAlignment - 1); }

bool extent_is_valid(const ImageExtent& extent) {
  const uint32_t side_limit = extent.depth > 1 ? kMaxImageDimension3D : kMaxImageDimension2D;
  const auto inside = [](uint32_t value, uint32_t limit) { return value >= 1 && value <= limit; };
  return inside(extent.width, side_limit) && inside(extent.height, side_limit) &&
         inside(extent.depth, kMaxImageDimension3D) && inside(extent.layers, kMaxImageLayers) &&
         inside(extent.samples, kMaxImageSamples) && std::has_single_bit(extent.samples) &&
         inside(extent.mip_levels, full_mip_chain(extent.width, extent.height, extent.depth));
}

constexpr const char* kRangeOutside = "image view range is outside of the image";

std::string describe(const ImageExtent& extent) {
  return std::to_string(extent.width) + "x" + std::to_string(extent.height) + "x" + std::to_string(extent.depth) +
         ", " + std::to_string(extent.mip_levels) + " levels, " + std::to_string(extent.layers) + " layers, " +
         std::to_string(extent.samples) + " samples";
}

Swizzle resolve(VkComponentSwizzle swizzle, Swizzle identity) {
  switch (swizzle) {
    case VK_COMPONENT_SWIZZLE_ZERO:
      return Swizzle::zero;
    case VK_COMPONENT_SWIZZLE_ONE:
      return Swizzle::one;
    case VK_COMPONENT_SWIZZLE_R:
      return Swizzle::r;
    case VK_COMPONENT_SWIZZLE_G:
      return Swizzle::g;
    case VK_COMPONENT_SWIZZLE_B:
      return Swizzle::b;
    case VK_COMPONENT_SWIZZLE_A:
      return Swizzle::a;
    default:
      return identity;
  }
}

std::array<uint32_t, 4> border_bits(VkBorderColor color) {
  constexpr uint32_t one = std::bit_cast<uint32_t>(1.0f);
  switch (color) {
    case VK_BORDER_COLOR_FLOAT_OPAQUE_BLACK:
      return {0, 0, 0, one};
    case VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE:
      return {one, one, one, one};
    case VK_BORDER_COLOR_INT_OPAQUE_BLACK:
      return {0, 0, 0, 1};
    case VK_BORDER_COLOR_INT_OPAQUE_WHITE:
      return {1, 1, 1, 1};
    default:
      return {0, 0, 0, 0};
  }
}

bool filter_is_offered(VkFilter filter) { return filter == VK_FILTER_NEAREST || filter == VK_FILTER_LINEAR; }

}  // namespace

uint32_t full_mip_chain(uint32_t width, uint32_t height, uint32_t depth) {
  return static_cast<uint32_t>(std::bit_width(std::max({width, height, depth})));
}

Result<ImageLayout> make_layout(VkFormat format, const ImageExtent& extent) {
  ImageLayout layout;
  layout.format = find_format(format);
  if (layout.format == nullptr) {
    return Error{VK_ERROR_FORMAT_NOT_SUPPORTED, "image format " + std::to_string(format) + " is not supported"};
  }
  if (!extent_is_valid(extent))
    return Error{VK_ERROR_UNKNOWN, "image of " + describe(extent) + " is empty or above the limits"};
  layout.extent = extent;
  // The limits keep every product below 2^54, far from overflow: a level has at most 2^34 bytes (512^3 * 16 or 8192^2 *
  // 16), a chain less than 2^35, times 2^11 layers and 2^3 samples.
  for (uint32_t i = 0; i < extent.mip_levels; ++i) {
    LevelLayout& level = layout.levels[i];
    level.width = std::max(extent.width >> i, 1u);
    level.height = std::max(extent.height >> i, 1u);
    level.depth = std::max(extent.depth >> i, 1u);
    level.offset = layout.layer_pitch;
    level.row_pitch = align_up(uint64_t{level.width} * layout.format->texel_size);
    level.slice_pitch = level.row_pitch * level.height;
    level.size = level.slice_pitch * level.depth;
    layout.layer_pitch += level.size;
  }
  layout.sample_pitch = layout.layer_pitch * extent.layers;
  layout.size = layout.sample_pitch * extent.samples;
  if (layout.size > kMaxImageBytes) {
    return Error{VK_ERROR_OUT_OF_DEVICE_MEMORY, "image of " + describe(extent) + " is larger than maxResourceSize"};
  }
  return layout;
}

TextureView make_texel_buffer(const FormatInfo& format, std::byte* data, uint64_t bytes) {
  TextureView view;
  view.format = &format;
  view.level_count = view.layer_count = 1;
  const uint64_t elements = std::min<uint64_t>(bytes / format.texel_size, kMaxTexelBufferElements);
  view.levels[0] = {data, static_cast<int32_t>(elements), 1, 0};
  return view;
}

Result<TextureView> make_view(const ImageLayout& layout, std::byte* image, VkFormat format,
                              const VkComponentMapping& mapping, const VkImageSubresourceRange& range) {
  TextureView view;
  view.format = find_format(format);
  if (view.format == nullptr || view.format->texel_size != layout.format->texel_size) {
    return Error{VK_ERROR_UNKNOWN, "image view format " + std::to_string(format) + " does not fit the image"};
  }
  const ImageExtent& extent = layout.extent;
  if (range.baseMipLevel >= extent.mip_levels || range.baseArrayLayer >= extent.layers)
    return Error{VK_ERROR_UNKNOWN, kRangeOutside};
  const uint32_t levels_left = extent.mip_levels - range.baseMipLevel;
  const uint32_t layers_left = extent.layers - range.baseArrayLayer;
  view.level_count = range.levelCount == VK_REMAINING_MIP_LEVELS ? levels_left : range.levelCount;
  view.layer_count = range.layerCount == VK_REMAINING_ARRAY_LAYERS ? layers_left : range.layerCount;
  if (view.level_count - 1 >= levels_left || view.layer_count - 1 >= layers_left)
    return Error{VK_ERROR_UNKNOWN, kRangeOutside};
  view.layer_pitch = layout.layer_pitch;
  for (uint32_t i = 0; i < view.level_count; ++i) {
    const LevelLayout& level = layout.levels[range.baseMipLevel + i];
    view.levels[i] = {image + texel_offset(layout, range.baseMipLevel + i, range.baseArrayLayer),
                      static_cast<int32_t>(level.width), static_cast<int32_t>(level.height),
                      static_cast<int32_t>(level.row_pitch)};
  }
  view.swizzle = {resolve(mapping.r, Swizzle::r), resolve(mapping.g, Swizzle::g), resolve(mapping.b, Swizzle::b),
                  resolve(mapping.a, Swizzle::a)};
  view.identity_swizzle = view.swizzle == TextureView().swizzle;
  return view;
}

Result<SamplerState> make_sampler(const VkSamplerCreateInfo& info) {
  if (info.anisotropyEnable == VK_TRUE) return Error{VK_ERROR_UNKNOWN, "anisotropic filtering is not supported"};
  if (!filter_is_offered(info.magFilter) || !filter_is_offered(info.minFilter)) {
    return Error{VK_ERROR_UNKNOWN, "sampler filter is neither NEAREST nor LINEAR"};
  }
  SamplerState sampler;
  sampler.mag_filter = info.magFilter;
  sampler.min_filter = info.minFilter;
  sampler.mipmap_mode = info.mipmapMode;
  sampler.address_u = info.addressModeU;
  sampler.address_v = info.addressModeV;
  sampler.address_w = info.addressModeW;
  sampler.lod_bias = info.mipLodBias;
  sampler.min_lod = info.minLod;
  sampler.max_lod = info.maxLod;
  sampler.border = border_bits(info.borderColor);
  sampler.compare = info.compareEnable == VK_TRUE;
  sampler.compare_op = info.compareOp;
  sampler.unnormalized = info.unnormalizedCoordinates == VK_TRUE;
  return sampler;
}

}  // namespace lapilli
