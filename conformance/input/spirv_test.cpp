// Broken shader modules: refused with VK_ERROR_UNKNOWN (the specification names no result for them) and a message of
// ERROR severity that names the instruction; never a crash.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "harness/compute.h"
#include "harness/devices.h"
#include "harness/graphics.h"
#include "input/messages.h"
#include "shaders/small.comp.h"

namespace lapilli::conformance {
namespace {

using Words = std::vector<uint32_t>;

class BadShaders : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    context = new_subject(true).release();
    log = new MessageLog(context->instance());
    const VkDescriptorSetLayoutBinding binding = {0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT,
                                                  nullptr};
    VkDescriptorSetLayoutCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    info.bindingCount = 1;
    info.pBindings = &binding;
    VkDescriptorSetLayout raw = VK_NULL_HANDLE;
    samples::check(vkCreateDescriptorSetLayout(context->device(), &info, nullptr, &raw), "set layout");
    set_layout = new samples::DescriptorSetLayout(context->device(), raw);
    layout = new samples::PipelineLayout(create_layout(*context, {&raw, 1}, 4));
  }
  static void TearDownTestSuite() {
    delete layout;
    delete set_layout;
    delete log;
    delete context;
  }

  static Words valid() { return Words(std::begin(shaders::kSmallComp), std::end(shaders::kSmallComp)); }

  // The result of making module and pipeline; the pipeline, if there is one, is destroyed.
  static VkResult build(const Words& code, const char* entry_point = "main") {
    VkPipeline pipeline = VK_NULL_HANDLE;
    const VkResult result = try_create_compute_pipeline(*context, code, layout->get(), &pipeline, nullptr, entry_point);
    if (result != VK_SUCCESS) {
      EXPECT_EQ(pipeline, VkPipeline(VK_NULL_HANDLE)) << "a failed pipeline must be VK_NULL_HANDLE";
    }
    vkDestroyPipeline(context->device(), pipeline, nullptr);
    return result;
  }

  static void expect_refused(const Words& code, const std::string& what, const std::string& named = "",
                             const char* entry_point = "main") {
    log->take_errors();
    EXPECT_EQ(build(code, entry_point), VK_ERROR_UNKNOWN) << what;
    const std::vector<std::string> errors = log->take_errors();
    ASSERT_FALSE(errors.empty()) << "no message: " << what;
    const bool mentioned = std::any_of(errors.begin(), errors.end(),
                                       [&](const std::string& e) { return e.find(named) != std::string::npos; });
    EXPECT_TRUE(mentioned) << what << ": no message names '" << named << "', but: " << errors[0];
  }

  // Replaces the first instruction with this opcode.
  static Words with_opcode(uint32_t from, uint32_t to) {
    Words code = valid();
    for (size_t i = 5; i < code.size(); i += code[i] >> 16) {
      if ((code[i] & 0xFFFF) == from) {
        code[i] = (code[i] & 0xFFFF0000u) | to;
        return code;
      }
    }
    ADD_FAILURE() << "the module has no instruction " << from;
    return code;
  }

  static inline samples::Context* context;
  static inline MessageLog* log;
  static inline samples::DescriptorSetLayout* set_layout;
  static inline samples::PipelineLayout* layout;
};

TEST_F(BadShaders, TheUndamagedModuleIsAccepted) { EXPECT_EQ(build(valid()), VK_SUCCESS); }

TEST_F(BadShaders, HeadersThatAreNone) {
  Words code = valid();
  code[0] = 0x12345678;
  expect_refused(code, "wrong magic number");
  code = valid();
  code[1] = 0x00990000;
  expect_refused(code, "unknown version");
  code = valid();
  code[3] = 0;
  expect_refused(code, "bound 0");
  code[3] = 0xFFFFFFFF;
  expect_refused(code, "bound 2^32 - 1");
  code = valid();
  expect_refused(Words(code.begin(), code.begin() + 5), "a header alone");
  expect_refused(Words(code.begin(), code.begin() + 3), "half a header");
}

TEST_F(BadShaders, TruncatedEverywhere) {
  const Words code = valid();
  for (size_t length = 1; length < code.size(); ++length) {
    ASSERT_EQ(build(Words(code.begin(), code.begin() + std::ptrdiff_t(length))), VK_ERROR_UNKNOWN)
        << length << " of " << code.size() << " words";
  }
  EXPECT_GE(log->take_errors().size(), code.size() - 2);
}

TEST_F(BadShaders, WordCounts) {
  Words code = valid();
  code[5] &= 0xFFFF;
  expect_refused(code, "word count 0");
  code = valid();
  code[5] |= 0xFFFF0000u;
  expect_refused(code, "word count beyond the module");
}

TEST_F(BadShaders, UnknownAndUnsupportedInstructionsAreNamed) {
  constexpr uint32_t kFMul = 133, kFAdd = 129, kConvertSToF = 111;
  expect_refused(with_opcode(kFMul, 0xFFF0), "an opcode that does not exist", "65520");
  expect_refused(with_opcode(kFAdd, 5000), "an extension's opcode", "OpGroupIAddNonUniformAMD");
  // OpUConvert of a float, with a 16-bit type nowhere in sight: another kind of operand than the instruction takes.
  expect_refused(with_opcode(kConvertSToF, 113), "a conversion that does not fit its types", "OpUConvert");
}

TEST_F(BadShaders, CapabilitiesThatAreNotThere) {
  // OpCapability is the first instruction: word 6 is the capability.
  for (const auto& [capability, name] :
       {std::pair{2u, "Geometry"}, {3u, "Tessellation"}, {5u, "Linkage"}, {6u, "Kernel"}, {0x7FFFFFFFu, ""}}) {
    Words code = valid();
    ASSERT_EQ(code[5] & 0xFFFF, 17u);
    code[6] = capability;
    expect_refused(code, std::string("capability ") + name, name);
  }
}

TEST_F(BadShaders, EntryPointsThatAreNotThere) {
  expect_refused(valid(), "another name", "nothing_like_that", "nothing_like_that");
  expect_refused(valid(), "an empty name", "", "");
  // The entry point is there, but for another stage: OpEntryPoint's first operand.
  Words code = valid();
  for (size_t i = 5; i < code.size(); i += code[i] >> 16) {
    if ((code[i] & 0xFFFF) == 15) code[i + 1] = 4;  // Fragment
  }
  expect_refused(code, "an entry point of another stage", "main");
}

TEST_F(BadShaders, GarbageAndRandomDamage) {
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    Words code(5 + random() % 200);
    for (uint32_t& w : code) w = uint32_t(random());
    std::copy_n(valid().begin(), i % 2 == 0 ? 5 : 1, code.begin());
    ASSERT_EQ(build(code), VK_ERROR_UNKNOWN);
  }
  // One to three words of a valid module replaced: accepted or refused, but alive.
  const Words good = valid();
  int refused = 0;
  for (uint32_t i = 0; i < 4000; ++i) {
    Words code = good;
    for (uint32_t k = 0; k <= i % 3; ++k) {
      uint32_t& word = code[5 + random() % (code.size() - 5)];
      switch (random() % 4) {
        case 0:
          word = uint32_t(random());
          break;
        case 1:
          word = code[5 + random() % (code.size() - 5)];
          break;
        case 2:
          word = uint32_t(random() % code[3]);
          break;
        default:
          word ^= 1u << (random() % 32);
          break;
      }
    }
    const VkResult result = build(code);
    ASSERT_TRUE(result == VK_SUCCESS || result == VK_ERROR_UNKNOWN) << result;
    refused += result != VK_SUCCESS;
  }
  EXPECT_GT(refused, 1000);
  EXPECT_EQ(build(good), VK_SUCCESS) << "after all that";
}

// Instructions removed or doubled: references to nothing, double definitions, blocks without ends.
TEST_F(BadShaders, InstructionsRemovedOrDoubled) {
  const Words good = valid();
  for (size_t i = 5; i < good.size(); i += good[i] >> 16) {
    const auto at = good.begin() + std::ptrdiff_t(i), end = at + std::ptrdiff_t(good[i] >> 16);
    Words removed(good.begin(), at);
    removed.insert(removed.end(), end, good.end());
    Words doubled(good.begin(), end);
    doubled.insert(doubled.end(), at, good.end());
    for (const Words& code : {removed, doubled}) {
      const VkResult result = build(code);
      ASSERT_TRUE(result == VK_SUCCESS || result == VK_ERROR_UNKNOWN) << result << " at word " << i;
    }
  }
}

}  // namespace
}  // namespace lapilli::conformance
