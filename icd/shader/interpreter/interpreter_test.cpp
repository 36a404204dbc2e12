// Whole programs through assemble() and Execution, on every SIMD target.
#include <gtest/gtest.h>

#include "base/simd_dispatch.h"
#include "shader/program.h"

namespace lapilli {
namespace {

TEST(Interpreter, LoopsUnderDivergence) {
  for (SimdTarget target : supported_simd_targets()) {
    ASSERT_TRUE(set_simd_target(target));
    Code code;
    code.output_slots = 1;
    const uint32_t header_mask = code.new_mask();
    const uint32_t exit_mask = code.new_mask();
    const uint32_t header = code.new_label();
    const uint32_t back = code.new_label();
    const uint32_t end = code.new_label();
    const Reg lane = code.emit(Opcode::builtin, kNoReg, kNoReg, kNoReg, static_cast<uint32_t>(BuiltIn::lane_index));
    const Reg sum = code.new_variable();
    const Reg i = code.new_variable();
    code.emit_to(Opcode::mov, sum, code.constant(0));
    code.emit_to(Opcode::mov, i, code.constant(0));
    code.emit_void(Opcode::branch, kNoReg, kNoReg, kNoReg, header_mask);
    code.place_label(header);
    code.emit_void(Opcode::enter, kNoReg, kNoReg, kNoReg, header_mask, back);
    code.emit_set(sum, code.emit(Opcode::iadd, sum, i));
    code.emit_set(i, code.emit(Opcode::iadd, i, code.constant(1)));
    code.emit_void(Opcode::branch_if, code.emit(Opcode::ule, i, lane), kNoReg, kNoReg, header_mask, exit_mask);
    code.place_label(back);
    code.emit_void(Opcode::loop, kNoReg, kNoReg, kNoReg, header_mask, header);
    code.emit_void(Opcode::enter, kNoReg, kNoReg, kNoReg, exit_mask, end);
    code.emit_void(Opcode::store_output, sum, kNoReg, kNoReg, 0);
    code.place_label(end);
    code.emit_void(Opcode::end);
    ASSERT_EQ(verify(code), "");
    Result<ProgramPtr> program = assemble(code);
    ASSERT_TRUE(program.ok());
    Execution execution;
    ResourceTable resources;
    ASSERT_TRUE(execution.prepare(**program, resources, nullptr));
    alignas(64) uint32_t outputs[64] = {};
    VertexBatch batch = {};
    batch.outputs = reinterpret_cast<float*>(outputs);
    execution.run_vertices(batch, ~uint64_t{0});
    for (uint32_t l = 0; l < 64; ++l) EXPECT_EQ(outputs[l], l * (l + 1) / 2) << disassemble(**program);
  }
}

}  // namespace
}  // namespace lapilli
