// What each pass does and what it must not do.
#include "shader/passes/passes.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <string>

#include "base/removals.h"
#include "shader/fixed_function.h"
#include "shader/program.h"

namespace lapilli {
namespace {

uint32_t count(const Code& code, Opcode op) {
  uint32_t n = 0;
  for (const Instruction& instruction : code.instructions) n += instruction.op == op ? 1 : 0;
  return n;
}

void output(Code& code, Reg reg, uint32_t slot = 0) {
  code.output_slots = std::max(code.output_slots, slot + 1);
  code.emit_void(Opcode::store_output, reg, kNoReg, kNoReg, slot);
}

constexpr uint32_t kUniforms = 1u << static_cast<uint32_t>(Removal::uniforms);

// Each pass shows what it made of the program.
TEST(Passes, Dump) {
  Code code;
  output(code, code.emit(Opcode::fadd, code.constant_f(1), code.constant_f(2)));
  code.emit_void(Opcode::end);
  set_dump_passes(true);
  testing::internal::CaptureStderr();
  EXPECT_TRUE(assemble(std::move(code)).ok());
  const std::string text = testing::internal::GetCapturedStderr();
  set_dump_passes(false);
  size_t at = 0;
  for (const char* when : {"lowered", "flatten", "simplify", "dead code", "once", "schedule", "program"}) {
    at = text.find(std::string("--- ") + when + "\n", at);
    ASSERT_NE(at, std::string::npos) << when;
  }
  EXPECT_NE(text.find("fadd"), std::string::npos);
  EXPECT_EQ(text.find("fadd", at), std::string::npos);
}

// Push constants stand for values of any kind here; but for the tests of Once they stay in lanes.
Code finished(Code code, bool split = false) {
  code.emit_void(Opcode::end);
  EXPECT_EQ(verify(code), "") << disassemble(code);
  set_kept_removals(split ? 0 : kUniforms);
  optimize(code, simd_target());
  set_kept_removals(0);
  EXPECT_EQ(verify(code), "") << disassemble(code);
  return code;
}

Reg push(Code& code, uint32_t word = 0) {
  return code.emit_n(Opcode::load_push, 1, kNoReg, kNoReg, kNoReg, 0, 4 * word);
}

TEST(Simplify, FoldsConstants) {
  Code code;
  const Reg sum = code.emit(Opcode::fadd, code.constant_f(1.5f), code.constant_f(2.0f));
  const Reg root = code.emit(Opcode::fsqrt, code.emit(Opcode::mov, sum));
  output(code, code.emit(Opcode::select, code.emit(Opcode::flt, root, code.constant_f(2)), root, sum));
  code = finished(std::move(code));
  ASSERT_EQ(code.instructions.size(), 2u) << disassemble(code);
  const RegInfo& result = code.registers[code.instructions[0].a];
  EXPECT_EQ(result.kind, RegKind::constant);
  EXPECT_EQ(std::bit_cast<float>(result.bits), std::sqrt(3.5f));
}

TEST(Simplify, KeepsWhatIsNotNeutral) {
  Code code;
  const Reg x = push(code);
  // x + 0 is not x for x = -0, x * 0 not 0 for an infinity.
  output(code, code.emit(Opcode::fadd, x, code.constant_f(0)), 0);
  output(code, code.emit(Opcode::fmul, x, code.constant_f(0)), 1);
  output(code, code.emit(Opcode::fmul, code.constant_f(1), x), 2);
  output(code, code.emit(Opcode::fadd, x, code.constant_f(-0.0f)), 3);
  output(code, code.emit(Opcode::fsub, x, code.constant_f(0)), 4);
  output(code, code.emit(Opcode::iadd, x, code.constant(0)), 5);
  code = finished(std::move(code));
  EXPECT_EQ(count(code, Opcode::fadd), 1u);
  EXPECT_EQ(count(code, Opcode::fmul), 1u);
  EXPECT_EQ(count(code, Opcode::fsub) + count(code, Opcode::iadd), 0u);
}

TEST(Simplify, SharesCommonSubexpressions) {
  Code code;
  code.add_resource({});
  const Reg x = push(code), y = push(code, 1);
  output(code, code.emit(Opcode::fmul, code.emit(Opcode::fadd, x, y), code.emit(Opcode::fadd, y, push(code))), 0);
  // Subtraction does not commute.
  output(code, code.emit(Opcode::fadd, code.emit(Opcode::fsub, x, y), code.emit(Opcode::fsub, y, x)), 1);
  code = finished(std::move(code));
  EXPECT_EQ(count(code, Opcode::fadd), 2u) << disassemble(code);
  EXPECT_EQ(count(code, Opcode::fsub), 2u);
  EXPECT_EQ(count(code, Opcode::load_push), 2u);
}

TEST(Simplify, DoesNotMergeLoadsAcrossAStore) {
  for (bool store : {false, true}) {
    Code code;
    code.add_resource({});
    const Reg address = push(code);
    const Reg before = code.emit_n(Opcode::load_buffer, 1, address);
    if (store) code.emit_void(Opcode::store_buffer, address, code.constant(7));
    output(code, code.emit(Opcode::iadd, before, code.emit_n(Opcode::load_buffer, 1, address)));
    code = finished(std::move(code));
    EXPECT_EQ(count(code, Opcode::load_buffer), store ? 2u : 1u);
  }
}

TEST(Simplify, ReadsOfVariablesSeeTheirWrites) {
  Code code;
  const Reg variable = code.new_variable();
  const Reg x = push(code), y = push(code, 1);
  code.emit_to(Opcode::mov, variable, x);
  const Reg first = code.emit(Opcode::mov, variable);
  code.emit_to(Opcode::mov, variable, y);
  const Reg second = code.emit(Opcode::mov, variable);
  output(code, code.emit(Opcode::fsub, first, second));
  code = finished(std::move(code));
  // The first read has to stay a copy: the variable is overwritten before the use.
  const Instruction& sub = code.instructions[code.instructions.size() - 3];
  ASSERT_EQ(sub.op, Opcode::fsub) << disassemble(code);
  EXPECT_NE(sub.a, variable);
}

TEST(Once, SaysWhereABlendedColorIsTheSame) {
  for (uint32_t varying = 0; varying < 4; ++varying) {
    Code code;
    code.stage = VK_SHADER_STAGE_FRAGMENT_BIT;
    code.color_formats = {VK_FORMAT_R8G8B8A8_UNORM};
    Reg color[4] = {push(code), code.constant_f(0.5f), push(code, 2), push(code, 3)};
    color[varying] = code.emit_n(Opcode::interpolate_perspective, 1);
    Instruction& blend = code.append(Opcode::blend_color);
    blend.imm2 = 15;
    code.set_list(blend, color);
    code = finished(std::move(code), true);
    const Instruction& found = code.instructions[code.instructions.size() - 2];
    ASSERT_EQ(found.op, Opcode::blend_color) << disassemble(code);
    EXPECT_EQ(found.imm2, varying == 3 ? 15 | kBlendSameColor : 15u);
  }
}

TEST(Simplify, DropsOverwrittenStores) {
  Code code;
  const Reg variable = code.new_variable();
  code.emit_to(Opcode::mov, variable, code.constant(1));
  code.emit_to(Opcode::mov, variable, push(code));
  code.emit_set(variable, push(code, 1));
  output(code, variable);
  code = finished(std::move(code));
  EXPECT_EQ(count(code, Opcode::mov), 1u) << disassemble(code);
  EXPECT_EQ(count(code, Opcode::set), 1u);
}

TEST(Simplify, DecidesConstantBranches) {
  Code code;
  const uint32_t yes = code.new_mask(), no = code.new_mask();
  code.emit_void(Opcode::branch_if, code.emit(Opcode::ieq, code.constant(1), code.constant(2)), kNoReg, kNoReg, yes,
                 no);
  code = finished(std::move(code));
  ASSERT_EQ(code.instructions[0].op, Opcode::branch);
  EXPECT_EQ(code.instructions[0].imm, no);
}

// if (lane_index < 7) v = f(lane_index) else v = 3; by way of a block that nothing else leads to. RandomPrograms
// compares what becomes of such programs.
Code short_if(Opcode f, bool stores = false) {
  Code code;
  code.add_resource({});
  const Reg lane = code.emit(Opcode::builtin, kNoReg, kNoReg, kNoReg, static_cast<uint32_t>(BuiltIn::lane_index));
  const Reg v = code.new_variable();
  const uint32_t next = code.new_mask(), yes = code.new_mask(), no = code.new_mask(), both = code.new_mask();
  uint32_t behind = code.new_label();
  const auto enter = [&](uint32_t mask) {
    code.place_label(behind);
    behind = code.new_label();
    code.emit_void(Opcode::enter, kNoReg, kNoReg, kNoReg, mask, behind);
  };
  code.emit_void(Opcode::branch, kNoReg, kNoReg, kNoReg, next);
  enter(next);
  code.emit_void(Opcode::branch_if, code.emit(Opcode::ult, lane, code.constant(7)), kNoReg, kNoReg, yes, no);
  enter(yes);
  if (stores) code.emit_void(Opcode::store_buffer, lane, lane);
  code.emit_set(v, code.emit(f, lane));
  code.emit_void(Opcode::branch, kNoReg, kNoReg, kNoReg, both);
  enter(no);
  code.emit_set(v, code.constant(3));
  code.emit_void(Opcode::branch, kNoReg, kNoReg, kNoReg, both);
  enter(both);
  output(code, v);
  code.place_label(behind);
  return code;
}

TEST(Flatten, ChoosesFromTheSidesOfAShortIf) {
  const Code code = finished(short_if(Opcode::bit_count));
  EXPECT_EQ(count(code, Opcode::enter) + count(code, Opcode::branch) + count(code, Opcode::branch_if), 0u)
      << disassemble(code);
  EXPECT_EQ(count(code, Opcode::select), 1u);
}

TEST(Flatten, LeavesWhatIsDearOrHasEffects) {
  for (const Code& code : {finished(short_if(Opcode::fasinh)), finished(short_if(Opcode::bit_count, true))}) {
    EXPECT_EQ(count(code, Opcode::branch_if), 1u);
    EXPECT_EQ(count(code, Opcode::enter), 3u) << disassemble(code);  // not of the block that simply comes next
    EXPECT_EQ(count(code, Opcode::select), 0u);
  }
}

TEST(DeadCode, RemovesAndTrims) {
  Code code;
  const Reg l1 = push(code), l2 = push(code, 1);
  const Reg varying = code.emit_n(Opcode::interpolate, 4, l1, l2, kNoReg, 8);
  code.emit(Opcode::fsin, varying);
  const Reg counter = code.new_variable();  // only counts itself
  code.emit_to(Opcode::mov, counter, code.constant(0));
  code.emit_set(counter, code.emit(Opcode::iadd, counter, code.constant(1)));
  const uint32_t array = code.new_array(4);  // never read
  code.emit_void(Opcode::store_array, l1, l2, kNoReg, array);
  output(code, code.emit(Opcode::fadd, varying + 1, varying + 2));
  code = finished(std::move(code));
  EXPECT_EQ(count(code, Opcode::fsin) + count(code, Opcode::set) + count(code, Opcode::mov) +
                count(code, Opcode::store_array),
            0u)
      << disassemble(code);
  for (const Instruction& instruction : code.instructions) {
    if (instruction.op != Opcode::interpolate) continue;
    EXPECT_EQ(instruction.results, 2);
    EXPECT_EQ(instruction.imm, 9u);
    EXPECT_EQ(instruction.dst, varying + 1);
  }
}

TEST(DeadCode, KeepsArraysThatAreRead) {
  Code code;
  const uint32_t array = code.new_array(2);
  const Reg index = push(code);
  code.emit_to(Opcode::mov, code.arrays[array].first + 1, push(code, 1));
  code.emit_void(Opcode::store_array, index, push(code, 2), kNoReg, array);
  output(code, code.emit(Opcode::load_array, index, kNoReg, kNoReg, array));
  code = finished(std::move(code));
  EXPECT_EQ(count(code, Opcode::store_array), 1u);
  EXPECT_EQ(count(code, Opcode::mov), 1u);
}

// --- Once -------------------------------------------------------------------------------------------------------

Reg lane_index(Code& code) {
  return code.emit(Opcode::builtin, kNoReg, kNoReg, kNoReg, static_cast<uint32_t>(BuiltIn::lane_index));
}
uint32_t count_once(const Code& code, Opcode op) {
  uint32_t n = 0;
  for (const Instruction& instruction : code.once) n += instruction.op == op ? 1 : 0;
  return n;
}

TEST(Once, TakesWhatDependsOnNoLane) {
  Code code;
  const Reg same = code.emit(Opcode::fsin, code.emit(Opcode::fmul, push(code), push(code, 1)));
  const Reg other = code.emit(Opcode::s_to_f, lane_index(code));
  output(code, code.emit(Opcode::fadd, same, other));
  code = finished(std::move(code), true);
  EXPECT_EQ(count_once(code, Opcode::load_push) + count_once(code, Opcode::fmul) + count_once(code, Opcode::fsin), 4u);
  EXPECT_EQ(code.once.size(), 4u) << disassemble(code);
  EXPECT_EQ(code.instructions.size(), 5u) << disassemble(code);  // builtin, s_to_f, fadd, store_output, end
}

TEST(Once, LeavesVariablesAndDifferencesOfLanes) {
  Code code;
  const Reg variable = code.new_variable();
  code.emit_to(Opcode::mov, variable, push(code));
  code.emit_set(variable, push(code, 1));
  output(code, code.emit(Opcode::fneg, variable));
  output(code, code.emit(Opcode::ddx_fine, push(code, 2)), 1);
  code = finished(std::move(code), true);
  EXPECT_EQ(code.once.size(), count_once(code, Opcode::load_push)) << disassemble(code);
  EXPECT_EQ(count(code, Opcode::fneg) + count(code, Opcode::ddx_fine), 2u);
}

// A branch that only some lanes take, with a load and arithmetic in it.
Code with_branch(bool stores, bool uniform_block, bool derivative) {
  Code code;
  ResourceRef ref;
  ref.uniform = uniform_block;
  code.add_resource(ref);
  const uint32_t mask = code.new_mask(), behind = code.new_mask();
  const uint32_t skip = code.new_label(), end = code.new_label();
  const Reg lane = lane_index(code), address = push(code);
  const Reg variable = code.new_variable();
  code.emit_to(Opcode::mov, variable, lane);
  code.emit_void(Opcode::branch_if, code.emit(Opcode::slt, lane, address), kNoReg, kNoReg, mask, behind);
  code.emit_void(Opcode::enter, kNoReg, kNoReg, kNoReg, mask, skip);
  const Reg loaded = code.emit_n(Opcode::load_buffer, 1, address);
  code.emit_set(variable, code.emit(Opcode::iadd, loaded, code.emit(Opcode::imul, address, address)));
  code.emit_void(Opcode::branch, kNoReg, kNoReg, kNoReg, behind);
  code.place_label(skip);
  code.emit_void(Opcode::enter, kNoReg, kNoReg, kNoReg, behind, end);
  output(code, code.emit(Opcode::imul, address, address), 1);
  if (stores) code.emit_void(Opcode::store_buffer, lane, variable);
  output(code, derivative ? code.emit(Opcode::ddx_fine, variable) : variable);
  code.place_label(end);
  return finished(std::move(code), true);
}

TEST(Once, TakesWhatIsPureOutOfBranches) {
  const Code code = with_branch(false, false, false);
  EXPECT_EQ(count_once(code, Opcode::load_buffer), 1u) << disassemble(code);
  EXPECT_EQ(count_once(code, Opcode::imul), 1u) << disassemble(code);  // once for both of its places
  EXPECT_EQ(count(code, Opcode::imul) + count(code, Opcode::iadd), 0u);
}

TEST(Once, LeavesLoadsOfWhatMayChange) {
  EXPECT_EQ(count_once(with_branch(true, false, false), Opcode::load_buffer), 0u);
  EXPECT_EQ(count_once(with_branch(true, true, false), Opcode::load_buffer), 1u);
}

// Idle lanes of a load in a branch read 0, and their neighbours may see it.
TEST(Once, LeavesLoadsInBranchesWhereLanesSeeOneAnother) {
  EXPECT_EQ(count_once(with_branch(false, true, true), Opcode::load_buffer), 0u);
}

TEST(Once, CostsAreThoseOfTheTable) {
  Code code;
  const Reg same = code.emit(Opcode::fsin, push(code));
  output(code, code.emit(Opcode::fadd, same, lane_index(code)));
  code.emit_void(Opcode::end);
  const Result<ProgramPtr> split = assemble(code);
  set_kept_removals(kUniforms);
  const Result<ProgramPtr> whole = assemble(code);
  set_kept_removals(0);
  ASSERT_TRUE(split.ok() && whole.ok());
  EXPECT_EQ(once_cost(**split), op_info(Opcode::load_push).cost + op_info(Opcode::fsin).cost);
  EXPECT_EQ(once_cost(**whole), 0u);
  EXPECT_EQ(lane_cost(**whole), once_cost(**split) + lane_cost(**split));
}

TEST(Schedule, ChainsNeedNoRegisters) {
  // Two polynomials, their terms interleaved as a compiler for vectors would emit them.
  Code code;
  const Reg x = push(code), y = push(code, 1);
  Reg p = x, q = y;
  for (int i = 0; i < 10; ++i) {
    p = code.emit(Opcode::fma, p, x, code.constant_f(static_cast<float>(i)));
    q = code.emit(Opcode::fma, q, y, code.constant_f(static_cast<float>(i) + 0.5f));
  }
  output(code, code.emit(Opcode::fsub, p, q));
  code.emit_void(Opcode::end);
  set_kept_removals(kUniforms);
  const Result<ProgramPtr> program = assemble(std::move(code));
  set_kept_removals(0);
  ASSERT_TRUE(program.ok());
  const std::string text = disassemble(**program);
  size_t kept = 0;
  for (size_t at = text.find("acc = "); at != std::string::npos; at = text.find("acc = ", at + 1)) ++kept;
  // Of 20 fma and a subtraction only one polynomial is stored.
  EXPECT_EQ(kept, 20u) << text;
}

TEST(Schedule, KeepsReadsBeforeWrites) {
  Code code;
  const Reg variable = code.new_variable();
  code.emit_to(Opcode::mov, variable, push(code));
  const Reg old = code.emit(Opcode::fneg, variable);
  code.emit_to(Opcode::mov, variable, push(code, 1));
  output(code, code.emit(Opcode::fadd, old, push(code, 2)), 0);
  output(code, variable, 1);
  code = finished(std::move(code));
  size_t read = 0, write = 0;
  for (size_t i = 0; i < code.instructions.size(); ++i) {
    if (code.instructions[i].op == Opcode::fneg) read = i;
    if (code.instructions[i].dst == variable) write = i;
  }
  EXPECT_LT(read, write) << disassemble(code);
}

// mov v; header: enter; x = a + b; set v x; branch_if; loop; use of v
TEST(Liveness, ExtendsOverLoops) {
  Code code;
  const uint32_t mask = code.new_mask(), exit_mask = code.new_mask();
  const uint32_t header = code.new_label(), back = code.new_label(), behind = code.new_label();
  const Reg outside = push(code);  // 0: used in the loop, by every iteration
  const Reg once = push(code, 1);  // 1: used before the loop only
  const Reg variable = code.new_variable();
  code.emit_to(Opcode::mov, variable, once);  // 2
  code.emit_void(Opcode::branch, kNoReg, kNoReg, kNoReg, mask);
  code.place_label(header);
  code.emit_void(Opcode::enter, kNoReg, kNoReg, kNoReg, mask, back);  // 4
  const Reg inner = code.emit(Opcode::iadd, outside, variable);       // 5
  code.emit_set(variable, inner);                                     // 6
  code.emit_void(Opcode::branch_if, inner, kNoReg, kNoReg, mask, exit_mask);
  code.place_label(back);
  code.emit_void(Opcode::loop, kNoReg, kNoReg, kNoReg, mask, header);  // 8
  code.emit_void(Opcode::enter, kNoReg, kNoReg, kNoReg, exit_mask, behind);
  output(code, variable);  // 10
  code.place_label(behind);
  code.emit_void(Opcode::end);
  ASSERT_EQ(verify(code), "");
  const std::vector<Interval> live = live_intervals(code);
  EXPECT_EQ(live[outside].first, 0u);
  EXPECT_EQ(live[outside].last, 8u);
  EXPECT_EQ(live[once].last, 2u);
  EXPECT_EQ(live[inner].first, 5u);
  EXPECT_EQ(live[inner].last, 7u);
  EXPECT_EQ(live[variable].first, 2u);
  EXPECT_EQ(live[variable].last, 10u);
}

TEST(Allocation, SharesRegistersThatAreNotLiveTogether) {
  Code code;
  code.add_resource({});
  Reg sum = push(code);
  for (uint32_t i = 0; i < 50; ++i) {
    const Reg loaded = code.emit_n(Opcode::load_uniform, 4, kNoReg, kNoReg, kNoReg, 0, 16 * i);
    sum = code.emit(Opcode::fadd, code.emit(Opcode::fmul, loaded, loaded + 3), sum);
  }
  output(code, sum);
  code.emit_void(Opcode::end);
  set_kept_removals(kUniforms);
  const Result<ProgramPtr> program = assemble(std::move(code));
  set_kept_removals(0);
  ASSERT_TRUE(program.ok());
  EXPECT_LE(register_count(**program), 8u) << disassemble(**program);
}

TEST(Allocation, RefusesTooManyRegisters) {
  Code code;
  for (int i = 0; i < 70; ++i) {
    const uint32_t array = code.new_array(1000);
    code.emit_to(Opcode::mov, code.arrays[array].first, code.constant(1));
    output(code, code.emit(Opcode::load_array, push(code), kNoReg, kNoReg, array));
  }
  for (uint32_t array = 0; array < 70; ++array)
    output(code, code.emit(Opcode::load_array, push(code), kNoReg, kNoReg, array));
  code.emit_void(Opcode::end);
  const Result<ProgramPtr> program = assemble(std::move(code));
  ASSERT_FALSE(program.ok());
  EXPECT_EQ(program.error().code, VK_ERROR_UNKNOWN);
}

}  // namespace
}  // namespace lapilli
