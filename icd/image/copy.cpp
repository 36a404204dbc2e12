// Copies and clears: every region becomes a box of rows on both sides, checked as a whole and then moved row by row.
#include "image/copy.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace lapilli {
namespace {

// Rows of texels in memory: `rows` rows in each of `planes` planes (slices or layers).
struct Box {
  uint64_t offset = 0;       // bytes to the first texel
  uint64_t row_pitch = 0;    // bytes
  uint64_t plane_pitch = 0;  // bytes
  uint64_t row_bytes = 0;
  uint32_t rows = 0;
  uint32_t planes = 0;
};

// [first, first + count) lies in [0, size) and has at least one element.
bool range_inside(int64_t first, uint64_t count, uint64_t size) {
  return first >= 0 && count >= 1 && static_cast<uint64_t>(first) < size &&
         count <= size - static_cast<uint64_t>(first);
}

// The aspects of a subresource as a copy may name them: one, and one that the format has.
bool aspect_is_valid(const FormatInfo& format, VkImageAspectFlags aspects) {
  return std::has_single_bit(aspects) && (aspects & format.aspects) != 0;
}

// `layers` is the number of layers, or of slices where the image has depth; both are planes of the box.
bool image_box(const ImageLayout& layout, const VkImageSubresourceLayers& subresource, const VkOffset3D& offset,
               const VkExtent3D& extent, Box* box) {
  if (!aspect_is_valid(*layout.format, subresource.aspectMask)) return false;
  if (subresource.mipLevel >= layout.extent.mip_levels) return false;
  const LevelLayout& level = layout.levels[subresource.mipLevel];
  if (!range_inside(subresource.baseArrayLayer, subresource.layerCount, layout.extent.layers)) return false;
  if (!range_inside(offset.x, extent.width, level.width) || !range_inside(offset.y, extent.height, level.height)) {
    return false;
  }
  const bool slices = layout.extent.depth > 1;
  if (slices ? !range_inside(offset.z, extent.depth, level.depth) : offset.z != 0) return false;
  const uint32_t slice = slices ? static_cast<uint32_t>(offset.z) : 0;
  const uint64_t texel_size = layout.format->texel_size;
  box->offset = texel_offset(layout, subresource.mipLevel, subresource.baseArrayLayer, slice) +
                static_cast<uint64_t>(offset.y) * level.row_pitch + static_cast<uint64_t>(offset.x) * texel_size;
  box->row_pitch = level.row_pitch;
  box->plane_pitch = slices ? level.slice_pitch : layout.layer_pitch;
  box->row_bytes = extent.width * texel_size;
  box->rows = extent.height;
  box->planes = slices ? extent.depth : subresource.layerCount;
  return true;
}

bool buffer_box(const VkBufferImageCopy& region, const ImageLayout& layout, const Box& image, uint64_t size, Box* box) {
  const uint32_t row_texels = region.bufferRowLength != 0 ? region.bufferRowLength : region.imageExtent.width;
  const uint32_t plane_rows = region.bufferImageHeight != 0 ? region.bufferImageHeight : region.imageExtent.height;
  if (row_texels < region.imageExtent.width || plane_rows < region.imageExtent.height) return false;
  *box = image;
  box->offset = region.bufferOffset;
  box->row_pitch = uint64_t{row_texels} * layout.format->texel_size;  // below 2^36
  // The last byte that is touched; a row length near 2^32 times a height near 2^32 does not fit 64 bits.
  uint64_t last_plane = 0;
  uint64_t end = 0;
  if (__builtin_mul_overflow(box->row_pitch, uint64_t{plane_rows}, &box->plane_pitch) ||
      __builtin_mul_overflow(box->plane_pitch, uint64_t{image.planes - 1}, &last_plane) ||
      __builtin_add_overflow(last_plane, box->row_pitch * (image.rows - 1) + image.row_bytes, &end) ||
      __builtin_add_overflow(end, region.bufferOffset, &end)) {
    return false;
  }
  return end <= size;
}

// Both boxes have the same rows, planes and bytes of a row. memmove: an image may be copied onto itself.
void move_box(const std::byte* source, const Box& from, std::byte* target, const Box& to) {
  for (uint32_t plane = 0; plane < from.planes; ++plane) {
    const std::byte* read = source + from.offset + plane * from.plane_pitch;
    std::byte* write = target + to.offset + plane * to.plane_pitch;
    if (from.row_bytes == from.row_pitch && to.row_bytes == to.row_pitch) {
      std::memmove(write, read, from.row_bytes * from.rows);
      continue;
    }
    for (uint32_t row = 0; row < from.rows; ++row) {
      std::memmove(write + row * to.row_pitch, read + row * from.row_pitch, from.row_bytes);
    }
  }
}

// IEEE binary16, rounded to nearest even.
uint32_t half_bits(float value) {
  if (std::isnan(value)) return 0x7E00;
  const uint32_t sign = std::signbit(value) ? 0x8000 : 0;
  const double magnitude = std::fabs(double{value});
  if (magnitude >= 65520.0) return sign | 0x7C00;
  const int exponent = magnitude < 0x1p-14 ? -14 : std::ilogb(magnitude);
  const auto steps = static_cast<uint32_t>(std::nearbyint(std::ldexp(magnitude, 10 - exponent)));
  // Steps of a normal number begin at 1024; one that is rounded up to 2048 carries into the exponent.
  return sign | (magnitude < 0x1p-14 ? steps : steps + (static_cast<uint32_t>(exponent + 14) << 10));
}

// Texel::to_small_float() on one number.
uint32_t small_float_bits(float value, uint32_t bits) {
  const uint32_t dropped = 15 - bits;
  const uint32_t half = half_bits(value < 0.0f ? 0.0f : value) & 0x7FFF;
  const uint32_t rounded = (half + (1u << (dropped - 1)) - 1 + (half >> dropped & 1)) >> dropped;
  return std::isfinite(value) ? std::min(rounded, (31u << (bits - 5)) - 1) : rounded;
}

// One component as the bits of the texel, in the low `bits` bits.
uint32_t pack_component(const ComponentLayout& component, uint32_t bits_of_value) {
  const float value = std::bit_cast<float>(bits_of_value);
  switch (component.kind) {
    case ComponentKind::unorm: {
      const double largest = std::exp2(component.bits) - 1.0;
      const double clamped = value > 0.0f ? std::min(double{value}, 1.0) : 0.0;  // NaN is not > 0
      // Rounded as the lanes do: the product in float, then to the nearest integer, half to even.
      return static_cast<uint32_t>(std::nearbyint(static_cast<float>(clamped) * static_cast<float>(largest)));
    }
    case ComponentKind::snorm: {
      const float largest = static_cast<float>(std::exp2(component.bits - 1) - 1.0);
      const float clamped = std::isnan(value) ? 0.0f : std::min(std::max(value, -1.0f), 1.0f);
      return static_cast<uint32_t>(static_cast<int32_t>(std::nearbyint(clamped * largest)));
    }
    case ComponentKind::sfloat:
      if (component.bits == 16) return half_bits(value);
      return std::isnan(value) ? 0x7FC00000u : bits_of_value;
    case ComponentKind::ufloat:
      return small_float_bits(value, component.bits);
    case ComponentKind::uint:
    case ComponentKind::sint:
      return bits_of_value;
    case ComponentKind::none:
      break;
  }
  return 0;
}

}  // namespace

bool copy_buffer_to_image(ConstBufferMemory source, ImageMemory target, const VkBufferImageCopy& region) {
  Box to;
  Box from;
  if (!image_box(*target.layout, region.imageSubresource, region.imageOffset, region.imageExtent, &to)) return false;
  if (!buffer_box(region, *target.layout, to, source.size, &from)) return false;
  move_box(source.data, from, target.data, to);
  return true;
}

bool copy_image_to_buffer(ConstImageMemory source, BufferMemory target, const VkBufferImageCopy& region) {
  Box from;
  Box to;
  if (!image_box(*source.layout, region.imageSubresource, region.imageOffset, region.imageExtent, &from)) return false;
  if (!buffer_box(region, *source.layout, from, target.size, &to)) return false;
  move_box(source.data, from, target.data, to);
  return true;
}

bool copy_image(ConstImageMemory source, ImageMemory target, const VkImageCopy& region) {
  const ImageLayout& from_layout = *source.layout;
  const ImageLayout& to_layout = *target.layout;
  if (from_layout.format->texel_size != to_layout.format->texel_size) return false;
  if (from_layout.extent.samples != to_layout.extent.samples) return false;
  Box from;
  Box to;
  if (!image_box(from_layout, region.srcSubresource, region.srcOffset, region.extent, &from)) return false;
  if (!image_box(to_layout, region.dstSubresource, region.dstOffset, region.extent, &to)) return false;
  if (from.planes != to.planes) return false;
  for (uint32_t sample = 0; sample < from_layout.extent.samples; ++sample) {
    move_box(source.data + sample * from_layout.sample_pitch, from, target.data + sample * to_layout.sample_pitch, to);
  }
  return true;
}

PackedTexel pack_clear_value(const FormatInfo& format, const VkClearValue& clear) {
  std::array<uint32_t, 4> words = {};
  for (size_t i = 0; i < format.components.size(); ++i) {
    const ComponentLayout& component = format.components[i];
    if (component.kind == ComponentKind::none) continue;
    const bool is_color = format.aspects == VK_IMAGE_ASPECT_COLOR_BIT;
    const uint32_t bits = is_color ? clear.color.uint32[i] : std::bit_cast<uint32_t>(clear.depthStencil.depth);
    const uint32_t mask = component.bits == 32 ? ~0u : (1u << component.bits) - 1;
    words[component.first_bit / 32u] |= (pack_component(component, bits) & mask) << component.first_bit % 32u;
  }
  return std::bit_cast<PackedTexel>(words);
}

bool clear_image(ImageMemory target, const VkImageSubresourceRange& range, const PackedTexel& texel) {
  const ImageLayout& layout = *target.layout;
  const ImageExtent& extent = layout.extent;
  if (range.aspectMask != layout.format->aspects) return false;
  if (range.baseMipLevel >= extent.mip_levels || range.baseArrayLayer >= extent.layers) return false;
  const uint32_t levels =
      range.levelCount == VK_REMAINING_MIP_LEVELS ? extent.mip_levels - range.baseMipLevel : range.levelCount;
  const uint32_t layers =
      range.layerCount == VK_REMAINING_ARRAY_LAYERS ? extent.layers - range.baseArrayLayer : range.layerCount;
  if (!range_inside(range.baseMipLevel, levels, extent.mip_levels)) return false;
  if (!range_inside(range.baseArrayLayer, layers, extent.layers)) return false;
  for (uint32_t sample = 0; sample < extent.samples; ++sample) {
    for (uint32_t layer = 0; layer < layers; ++layer) {
      for (uint32_t i = 0; i < levels; ++i) {
        const LevelLayout& level = layout.levels[range.baseMipLevel + i];
        std::byte* row =
            target.data + texel_offset(layout, range.baseMipLevel + i, range.baseArrayLayer + layer, 0, sample);
        for (uint64_t y = 0; y < uint64_t{level.height} * level.depth; ++y, row += level.row_pitch) {
          fill_texels(row, level.width, layout.format->texel_size, texel);
        }
      }
    }
  }
  return true;
}

void fill_texels(std::byte* target, uint64_t count, uint32_t texel_size, const PackedTexel& texel) {
  const uint64_t bytes = count * texel_size;
  if (bytes == 0) return;  // `target` may be null
  if (std::all_of(texel.begin(), texel.begin() + texel_size, [&](std::byte b) { return b == texel[0]; })) {
    std::memset(target, std::to_integer<int>(texel[0]), bytes);
    return;
  }
  // Copies what is there behind itself, in whole texels that stay in the first-level cache.
  const uint64_t longest = uint64_t{texel_size} * 256;
  uint64_t done = std::min<uint64_t>(bytes, texel_size);
  std::memcpy(target, texel.data(), done);
  while (done < bytes) {
    const uint64_t step = std::min({done, bytes - done, longest});
    std::memcpy(target + done, target, step);
    done += step;
  }
}

}  // namespace lapilli
