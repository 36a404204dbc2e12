// Random programs on the driver under test and on its peer, against what they compute here.
// LAPILLI_RANDOM_PROGRAMS=10000 LAPILLI_RANDOM_SEED=1 make a long run.
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

#include "harness/devices.h"
#include "spirv/random_program.h"

namespace lapilli::conformance::spirv {
namespace {

constexpr uint32_t kElements = 128;

uint32_t from_environment(const char* name, uint32_t otherwise) {
  const char* const text = std::getenv(name);
  return text != nullptr ? uint32_t(std::strtoul(text, nullptr, 10)) : otherwise;
}

Words random_words(uint32_t count, uint32_t seed) {
  std::mt19937 random(seed);
  Words out;
  for (uint32_t i = 0; i < count; ++i) out.push_back(i % 3 == 0 ? uint32_t(random()) : uint32_t(random()) % 16);
  return out;
}

struct Difference {
  bool found = false;
  std::string text;
};

Difference difference(const samples::Context& context, const Program& program, Stage stage, uint32_t seed) {
  const Words uniforms = random_words(Program::kUniforms, seed + 1),
              operands = random_words(Program::kInputs * kElements, seed);
  const uint32_t results = stage == Stage::compute ? Program::kResults : 2;
  const Words got = run(context, snippet_of(program, uniforms, results), stage, operands);
  for (uint32_t element = 0; element < kElements; ++element) {
    const auto want = evaluate(program, &operands[Program::kInputs * element], uniforms.data());
    for (uint32_t i = 0; i < results; ++i) {
      const uint32_t result = got[results * element + i];
      if (result == want[i]) continue;
      std::ostringstream text;
      text << name_of(stage) << ", element " << element << ", result " << i << ": " << std::hex << result
           << ", expected " << want[i];
      return {true, text.str()};
    }
  }
  return {};
}

void check(const samples::Context& context, uint32_t seed, Stage stage) {
  const Program program = random_program(seed);
  const Difference found = difference(context, program, stage, seed);
  if (!found.found) return;
  const Program smaller = shrink(program, [&](const Program& p) { return difference(context, p, stage, seed).found; });
  ADD_FAILURE() << "seed " << seed << ", " << found.text
                << "\nshrunk: " << difference(context, smaller, stage, seed).text << '\n'
                << text_of(smaller);
}

TEST(RandomShaders, ComputeWhatTheyMean) {
  const uint32_t first = from_environment("LAPILLI_RANDOM_SEED", 1),
                 count = from_environment("LAPILLI_RANDOM_PROGRAMS", 150);
  for (uint32_t seed = first; seed < first + count && !HasFailure(); ++seed) check(subject(), seed, kStages[seed % 3]);
}

TEST(RandomShaders, ThePeerAgrees) {
  if (peer() == nullptr) GTEST_SKIP() << "no peer";
  const uint32_t first = from_environment("LAPILLI_RANDOM_SEED", 1),
                 count = from_environment("LAPILLI_RANDOM_PROGRAMS", 150);
  for (uint32_t seed = first; seed < first + count / 10 && !HasFailure(); ++seed) check(*peer(), seed, Stage::compute);
}

}  // namespace
}  // namespace lapilli::conformance::spirv
