// The formats of storage images and storage texel buffers: those that Vulkan 1.0 requires, and those of
// shaderStorageImageExtendedFormats. And texels of them.
// Specification: "Required Format Support".
#pragma once

#include <vulkan/vulkan_core.h>

#include <random>

#include "harness/compute.h"
#include "oracle/formats.h"

namespace lapilli::conformance {

using oracle::Number;

struct StorageFormat {
  VkFormat vk;
  oracle::Format format;
};
inline constexpr StorageFormat kStorageFormats[] = {
    {VK_FORMAT_R8_UNORM, {Number::kUnorm, 8, 1}},
    {VK_FORMAT_R8_SNORM, {Number::kSnorm, 8, 1}},
    {VK_FORMAT_R8_UINT, {Number::kUint, 8, 1}},
    {VK_FORMAT_R8_SINT, {Number::kSint, 8, 1}},
    {VK_FORMAT_R8G8_UNORM, {Number::kUnorm, 8, 2}},
    {VK_FORMAT_R8G8_SNORM, {Number::kSnorm, 8, 2}},
    {VK_FORMAT_R8G8_UINT, {Number::kUint, 8, 2}},
    {VK_FORMAT_R8G8_SINT, {Number::kSint, 8, 2}},
    {VK_FORMAT_R16_UNORM, {Number::kUnorm, 16, 1}},
    {VK_FORMAT_R16_SNORM, {Number::kSnorm, 16, 1}},
    {VK_FORMAT_R16_UINT, {Number::kUint, 16, 1}},
    {VK_FORMAT_R16_SINT, {Number::kSint, 16, 1}},
    {VK_FORMAT_R16_SFLOAT, {Number::kFloat, 16, 1}},
    {VK_FORMAT_R16G16_UNORM, {Number::kUnorm, 16, 2}},
    {VK_FORMAT_R16G16_SNORM, {Number::kSnorm, 16, 2}},
    {VK_FORMAT_R16G16_UINT, {Number::kUint, 16, 2}},
    {VK_FORMAT_R16G16_SINT, {Number::kSint, 16, 2}},
    {VK_FORMAT_R16G16_SFLOAT, {Number::kFloat, 16, 2}},
    {VK_FORMAT_R16G16B16A16_UNORM, {Number::kUnorm, 16, 4}},
    {VK_FORMAT_R16G16B16A16_SNORM, {Number::kSnorm, 16, 4}},
    {VK_FORMAT_A2B10G10R10_UNORM_PACK32, {Number::kUnorm, 0, 4, {10, 10, 10, 2}}},
    {VK_FORMAT_A2B10G10R10_UINT_PACK32, {Number::kUint, 0, 4, {10, 10, 10, 2}}},
    {VK_FORMAT_B10G11R11_UFLOAT_PACK32, {Number::kSmallFloat, 0, 3, {11, 11, 10}}},
    {VK_FORMAT_R8G8B8A8_UNORM, {Number::kUnorm, 8, 4}},
    {VK_FORMAT_R8G8B8A8_SNORM, {Number::kSnorm, 8, 4}},
    {VK_FORMAT_R8G8B8A8_UINT, {Number::kUint, 8, 4}},
    {VK_FORMAT_R8G8B8A8_SINT, {Number::kSint, 8, 4}},
    {VK_FORMAT_R16G16B16A16_UINT, {Number::kUint, 16, 4}},
    {VK_FORMAT_R16G16B16A16_SINT, {Number::kSint, 16, 4}},
    {VK_FORMAT_R16G16B16A16_SFLOAT, {Number::kFloat, 16, 4}},
    {VK_FORMAT_R32_UINT, {Number::kUint, 32, 1}},
    {VK_FORMAT_R32_SINT, {Number::kSint, 32, 1}},
    {VK_FORMAT_R32_SFLOAT, {Number::kFloat, 32, 1}},
    {VK_FORMAT_R32G32_UINT, {Number::kUint, 32, 2}},
    {VK_FORMAT_R32G32_SINT, {Number::kSint, 32, 2}},
    {VK_FORMAT_R32G32_SFLOAT, {Number::kFloat, 32, 2}},
    {VK_FORMAT_R32G32B32A32_UINT, {Number::kUint, 32, 4}},
    {VK_FORMAT_R32G32B32A32_SINT, {Number::kSint, 32, 4}},
    {VK_FORMAT_R32G32B32A32_SFLOAT, {Number::kFloat, 32, 4}}};

// Floats are finite.
inline Bytes random_texels(std::mt19937& random, const oracle::Format& format, size_t count) {
  Bytes bytes(count * format.bytes());
  for (std::byte& b : bytes) b = std::byte(random());
  if (format.kind == Number::kFloat) {
    for (size_t i = format.bits / 8 - 1; i < bytes.size(); i += format.bits / 8) bytes[i] &= std::byte{0xBB};
  }
  if (format.kind == Number::kSmallFloat) {
    constexpr uint32_t kNotTheLargestExponents = ~(1u << 10 | 1u << 21 | 1u << 31);
    for (size_t i = 0; i < bytes.size(); i += 4) {
      for (size_t k = 0; k < 4; ++k) bytes[i + k] &= std::byte(kNotTheLargestExponents >> 8 * k);
    }
  }
  return bytes;
}

}  // namespace lapilli::conformance
