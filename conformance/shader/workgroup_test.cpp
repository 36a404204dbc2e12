// Shared memory and barriers: workgroups that compute together. Specification: "Scope and Semantics" of SPIR-V.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "harness/compute.h"
#include "harness/devices.h"
#include "shaders/bitonic.comp.h"
#include "shaders/matrix_tiles.comp.h"
#include "shaders/scan.comp.h"
#include "shaders/shared_types.comp.h"
#include "shaders/sort_rounds.comp.h"
#include "shaders/stray_barriers.comp.h"

namespace lapilli::conformance {
namespace {

std::vector<uint32_t> random_words(size_t count, uint32_t seed, uint32_t below) {
  std::mt19937 random(seed);
  std::vector<uint32_t> words(count);
  for (uint32_t& word : words) word = static_cast<uint32_t>(random()) % below;
  return words;
}

TEST(Workgroup, SharedVariablesOfAllTypes) {
  constexpr uint32_t kGroups = 3, kSize = 130, kWords = 13;
  ComputeRun run;
  run.shader = shaders::kSharedTypesComp;
  run.buffers = {Bytes(kGroups * kSize * kWords * sizeof(float))};
  run.groups[0] = kGroups;
  const auto results = from_bytes<float>(run_compute(subject(), run)[0]);

  struct Part {
    float m[3][2], list[5];
    uint32_t words[3];
  };
  for (uint32_t group = 0; group < kGroups; ++group) {
    Part parts[7];
    float vectors[kSize][4];
    for (uint32_t n = 0; n < kSize; ++n) {
      for (uint32_t c = 0; c < 4; ++c) vectors[n][c] = float(c == 0 ? n : c == 1 ? 2 * n : c == 2 ? group : n ^ 5);
      vectors[n][n & 3] = 100;
    }
    for (uint32_t n = 0; n < 7; ++n) {
      for (uint32_t c = 0; c < 6; ++c) parts[n].m[c / 2][c % 2] = float(n + c);
      parts[n].m[n % 3][n & 1] = -1;
      for (uint32_t k = 0; k < 5; ++k) parts[n].list[k] = float(10 * n + k);
      for (uint32_t k = 0; k < 3; ++k) parts[n].words[k] = n + k;
    }
    for (uint32_t n = 0; n < kSize; ++n) {
      const Part& part = parts[n % 7];
      const Part& copied = parts[5];
      const float* const v = vectors[kSize - 1 - n];
      const float want[kWords] = {0,
                                  v[0],
                                  v[1],
                                  v[2],
                                  v[3],
                                  (kSize - 1 - n) % 3 == 0 ? 1.0f : 0.0f,
                                  part.m[n % 3][n & 1],
                                  part.list[n % 5],
                                  float(parts[(n + 3) % 7].words[n % 3]),
                                  n % 7 % 2 == 1 ? 1.0f : 0.0f,
                                  part.list[4] + part.m[2][1],
                                  copied.list[n % 5] + (n % 7 == 2 ? copied : part).list[4],
                                  vectors[n * 7 % kSize][n & 3]};
      // What is there at the start is Lapilli's promise only.
      for (uint32_t w = subject_is_lapilli() ? 0 : 1; w < kWords; ++w)
        ASSERT_EQ(results[(group * kSize + n) * kWords + w], want[w]) << group << ' ' << n << ' ' << w;
    }
  }
}

TEST(Workgroup, SumsWithBarriersInTheLoopOfAFunction) {
  for (const uint32_t size : {1024u, 1u, 2u, 63u, 64u, 65u, 129u, 1000u}) {
    constexpr uint32_t kGroups = 5;
    const std::vector<uint32_t> values = random_words(size * kGroups, size, 1000);
    const VkSpecializationMapEntry entry = {0, 0, 4};
    const VkSpecializationInfo specialization = {1, &entry, 4, &size};
    ComputeRun run;
    run.shader = shaders::kScanComp;
    run.buffers = {to_bytes(values), Bytes(values.size() * 4), Bytes(kGroups * 4)};
    run.groups[0] = kGroups;
    run.specialization = &specialization;
    const std::vector<Bytes> after = run_compute(subject(), run);
    const auto sums = from_bytes<uint32_t>(after[1]), totals = from_bytes<uint32_t>(after[2]);
    for (uint32_t group = 0; group < kGroups; ++group) {
      uint32_t sum = 0;
      for (uint32_t n = 0; n < size; ++n) {
        sum += values[group * size + n];
        ASSERT_EQ(sums[group * size + n], sum) << size << ' ' << n;
      }
      EXPECT_EQ(totals[group], sum) << size;
    }
  }
}

TEST(Workgroup, ProductOfMatricesByTiles) {
  constexpr uint32_t kSize = 96;
  for (const uint32_t tile : {16u, 4u, 8u, 32u}) {
    std::vector<float> a(kSize * kSize), b(kSize * kSize), want(kSize * kSize);
    const auto numbers = random_words(2 * kSize * kSize, tile, 100);  // sums stay exact
    std::copy_n(numbers.begin(), a.size(), a.begin());
    std::copy_n(numbers.begin() + std::ptrdiff_t(a.size()), b.size(), b.begin());
    for (uint32_t y = 0; y < kSize; ++y) {
      for (uint32_t x = 0; x < kSize; ++x) {
        for (uint32_t k = 0; k < kSize; ++k) want[y * kSize + x] += a[y * kSize + k] * b[k * kSize + x];
      }
    }
    const uint32_t sizes[2] = {tile, tile};
    const VkSpecializationMapEntry entries[2] = {{0, 0, 4}, {1, 4, 4}};
    const VkSpecializationInfo specialization = {2, entries, sizeof sizes, sizes};
    ComputeRun run;
    run.shader = shaders::kMatrixTilesComp;
    run.buffers = {to_bytes(a), to_bytes(b), Bytes(want.size() * 4)};
    run.groups[0] = run.groups[1] = kSize / tile;
    run.push_constants = to_bytes(std::vector<uint32_t>{kSize});
    run.specialization = &specialization;
    EXPECT_TRUE(from_bytes<float>(run_compute(subject(), run)[2]) == want) << tile;
  }
}

TEST(Workgroup, SortsWithBarriersInNestedLoops) {
  constexpr uint32_t kGroups = 7, kSize = 512;
  const auto words = random_words(kGroups * kSize, 1, 3000);
  std::vector<int32_t> values(words.begin(), words.end());
  for (int32_t& value : values) value -= 1500;
  ComputeRun run;
  run.shader = shaders::kBitonicComp;
  run.buffers = {to_bytes(values)};
  run.groups[0] = kGroups;
  const auto sorted = from_bytes<int32_t>(run_compute(subject(), run)[0]);
  for (auto first = values.begin(); first != values.end(); first += kSize) std::sort(first, first + kSize);
  EXPECT_TRUE(sorted == values);
}

// Each workgroup meets its barriers a number of times of its own.
TEST(Workgroup, LoopsThatSharedMemoryEnds) {
  constexpr uint32_t kGroups = 9, kSize = 200;
  auto values = random_words(kGroups * kSize, 2, 1000);
  std::vector<uint32_t> want_rounds;
  for (uint32_t group = 0; group < kGroups; ++group) {
    const auto first = values.begin() + group * kSize;
    if (group % 3 == 0) std::sort(first, first + kSize);  // nothing to do
    if (group % 3 == 1) std::sort(first, first + kSize, std::greater<>());
    std::vector<uint32_t> data(first, first + kSize);
    uint32_t rounds = 0;
    for (bool changed = true; changed; rounds += changed) {
      changed = false;
      for (uint32_t start : {0u, 1u}) {
        for (uint32_t low = start; low + 1 < kSize; low += 2) {
          if (data[low] <= data[low + 1]) continue;
          std::swap(data[low], data[low + 1]);
          changed = true;
        }
      }
    }
    want_rounds.push_back(rounds);
  }
  ComputeRun run;
  run.shader = shaders::kSortRoundsComp;
  run.buffers = {to_bytes(values), Bytes(kGroups * 4)};
  run.groups[0] = kGroups;
  const std::vector<Bytes> after = run_compute(subject(), run);
  for (auto first = values.begin(); first != values.end(); first += kSize) std::sort(first, first + kSize);
  EXPECT_TRUE(from_bytes<uint32_t>(after[0]) == values);
  EXPECT_EQ(from_bytes<uint32_t>(after[1]), want_rounds);
}

// Not valid, but what a driver should bear: invocations that returned before the barrier, a barrier in one side of a
// branch, another number of barriers in each invocation.
TEST(Workgroup, BarriersThatSomeNeverReach) {
  if (!subject_is_lapilli()) GTEST_SKIP() << "no shader may do this";
  for (const uint32_t kind : {0u, 1u, 2u}) {
    ComputeRun run;
    run.shader = shaders::kStrayBarriersComp;
    run.buffers = {Bytes(200 * 4)};
    run.push_constants = to_bytes(std::vector<uint32_t>{kind});
    const auto results = from_bytes<uint32_t>(run_compute(subject(), run)[0]);
    for (uint32_t n = 0; n < 200; ++n) EXPECT_EQ(results[n], kind == 0 && n >= 70 ? 0 : n + 1) << kind;
  }
}

}  // namespace
}  // namespace lapilli::conformance
