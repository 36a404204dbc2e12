// For tests: lowers, checks and runs a compute shader on buffers.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "shader/stage_code.h"

namespace lapilli {

inline std::shared_ptr<const SpirvModule> parse_or_fail(std::span<const uint32_t> words) {
  Result<std::shared_ptr<const SpirvModule>> module = parse_spirv(words);
  EXPECT_TRUE(module.ok()) << module.error().message;
  return module.ok() ? *module : nullptr;
}

class ComputeRun {
 public:
  std::vector<SpecializationEntry> specialization;
  std::vector<std::byte> push = std::vector<std::byte>(kMaxPushConstantBytes);
  uint32_t workgroup_size[3] = {};

  // Each call makes the next descriptor: binding b, array element e. Zeroed.
  template <class T>
  T* buffer(uint32_t binding, size_t count) {
    storage_.emplace_back(count * sizeof(T) + 16);
    Descriptor descriptor;
    descriptor.data = storage_.back().data();
    descriptor.size = descriptor.room = count * sizeof(T);
    if (slots_.empty() || slots_.back().binding != binding) {
      slots_.push_back({0, binding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_COMPUTE_BIT,
                        static_cast<uint32_t>(descriptors_.size()), 0, -1});
    }
    ++slots_.back().count;
    descriptors_.push_back(descriptor);
    return reinterpret_cast<T*>(descriptor.data);
  }

  // Runs `groups` workgroups.
  void run(std::span<const uint32_t> words, uint32_t groups = 1) {
    const ResourceLayout layout{slots_, kMaxPushConstantBytes};
    const ShaderStage stage{parse_or_fail(words), "main", specialization};
    ASSERT_TRUE(stage.module);
    Result<Code> code = make_compute_code(stage, layout);
    ASSERT_TRUE(code.ok()) << code.error().message;
    ASSERT_EQ(verify(*code), "") << disassemble(*code);
    std::copy(std::begin(code->workgroup_size), std::end(code->workgroup_size), workgroup_size);
    Result<ProgramPtr> program = assemble(std::move(*code));
    ASSERT_TRUE(program.ok()) << program.error().message;
    ResourceTable table;
    table.sets[0] = descriptors_.data();
    table.push_constants = push.data();
    table.push_constant_bytes = static_cast<uint32_t>(push.size());
    Execution execution;
    ExecutionLimits limits;
    ASSERT_TRUE(execution.prepare(**program, table, &limits));
    const uint32_t counts[3] = {groups, 1, 1};
    for (uint32_t group = 0; group < groups; ++group) {
      const uint32_t workgroup[3] = {group, 0, 0};
      execution.run_workgroup(workgroup, counts);
    }
  }

 private:
  std::vector<std::vector<std::byte>> storage_;
  std::vector<Descriptor> descriptors_;
  std::vector<BindingSlot> slots_;
};

}  // namespace lapilli
