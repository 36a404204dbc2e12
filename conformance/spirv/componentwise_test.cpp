// Every componentwise instruction as scalar and vector, in compute, fragment and vertex shaders, with extremes among
// the operands; on the driver under test and, as far as the specification says what comes out, on the peer.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "harness/devices.h"
#include "oracle/ulp.h"
#include "shader/numbers.h"
#include "spirv/componentwise.h"
#include "spirv/snippet.h"

namespace lapilli::conformance::spirv {

void PrintTo(const Componentwise& instruction, std::ostream* out) { *out << instruction.name; }

namespace {

constexpr uint32_t kComponents = 4;

Id type_of(Module& m, char letter) {
  return letter == 'f' ? m.float_type() : letter == 'i' ? m.int_type() : letter == 'u' ? m.uint_type() : m.bool_type();
}

Id from_word(Module& m, char letter, Id word) {
  if (letter == 'u' || letter == 'o') return word;
  if (letter == 'b') return m.emit(spv::Op::OpINotEqual, m.bool_type(), {word, m.constant_uint(0)});
  return m.emit(spv::Op::OpBitcast, type_of(m, letter), {word});
}
Id to_word(Module& m, char letter, Id value) {
  if (letter == 'u') return value;
  if (letter == 'b') return m.emit(spv::Op::OpSelect, m.uint_type(), {value, m.constant_uint(1), m.constant_uint(0)});
  return m.emit(spv::Op::OpBitcast, m.uint_type(), {value});
}

// The instruction on vectors of `width` components.
Words apply(Module& m, const Componentwise& instruction, const Words& inputs, uint32_t width) {
  Words operands;
  for (uint32_t k = 0; instruction.types[k + 1] != 0; ++k) {
    const char letter = instruction.types[k + 1];
    if (letter == 'o') {
      operands.push_back(inputs[kComponents * k]);
      continue;
    }
    Words parts;
    for (uint32_t c = 0; c < width; ++c) parts.push_back(from_word(m, letter, inputs[kComponents * k + c]));
    operands.push_back(width == 1 ? parts[0] : m.composite(m.vector_type(type_of(m, letter), width), parts));
  }
  const char letter = instruction.types[0];
  const Id scalar = type_of(m, letter), whole = m.vector_type(scalar, width);
  const Id result = instruction.extended ? m.ext(instruction.number, whole, operands)
                                         : m.emit(spv::Op(instruction.number), whole, operands);
  Words words;
  for (uint32_t c = 0; c < width; ++c)
    words.push_back(to_word(m, letter, width == 1 ? result : m.extract(scalar, result, c)));
  return words;
}

// Compute shaders try all widths, one after the other; the others have room for two words.
Snippet snippet_of(const Componentwise& instruction, Stage stage) {
  const auto operands = uint32_t(std::string_view(instruction.types).size() - 1);
  const bool all = stage == Stage::compute;
  return {kComponents * operands, all ? 10u : 2u, [&instruction, all](Module& m, const Words& inputs) {
            Words words;
            for (uint32_t width = all ? 1 : 2; width <= (all ? kComponents : 2); ++width) {
              const Words part = apply(m, instruction, inputs, width);
              words.insert(words.end(), part.begin(), part.end());
            }
            return words;
          }};
}

// `inputs` words for each element: special values first, in all pairs.
Words operands_for(const Componentwise& instruction) {
  const FloatOperands floats = float_operands(11);
  const IntOperands ints = int_operands(12);
  const std::vector<float>* const float_lists[] = {&floats.a, &floats.b, &floats.c};
  const std::vector<uint32_t>* const int_lists[] = {&ints.a, &ints.b, &ints.c, &ints.b};
  const std::string_view types = std::string_view(instruction.types).substr(1);
  const size_t elements = std::min(floats.a.size(), ints.a.size()) / kComponents / 64 * 64;
  Words out;
  for (size_t element = 0; element < elements; ++element) {
    for (size_t k = 0; k < types.size(); ++k) {
      for (size_t c = 0; c < kComponents; ++c) {
        const size_t at = kComponents * element + c;
        const uint32_t integer = (*int_lists[k])[at];
        out.push_back(types[k] == 'f'   ? std::bit_cast<uint32_t>((*float_lists[k])[at])
                      : types[k] == 'b' ? integer & 1
                      : types[k] == 'o' ? integer % 17
                                        : integer);
      }
    }
  }
  return out;
}

bool ordinary(char letter, uint32_t bits) {
  const float value = std::bit_cast<float>(bits);
  return letter != 'f' || value == 0 || (std::isfinite(value) && std::abs(value) >= 0x1p-126f);
}

bool agrees(const Componentwise& instruction, uint32_t got, uint32_t want, bool promised) {
  if (got == want) return true;
  if (instruction.types[0] != 'f') return false;
  const float a = std::bit_cast<float>(got), b = std::bit_cast<float>(want);
  // The sign of a zero counts in exact arithmetic of ours; remainders, minimum, maximum and clamping leave it open.
  if (a == 0 && b == 0) return !promised || instruction.extended || instruction.peer_ulp != 0;
  const double allowed = promised ? instruction.ulp : instruction.peer_ulp;
  if (!promised && allowed > 100 && std::abs(double(a) - double(b)) <= 0x1p-11) return true;
  return oracle::ulp_error(a, double(b)) <= allowed;
}

// `promised`: Lapilli, whose results are fixed everywhere.
void check(const samples::Context& context, const Componentwise& instruction, Stage stage, bool promised) {
  const Snippet snippet = snippet_of(instruction, stage);
  const Words operands = operands_for(instruction);
  const Words got = run(context, snippet, stage, operands);
  const std::string_view types = std::string_view(instruction.types).substr(1);
  const size_t elements = operands.size() / snippet.inputs;
  ASSERT_EQ(got.size(), elements * snippet.outputs);
  int wrong = 0;
  size_t compared = 0;
  for (size_t element = 0; element < elements; ++element) {
    for (uint32_t i = 0; i < snippet.outputs; ++i) {
      // Widths 1, 2, 3, 4 in a row: components 0, 0 1, 0 1 2, 0 1 2 3.
      const uint32_t component = snippet.outputs == 2 ? i : i - (i >= 6 ? 6 : i >= 3 ? 3 : i >= 1 ? 1 : 0);
      uint32_t x[4] = {};
      bool usual = true;
      for (size_t k = 0; k < types.size(); ++k) {
        x[k] = operands[element * snippet.inputs + kComponents * k + (types[k] == 'o' ? 0 : component)];
        usual = usual && ordinary(types[k], x[k]);
      }
      if (instruction.open != nullptr && instruction.open(x)) continue;
      const uint32_t want = instruction.value(x), result = got[element * snippet.outputs + i];
      const bool defined = instruction.defined == nullptr || instruction.defined(x);
      if (!promised && (!usual || !ordinary(instruction.types[0], want) || !defined)) continue;
      ++compared;
      if (agrees(instruction, result, want, promised)) continue;
      if (++wrong <= 2) {
        ADD_FAILURE() << instruction.name << " (" << name_of(stage) << ", word " << i << ")" << std::hex << " of "
                      << x[0] << ' ' << x[1] << ' ' << x[2] << " = " << result << ", expected " << want;
      }
    }
  }
  EXPECT_EQ(wrong, 0) << instruction.name;
  EXPECT_GT(compared, 100u) << instruction.name;
}

class ComponentwiseTest : public testing::TestWithParam<Componentwise> {};

TEST_P(ComponentwiseTest, GivesWhatIsDefined) {
  for (const Stage stage : kStages) check(subject(), GetParam(), stage, subject_is_lapilli());
}

TEST_P(ComponentwiseTest, PeerAgrees) {
  if (peer() == nullptr) GTEST_SKIP() << "no peer";
  check(*peer(), GetParam(), Stage::compute, false);
}

std::string test_name(const testing::TestParamInfo<Componentwise>& test) {
  return std::string(test.param.extended ? "Glsl" : "Op") + test.param.name;
}

INSTANTIATE_TEST_SUITE_P(Spirv, ComponentwiseTest, testing::ValuesIn(componentwise_instructions()), test_name);

}  // namespace
}  // namespace lapilli::conformance::spirv
