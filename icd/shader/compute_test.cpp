// Tests of dispatch: every invocation runs once, with the right built-ins, whatever the number of threads.
#include "shader/compute.h"

#include <gtest/gtest.h>

#include <chrono>
#include <vector>

namespace lapilli {
namespace {

constexpr uint32_t kSize[3] = {5, 7, 3};  // 105 invocations: two batches

Reg builtin(Code& code, BuiltIn which) {
  return code.emit(Opcode::builtin, kNoReg, kNoReg, kNoReg, static_cast<uint32_t>(which));
}

// buffer[linear global index] += 1 + number of the workgroup.
ProgramPtr counting_program(const uint32_t groups[3]) {
  Code code;
  code.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  std::copy_n(kSize, 3, code.workgroup_size);
  code.add_resource({});
  const auto combine = [&](BuiltIn x, BuiltIn y, BuiltIn z, uint32_t width, uint32_t height) {
    const Reg slice = code.emit(Opcode::imul, builtin(code, z), code.constant(width * height));
    const Reg row = code.emit(Opcode::imul, builtin(code, y), code.constant(width));
    return code.emit(Opcode::iadd, code.emit(Opcode::iadd, slice, row), builtin(code, x));
  };
  const Reg index = combine(BuiltIn::global_invocation_x, BuiltIn::global_invocation_y, BuiltIn::global_invocation_z,
                            kSize[0] * groups[0], kSize[1] * groups[1]);
  const Reg group = combine(BuiltIn::workgroup_x, BuiltIn::workgroup_y, BuiltIn::workgroup_z, groups[0], groups[1]);
  const Reg address = code.emit(Opcode::shl, index, code.constant(2));
  const Reg old = code.emit_n(Opcode::load_buffer, 1, address);
  const Reg sum = code.emit(Opcode::iadd, code.emit(Opcode::iadd, old, group), code.constant(1));
  code.emit_void(Opcode::store_buffer, address, sum);
  code.emit_void(Opcode::end);
  EXPECT_EQ(verify(code), "");
  return std::move(*assemble(std::move(code)));
}

TEST(Dispatch, RunsEveryInvocationOnce) {
  for (unsigned threads : {1u, 2u, 7u}) {
    ThreadPool pool(threads);
    const uint32_t groups[3] = {4, 3, 5};
    const uint32_t width = kSize[0] * groups[0], height = kSize[1] * groups[1], depth = kSize[2] * groups[2];
    std::vector<uint32_t> words(size_t{width} * height * depth);
    Descriptor descriptor;
    descriptor.data = reinterpret_cast<std::byte*>(words.data());
    descriptor.size = descriptor.room = words.size() * 4;
    ResourceTable resources;
    resources.sets[0] = &descriptor;
    const ProgramPtr program = counting_program(groups);
    ASSERT_TRUE(dispatch(pool, *program, resources, groups, nullptr));
    for (uint32_t z = 0; z < depth; ++z) {
      for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x) {
          const uint32_t group = (z / kSize[2] * groups[1] + y / kSize[1]) * groups[0] + x / kSize[0];
          ASSERT_EQ(words[(z * height + y) * width + x], group + 1);
        }
      }
    }
  }
}

TEST(Dispatch, NoWorkgroupsIsNothing) {
  ThreadPool pool(1);
  const uint32_t groups[3] = {4, 0, 5};
  const uint32_t any[3] = {1, 1, 1};
  const ProgramPtr program = counting_program(any);
  EXPECT_TRUE(dispatch(pool, *program, ResourceTable{}, groups, nullptr));
}

TEST(Dispatch, ManyWorkgroupsEndAtTheDeadline) {
  ThreadPool pool(2);
  const uint32_t groups[3] = {65535, 65535, 65535};
  const uint32_t any[3] = {1, 1, 1};
  const ProgramPtr program = counting_program(any);
  ExecutionLimits limits;
  limits.deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(20);
  EXPECT_TRUE(dispatch(pool, *program, ResourceTable{}, groups, &limits));
  EXPECT_TRUE(limits.expired.load());
}

// A program without loops, of more than a millisecond a batch: the clock is read before each of them.
TEST(Dispatch, LongProgramsEndInTime) {
  constexpr uint32_t kLength = 400000;
  Code code;
  code.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  code.workgroup_size[0] = kBatchLanes;
  code.add_resource({});
  const Reg address = code.emit(Opcode::shl, builtin(code, BuiltIn::workgroup_x), code.constant(2));
  Reg value = builtin(code, BuiltIn::global_invocation_x);
  for (uint32_t i = 0; i < kLength; ++i) value = code.emit(Opcode::fdiv, value, address);
  code.emit_void(Opcode::store_buffer, address, code.emit(Opcode::ior, value, code.constant(1)));
  code.emit_void(Opcode::end);
  const Result<ProgramPtr> program = assemble(std::move(code));
  ASSERT_TRUE(program.ok()) << program.error().message;
  constexpr uint32_t kGroups = 200;
  std::vector<uint32_t> words(kGroups);
  Descriptor descriptor;
  descriptor.data = reinterpret_cast<std::byte*>(words.data());
  descriptor.size = descriptor.room = words.size() * 4;
  ResourceTable resources;
  resources.sets[0] = &descriptor;
  ThreadPool pool(1);
  ExecutionLimits limits;
  limits.deadline = std::chrono::steady_clock::now() + std::chrono::microseconds(1);
  const uint32_t groups[3] = {kGroups, 1, 1};
  ASSERT_TRUE(dispatch(pool, **program, resources, groups, &limits));
  EXPECT_TRUE(limits.expired);
  EXPECT_EQ(words.back(), 0u);
}

}  // namespace
}  // namespace lapilli
