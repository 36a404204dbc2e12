// VkDescriptorSetLayout and VkPipelineLayout. Specification: chapter "Resource Descriptors".
#pragma once

#include "object/sampler.h"
#include "shader/resources.h"

namespace lapilli {

struct LayoutBinding {
  uint32_t binding = 0;
  VkDescriptorType type = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
  uint32_t count = 0;  // 0: a reserved binding
  VkShaderStageFlags stages = 0;
  uint32_t first = 0;               // its first descriptor in the set
  uint32_t first_dynamic = 0;       // dynamic types: its first offset among those of the set
  uint32_t immutable_samplers = 0;  // index of its first in DescriptorSetLayout::immutable_samplers
  bool has_immutable_samplers = false;
};

bool is_dynamic(VkDescriptorType type);

struct DescriptorSetLayout : Handle<DescriptorSetLayout, VkDescriptorSetLayout> {
  explicit DescriptorSetLayout(const HostMemory& memory) : Handle(memory), bindings(host), immutable_samplers(host) {}

  HostVector<LayoutBinding> bindings;  // by rising binding number
  // Pointers, as sets do: a sampler must outlive its use.
  HostVector<const SamplerState*> immutable_samplers;
  uint32_t descriptor_count = 0;
  uint32_t dynamic_count = 0;

  // Null if there is no such binding.
  const LayoutBinding* find(uint32_t binding) const;
};

VkResult create_descriptor_set_layout(DeviceContext& device, const VkDescriptorSetLayoutCreateInfo& info,
                                      const VkAllocationCallbacks* callbacks, VkDescriptorSetLayout* handle);

// Holds copies of what it needs: set layouts may be destroyed before it.
struct PipelineLayout : Handle<PipelineLayout, VkPipelineLayout> {
  explicit PipelineLayout(const HostMemory& memory) : Handle(memory), slots(host) {}

  HostVector<BindingSlot> slots;
  uint32_t set_count = 0;
  uint32_t push_constant_bytes = 0;
  // Of each set: how many dynamic offsets it takes, and where they begin in ResourceTable::dynamic_offsets.
  uint32_t dynamic_count[kMaxDescriptorSets] = {};
  uint32_t first_dynamic[kMaxDescriptorSets] = {};
  uint32_t dynamic_total = 0;

  ResourceLayout resources() const { return {slots, push_constant_bytes}; }
};

VkResult create_pipeline_layout(DeviceContext& device, const VkPipelineLayoutCreateInfo& info,
                                const VkAllocationCallbacks* callbacks, VkPipelineLayout* handle);

}  // namespace lapilli
