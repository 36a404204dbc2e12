// Layouts: bindings in order of their numbers, and where their descriptors and dynamic offsets lie.
#include "object/descriptor_layout.h"

#include <algorithm>

namespace lapilli {
namespace {

bool takes_sampler(VkDescriptorType type) {
  return type == VK_DESCRIPTOR_TYPE_SAMPLER || type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
}

void add_binding(DescriptorSetLayout& layout, const VkDescriptorSetLayoutBinding& info) {
  LayoutBinding binding;
  binding.binding = info.binding;
  binding.type = info.descriptorType;
  binding.count = info.descriptorCount;
  binding.stages = info.stageFlags;
  if (takes_sampler(info.descriptorType) && info.pImmutableSamplers != nullptr && info.descriptorCount != 0) {
    binding.has_immutable_samplers = true;
    binding.immutable_samplers = static_cast<uint32_t>(layout.immutable_samplers.size());
    for (uint32_t i = 0; i < info.descriptorCount; ++i) {
      layout.immutable_samplers.push_back(&Sampler::from(info.pImmutableSamplers[i])->state);
    }
  }
  layout.bindings.push_back(binding);
}

// Far above maxDescriptorSet…; keeps sums of counts inside 32 bits.
constexpr uint64_t kMaxSetDescriptors = 1u << 20;

uint64_t total_descriptors(const VkDescriptorSetLayoutCreateInfo& info) {
  uint64_t total = 0;
  for (uint32_t i = 0; i < info.bindingCount; ++i) total += info.pBindings[i].descriptorCount;
  return total;
}

void place_bindings(DescriptorSetLayout& layout) {
  std::sort(layout.bindings.begin(), layout.bindings.end(),
            [](const LayoutBinding& a, const LayoutBinding& b) { return a.binding < b.binding; });
  for (LayoutBinding& binding : layout.bindings) {
    binding.first = layout.descriptor_count;
    layout.descriptor_count += binding.count;
    if (!is_dynamic(binding.type)) continue;
    binding.first_dynamic = layout.dynamic_count;
    layout.dynamic_count += binding.count;
  }
}

}  // namespace

bool is_dynamic(VkDescriptorType type) {
  return type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC || type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC;
}

const LayoutBinding* DescriptorSetLayout::find(uint32_t binding) const {
  const auto at = std::lower_bound(bindings.begin(), bindings.end(), binding,
                                   [](const LayoutBinding& a, uint32_t number) { return a.binding < number; });
  return at != bindings.end() && at->binding == binding ? &*at : nullptr;
}

VkResult create_descriptor_set_layout(DeviceContext& device, const VkDescriptorSetLayoutCreateInfo& info,
                                      const VkAllocationCallbacks* callbacks, VkDescriptorSetLayout* handle) {
  if (total_descriptors(info) > kMaxSetDescriptors) {
    log_error("vkCreateDescriptorSetLayout: more than %llu descriptors",
              static_cast<unsigned long long>(kMaxSetDescriptors));
    return VK_ERROR_OUT_OF_HOST_MEMORY;
  }
  auto layout = make_object<DescriptorSetLayout>(device.object_memory(callbacks), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  for (uint32_t i = 0; i < info.bindingCount; ++i) add_binding(*layout, info.pBindings[i]);
  place_bindings(*layout);
  return publish(std::move(layout), handle);
}

VkResult create_pipeline_layout(DeviceContext& device, const VkPipelineLayoutCreateInfo& info,
                                const VkAllocationCallbacks* callbacks, VkPipelineLayout* handle) {
  if (info.setLayoutCount > kMaxDescriptorSets) {
    log_error("vkCreatePipelineLayout: %u descriptor sets; the limit is %u", info.setLayoutCount, kMaxDescriptorSets);
    return VK_ERROR_OUT_OF_HOST_MEMORY;
  }
  auto layout = make_object<PipelineLayout>(device.object_memory(callbacks), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  layout->set_count = info.setLayoutCount;
  for (uint32_t set = 0; set < info.setLayoutCount; ++set) {
    const DescriptorSetLayout& set_layout = *DescriptorSetLayout::from(info.pSetLayouts[set]);
    layout->first_dynamic[set] = layout->dynamic_total;
    layout->dynamic_count[set] = set_layout.dynamic_count;
    for (const LayoutBinding& binding : set_layout.bindings) {
      const int32_t dynamic =
          is_dynamic(binding.type) ? static_cast<int32_t>(layout->dynamic_total + binding.first_dynamic) : -1;
      layout->slots.push_back(
          {set, binding.binding, binding.type, binding.stages, binding.first, binding.count, dynamic});
    }
    layout->dynamic_total += set_layout.dynamic_count;
  }
  for (uint32_t i = 0; i < info.pushConstantRangeCount; ++i) {
    const VkPushConstantRange& range = info.pPushConstantRanges[i];
    const uint64_t end = uint64_t{range.offset} + range.size;
    if (end > kMaxPushConstantBytes) {
      log_error("vkCreatePipelineLayout: push constants up to byte %llu; the limit is %u",
                static_cast<unsigned long long>(end), kMaxPushConstantBytes);
      return VK_ERROR_OUT_OF_HOST_MEMORY;
    }
    layout->push_constant_bytes = std::max(layout->push_constant_bytes, static_cast<uint32_t>(end));
  }
  return publish(std::move(layout), handle);
}

}  // namespace lapilli
