// What a batch leaves in lanes that do not take part may not reach a later batch: derivatives read the neighbours.
#include <gtest/gtest.h>

#include <array>
#include <numeric>

#include "base/simd_dispatch.h"
#include "shader/program.h"

namespace lapilli {
namespace {

constexpr Reg kNone = kNoReg;

// Where flags[lane]: result[lane] := derivative in x of input[lane], loaded inside of the branch.
Code derivative_under_a_branch() {
  Code code;
  code.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  code.workgroup_size[0] = kBatchLanes;
  uint32_t buffers[3];
  for (uint32_t i = 0; i < 3; ++i) buffers[i] = code.add_resource({0, i, 1, -1});
  const uint32_t taken = code.new_mask();
  const uint32_t end = code.new_label();
  const Reg lane = code.emit(Opcode::builtin, kNone, kNone, kNone, static_cast<uint32_t>(BuiltIn::lane_index));
  const Reg address = code.emit(Opcode::shl, lane, code.constant(2));
  const Reg flag = code.emit_n(Opcode::load_buffer, 1, address, kNone, kNone, buffers[0]);
  code.emit_void(Opcode::branch_where, flag, kNone, kNone, taken);
  code.emit_void(Opcode::enter, kNone, kNone, kNone, taken, end);
  const Reg value = code.emit_n(Opcode::load_buffer, 1, address, kNone, kNone, buffers[1]);
  const Reg derivative = code.emit(Opcode::ddx_fine, value);
  code.emit_void(Opcode::store_buffer, address, derivative, kNone, buffers[2]);
  code.place_label(end);
  code.emit_void(Opcode::end);
  return code;
}

TEST(IdleLanes, LoadsLeaveNothingOfAnEarlierBatch) {
  for (const SimdTarget target : supported_simd_targets()) {
    const SimdTarget before = simd_target();
    ASSERT_TRUE(set_simd_target(target));
    Result<ProgramPtr> program = assemble(derivative_under_a_branch());
    set_simd_target(before);
    ASSERT_TRUE(program.ok()) << program.error().message;

    std::array<uint32_t, kBatchLanes> flags;
    std::array<float, kBatchLanes> input, output{};
    Descriptor descriptors[3];
    descriptors[0].data = reinterpret_cast<std::byte*>(flags.data());
    descriptors[1].data = reinterpret_cast<std::byte*>(input.data());
    descriptors[2].data = reinterpret_cast<std::byte*>(output.data());
    for (Descriptor& descriptor : descriptors) descriptor.size = descriptor.room = sizeof input;
    ResourceTable resources;
    resources.sets[0] = descriptors;

    Execution execution;
    ASSERT_TRUE(execution.prepare(*program.value(), resources, nullptr));
    const uint32_t first[3] = {}, groups[3] = {1, 1, 1};
    flags.fill(~0u);
    input.fill(1000);
    execution.run_workgroup(first, groups);

    std::iota(input.begin(), input.end(), 1.0f);
    for (uint32_t lane = 0; lane < kBatchLanes; ++lane) flags[lane] = lane % 2 != 0 ? ~0u : 0u;
    execution.run_workgroup(first, groups);
    for (uint32_t lane = 1; lane < kBatchLanes; lane += 2) {
      EXPECT_EQ(output[lane], static_cast<float>(lane + 1)) << lane;  // its left neighbour counts as 0
    }
  }
}

}  // namespace
}  // namespace lapilli
