// Garbage in: every truncation of real modules, and thousands of random changes to them, end in a module or an error.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include <gtest/gtest.h>

#include "shader/spirv/test/try_module.h"
#include "shaders/atomics.comp.h"
#include "shaders/control.comp.h"
#include "shaders/distances.frag.h"
#include "shaders/empty.comp.h"
#include "shaders/functions.comp.h"
#include "shaders/image_atomics.frag.h"
#include "shaders/interface.frag.h"
#include "shaders/interface.vert.h"
#include "shaders/interpolate_at.frag.h"
#include "shaders/memory.comp.h"
#include "shaders/phis.comp.h"
#include "shaders/shared_types.comp.h"
#include "shaders/some_distances.vert.h"
#include "shaders/special.comp.h"
#include "shaders/texture.frag.h"
#include "shaders/two_coords.frag.h"

namespace lapilli {
namespace {

const std::span<const uint32_t> kSamples[] = {
    shaders::kAtomicsComp,      shaders::kSharedTypesComp,   shaders::kControlComp,       shaders::kFunctionsComp,
    shaders::kInterfaceFrag,    shaders::kInterfaceVert,     shaders::kMemoryComp,        shaders::kPhisComp,
    shaders::kSpecialComp,      shaders::kTextureFrag,       shaders::kDistancesFrag,     shaders::kEmptyComp,
    shaders::kImageAtomicsFrag, shaders::kInterpolateAtFrag, shaders::kSomeDistancesVert, shaders::kTwoCoordsFrag,
};

TEST(SpirvFuzz, SamplesAreFine) {
  for (const std::span<const uint32_t> sample : kSamples) EXPECT_EQ(try_module(sample), "");
}

TEST(SpirvFuzz, EveryTruncationIsRefused) {
  for (const std::span<const uint32_t> sample : kSamples) {
    for (size_t size = 0; size < sample.size(); ++size) {
      // A module that ends between two functions may be whole; not with one function, or before the last one.
      const std::string text = try_module(sample.first(size));
      EXPECT_TRUE(text.empty() || is_refusal(text)) << size << ": " << text;
      if (size + 1 == sample.size()) {
        EXPECT_TRUE(is_refusal(text)) << text;
      }
    }
  }
}

TEST(SpirvFuzz, SwappedBytesAreTheSameModule) {
  for (const std::span<const uint32_t> sample : kSamples) {
    std::vector<uint32_t> swapped(sample.begin(), sample.end());
    for (uint32_t& word : swapped) word = __builtin_bswap32(word);
    EXPECT_EQ(try_module(swapped), "");
  }
}

// What spirv_fuzzer keeps (its minimized corpus) and what it has found.
TEST(SpirvFuzz, CorpusIsRefusedOrLowered) {
  size_t modules = 0;
  for (const auto& file : std::filesystem::directory_iterator(LAPILLI_FUZZ_CORPUS)) {
    std::ifstream in(file.path(), std::ios::binary);
    std::vector<uint32_t> words(file.file_size() / sizeof(uint32_t));
    in.read(reinterpret_cast<char*>(words.data()), static_cast<std::streamsize>(words.size() * sizeof(uint32_t)));
    const std::string text = try_module(words);
    EXPECT_TRUE(text.empty() || is_refusal(text)) << file.path() << ": " << text;
    ++modules;
  }
  EXPECT_GT(modules, 0u);
}

// LAPILLI_FUZZ_ROUNDS=1000000 for a long run.
TEST(SpirvFuzz, RandomChangesAreRefusedOrLowered) {
  const char* const wish = std::getenv("LAPILLI_FUZZ_ROUNDS");
  const long rounds = wish != nullptr ? std::atol(wish) : 20000;
  std::mt19937 random(static_cast<uint32_t>(rounds));
  const auto below = [&](size_t limit) { return static_cast<size_t>(random() % limit); };
  long accepted = 0;
  for (long round = 0; round < rounds; ++round) {
    const std::span<const uint32_t> sample = kSamples[below(std::size(kSamples))];
    std::vector<uint32_t> words(sample.begin(), sample.end());
    const size_t changes = 1 + below(3);
    for (size_t change = 0; change < changes; ++change) {
      uint32_t& word = words[5 + below(words.size() - 5)];
      switch (below(5)) {
        case 0:
          word ^= 1u << below(32);
          break;
        case 1:
          word = static_cast<uint32_t>(below(words[3] + 2));  // another id
          break;
        case 2:
          word = static_cast<uint32_t>(random());
          break;
        case 3:
          word = words[5 + below(words.size() - 5)];
          break;
        default:
          word += static_cast<uint32_t>(below(3)) - 1;
      }
    }
    const std::string text = try_module(words);
    EXPECT_TRUE(text.empty() || is_refusal(text)) << "round " << round << ": " << text;
    accepted += text.empty() ? 1 : 0;
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(accepted, rounds / 50);  // or nothing of the lowering was reached
}

}  // namespace
}  // namespace lapilli
