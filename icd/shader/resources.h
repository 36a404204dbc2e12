// What a shader can reach: descriptors as plain structs, and where the pipeline layout put them.
// Specification: chapter "Resource Descriptors".
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace lapilli {

struct TextureView;
struct SamplerState;

constexpr uint32_t kMaxDescriptorSets = 8;
constexpr uint32_t kMaxPushConstantBytes = 256;

// One descriptor. A descriptor that was never written is all zero: a buffer of 0 bytes, no texture; reading it gives 0.
struct Descriptor {
  std::byte* data = nullptr;              // first byte of the buffer range
  uint64_t size = 0;                      // bytes that may be accessed from `data`
  uint64_t room = 0;                      // bytes from `data` to the end of the buffer: the limit for dynamic offsets
  const TextureView* texture = nullptr;   // sampled image
  const SamplerState* sampler = nullptr;  // sampler; an immutable one is written when the set is allocated
};

// The bound state of one draw or dispatch, flattened. Everything pointed to outlives the draw.
struct ResourceTable {
  const Descriptor* sets[kMaxDescriptorSets] =
      {};                                     // all descriptors of a set, in binding order; null where nothing is bound
  const uint32_t* dynamic_offsets = nullptr;  // bytes; indexed by BindingSlot::dynamic_offset
  const std::byte* push_constants = nullptr;
  uint32_t push_constant_bytes = 0;  // those beyond read as 0
};

// One binding of a pipeline layout.
struct BindingSlot {
  uint32_t set = 0;
  uint32_t binding = 0;
  VkDescriptorType type = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
  VkShaderStageFlags stages = 0;
  uint32_t first = 0;           // index of the binding's first descriptor in its set
  uint32_t count = 1;           // array size; 0 for a reserved binding
  int32_t dynamic_offset = -1;  // index into ResourceTable::dynamic_offsets of element 0; -1: not a dynamic buffer
};

struct ResourceLayout {
  std::span<const BindingSlot> slots;
  uint32_t push_constant_bytes = 0;
};

}  // namespace lapilli
