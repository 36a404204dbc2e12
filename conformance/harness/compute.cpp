// See compute.h.
#include "harness/compute.h"

#include "common/pipeline.h"
#include "harness/graphics.h"
#include "harness/variants.h"

namespace lapilli::conformance {

VkResult try_create_compute_pipeline(const samples::Context& context, std::span<const uint32_t> shader,
                                     VkPipelineLayout layout, VkPipeline* pipeline,
                                     const VkSpecializationInfo* specialization, const char* entry_point) {
  shader = in_variant(shader);
  VkShaderModuleCreateInfo module_info = {};
  module_info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  module_info.codeSize = shader.size_bytes();
  module_info.pCode = shader.data();
  VkShaderModule module = VK_NULL_HANDLE;
  const VkResult created = vkCreateShaderModule(context.device(), &module_info, nullptr, &module);
  if (created != VK_SUCCESS) return created;
  const samples::ShaderModule owner(context.device(), module);
  VkComputePipelineCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = module;
  info.stage.pName = entry_point;
  info.stage.pSpecializationInfo = specialization;
  info.layout = layout;
  return vkCreateComputePipelines(context.device(), VK_NULL_HANDLE, 1, &info, nullptr, pipeline);
}

std::vector<Bytes> run_compute(const samples::Context& context, const ComputeRun& run) {
  std::vector<samples::Buffer> buffers;
  std::vector<samples::Binding> bindings;
  buffers.reserve(run.buffers.size());
  for (const Bytes& contents : run.buffers) {
    buffers.emplace_back(context, std::span<const std::byte>(contents), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    bindings.emplace_back(
        samples::BufferBinding{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_COMPUTE_BIT, &buffers.back()});
  }
  const samples::DescriptorSet descriptors(context, bindings);
  const VkDescriptorSetLayout set_layout = descriptors.layout();
  const samples::PipelineLayout layout = create_layout(context, {&set_layout, 1}, uint32_t(run.push_constants.size()));
  VkPipeline raw_pipeline = VK_NULL_HANDLE;
  samples::check(try_create_compute_pipeline(context, run.shader, layout.get(), &raw_pipeline, run.specialization),
                 "vkCreateComputePipelines");
  const samples::Pipeline pipeline(context.device(), raw_pipeline);

  VkCommandBuffer commands = context.begin_commands();
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.get());
  const VkDescriptorSet set = descriptors.get();
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout.get(), 0, 1, &set, 0, nullptr);
  if (!run.push_constants.empty()) {
    vkCmdPushConstants(commands, layout.get(),
                       VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT | VK_SHADER_STAGE_COMPUTE_BIT, 0,
                       uint32_t(run.push_constants.size()), run.push_constants.data());
  }
  vkCmdDispatch(commands, run.groups[0], run.groups[1], run.groups[2]);
  VkMemoryBarrier for_host = {};
  for_host.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  for_host.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
  for_host.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &for_host, 0,
                       nullptr, 0, nullptr);
  context.submit_and_wait(commands);

  std::vector<Bytes> out;
  for (const samples::Buffer& b : buffers) {
    const auto* data = static_cast<const std::byte*>(b.data());
    out.emplace_back(data, data + b.size());
  }
  return out;
}

void dispatch(const samples::Context& context, const samples::Pipeline& pipeline, VkPipelineLayout layout,
              VkDescriptorSet set, uint32_t groups_x, uint32_t groups_y) {
  VkCommandBuffer commands = context.begin_commands();
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.get());
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, nullptr);
  vkCmdDispatch(commands, groups_x, groups_y, 1);
  context.submit_and_wait(commands);
}

}  // namespace lapilli::conformance
