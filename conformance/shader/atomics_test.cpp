// Atomic operations of many invocations, threads and workgroups on the same words. Specification: SPIR-V, "Atomic
// Instructions".
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "harness/compute.h"
#include "harness/devices.h"
#include "shaders/atomics.comp.h"
#include "shaders/atomics_plain.comp.h"
#include "shaders/histogram.comp.h"
#include "shaders/robust_atomics.comp.h"

namespace lapilli::conformance {
namespace {

struct Words {
  uint32_t sum, low, high, all, any, odd, last, ticket;
  int32_t least, most;
  uint32_t up, loaded, guard;
};
constexpr Words kStart = {0, ~0u, 0, ~0u, 0, 0, 0, 0, INT32_MAX, INT32_MIN, 0, 0, 0x600D};

std::vector<uint32_t> random_words(size_t count, uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<uint32_t> words(count);
  for (uint32_t& word : words) word = static_cast<uint32_t>(random());
  return words;
}

TEST(Atomics, AllOperationsOnBuffersAndSharedMemory) {
  constexpr uint32_t kGroups = 200, kSize = 96;
  const std::vector<uint32_t> values = random_words(kGroups * kSize, 3);
  ComputeRun run;
  run.shader = shaders::kAtomicsComp;
  run.buffers = {to_bytes(values), to_bytes(std::vector<Words>(3, kStart)), Bytes(values.size() * 8)};
  run.groups[0] = kGroups;
  const std::vector<Bytes> after = run_compute(subject(), run);
  const auto words = from_bytes<Words>(after[1]);
  const auto tickets = from_bytes<uint32_t>(after[2]);

  Words want = kStart;
  std::vector<uint32_t> taken;
  for (uint32_t n = 0; n < values.size(); ++n) {
    if (n % 5 == 0) continue;
    const uint32_t value = values[n];
    want.sum += value;
    want.low = std::min(want.low, value);
    want.high = std::max(want.high, value);
    want.all &= value | 0xFF;
    want.any |= value & 0xFFFF00;
    want.odd ^= value;
    want.least = std::min(want.least, int32_t(value));
    want.most = std::max(want.most, int32_t(value));
    want.ticket += 1;
    want.up += 3;
    taken.push_back(tickets[2 * n]);
  }
  for (const Words& got : {words[0], words[1]}) {
    EXPECT_EQ(got.sum, want.sum);
    EXPECT_EQ(got.low, want.low);
    EXPECT_EQ(got.high, want.high);
    EXPECT_EQ(got.all, want.all);
    EXPECT_EQ(got.any, want.any);
    EXPECT_EQ(got.odd, want.odd);
    EXPECT_EQ(got.least, want.least);
    EXPECT_EQ(got.most, want.most);
    EXPECT_EQ(got.ticket, want.ticket);
    EXPECT_EQ(got.up, want.up);
    EXPECT_EQ(got.guard, kStart.guard);
  }
  EXPECT_NE(std::find(values.begin(), values.end(), words[0].last), values.end());
  EXPECT_EQ(words[1].last, 0u);
  // Each invocation drew a number of its own.
  std::sort(taken.begin(), taken.end());
  for (uint32_t i = 0; i < taken.size(); ++i) ASSERT_EQ(taken[i], i);
  for (uint32_t group = 0; group < kGroups; ++group) {
    taken.clear();
    for (uint32_t n = group * kSize; n < (group + 1) * kSize; ++n) {
      if (n % 5 != 0) taken.push_back(tickets[2 * n + 1]);
    }
    // Within a workgroup Lapilli's lanes go one after the other.
    if (!subject_is_lapilli()) std::sort(taken.begin(), taken.end());
    for (uint32_t i = 0; i < taken.size(); ++i) ASSERT_EQ(taken[i], i) << group;
  }
}

TEST(Atomics, InstructionsThatGlslDoesNotHave) {
  constexpr uint32_t kGroups = 50, kSize = 100, kCount = kGroups * kSize;
  ComputeRun run;
  run.shader = shaders::kAtomicsPlainComp;
  run.buffers = {to_bytes(std::vector<uint32_t>{5, 6, 7, 1000, 3, 0, 0, 0})};
  run.groups[0] = kGroups;
  const auto words = from_bytes<uint32_t>(run_compute(subject(), run)[0]);
  EXPECT_EQ(words[0], 5 + kCount);
  EXPECT_EQ(words[1], 6 - kCount);
  EXPECT_EQ(words[2], 7 - kGroups * (kSize * (kSize - 1) / 2));
  EXPECT_LT(words[3], kSize);
  EXPECT_EQ(words[4], 3u);
  EXPECT_EQ(words[5], 3 * kCount);
  EXPECT_EQ(words[6], kSize);
}

TEST(Atomics, Histogram) {
  constexpr uint32_t kGroups = 100;
  std::vector<uint32_t> values = random_words(kGroups * 16 * 256, 4);
  for (size_t i = 0; i < values.size() / 2; ++i) values[i] &= 7;  // many on few words
  std::vector<uint32_t> want(64, 1000);
  for (const uint32_t value : values) ++want[value & 63];
  ComputeRun run;
  run.shader = shaders::kHistogramComp;
  run.buffers = {to_bytes(values), to_bytes(std::vector<uint32_t>(64, 1000))};
  run.groups[0] = kGroups;
  EXPECT_EQ(from_bytes<uint32_t>(run_compute(subject(), run)[1]), want);
}

TEST(Atomics, AreBounded) {
  if (!subject_is_lapilli()) GTEST_SKIP() << "other drivers need robustBufferAccess for this";
  for (const uint32_t index : {0u, 1u, 63u, 64u, 100u, 1u << 20, 0x3FFFFFFFu, 0x40000000u, ~0u}) {
    ComputeRun run;
    run.shader = shaders::kRobustAtomicsComp;
    run.buffers = {to_bytes(std::vector<uint32_t>(64, 7)), Bytes(128 * 4)};
    run.push_constants = to_bytes(std::vector<uint32_t>{index});
    const std::vector<Bytes> after = run_compute(subject(), run);
    const auto values = from_bytes<uint32_t>(after[0]), results = from_bytes<uint32_t>(after[1]);
    std::vector<uint32_t> want(64, 7), local(64, 77), old(64), local_old(64);
    for (uint32_t n = 0; n < 64; ++n) {
      const uint32_t at = (index + n) & 0x3FFFFFFF;  // the address in bytes wraps around
      if (at >= 64) continue;
      old[n] = 7;
      local_old[n] = 77;
      want[at] = 12;
      local[at] = 77 | 0x100;
    }
    EXPECT_EQ(values, want) << index;
    for (uint32_t n = 0; n < 64; ++n) {
      EXPECT_EQ(results[n], old[n]) << index;
      EXPECT_EQ(results[64 + n], local_old[n] + 0x20000 + 0x1000000 * local[n]) << index;
    }
  }
}

}  // namespace
}  // namespace lapilli::conformance
