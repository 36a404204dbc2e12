// VkDescriptorPool and VkDescriptorSet, and how sets are written. Specification: chapter "Resource Descriptors".
#pragma once

#include "object/descriptor_layout.h"

namespace lapilli {

struct DescriptorPool;

struct DescriptorSet : Handle<DescriptorSet, VkDescriptorSet> {
  DescriptorSet(const HostMemory& memory, DescriptorPool& owner, const DescriptorSetLayout& set_layout);

  DescriptorPool& pool;
  HostVector<LayoutBinding> bindings;  // copied: the layout may be destroyed before the set
  HostVector<Descriptor> descriptors;  // in binding order
  // Per descriptor, empty if the layout has none: the sampler that updates may not change, or null.
  HostVector<const SamplerState*> immutable_samplers;
  DescriptorSet* next = nullptr;  // list of the pool
  DescriptorSet* previous = nullptr;

  const LayoutBinding* find(uint32_t binding) const;
};

inline constexpr uint32_t kDescriptorTypes = VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT + 1;

// Counts what may still be allocated; the sets themselves come from the pool's host memory, so that a pool never
// fragments.
struct DescriptorPool : Handle<DescriptorPool, VkDescriptorPool> {
  using Handle::Handle;
  ~DescriptorPool() { free_all(); }

  uint32_t free_sets = 0;
  uint32_t free_descriptors[kDescriptorTypes] = {};
  DescriptorSet* first = nullptr;

  void free(DescriptorSet& set);
  void free_all();
};

VkResult create_descriptor_pool(DeviceContext& device, const VkDescriptorPoolCreateInfo& info,
                                const VkAllocationCallbacks* callbacks, VkDescriptorPool* handle);
// Either all sets or, with an error, none; then all handles are null.
VkResult allocate_descriptor_sets(const VkDescriptorSetAllocateInfo& info, VkDescriptorSet* handles);

void write_descriptors(const VkWriteDescriptorSet& write);
void copy_descriptors(const VkCopyDescriptorSet& copy);

}  // namespace lapilli
