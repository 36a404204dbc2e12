// Every lane op in every form on every SIMD target, against the scalar reference, on edge values.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <random>
#include <set>

#include "shader/interpreter/op_reference.h"
#include "shader/interpreter/test_frame.h"

namespace lapilli {
namespace {

using Lanes = std::array<uint32_t, kBatchLanes>;

struct Inputs {
  Lanes operands[3];
};

// All pairs of edge values in a and b; c runs through all of them too, and random ones.
const std::vector<Inputs>& inputs() {
  static const std::vector<Inputs> all = [] {
    const std::span<const uint32_t> edges = edge_values();
    std::mt19937 random(1);
    std::vector<Inputs> batches;
    size_t lane = kBatchLanes;
    const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
      if (lane == kBatchLanes) {
        batches.emplace_back();
        lane = 0;
      }
      const uint32_t values[] = {a, b, c};
      for (size_t k = 0; k < 3; ++k) batches.back().operands[k][lane] = values[k];
      ++lane;
    };
    for (uint32_t a : edges) {
      for (uint32_t b : edges) add(a, b, edges[random() % edges.size()]);
    }
    for (int i = 0; i < 4096; ++i)
      add(static_cast<uint32_t>(random()), static_cast<uint32_t>(random()), static_cast<uint32_t>(random()) % 33);
    // Numbers of similar size, for which sums cancel and products round.
    std::uniform_real_distribution<float> near(-4.0f, 4.0f);
    const auto some = [&] { return std::bit_cast<uint32_t>(near(random)); };
    for (int i = 0; i < 4096; ++i) add(some(), some(), some());
    for (; lane < kBatchLanes;) add(0, 0, 0);
    return batches;
  }();
  return all;
}

bool matches(const OpReference& reference, uint32_t got, uint32_t a, uint32_t b, uint32_t c) {
  if (reference.defined != nullptr && !reference.defined(a, b, c)) return true;
  // Signalling NaN do not come out of ops; as operands they only become quiet.
  if (reference.exact != nullptr) {
    const uint32_t expected = reference.exact(a, b, c);
    return got == expected || (reference.float_result && is_nan_bits(got) && is_nan_bits(expected));
  }
  const double expected = reference.real(std::bit_cast<float>(a), std::bit_cast<float>(b));
  const float value = std::bit_cast<float>(got);
  if (std::isnan(expected) || std::isnan(value)) return std::isnan(expected) && std::isnan(value);
  const float rounded = static_cast<float>(expected);
  if (std::isinf(rounded) || std::isinf(value)) {
    // Within the error of the largest float.
    return rounded == value || std::fabs(expected) > 0x1.fffff0p127;
  }
  const double unit = std::ldexp(1.0, std::max(rounded == 0 ? -126 : std::ilogb(rounded), -126) - 23);
  return std::fabs(expected - static_cast<double>(value)) <= reference.ulp * unit;
}

// The op's results for a batch, in one form. Operands that the form takes from the accumulator are garbage in memory.
void run_form(TestFrame& frame, Opcode op, uint32_t form, const Inputs& in, Lanes& result) {
  enum : uint16_t { kA, kB, kC, kPoison, kResult, kAgain };
  for (uint16_t k = 0; k < 3; ++k) frame.write(k, in.operands[k]);
  Lanes poison;
  poison.fill(0x7FC0DEAD);
  frame.write(kPoison, poison);
  frame.write(kResult, poison);
  Op test = {};
  test.dst = kResult;
  test.a = kA;
  test.b = kB;
  test.c = kC;
  const uint32_t source = form & 6;
  if (source != 0) {
    const uint16_t operand = static_cast<uint16_t>(source / 2 - 1);
    frame.add(Opcode::mov, kKeep, kPoison, operand);
    (operand == 0 ? test.a : operand == 1 ? test.b : test.c) = kPoison;
  }
  frame.add(op, form, test);
  frame.add(Opcode::mov, kAccumulatorIsA | kStore, kAgain, kPoison);
  frame.run();
  Lanes again;
  frame.read(kAgain, again);
  frame.read(kResult, result);
  if ((form & kStore) != 0) {
    EXPECT_EQ(again, result) << "the accumulator does not hold the result";
  } else {
    EXPECT_EQ(result, poison) << "a result that should be kept is stored";
    result = again;
  }
}

TEST(LaneOps, AllFormsMatchTheReferenceOnAllTargets) {
  for (const OpReference& reference : op_references()) {
    const char* const name = op_info(reference.op).name;
    std::vector<Lanes> first_results;
    for (SimdTarget target : supported_simd_targets()) {
      TestFrame frame(target);
      ASSERT_NE(find_handler(target, reference.op, kStore), nullptr) << name;
      for (uint32_t form = 0; form < kOnce; ++form) {
        if (find_handler(target, reference.op, form) == nullptr) continue;
        for (size_t batch = 0; batch < inputs().size(); ++batch) {
          const Inputs& in = inputs()[batch];
          Lanes result;
          run_form(frame, reference.op, form, in, result);
          if (first_results.size() == batch) first_results.push_back(result);
          for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
            const uint32_t a = in.operands[0][lane];
            const uint32_t b = in.operands[1][lane];
            const uint32_t c = in.operands[2][lane];
            const uint32_t other = first_results[batch][lane];
            const bool same =
                result[lane] == other || (reference.float_result && is_nan_bits(other) && is_nan_bits(result[lane]));
            ASSERT_TRUE(same && matches(reference, result[lane], a, b, c))
                << name << " form " << form << ' ' << simd_target_name(target) << std::hex << ": " << a << ' ' << b
                << ' ' << c << " gives " << result[lane] << ", the first target " << other;
          }
        }
      }
    }
  }
}

TEST(LaneOps, EveryPureOpHasAReference) {
  for (uint32_t i = 0; i < static_cast<uint32_t>(Opcode::kCount); ++i) {
    const Opcode op = static_cast<Opcode>(i);
    const OpInfo& info = op_info(op);
    if ((info.effects & ~static_cast<uint32_t>(kCommutes)) != kPure) continue;
    EXPECT_NE(find_reference(op), nullptr) << info.name;
    if ((info.effects & kCommutes) == 0 || find_reference(op) == nullptr || find_reference(op)->exact == nullptr)
      continue;
    for (uint32_t a : edge_values()) {
      for (uint32_t b : edge_values()) {
        const uint32_t ab = find_reference(op)->exact(a, b, 0x3F800000);
        const uint32_t ba = find_reference(op)->exact(b, a, 0x3F800000);
        EXPECT_TRUE(ab == ba || (is_nan_bits(ab) && is_nan_bits(ba))) << info.name << " does not commute";
      }
    }
  }
}

// What runs once per draw has the bits of what runs in lanes: each lane of a batch, once more as a scalar.
TEST(LaneOps, ScalarFormsHaveTheBitsOfTheLanes) {
  for (const OpReference& reference : op_references()) {
    const char* const name = op_info(reference.op).name;
    for (SimdTarget target : supported_simd_targets()) {
      const bool crosses_lanes = (op_info(reference.op).effects & kCrossLane) != 0;
      ASSERT_EQ(find_handler(target, reference.op, kOnce) == nullptr, crosses_lanes) << name;
      if (crosses_lanes) continue;
      TestFrame frame(target);
      for (size_t batch = 0; batch < inputs().size(); batch += 3) {
        const Inputs& in = inputs()[batch];
        Lanes lanes, scalars;
        run_form(frame, reference.op, kStore, in, lanes);
        for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
          std::array<uint32_t, 4> file;
          for (size_t k = 0; k < 3; ++k) file[k] = in.operands[k][lane];
          Op op = {};
          op.a = 0, op.b = 1, op.c = 2, op.dst = 3;
          frame.frame().scalars = file.data();
          frame.add(reference.op, kOnce, op);
          frame.run();
          scalars[lane] = file[3];
        }
        // Which of two NaN comes out is the compiler's choice; they are the same to all that follows.
        for (uint32_t lane = 0; reference.float_result && lane < kBatchLanes; ++lane) {
          if (is_nan_bits(lanes[lane]) && is_nan_bits(scalars[lane])) scalars[lane] = lanes[lane];
        }
        ASSERT_EQ(lanes, scalars) << name << ' ' << simd_target_name(target);
      }
    }
  }
}

// The choice of forms asks one target what all of them have.
TEST(Handlers, AllTargetsHaveTheSameForms) {
  for (uint32_t i = 0; i < static_cast<uint32_t>(Opcode::kCount); ++i) {
    const Opcode op = static_cast<Opcode>(i);
    for (SimdTarget target : supported_simd_targets()) {
      EXPECT_NE(find_handler(target, op, kStore), nullptr) << op_info(op).name << ' ' << simd_target_name(target);
      const bool scalar_pure = (op_info(op).effects & ~static_cast<uint32_t>(kCommutes)) == kPure;
      EXPECT_TRUE(!scalar_pure || find_handler(target, op, kOnce) != nullptr) << op_info(op).name;
      for (uint32_t form = 0; form < kFormCount; ++form) {
        EXPECT_EQ(find_handler(target, op, form) == nullptr, find_handler(SimdTarget::kBaseline, op, form) == nullptr)
            << op_info(op).name << ' ' << simd_target_name(target) << " form " << form;
      }
    }
  }
}

}  // namespace
}  // namespace lapilli
