// Tests of single ops: masks, control flow, quads; and that every op has a test.
#include <gtest/gtest.h>

#include <bit>
#include <chrono>
#include <random>
#include <set>
#include <string>

#include "shader/interpreter/op_reference.h"
#include "shader/interpreter/test_frame.h"
#include "shader/program.h"

namespace lapilli {
namespace {

using Lanes = std::array<uint32_t, kBatchLanes>;
constexpr uint64_t kSome = 0x8000F00FC3A50F31;

Op immediates(uint32_t imm, uint32_t imm2 = 0, uint16_t a = 0) {
  Op op = {};
  op.imm = imm;
  op.imm2 = imm2;
  op.a = a;
  return op;
}

class ControlFrame : public TestFrame {
 public:
  explicit ControlFrame(SimdTarget target) : TestFrame(target) { frame().masks = masks; }
  uint64_t masks[4] = {};
};

Lanes numbered(uint32_t first) {
  Lanes lanes;
  for (uint32_t i = 0; i < kBatchLanes; ++i) lanes[i] = first + i;
  return lanes;
}
Lanes from_bits(uint64_t bits) {
  Lanes lanes;
  for (uint32_t i = 0; i < kBatchLanes; ++i) lanes[i] = (bits >> i & 1) != 0 ? 0xFFFFFFFFu : 0;
  return lanes;
}

TEST(Op, set) {
  for (SimdTarget target : supported_simd_targets()) {
    for (uint32_t form : {uint32_t{kStore}, uint32_t{kStore | kAccumulatorIsA}}) {
      for (uint64_t exec : {uint64_t{0}, kSome, ~uint64_t{0}}) {
        ControlFrame test(target);
        test.frame().exec = exec;
        test.write(0, numbered(100));
        test.write(1, numbered(200));
        test.add(Opcode::mov, kKeep, 5, 0);
        test.add(Opcode::set, form, 1, static_cast<uint16_t>(form == kStore ? 0 : 7));
        test.add(Opcode::mov, kAccumulatorIsA | kStore, 2, 9);
        test.run();
        Lanes got, accumulator;
        test.read(1, got);
        test.read(2, accumulator);
        EXPECT_EQ(got, accumulator);
        for (uint32_t i = 0; i < kBatchLanes; ++i) EXPECT_EQ(got[i], ((exec >> i & 1) != 0 ? 100 : 200) + i);
      }
    }
  }
}

TEST(Op, branch) {
  for (SimdTarget target : supported_simd_targets()) {
    ControlFrame test(target);
    test.frame().exec = kSome;
    test.masks[2] = 6;
    test.add(Opcode::branch, kStore, immediates(2));
    test.run();
    EXPECT_EQ(test.masks[2], kSome | 6);
    EXPECT_EQ(test.frame().exec, kSome);
  }
}

// Also takes 1 for true, which is no boolean of ops.def but what a load may give.
void check_condition(Opcode op) {
  const uint64_t exec = 0x00FFFF00FF00FFFF;
  for (SimdTarget target : supported_simd_targets()) {
    for (bool from_accumulator : {false, true}) {
      ControlFrame test(target);
      test.frame().exec = exec;
      test.masks[1] = 1;
      Lanes condition = from_bits(kSome);
      condition[std::countr_zero(kSome)] = 1;
      test.write(0, condition);
      test.write(1, from_bits(~kSome));
      if (from_accumulator) test.add(Opcode::mov, kKeep, 5, 0);
      test.add(op, from_accumulator ? kAccumulatorIsA | kStore : kStore, immediates(1, 3, from_accumulator ? 1 : 0));
      test.run();
      EXPECT_EQ(test.masks[1], (exec & kSome) | 1);
      EXPECT_EQ(test.masks[3], op == Opcode::branch_if ? exec & ~kSome : 0);
    }
  }
}
TEST(Op, branch_if) { check_condition(Opcode::branch_if); }
TEST(Op, branch_where) { check_condition(Opcode::branch_where); }

// `op` jumps over an op that writes register 1, if it jumps.
bool jumps(ControlFrame& test, Opcode op, Op operands) {
  test.write(0, numbered(1));
  test.write(1, numbered(0));
  test.add(op, kStore, operands);
  test.add(Opcode::mov, kStore, 1, 0);
  test.run();
  Lanes got;
  test.read(1, got);
  return got[0] == 0;
}

TEST(Op, enter) {
  for (SimdTarget target : supported_simd_targets()) {
    ControlFrame test(target);
    EXPECT_TRUE(jumps(test, Opcode::enter, immediates(1, 2)));
    EXPECT_EQ(test.frame().exec, 0u);
    test.masks[1] = kSome;
    EXPECT_FALSE(jumps(test, Opcode::enter, immediates(1, 2)));
    EXPECT_EQ(test.frame().exec, kSome);
    EXPECT_EQ(test.masks[1], 0u);
  }
}

TEST(Op, jump_if_none) {
  for (SimdTarget target : supported_simd_targets()) {
    ControlFrame test(target);
    test.frame().exec = 0;
    EXPECT_TRUE(jumps(test, Opcode::jump_if_none, immediates(2)));
    test.frame().exec = kSome;
    EXPECT_FALSE(jumps(test, Opcode::jump_if_none, immediates(2)));
  }
}

TEST(Op, loop) {
  for (SimdTarget target : supported_simd_targets()) {
    ControlFrame test(target);
    test.frame().loop_budget = 10;
    EXPECT_FALSE(jumps(test, Opcode::loop, immediates(1, 2)));
    EXPECT_EQ(test.frame().loop_budget, 10u);
    test.masks[1] = kSome;
    EXPECT_TRUE(jumps(test, Opcode::loop, immediates(1, 2)));
    EXPECT_EQ(test.frame().loop_budget, 9u);
    EXPECT_EQ(test.masks[1], kSome);
  }
}

TEST(Op, kill) {
  for (SimdTarget target : supported_simd_targets()) {
    ControlFrame test(target);
    test.frame().exec = kSome;
    test.add(Opcode::kill, kStore, Op{});
    test.run();
    EXPECT_EQ(test.frame().exec, 0u);
    EXPECT_EQ(test.frame().write, ~kSome);
  }
}

TEST(Op, demote) {
  for (SimdTarget target : supported_simd_targets()) {
    for (bool from_accumulator : {false, true}) {
      ControlFrame test(target);
      test.frame().exec = 0x00FFFF00FF00FFFF;
      test.write(0, from_bits(kSome));
      test.write(1, from_bits(~kSome));
      if (from_accumulator) test.add(Opcode::mov, kKeep, 5, 0);
      test.add(Opcode::demote, from_accumulator ? kAccumulatorIsA | kStore : kStore,
               immediates(0, 0, from_accumulator ? 1 : 0));
      test.run();
      EXPECT_EQ(test.frame().exec, 0x00FFFF00FF00FFFFu);
      EXPECT_EQ(test.frame().write, ~(0x00FFFF00FF00FFFFu & kSome));
    }
  }
}

// Ends the run; the batch goes on behind it with the lanes and registers that it had.
TEST(Op, barrier) {
  for (SimdTarget target : supported_simd_targets()) {
    ControlFrame test(target);
    const Op last = {find_handler(target, Opcode::end, kStore), 0, 0, 0, 0, 0, 0};
    test.frame().last = &last;
    test.frame().exec = kSome;
    test.write(0, numbered(1));
    test.write(1, numbered(0));
    test.add(Opcode::barrier, kStore, Op{});
    test.add(Opcode::mov, kStore, 1, 0);
    Lanes got;
    test.run([&](const Op* first) {
      test.read(1, got);
      EXPECT_EQ(got, numbered(0));
      EXPECT_EQ(test.frame().exec, kSome);
      ASSERT_EQ(test.frame().resume, first + 1);
      interpreter_run(target)(test.frame().resume, &test.frame());
    });
    test.read(1, got);
    EXPECT_EQ(got, numbered(1));
  }
}

TEST(Op, end) {
  for (SimdTarget target : supported_simd_targets()) {
    ControlFrame test(target);
    test.write(0, numbered(1));
    test.write(1, numbered(0));
    test.add(Opcode::end, kStore, Op{});
    test.add(Opcode::mov, kStore, 1, 0);
    test.run();
    Lanes got;
    test.read(1, got);
    EXPECT_EQ(got, numbered(0));
  }
}

TEST(Op, store_output) {
  for (SimdTarget target : supported_simd_targets()) {
    for (bool from_accumulator : {false, true}) {
      ControlFrame test(target);
      alignas(64) uint32_t outputs[3][kBatchLanes] = {};
      VertexBatch batch = {};
      batch.outputs = reinterpret_cast<float*>(outputs[0]);
      test.frame().vertices = &batch;
      test.write(0, numbered(7));
      test.write(1, numbered(0));
      if (from_accumulator) test.add(Opcode::mov, kKeep, 5, 0);
      test.add(Opcode::store_output, from_accumulator ? kAccumulatorIsA | kStore : kStore,
               immediates(2, 0, from_accumulator ? 1 : 0));
      test.run();
      for (uint32_t i = 0; i < kBatchLanes; ++i) EXPECT_EQ(outputs[2][i], i + 7);
      EXPECT_EQ(outputs[1][63], 0u);
    }
  }
}

// right - left and lower - upper, of the values that quads have in `in`.
void check_derivative(Opcode op, bool in_x, bool fine) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> values(-10, 10);
  Lanes in;
  for (uint32_t& lane : in) lane = std::bit_cast<uint32_t>(values(random));
  const auto at = [&](uint32_t quad, uint32_t x, uint32_t y) { return std::bit_cast<float>(in[quad * 4 + y * 2 + x]); };
  for (SimdTarget target : supported_simd_targets()) {
    ControlFrame test(target);
    test.write(0, in);
    test.add(op, kStore, 1, 0);
    test.run();
    Lanes got;
    test.read(1, got);
    for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
      const uint32_t quad = lane / 4;
      const uint32_t x = fine ? lane & 1 : 0;
      const uint32_t y = fine ? lane >> 1 & 1 : 0;
      const float expected = in_x ? at(quad, 1, y) - at(quad, 0, y) : at(quad, x, 1) - at(quad, x, 0);
      EXPECT_EQ(got[lane], std::bit_cast<uint32_t>(expected)) << lane;
    }
  }
}
TEST(Op, ddx_fine) { check_derivative(Opcode::ddx_fine, true, true); }
TEST(Op, ddy_fine) { check_derivative(Opcode::ddy_fine, false, true); }
TEST(Op, ddx_coarse) { check_derivative(Opcode::ddx_coarse, true, false); }
TEST(Op, ddy_coarse) { check_derivative(Opcode::ddy_coarse, false, false); }

TEST(Interpreter, EndlessLoopEndsAtTheDeadline) {
  for (SimdTarget target : supported_simd_targets()) {
    ASSERT_TRUE(set_simd_target(target));
    Code code;
    const uint32_t mask = code.new_mask();
    const uint32_t header = code.new_label();
    const uint32_t back = code.new_label();
    code.emit_void(Opcode::branch, kNoReg, kNoReg, kNoReg, mask);
    code.place_label(header);
    code.emit_void(Opcode::enter, kNoReg, kNoReg, kNoReg, mask, back);
    code.emit_void(Opcode::branch, kNoReg, kNoReg, kNoReg, mask);
    code.place_label(back);
    code.emit_void(Opcode::loop, kNoReg, kNoReg, kNoReg, mask, header);
    code.emit_void(Opcode::end);
    ASSERT_EQ(verify(code), "");
    Result<ProgramPtr> program = assemble(std::move(code));
    ASSERT_TRUE(program.ok());
    ExecutionLimits limits;
    limits.deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(20);
    Execution execution;
    ResourceTable resources;
    ASSERT_TRUE(execution.prepare(**program, resources, &limits));
    const VertexBatch batch = {};
    execution.run_vertices(batch, ~uint64_t{0});
    EXPECT_TRUE(limits.expired.load());
    EXPECT_GE(std::chrono::steady_clock::now(), limits.deadline);
    execution.run_vertices(batch, ~uint64_t{0});  // ends at once
  }
  set_simd_target(best_simd_target());
}

// Lane ops have references (op_test.cpp); each other op has a test of its name in the suite Op.
TEST(Ops, EachHasATest) {
  std::set<std::string> tested;
  const ::testing::UnitTest& all = *::testing::UnitTest::GetInstance();
  for (int suite = 0; suite < all.total_test_suite_count(); ++suite) {
    const ::testing::TestSuite& tests = *all.GetTestSuite(suite);
    if (std::string(tests.name()) != "Op") continue;
    for (int i = 0; i < tests.total_test_count(); ++i) tested.insert(tests.GetTestInfo(i)->name());
  }
  for (uint32_t i = 0; i < static_cast<uint32_t>(Opcode::kCount); ++i) {
    const Opcode op = static_cast<Opcode>(i);
    const bool has_test = find_reference(op) != nullptr || tested.count(op_info(op).name) != 0;
    EXPECT_TRUE(has_test) << op_info(op).name << " has no test";
  }
}

}  // namespace
}  // namespace lapilli
