// See descriptors.h.
#include "harness/descriptors.h"

namespace lapilli::conformance {

Descriptors::Descriptors(const samples::Context& context, std::span<const DescriptorSlot> slots) : context_(context) {
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  std::vector<VkDescriptorPoolSize> sizes;
  for (const DescriptorSlot& s : slots) {
    if (s.element == 0) bindings.push_back({s.binding, s.type, 0, VK_SHADER_STAGE_ALL, nullptr});
    ++bindings.back().descriptorCount;
    sizes.push_back({s.type, 1});
  }
  VkDescriptorSetLayoutCreateInfo layout = {};
  layout.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  layout.bindingCount = uint32_t(bindings.size());
  layout.pBindings = bindings.data();
  VkDescriptorSetLayout raw_layout = VK_NULL_HANDLE;
  samples::check(vkCreateDescriptorSetLayout(context.device(), &layout, nullptr, &raw_layout),
                 "vkCreateDescriptorSetLayout");
  layout_ = samples::DescriptorSetLayout(context.device(), raw_layout);

  VkDescriptorPoolCreateInfo pool = {};
  pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  pool.maxSets = 1;
  pool.poolSizeCount = uint32_t(sizes.size());
  pool.pPoolSizes = sizes.data();
  VkDescriptorPool raw_pool = VK_NULL_HANDLE;
  samples::check(vkCreateDescriptorPool(context.device(), &pool, nullptr, &raw_pool), "vkCreateDescriptorPool");
  pool_ = samples::DescriptorPool(context.device(), raw_pool);

  VkDescriptorSetAllocateInfo allocate = {};
  allocate.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  allocate.descriptorPool = raw_pool;
  allocate.descriptorSetCount = 1;
  allocate.pSetLayouts = &raw_layout;
  samples::check(vkAllocateDescriptorSets(context.device(), &allocate, &set_), "vkAllocateDescriptorSets");
  for (const DescriptorSlot& s : slots) {
    if (s.written) write(s);
  }
}

void Descriptors::write(const DescriptorSlot& slot) const {
  VkWriteDescriptorSet write = {};
  write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
  write.dstSet = set_;
  write.dstBinding = slot.binding;
  write.dstArrayElement = slot.element;
  write.descriptorCount = 1;
  write.descriptorType = slot.type;
  write.pBufferInfo = &slot.buffer;
  write.pImageInfo = &slot.image;
  write.pTexelBufferView = &slot.view;
  vkUpdateDescriptorSets(context_.device(), 1, &write, 0, nullptr);
}

}  // namespace lapilli::conformance
