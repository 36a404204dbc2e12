// Garbage in: every truncation of real modules, and thousands of random changes to them, end in a module or an error.
#include <cstdlib>
#include <random>

#include "shader/spirv/test/run_shader.h"
#include "shaders/control.comp.h"
#include "shaders/functions.comp.h"
#include "shaders/interface.frag.h"
#include "shaders/interface.vert.h"
#include "shaders/memory.comp.h"
#include "shaders/phis.comp.h"
#include "shaders/special.comp.h"
#include "shaders/texture.frag.h"

namespace lapilli {
namespace {

struct Sample {
  std::span<const uint32_t> words;
  VkShaderStageFlagBits stage;
};
const Sample kSamples[] = {
    {shaders::kControlComp, VK_SHADER_STAGE_COMPUTE_BIT},    {shaders::kFunctionsComp, VK_SHADER_STAGE_COMPUTE_BIT},
    {shaders::kInterfaceFrag, VK_SHADER_STAGE_FRAGMENT_BIT}, {shaders::kInterfaceVert, VK_SHADER_STAGE_VERTEX_BIT},
    {shaders::kMemoryComp, VK_SHADER_STAGE_COMPUTE_BIT},     {shaders::kPhisComp, VK_SHADER_STAGE_COMPUTE_BIT},
    {shaders::kSpecialComp, VK_SHADER_STAGE_COMPUTE_BIT},    {shaders::kTextureFrag, VK_SHADER_STAGE_FRAGMENT_BIT},
};

std::vector<BindingSlot> some_slots() {
  std::vector<BindingSlot> slots;
  for (uint32_t set = 0; set < 2; ++set) {
    for (uint32_t binding = 0; binding < 4; ++binding)
      slots.push_back({set, binding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_ALL, binding * 4, 4, -1});
  }
  return slots;
}

// What was lowered, or the error's text.
std::string try_module(std::span<const uint32_t> words, VkShaderStageFlagBits stage) {
  static const std::vector<BindingSlot> slots = some_slots();
  const ResourceLayout layout{slots, 128};
  Result<std::shared_ptr<const SpirvModule>> module = parse_spirv(words);
  if (!module) return module.error().message;
  const ShaderStage shader{*module, "main", {}};
  if (stage == VK_SHADER_STAGE_COMPUTE_BIT) {
    const Result<Code> code = make_compute_code(shader, layout);
    return code.ok() ? verify(*code) : code.error().message;
  }
  const ShaderStage vertex{parse_or_fail(shaders::kInterfaceVert), "main", {}};
  const bool is_fragment = stage == VK_SHADER_STAGE_FRAGMENT_BIT;
  const VkFormat formats[] = {VK_FORMAT_R8G8B8A8_UNORM};
  VkPipelineColorBlendAttachmentState blend[1] = {};
  blend[0].colorWriteMask = 0xF;
  GraphicsState state;
  state.color_formats = formats;
  state.blend = blend;
  const Result<GraphicsCode> code =
      make_graphics_code(is_fragment ? vertex : shader, is_fragment ? &shader : nullptr, state, layout);
  if (!code) return code.error().message;
  return verify(code->vertex) + verify(code->fragment);
}

bool is_refusal(const std::string& text) {
  return text.starts_with("SPIR-V: ") || text.starts_with("the fragment shader reads more than");
}

TEST(SpirvFuzz, SamplesAreFine) {
  for (const Sample& sample : kSamples) EXPECT_EQ(try_module(sample.words, sample.stage), "");
}

TEST(SpirvFuzz, EveryTruncationIsRefused) {
  for (const Sample& sample : kSamples) {
    for (size_t size = 0; size < sample.words.size(); ++size) {
      // A module that ends between two functions may be whole; not with one function, or before the last one.
      const std::string text = try_module(sample.words.first(size), sample.stage);
      EXPECT_TRUE(text.empty() || is_refusal(text)) << size << ": " << text;
      if (size + 1 == sample.words.size()) {
        EXPECT_TRUE(is_refusal(text)) << text;
      }
    }
  }
}

TEST(SpirvFuzz, SwappedBytesAreTheSameModule) {
  for (const Sample& sample : kSamples) {
    std::vector<uint32_t> swapped(sample.words.begin(), sample.words.end());
    for (uint32_t& word : swapped) word = __builtin_bswap32(word);
    EXPECT_EQ(try_module(swapped, sample.stage), "");
  }
}

// LAPILLI_FUZZ_ROUNDS=1000000 for a long run.
TEST(SpirvFuzz, RandomChangesAreRefusedOrLowered) {
  const char* const wish = std::getenv("LAPILLI_FUZZ_ROUNDS");
  const long rounds = wish != nullptr ? std::atol(wish) : 20000;
  std::mt19937 random(static_cast<uint32_t>(rounds));
  const auto below = [&](size_t limit) { return static_cast<size_t>(random() % limit); };
  long accepted = 0;
  for (long round = 0; round < rounds; ++round) {
    const Sample& sample = kSamples[below(std::size(kSamples))];
    std::vector<uint32_t> words(sample.words.begin(), sample.words.end());
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
    const std::string text = try_module(words, sample.stage);
    EXPECT_TRUE(text.empty() || is_refusal(text)) << "round " << round << ": " << text;
    accepted += text.empty() ? 1 : 0;
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(accepted, rounds / 50);  // or nothing of the lowering was reached
}

}  // namespace
}  // namespace lapilli
