// Loops with a known number of rounds, run in the interpreter and compared with the same code in C++.
#include "shader/spirv/test/run_shader.h"
#include "shaders/unroll.comp.h"

namespace lapilli {
namespace {

constexpr uint32_t kInvocations = 256;

uint32_t up(uint32_t n, int rounds) {
  uint32_t sum = n;
  for (int i = 0; i < rounds; ++i) sum = sum * 3 + static_cast<uint32_t>(i);
  return sum;
}

uint32_t down(uint32_t n, int rounds) {
  uint32_t sum = n;
  for (int i = rounds; i > 0; --i) {
    const uint32_t number = static_cast<uint32_t>(i);
    if ((n & 7) == number) continue;
    sum += number * 10;
    if ((n & 15) == number + 8) break;
    if (sum > 150) return sum;
  }
  return sum + 1000;
}

uint32_t in_a_loop(uint32_t n, int rounds) {
  uint32_t sum = 0;
  for (uint32_t k = 0; k < (n & 31); ++k) {
    uint32_t last = k;
    for (uint32_t i = 1; i <= static_cast<uint32_t>(rounds); i += 2) {
      if (((k + n) & 3) == i) break;
      last = last * 5 + i;
    }
    sum ^= last;
  }
  return sum;
}

uint32_t bent_counter(uint32_t n, int rounds) {
  uint32_t sum = 0;
  for (int i = 0; i < rounds; ++i) {
    sum = sum * 7 + static_cast<uint32_t>(i) + n;
    if (i == 2) i -= static_cast<int>(n & 1) - 1;
    if (i == 3 && sum > 3000000) i = rounds;
    if (sum > 4000000000) break;
  }
  return sum;
}

TEST(SpirvUnroll, RoundsMatchScalarCode) {
  for (const int rounds : {0, 1, 3, 5, 8, 9, 30}) {
    ComputeRun run;
    uint32_t* results = run.buffer<uint32_t>(0, kInvocations * 4);
    run.specialization.push_back({0, static_cast<uint32_t>(rounds)});
    run.run(shaders::kUnrollComp, kInvocations / kBatchLanes);
    for (uint32_t n = 0; n < kInvocations; ++n) {
      const uint32_t* got = results + n * 4;
      EXPECT_EQ(got[0], up(n, rounds)) << n << ", rounds " << rounds;
      EXPECT_EQ(got[1], down(n, rounds)) << n << ", rounds " << rounds;
      EXPECT_EQ(got[2], in_a_loop(n, rounds)) << n << ", rounds " << rounds;
      EXPECT_EQ(got[3], bent_counter(n, rounds)) << n << ", rounds " << rounds;
    }
  }
}

// Of the program's five loops, one has an unknown number of rounds and one counts in its own way.
TEST(SpirvUnroll, LoopsOfFewRoundsAreGone) {
  const auto loops = [](uint32_t rounds) {
    const BindingSlot slot{0, 0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_COMPUTE_BIT, 0, 1, -1};
    const SpecializationEntry entry{0, rounds};
    const ShaderStage stage{parse_or_fail(shaders::kUnrollComp), "main", {&entry, 1}};
    const Result<Code> code = make_compute_code(stage, {{&slot, 1}, kMaxPushConstantBytes});
    EXPECT_TRUE(code.ok());
    return code.ok() ? std::count_if(code->instructions.begin(), code->instructions.end(),
                                     [](const Instruction& each) { return each.op == Opcode::loop; })
                     : -1;
  };
  EXPECT_EQ(loops(5), 2);
  EXPECT_EQ(loops(0), 1);
  EXPECT_EQ(loops(30), 5);
}

}  // namespace
}  // namespace lapilli
