// Divergent control flow, run in the interpreter and compared with the same code in C++.
#include "shader/spirv/test/run_shader.h"
#include "shaders/control.comp.h"
#include "shaders/exits.comp.h"
#include "shaders/phis.comp.h"

namespace lapilli {
namespace {

constexpr uint32_t kInvocations = 256;

uint32_t early_return(uint32_t n) {
  for (uint32_t i = 0; i < 20; ++i) {
    if (i * i > n) return i;
    if ((n & 7) == 5) return 100 + i;
  }
  return 1000;
}

uint32_t nested(uint32_t n) {
  uint32_t sum = 0;
  for (uint32_t i = 0; i < (n & 15); ++i) {
    uint32_t j = 0;
    while (true) {
      if (j > i) break;
      ++j;
      if (((i + j) & 3) == 0) continue;
      sum += i * 10 + j;
      if (sum > 500) return sum;
    }
    if ((i & 1) == 1) continue;
    sum ^= j;
  }
  return sum;
}

uint32_t fall_through(uint32_t n) {
  uint32_t value = 1;
  switch (static_cast<int>(n % 9) - 2) {
    case -2:
      value = 20;
      break;
    case 0:
      value += 3;
      [[fallthrough]];
    case 1:
      value += 5;
      [[fallthrough]];
    case 2:
      value *= 7;
      break;
    default:
      value = 77;
      [[fallthrough]];
    case 3:
      value += 11;
      break;
    case 5:
      for (uint32_t i = 0; i < 4; ++i) {
        if (i == (n & 3)) break;
        value += 2;
      }
      return value;
  }
  return value + 1000;
}

uint32_t after_loop(uint32_t n) {
  uint32_t last = 7, square = 0, i = 0;
  do {
    square = i * i;
    last = square + n;
    ++i;
  } while (last % 13 != 0 && i < 40);
  uint32_t inner = square * 3;
  for (uint32_t k = 0; k < (n & 3); ++k) inner += last;
  return inner * 1000 + last + i;
}

void out_parameters(uint32_t n, uint32_t& a, uint32_t& b) {
  a = n + 1;
  if ((n & 1) == 0) {
    b += a;
    return;
  }
  a *= 2;
}

TEST(SpirvControl, DivergentLanesMatchScalarCode) {
  ComputeRun run;
  uint32_t* results = run.buffer<uint32_t>(0, kInvocations * 7);
  run.run(shaders::kControlComp, kInvocations / kBatchLanes);
  for (uint32_t n = 0; n < kInvocations; ++n) {
    const uint32_t* got = results + n * 7;
    EXPECT_EQ(got[0], early_return(n)) << n;
    EXPECT_EQ(got[1], nested(n)) << n;
    EXPECT_EQ(got[2], fall_through(n)) << n;
    EXPECT_EQ(got[3], after_loop(n)) << n;
    uint32_t a = 0, b = 5;
    for (uint32_t i = 0; i < 3; ++i) out_parameters(n + i * b, a, b);
    EXPECT_EQ(got[4], a * 65536 + b) << n;
    const bool taken = (n > 10 && (n & 4) != 0) || n == 3;
    EXPECT_EQ(got[5], (taken ? 1u : 2u) + ((n > 5) == (n < 50) ? 10u : 20u)) << n;
    EXPECT_EQ(got[6], n % 3 == 1 ? 0 : n) << n;
  }
}

TEST(SpirvControl, PhisMatchScalarCode) {
  ComputeRun run;
  uint32_t* results = run.buffer<uint32_t>(0, kInvocations * 5);
  run.run(shaders::kPhisComp, kInvocations / kBatchLanes);
  for (uint32_t n = 0; n < kInvocations; ++n) {
    uint32_t a = 1, b = 2, i = 0, ab = 0;
    for (;; ++i, std::swap(a, b)) {
      ab = a * (i + 1);
      if (i >= (n & 7)) break;
    }
    const uint32_t packed = (a * 5 + b) * 5 + ab + i * 7;
    const uint32_t picked = (n & 3) == 0 ? 7 : (n & 3) == 1 ? n : n + n;
    const uint32_t vector[4] = {packed, picked, 0, n};
    const uint32_t* got = results + n * 5;
    EXPECT_EQ(got[0], packed) << n;
    EXPECT_EQ(got[1], picked) << n;
    EXPECT_EQ(got[2], vector[n & 3]) << n;
    EXPECT_EQ(got[3], (n & 3) == 2 ? 5u : 0u) << n;
    EXPECT_EQ(got[4], vector[n & 3]) << n;
  }
}

TEST(SpirvControl, PhisOfWhatALoopHandsOut) {
  ComputeRun run;
  const uint32_t* const results = run.buffer<uint32_t>(0, kInvocations);
  run.run(shaders::kExitsComp, kInvocations / kBatchLanes);
  for (uint32_t n = 0; n < kInvocations; ++n) EXPECT_EQ(results[n], 2 * (n & 7) * (n & 7)) << n;
}

}  // namespace
}  // namespace lapilli
