// Commands that change what later commands use. Specification: chapters "Pipelines", "Resource Descriptors",
// "Fixed-Function Vertex Processing", "Dynamic State".
#pragma once

#include <span>

#include "command/command.h"
#include "object/buffer.h"
#include "object/descriptor_set.h"
#include "object/pipeline.h"

namespace lapilli::cmd {

struct BindPipeline : CommandOf<CommandKind::kBindPipeline> {
  const Pipeline* pipeline = nullptr;
};

struct SetBinding {
  DescriptorSet* set = nullptr;
  std::span<const uint32_t> dynamic_offsets;  // bytes
};
struct BindDescriptorSets : CommandOf<CommandKind::kBindDescriptorSets> {
  VkPipelineBindPoint bind_point = VK_PIPELINE_BIND_POINT_GRAPHICS;
  uint32_t first = 0;
  std::span<const SetBinding> sets;
};

struct VertexBufferBinding {
  Buffer* buffer = nullptr;
  uint64_t offset = 0;  // bytes
};
struct BindVertexBuffers : CommandOf<CommandKind::kBindVertexBuffers> {
  uint32_t first = 0;
  std::span<const VertexBufferBinding> buffers;
};

struct BindIndexBuffer : CommandOf<CommandKind::kBindIndexBuffer> {
  Buffer* buffer = nullptr;
  uint64_t offset = 0;  // bytes
  VkIndexType type = VK_INDEX_TYPE_UINT16;
};

struct PushConstants : CommandOf<CommandKind::kPushConstants> {
  uint32_t offset = 0;  // bytes
  std::span<const std::byte> values;
};

struct SetViewport : CommandOf<CommandKind::kSetViewport> {
  VkViewport viewport = {};
};
struct SetScissor : CommandOf<CommandKind::kSetScissor> {
  VkRect2D scissor = {};
};
struct SetLineWidth : CommandOf<CommandKind::kSetLineWidth> {
  float width = 1;
};
struct SetDepthBias : CommandOf<CommandKind::kSetDepthBias> {
  float constant = 0, clamp = 0, slope = 0;
};
struct SetBlendConstants : CommandOf<CommandKind::kSetBlendConstants> {
  float values[4] = {};
};

}  // namespace lapilli::cmd
