// Descriptor pools, and allocation of sets from them.
#include <algorithm>

#include "object/descriptor_set.h"

namespace lapilli {
namespace {

// Takes the set's descriptors from the pool's counts (or gives them back).
bool take(DescriptorPool& pool, const DescriptorSetLayout& layout) {
  uint32_t needed[kDescriptorTypes] = {};
  for (const LayoutBinding& binding : layout.bindings) {
    if (binding.type >= kDescriptorTypes) return false;
    needed[binding.type] += binding.count;
  }
  if (pool.free_sets == 0) return false;
  for (uint32_t type = 0; type < kDescriptorTypes; ++type) {
    if (needed[type] > pool.free_descriptors[type]) return false;
  }
  --pool.free_sets;
  for (uint32_t type = 0; type < kDescriptorTypes; ++type) pool.free_descriptors[type] -= needed[type];
  return true;
}

void give_back(DescriptorPool& pool, std::span<const LayoutBinding> bindings) {
  ++pool.free_sets;
  for (const LayoutBinding& binding : bindings) pool.free_descriptors[binding.type] += binding.count;
}

void insert(DescriptorPool& pool, DescriptorSet& set) {
  set.next = pool.first;
  if (pool.first != nullptr) pool.first->previous = &set;
  pool.first = &set;
}

}  // namespace

DescriptorSet::DescriptorSet(const HostMemory& memory, DescriptorPool& owner, const DescriptorSetLayout& set_layout)
    : Handle(memory),
      pool(owner),
      bindings(set_layout.bindings.begin(), set_layout.bindings.end(), host),
      descriptors(set_layout.descriptor_count, host),
      immutable_samplers(host) {
  if (set_layout.immutable_samplers.empty()) return;
  immutable_samplers.resize(descriptors.size(), nullptr);
  for (const LayoutBinding& binding : bindings) {
    if (!binding.has_immutable_samplers) continue;
    for (uint32_t i = 0; i < binding.count; ++i) {
      const SamplerState* sampler = set_layout.immutable_samplers[binding.immutable_samplers + i];
      immutable_samplers[binding.first + i] = sampler;
      descriptors[binding.first + i].sampler = sampler;
    }
  }
}

void DescriptorPool::free(DescriptorSet& set) {
  give_back(*this, set.bindings);
  if (set.next != nullptr) set.next->previous = set.previous;
  (set.previous != nullptr ? set.previous->next : first) = set.next;
  destroy(&set);
}

void DescriptorPool::free_all() {
  while (first != nullptr) free(*first);
}

VkResult create_descriptor_pool(DeviceContext& device, const VkDescriptorPoolCreateInfo& info,
                                const VkAllocationCallbacks* callbacks, VkDescriptorPool* handle) {
  auto pool = make_object<DescriptorPool>(device.object_memory(callbacks), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  pool->free_sets = info.maxSets;
  for (uint32_t i = 0; i < info.poolSizeCount; ++i) {
    const VkDescriptorPoolSize& size = info.pPoolSizes[i];
    if (size.type < kDescriptorTypes) pool->free_descriptors[size.type] += size.descriptorCount;
  }
  return publish(std::move(pool), handle);
}

VkResult allocate_descriptor_sets(const VkDescriptorSetAllocateInfo& info, VkDescriptorSet* handles) {
  DescriptorPool& pool = *DescriptorPool::from(info.descriptorPool);
  std::fill_n(handles, info.descriptorSetCount, VkDescriptorSet{VK_NULL_HANDLE});
  VkResult result = VK_SUCCESS;
  for (uint32_t i = 0; i < info.descriptorSetCount && result == VK_SUCCESS; ++i) {
    const DescriptorSetLayout& layout = *DescriptorSetLayout::from(info.pSetLayouts[i]);
    if (!take(pool, layout)) {
      result = VK_ERROR_OUT_OF_POOL_MEMORY;
      break;
    }
    try {
      auto set = make_object<DescriptorSet>(pool.host, VK_SYSTEM_ALLOCATION_SCOPE_OBJECT, pool, layout);
      insert(pool, *set);
      handles[i] = set.release()->handle();
    } catch (const std::bad_alloc&) {
      give_back(pool, layout.bindings);
      result = VK_ERROR_OUT_OF_HOST_MEMORY;
    }
  }
  if (result == VK_SUCCESS) return result;
  for (uint32_t i = 0; i < info.descriptorSetCount; ++i) {
    if (DescriptorSet* set = DescriptorSet::from(handles[i])) pool.free(*set);
    handles[i] = VK_NULL_HANDLE;
  }
  return result;
}

}  // namespace lapilli
