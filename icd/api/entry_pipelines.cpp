// Entry points of chapters "Shaders" and "Pipelines".
#include "api/entry.h"
#include "object/pipeline_cache.h"

namespace lapilli::entry {

VKAPI_ATTR VkResult VKAPI_CALL vkCreateShaderModule(VkDevice device, const VkShaderModuleCreateInfo* info,
                                                    const VkAllocationCallbacks* callbacks, VkShaderModule* module) {
  return create_shader_module(*Device::from(device), *info, callbacks, module);
}

VKAPI_ATTR void VKAPI_CALL vkDestroyShaderModule(VkDevice, VkShaderModule module, const VkAllocationCallbacks*) {
  destroy(ShaderModule::from(module));
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateGraphicsPipelines(VkDevice device, VkPipelineCache, uint32_t count,
                                                         const VkGraphicsPipelineCreateInfo* infos,
                                                         const VkAllocationCallbacks* callbacks,
                                                         VkPipeline* pipelines) {
  return create_graphics_pipelines(*Device::from(device), list(infos, count), callbacks, pipelines);
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreateComputePipelines(VkDevice device, VkPipelineCache, uint32_t count,
                                                        const VkComputePipelineCreateInfo* infos,
                                                        const VkAllocationCallbacks* callbacks, VkPipeline* pipelines) {
  return create_compute_pipelines(*Device::from(device), list(infos, count), callbacks, pipelines);
}

VKAPI_ATTR void VKAPI_CALL vkDestroyPipeline(VkDevice, VkPipeline pipeline, const VkAllocationCallbacks*) {
  destroy(Pipeline::from(pipeline));
}

VKAPI_ATTR void VKAPI_CALL vkCmdBindPipeline(VkCommandBuffer commands, VkPipelineBindPoint, VkPipeline pipeline) {
  record_bind_pipeline(*CommandBuffer::from(commands), *Pipeline::from(pipeline));
}

VKAPI_ATTR VkResult VKAPI_CALL vkCreatePipelineCache(VkDevice device, const VkPipelineCacheCreateInfo*,
                                                     const VkAllocationCallbacks* callbacks, VkPipelineCache* cache) {
  return create_pipeline_cache(*Device::from(device), callbacks, cache);
}

VKAPI_ATTR void VKAPI_CALL vkDestroyPipelineCache(VkDevice, VkPipelineCache cache, const VkAllocationCallbacks*) {
  destroy(PipelineCache::from(cache));
}

VKAPI_ATTR VkResult VKAPI_CALL vkGetPipelineCacheData(VkDevice device, VkPipelineCache, size_t* size, void* data) {
  return pipeline_cache_data(*Device::from(device), size, data);
}

// Caches hold nothing, so that merging them changes nothing.
VKAPI_ATTR VkResult VKAPI_CALL vkMergePipelineCaches(VkDevice, VkPipelineCache, uint32_t, const VkPipelineCache*) {
  return VK_SUCCESS;
}

}  // namespace lapilli::entry
