// What the driver knows about a VkFormat: the table of formats.def as data.
// Specification: chapter "Formats".
#pragma once

#include <vulkan/vulkan_core.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace lapilli {

enum class ComponentKind : uint8_t { none, unorm, snorm, sfloat, ufloat, uint, sint };

struct ComponentLayout {
  ComponentKind kind = ComponentKind::none;
  uint8_t first_bit = 0;  // from the lowest bit of the little-endian texel
  uint8_t bits = 0;

  bool operator==(const ComponentLayout&) const = default;
};

enum FormatFeature : uint32_t {
  kTransfer = 1,     // copies and clears
  kSampled = 2,      // sampled and input attachment
  kFilterable = 4,   // linear filters
  kColorTarget = 8,  // colour attachment
  kBlendable = 16,
  kDepthTarget = 32,          // depth attachment
  kVertex = 64,               // vertex buffer
  kStorage = 128,             // storage image
  kTexelBuffer = 256,         // uniform texel buffer
  kStorageTexelBuffer = 512,  // and a storage one
  kAtomic = 1024,             // atomic operations on storage images and storage texel buffers
};

struct FormatInfo {
  VkFormat format = VK_FORMAT_UNDEFINED;
  const char* name = "";                      // "R8G8B8A8_UNORM"
  uint32_t index = 0;                         // place in the table
  uint32_t texel_size = 0;                    // bytes
  std::array<ComponentLayout, 4> components;  // R G B A; depth is R
  VkImageAspectFlags aspects = 0;
  uint32_t features = 0;  // FormatFeature

  constexpr bool has(FormatFeature feature) const { return (features & feature) != 0; }
  constexpr bool is_target() const { return has(kColorTarget) || has(kDepthTarget); }
  // Components are integers in a shader: a missing alpha is the integer 1.
  constexpr bool is_integer() const {
    return components[0].kind == ComponentKind::uint || components[0].kind == ComponentKind::sint;
  }
};

// FormatInfo::index by name: static_cast<size_t>(FormatIndex::R8G8B8A8_UNORM).
enum class FormatIndex : uint8_t {
#define FORMAT(name, texel_size, r, g, b, a, aspect, features) name,
#include "image/formats.def"
#undef FORMAT
  kCount
};
inline constexpr size_t kFormatCount = static_cast<size_t>(FormatIndex::kCount);

// The whole table, for code that is instantiated for each format.
inline constexpr std::array<FormatInfo, kFormatCount> kFormats = [] {
  constexpr VkImageAspectFlags color = VK_IMAGE_ASPECT_COLOR_BIT;
  constexpr VkImageAspectFlags depth = VK_IMAGE_ASPECT_DEPTH_BIT;
#define C(kind, first_bit, bits) \
  ComponentLayout { ComponentKind::kind, first_bit, bits }
#define NONE \
  ComponentLayout {}
#define FORMAT(name, texel_size, r, g, b, a, aspect, features)                                              \
  FormatInfo{VK_FORMAT_##name, #name,   static_cast<uint32_t>(FormatIndex::name), texel_size, {r, g, b, a}, \
             aspect,           features},
  return std::array<FormatInfo, kFormatCount>{
#include "image/formats.def"
  };
#undef FORMAT
#undef NONE
#undef C
}();

// Null for a format that the driver does not know. The pointer stays valid.
const FormatInfo* find_format(VkFormat format);

// What vkGetPhysicalDeviceFormatProperties answers; 0 for an unknown format. Transfers have no bit in Vulkan 1.0: an
// image format with any feature can be copied.
VkFormatProperties format_properties(VkFormat format);

}  // namespace lapilli
