// Compute pipelines, and what both kinds of pipelines share.
#include "object/pipeline.h"

#include <algorithm>
#include <cstring>

#include "object/limits.h"

namespace lapilli {

StageInfo::StageInfo(const VkPipelineShaderStageCreateInfo& info) {
  if (const VkSpecializationInfo* special = info.pSpecializationInfo) {
    const auto* data = static_cast<const std::byte*>(special->pData);
    for (uint32_t i = 0; i < special->mapEntryCount; ++i) {
      const VkSpecializationMapEntry& from = special->pMapEntries[i];
      SpecializationEntry entry;
      entry.constant_id = from.constantID;
      entry.size = static_cast<uint32_t>(std::min(from.size, sizeof(entry.bits)));
      if (from.offset > special->dataSize || entry.size > special->dataSize - from.offset) continue;
      std::memcpy(&entry.bits, data + from.offset, entry.size);
      entries.push_back(entry);
    }
  }
  stage = {ShaderModule::from(info.module)->spirv, info.pName, entries};
}

PipelineResources resources_of(const PipelineLayout& layout) {
  PipelineResources resources;
  resources.set_count = layout.set_count;
  for (const BindingSlot& slot : layout.slots) {
    uint32_t& count = resources.descriptor_count[slot.set];
    count = std::max(count, slot.first + slot.count);
  }
  std::copy(std::begin(layout.dynamic_count), std::end(layout.dynamic_count), resources.dynamic_count);
  std::copy(std::begin(layout.first_dynamic), std::end(layout.first_dynamic), resources.first_dynamic);
  resources.dynamic_total = layout.dynamic_total;
  return resources;
}

namespace {

VkResult create_one(DeviceContext& device, const VkComputePipelineCreateInfo& info,
                    const VkAllocationCallbacks* callbacks, VkPipeline* handle) {
  auto pipeline = make_object<Pipeline>(device.object_memory(callbacks), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  const StageInfo stage(info.stage);
  Result<ProgramPtr> program = build_compute(stage.stage, PipelineLayout::from(info.layout)->resources());
  if (!program) {
    log_error("vkCreateComputePipelines: %s", program.error().message.c_str());
    return program.error().code;
  }
  pipeline->bind_point = VK_PIPELINE_BIND_POINT_COMPUTE;
  pipeline->resources = resources_of(*PipelineLayout::from(info.layout));
  pipeline->compute = std::move(*program);
  return publish(std::move(pipeline), handle);
}

}  // namespace

VkResult create_compute_pipelines(DeviceContext& device, std::span<const VkComputePipelineCreateInfo> infos,
                                  const VkAllocationCallbacks* callbacks, VkPipeline* handles) {
  std::fill_n(handles, infos.size(), VkPipeline{VK_NULL_HANDLE});
  VkResult worst = VK_SUCCESS;
  for (size_t i = 0; i < infos.size(); ++i) {
    const VkResult result = create_one(device, infos[i], callbacks, &handles[i]);
    if (worst == VK_SUCCESS) worst = result;
  }
  return worst;
}

}  // namespace lapilli
