// Runs a compute shader over storage buffers (binding 0, 1, …) and reads them back.
#pragma once

#include <cstring>
#include <span>
#include <vector>

#include "common/resources.h"

namespace lapilli::conformance {

using Bytes = std::vector<std::byte>;

template <typename T>
Bytes to_bytes(const std::vector<T>& values) {
  Bytes out(values.size() * sizeof(T));
  if (!out.empty()) std::memcpy(out.data(), values.data(), out.size());
  return out;
}

template <typename T>
std::vector<T> from_bytes(const Bytes& bytes) {
  std::vector<T> out(bytes.size() / sizeof(T));
  if (!out.empty()) std::memcpy(out.data(), bytes.data(), out.size() * sizeof(T));
  return out;
}

struct ComputeRun {
  std::span<const uint32_t> shader;
  std::vector<Bytes> buffers;  // contents before; the run returns the contents after
  uint32_t groups[3] = {1, 1, 1};
  Bytes push_constants = {};
  const VkSpecializationInfo* specialization = nullptr;
};

std::vector<Bytes> run_compute(const samples::Context& context, const ComputeRun& run);

// Without check(): the pipeline's result, for shaders that may be refused.
VkResult try_create_compute_pipeline(const samples::Context& context, std::span<const uint32_t> shader,
                                     VkPipelineLayout layout, VkPipeline* pipeline,
                                     const VkSpecializationInfo* specialization = nullptr,
                                     const char* entry_point = "main");

// Runs the groups with one descriptor set, bound as set 0, and waits.
void dispatch(const samples::Context& context, const samples::Pipeline& pipeline, VkPipelineLayout layout,
              VkDescriptorSet set, uint32_t groups_x, uint32_t groups_y = 1);

}  // namespace lapilli::conformance
