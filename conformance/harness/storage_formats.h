// The formats of storage images and storage texel buffers that Vulkan 1.0 requires, and texels of them.
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
inline constexpr StorageFormat kStorageFormats[] = {{VK_FORMAT_R8G8B8A8_UNORM, {Number::kUnorm, 8, 4}},
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
  if (format.kind != Number::kFloat) return bytes;
  for (size_t i = format.bits / 8 - 1; i < bytes.size(); i += format.bits / 8) bytes[i] &= std::byte{0xBB};
  return bytes;
}

}  // namespace lapilli::conformance
