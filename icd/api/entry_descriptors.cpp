// Entry points of chapter "Resource Descriptors".
#include "api/entry.h"

namespace lapilli::entry {

VKAPI_ATTR VkResult VKAPI_CALL vkCreateDescriptorSetLayout(VkDevice device, const VkDescriptorSetLayoutCreateInfo* info,
                                                           const VkAllocationCallbacks* callbacks,
                                                           VkDescriptorSetLayout* layout) {
  return create_descriptor_set_layout(*Device::from(device), *info, callbacks, layout);
}

VKAPI_ATTR void VKAPI_CALL vkDestroyDescriptorSetLayout(VkDevice, VkDescriptorSetLayout layout,
                                                        const VkAllocationCallbacks*) {
  destroy(DescriptorSetLayout::from(layout));
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreatePipelineLayout(VkDevice device, const VkPipelineLayoutCreateInfo* info,
                                                      const VkAllocationCallbacks* callbacks,
                                                      VkPipelineLayout* layout) {
  return create_pipeline_layout(*Device::from(device), *info, callbacks, layout);
}

VKAPI_ATTR void VKAPI_CALL vkDestroyPipelineLayout(VkDevice, VkPipelineLayout layout, const VkAllocationCallbacks*) {
  destroy(PipelineLayout::from(layout));
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateDescriptorPool(VkDevice device, const VkDescriptorPoolCreateInfo* info,
                                                      const VkAllocationCallbacks* callbacks, VkDescriptorPool* pool) {
  return create_descriptor_pool(*Device::from(device), *info, callbacks, pool);
}

VKAPI_ATTR void VKAPI_CALL vkDestroyDescriptorPool(VkDevice, VkDescriptorPool pool, const VkAllocationCallbacks*) {
  destroy(DescriptorPool::from(pool));
}

VKAPI_ATTR VkResult VKAPI_CALL vkResetDescriptorPool(VkDevice, VkDescriptorPool pool, VkDescriptorPoolResetFlags) {
  DescriptorPool::from(pool)->free_all();
  return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL vkAllocateDescriptorSets(VkDevice, const VkDescriptorSetAllocateInfo* info,
                                                        VkDescriptorSet* sets) {
  return allocate_descriptor_sets(*info, sets);
}

VKAPI_ATTR VkResult VKAPI_CALL vkFreeDescriptorSets(VkDevice, VkDescriptorPool pool, uint32_t count,
                                                    const VkDescriptorSet* sets) {
  for (VkDescriptorSet set : list(sets, count)) {
    if (set != VK_NULL_HANDLE) DescriptorPool::from(pool)->free(*DescriptorSet::from(set));
  }
  return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL vkUpdateDescriptorSets(VkDevice, uint32_t write_count, const VkWriteDescriptorSet* writes,
                                                  uint32_t copy_count, const VkCopyDescriptorSet* copies) {
  for (const VkWriteDescriptorSet& write : list(writes, write_count)) write_descriptors(write);
  for (const VkCopyDescriptorSet& copy : list(copies, copy_count)) copy_descriptors(copy);
}

VKAPI_ATTR void VKAPI_CALL vkCmdBindDescriptorSets(VkCommandBuffer commands, VkPipelineBindPoint bind_point,
                                                   VkPipelineLayout layout, uint32_t first, uint32_t count,
                                                   const VkDescriptorSet* sets, uint32_t offset_count,
                                                   const uint32_t* offsets) {
  record_bind_descriptor_sets(*CommandBuffer::from(commands), bind_point, *PipelineLayout::from(layout), first,
                              list(sets, count), list(offsets, offset_count));
}

VKAPI_ATTR void VKAPI_CALL vkCmdPushConstants(VkCommandBuffer commands, VkPipelineLayout, VkShaderStageFlags,
                                              uint32_t offset, uint32_t size, const void* values) {
  record_push_constants(*CommandBuffer::from(commands), offset, list(static_cast<const std::byte*>(values), size));
}

}  // namespace lapilli::entry
