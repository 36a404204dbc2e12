// Random programs with nested ifs, loops, breaks, arrays and memory: what all passes made of them, on every SIMD
// target, against the plain evaluation of the program as it was. Bit for bit.
#include <gtest/gtest.h>

#include <bit>
#include <random>

#include "base/removals.h"
#include "base/simd_dispatch.h"
#include "shader/passes/evaluate.h"
#include "shader/program.h"

namespace lapilli {
namespace {

constexpr uint32_t kBufferWords = 96;  // not all addresses are inside
constexpr uint32_t kOutputs = 6;

class Generator {
 public:
  explicit Generator(uint32_t seed) : random_(seed) {}

  Code run() {
    code_.output_slots = kOutputs;
    code_.add_resource({});
    const Reg lane = code_.emit(Opcode::builtin, kNoReg, kNoReg, kNoReg, static_cast<uint32_t>(BuiltIn::lane_index));
    integers_.push_back(lane);
    floats_.push_back(code_.emit(Opcode::s_to_f, lane));
    for (uint32_t bits : {0u, 1u, 3u, 31u, 0x80000000u, 0xFFFFFFFFu}) integers_.push_back(code_.constant(bits));
    for (float value : {0.0f, -0.0f, 1.0f, -2.5f, 0.1f, 1e30f}) floats_.push_back(code_.constant_f(value));
    const uint32_t loaded = 1 + pick(4);
    const Reg push = code_.emit_n(Opcode::load_push, loaded, kNoReg, kNoReg, kNoReg, 0, 4 * pick(4));
    for (uint32_t k = 0; k < loaded; ++k) integers_.push_back(push + k);
    array_ = code_.new_array(3);
    for (uint32_t k = 0; k < 3; ++k) code_.emit_to(Opcode::mov, code_.arrays[array_].first + k, any_integer());
    for (uint32_t k = 0; k < kOutputs; ++k) {
      const Reg initial = any_integer();
      variables_.push_back(code_.new_variable());
      code_.emit_to(Opcode::mov, variables_.back(), initial);
    }
    statements(3, 3 + pick(8));
    for (uint32_t k = 0; k < kOutputs; ++k) code_.emit_void(Opcode::store_output, variables_[k], kNoReg, kNoReg, k);
    code_.emit_void(Opcode::end);
    return std::move(code_);
  }

 private:
  uint32_t pick(size_t count) { return static_cast<uint32_t>(random_() % count); }
  Reg any_integer() {
    return pick(6) == 0 && !variables_.empty()
               ? variables_[pick(variables_.size())]
               : integers_[integers_.size() - 1 - pick(std::min<size_t>(integers_.size(), 12))];
  }
  Reg any_float() { return floats_[floats_.size() - 1 - pick(std::min<size_t>(floats_.size(), 12))]; }

  // Registers that hold floats and integers are kept apart: which of two NaN an op returns is no part of its meaning.
  void expression() {
    static constexpr Opcode kFloat1[] = {Opcode::fneg,  Opcode::fabs,   Opcode::ffloor,
                                         Opcode::fsqrt, Opcode::ffract, Opcode::mov};
    static constexpr Opcode kFloat2[] = {Opcode::fadd, Opcode::fadd, Opcode::fsub, Opcode::fmul,
                                         Opcode::fmul, Opcode::fdiv, Opcode::fmin, Opcode::fmax};
    static constexpr Opcode kCompare[] = {Opcode::flt, Opcode::fle, Opcode::feq, Opcode::funlt, Opcode::funne};
    static constexpr Opcode kInteger1[] = {Opcode::ineg, Opcode::inot, Opcode::bit_count, Opcode::mov, Opcode::iabs};
    static constexpr Opcode kInteger2[] = {Opcode::iadd, Opcode::isub, Opcode::imul, Opcode::iand, Opcode::ior,
                                           Opcode::ixor, Opcode::shl,  Opcode::shr,  Opcode::slt,  Opcode::ult,
                                           Opcode::ieq,  Opcode::umin, Opcode::udiv, Opcode::smod};
    switch (pick(12)) {
      case 0:
        return floats_.push_back(code_.emit(kFloat1[pick(std::size(kFloat1))], any_float()));
      case 1:
      case 2:
      case 3:
        return floats_.push_back(code_.emit(kFloat2[pick(std::size(kFloat2))], any_float(), any_float()));
      case 4:
        return floats_.push_back(code_.emit(Opcode::fma, any_float(), any_float(), any_float()));
      case 5:
        return floats_.push_back(code_.emit(Opcode::select, condition(), any_float(), any_float()));
      case 6:
        return integers_.push_back(code_.emit(kCompare[pick(std::size(kCompare))], any_float(), any_float()));
      case 7:
        return integers_.push_back(code_.emit(Opcode::canonical, any_float()));
      case 8:
        return floats_.push_back(code_.emit(pick(2) == 0 ? Opcode::s_to_f : Opcode::u_to_f, any_integer()));
      case 9:
        return integers_.push_back(code_.emit(kInteger1[pick(std::size(kInteger1))], any_integer()));
      default:
        return integers_.push_back(code_.emit(kInteger2[pick(std::size(kInteger2))], any_integer(), any_integer()));
    }
  }

  Reg condition() { return code_.emit(Opcode::ult, any_integer(), any_integer()); }

  void memory() {
    const Reg address = code_.emit(Opcode::iand, any_integer(), code_.constant(4 * 127));
    switch (pick(4)) {
      case 0: {
        const uint32_t count = 1 + pick(3);
        const Reg first = code_.emit_n(Opcode::load_buffer, count, address, kNoReg, kNoReg, 0, 4 * pick(3));
        for (uint32_t k = 0; k < count; ++k) integers_.push_back(first + k);
        return;
      }
      case 1: {  // each lane has its own word, so that the order of lanes plays no part
        const Reg own = code_.emit(Opcode::shl, integers_[0], code_.constant(2));
        code_.emit_void(Opcode::store_buffer, own, any_integer(), kNoReg, 0, 4 * pick(2) * 48);
        return;
      }
      case 2:
        integers_.push_back(code_.emit(Opcode::load_array, code_.emit(Opcode::iand, any_integer(), code_.constant(3)),
                                       kNoReg, kNoReg, array_));
        return;
      default:
        code_.emit_void(Opcode::store_array, code_.emit(Opcode::iand, any_integer(), code_.constant(3)), any_integer(),
                        kNoReg, array_);
        return;
    }
  }

  void assignment() {
    const Reg to = pick(5) == 0 ? code_.arrays[array_].first + pick(3) : variables_[pick(variables_.size())];
    code_.emit_set(to, any_integer());
  }

  void enter(uint32_t mask, uint32_t next) { code_.emit_void(Opcode::enter, kNoReg, kNoReg, kNoReg, mask, next); }

  void if_else(uint32_t depth) {
    const uint32_t then_mask = code_.new_mask(), else_mask = code_.new_mask(), merge_mask = code_.new_mask();
    const uint32_t else_label = code_.new_label(), merge_label = code_.new_label(), behind = code_.new_label();
    code_.emit_void(Opcode::branch_if, condition(), kNoReg, kNoReg, then_mask, else_mask);
    enter(then_mask, else_label);
    block(depth);
    code_.emit_void(Opcode::branch, kNoReg, kNoReg, kNoReg, merge_mask);
    code_.place_label(else_label);
    enter(else_mask, merge_label);
    if (pick(2) == 0) block(depth);
    code_.emit_void(Opcode::branch, kNoReg, kNoReg, kNoReg, merge_mask);
    code_.place_label(merge_label);
    enter(merge_mask, behind);
    code_.place_label(behind);
  }

  // for (i = 0; i < n; ++i) { …; if (c) break; …; if (d) continue; … }
  void loop(uint32_t depth) {
    const uint32_t header_mask = code_.new_mask(), next_mask = code_.new_mask(), exit_mask = code_.new_mask();
    const uint32_t header = code_.new_label(), back = code_.new_label(), behind = code_.new_label();
    const Reg i = code_.new_variable();
    code_.emit_set(i, code_.constant(0));
    code_.emit_void(Opcode::branch, kNoReg, kNoReg, kNoReg, header_mask);
    code_.place_label(header);
    enter(header_mask, back);
    const size_t integers = integers_.size(), floats = floats_.size();
    integers_.push_back(code_.emit(Opcode::mov, i));
    block(depth);
    leave_some(exit_mask);
    block(depth);
    leave_some(next_mask);
    block(depth);
    code_.emit_void(Opcode::branch, kNoReg, kNoReg, kNoReg, next_mask);
    enter(next_mask, back);
    const Reg next = code_.emit(Opcode::iadd, i, code_.constant(1));
    code_.emit_set(i, next);
    const Reg more = code_.emit(Opcode::ult, next, code_.emit(Opcode::umin, any_integer(), code_.constant(4)));
    code_.emit_void(Opcode::branch_if, more, kNoReg, kNoReg, header_mask, exit_mask);
    code_.place_label(back);
    code_.emit_void(Opcode::loop, kNoReg, kNoReg, kNoReg, header_mask, header);
    enter(exit_mask, behind);
    code_.place_label(behind);
    // What the loop defined is not used outside of it.
    integers_.resize(integers);
    floats_.resize(floats);
  }

  // Some lanes go to another block of the loop; the others go on.
  void leave_some(uint32_t target) {
    const uint32_t rest = code_.new_mask();
    code_.emit_void(Opcode::branch_if, condition(), kNoReg, kNoReg, target, rest);
    const uint32_t here = code_.new_label();
    enter(rest, here);
    code_.place_label(here);
    if (pick(3) != 0) return;
    const uint32_t behind = code_.new_label();
    code_.emit_void(Opcode::jump_if_none, kNoReg, kNoReg, kNoReg, behind);
    block(1);
    code_.place_label(behind);
  }

  void block(uint32_t depth) {
    const size_t integers = integers_.size(), floats = floats_.size();
    statements(depth - 1, 1 + pick(5));
    integers_.resize(integers);
    floats_.resize(floats);
  }

  void statements(uint32_t depth, uint32_t count) {
    for (uint32_t k = 0; k < count; ++k) {
      for (uint32_t e = pick(6); e > 0; --e) expression();
      const uint32_t kind = pick(8);
      if (kind == 0 && depth > 0) {
        if_else(depth);
      } else if (kind == 1 && depth > 0) {
        loop(depth);
      } else if (kind < 4) {
        memory();
      } else {
        assignment();
      }
    }
  }

  std::mt19937 random_;
  Code code_;
  std::vector<Reg> integers_, floats_;  // in scope
  std::vector<Reg> variables_;
  uint32_t array_ = 0;
};

void check_program(uint32_t seed) {
  const Code code = Generator(seed).run();
  ASSERT_EQ(verify(code), "") << seed << '\n' << disassemble(code);
  EvaluationInput input;
  std::mt19937 random(seed);
  if (seed % 3 == 0) input.lanes = random() | uint64_t{random()} << 32;
  input.push_constants.resize(256);
  for (uint32_t k = 0; k < 16; ++k) input.push_constants[4 * k] = static_cast<std::byte>(random());
  input.buffer.resize(4 * kBufferWords);
  for (std::byte& byte : input.buffer) byte = static_cast<std::byte>(random() % 5);
  const std::vector<std::byte> buffer = input.buffer;
  const std::vector<LaneValues> expected = evaluate(code, input);
  ASSERT_FALSE(expected.empty()) << seed;
  const SimdTarget before = simd_target();
  const std::vector<SimdTarget> targets = supported_simd_targets();
  for (size_t way = 0; way < 2 * targets.size(); ++way) {
    const SimdTarget target = targets[way / 2];
    ASSERT_TRUE(set_simd_target(target));
    set_kept_removals(way % 2 == 0 ? 0 : 1u << static_cast<uint32_t>(Removal::uniforms));
    Result<ProgramPtr> program = assemble(code);
    ASSERT_TRUE(program.ok()) << program.error().message;
    ASSERT_EQ(verify(source(**program)), "") << seed;
    std::vector<std::byte> written = buffer;
    Descriptor descriptor;
    descriptor.data = written.data();
    descriptor.size = descriptor.room = written.size();
    ResourceTable resources;
    resources.sets[0] = &descriptor;
    resources.push_constants = input.push_constants.data();
    resources.push_constant_bytes = static_cast<uint32_t>(input.push_constants.size());
    Execution execution;
    ASSERT_TRUE(execution.prepare(**program, resources, nullptr));
    alignas(64) float outputs[kOutputs][64] = {};
    VertexBatch batch = {};
    batch.outputs = outputs[0];
    execution.run_vertices(batch, input.lanes);
    for (uint32_t slot = 0; slot < kOutputs; ++slot) {
      for (uint32_t lane = 0; lane < 64; ++lane) {
        if ((input.lanes >> lane & 1) == 0) continue;
        ASSERT_EQ(std::bit_cast<uint32_t>(outputs[slot][lane]), expected[slot][lane])
            << "seed " << seed << " slot " << slot << " lane " << lane << ' ' << simd_target_name(target) << '\n'
            << disassemble(code) << "\n→\n"
            << disassemble(source(**program)) << '\n'
            << disassemble(**program);
      }
    }
    ASSERT_TRUE(written == input.buffer) << "memory differs, seed " << seed << '\n'
                                         << disassemble(code) << '\n'
                                         << disassemble(**program);
  }
  set_simd_target(before);
  set_kept_removals(0);
}

TEST(RandomPrograms, KeepTheirMeaning) {
  for (uint32_t seed = 1; seed <= 1000 && !::testing::Test::HasFatalFailure(); ++seed) check_program(seed);
}

}  // namespace
}  // namespace lapilli
