// Linking of stages, prologues and epilogues: what is in the programs, and what is not.
#include <map>

#include "base/removals.h"
#include "shader/spirv/test/run_shader.h"
#include "shaders/counting.frag.h"
#include "shaders/depth.frag.h"
#include "shaders/interface.frag.h"
#include "shaders/interface.vert.h"
#include "shaders/some_distances.vert.h"
#include "shaders/texture.frag.h"

namespace lapilli {
namespace {

class Stage : public testing::Test {
 protected:
  Stage() {
    for (const uint32_t location : {0u, 1u, 3u, 5u})
      attributes.push_back({location, 0, 16 * location, VK_FORMAT_R32G32B32A32_SFLOAT});
    formats.assign(3, VK_FORMAT_R8G8B8A8_UNORM);
    blend.resize(3);
    for (VkPipelineColorBlendAttachmentState& each : blend) each.colorWriteMask = 0xF;
    for (uint32_t binding = 0; binding < 4; ++binding)
      slots.push_back({1, binding, VK_DESCRIPTOR_TYPE_SAMPLER, VK_SHADER_STAGE_ALL, binding * 10, 4, -1});
  }

  void make(std::span<const uint32_t> fragment_words = shaders::kInterfaceFrag,
            std::span<const uint32_t> vertex_words = shaders::kInterfaceVert) {
    const ShaderStage vertex{parse_or_fail(vertex_words), "main", {}};
    const ShaderStage fragment{parse_or_fail(fragment_words), "main", specialization};
    state.attributes = attributes;
    state.color_formats = formats;
    state.blend = blend;
    Result<GraphicsCode> made =
        make_graphics_code(vertex, fragment_words.empty() ? nullptr : &fragment, state, {slots, 0});
    ASSERT_TRUE(made.ok()) << made.error().message;
    code = std::move(*made);
    ASSERT_EQ(verify(code.vertex), "") << disassemble(code.vertex);
    ASSERT_EQ(verify(code.fragment), "") << disassemble(code.fragment);
  }

  static std::vector<Instruction> all(const Code& of, Opcode op) {
    std::vector<Instruction> found;
    for (const Instruction& instruction : of.instructions) {
      if (instruction.op == op) found.push_back(instruction);
    }
    return found;
  }
  static size_t count(const Code& of, Opcode op) { return all(of, op).size(); }
  static size_t place(const Code& of, Opcode op) {
    size_t i = 0;
    while (i < of.instructions.size() && of.instructions[i].op != op) ++i;
    return i;
  }

  std::vector<VertexAttribute> attributes;
  std::vector<VkFormat> formats;
  std::vector<VkPipelineColorBlendAttachmentState> blend;
  std::vector<BindingSlot> slots;
  std::vector<SpecializationEntry> specialization;
  GraphicsState state;
  GraphicsCode code;
};

TEST_F(Stage, OnlyWhatIsReadIsStoredAndInterpolated) {
  make();
  // smooth_color.x and .z, screen.y, ids.y, matrix[1].xy.
  const std::vector<Interpolation> expected{Interpolation::perspective, Interpolation::perspective,
                                            Interpolation::linear,      Interpolation::flat,
                                            Interpolation::perspective, Interpolation::perspective};
  EXPECT_EQ(code.varyings, expected);
  EXPECT_EQ(code.output_slots, kSlotVaryings + expected.size());
  std::map<uint32_t, int> stores;
  for (const Instruction& store : all(code.vertex, Opcode::store_output)) ++stores[store.imm];
  EXPECT_EQ(stores.size(), code.output_slots);
  for (const auto& [slot, times] : stores) EXPECT_EQ(times, 1) << slot;
  EXPECT_EQ(count(code.vertex, Opcode::fsin), 0u);
  EXPECT_EQ(count(code.fragment, Opcode::interpolate_flat), 1u);
  EXPECT_EQ(count(code.fragment, Opcode::frag_perspective), 1u);
  EXPECT_EQ(count(code.fragment, Opcode::frag_depth), 0u);
  EXPECT_EQ(count(code.fragment, Opcode::count_samples), 1u);
}

TEST_F(Stage, OnlyDistancesThatAreWrittenGetSlots) {
  make();
  EXPECT_EQ(code.clip_distances + code.cull_distances, 0u);
  make(shaders::kInterfaceFrag, shaders::kSomeDistancesVert);
  EXPECT_EQ(code.clip_distances, 1u);
  EXPECT_EQ(code.cull_distances, 1u);
  EXPECT_EQ(code.output_slots, kSlotVaryings + code.varyings.size() + 2);
}

TEST_F(Stage, KeepsWhatNobodyReadsIfAsked) {
  state.counts_removals = true;
  make();
  EXPECT_EQ(code.removed.input_values, 13u - 6u);
  EXPECT_EQ(code.removed.vertex_values, 13u - 6u);
  EXPECT_GE(code.removed.vertex_cost, op_info(Opcode::fsin).cost);
  set_kept_removals(1u << static_cast<uint32_t>(Removal::varyings));
  make();
  set_kept_removals(0);
  EXPECT_EQ(code.varyings.size(), 13u);
  EXPECT_EQ(count(code.vertex, Opcode::fsin), 1u);
}

TEST_F(Stage, KeepsWhatOnlyMaskedTargetsTakeIfAsked) {
  state.counts_removals = true;
  make();
  EXPECT_EQ(code.removed.output_ops, 0u);
  for (VkPipelineColorBlendAttachmentState& each : blend) each.colorWriteMask = 0;
  make();
  EXPECT_TRUE(code.fragment_reads_nothing);
  EXPECT_GT(code.removed.output_ops, 0u);
  EXPECT_EQ(count(code.fragment, Opcode::fmul), 0u);
  set_kept_removals(1u << static_cast<uint32_t>(Removal::outputs));
  make();
  set_kept_removals(0);
  EXPECT_FALSE(code.fragment_reads_nothing);
  EXPECT_GT(count(code.fragment, Opcode::fmul), 0u);
  EXPECT_EQ(count(code.fragment, Opcode::store_color), 0u);
}

TEST_F(Stage, FetchesOfAttributes) {
  make();
  EXPECT_EQ(all(code.vertex, Opcode::fetch).size(), 4u);
  attributes.pop_back();  // of `numbers`, which then reads as 0
  make();
  EXPECT_EQ(all(code.vertex, Opcode::fetch).size(), 3u);
  for (const Instruction& fetch : all(code.vertex, Opcode::fetch)) {
    // `late` stands in components 1 and 2 of location 3; only its y is read.
    if (code.vertex.attributes[fetch.imm].location == 3) {
      EXPECT_EQ(fetch.results, 3);
    }
  }
}

TEST_F(Stage, ColourAttachments) {
  make();
  std::vector<Instruction> stores = all(code.fragment, Opcode::store_color);
  ASSERT_EQ(stores.size(), 2u);  // nothing is written to location 1
  EXPECT_EQ(stores[0].imm, 0u);
  EXPECT_EQ(stores[1].imm, 2u);
  blend[0].colorWriteMask = 0;
  formats[2] = VK_FORMAT_UNDEFINED;
  make();
  EXPECT_EQ(count(code.fragment, Opcode::store_color), 0u);
  EXPECT_TRUE(code.fragment_reads_nothing);
  EXPECT_TRUE(code.varyings.empty());
  EXPECT_EQ(code.fragment.instructions.size(), 2u);  // count_samples, end
}

TEST_F(Stage, BlendingReadsTheTargetOnlyIfItMust) {
  blend[0].blendEnable = VK_TRUE;
  blend[0].srcColorBlendFactor = blend[0].srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
  blend[0].dstColorBlendFactor = blend[0].dstAlphaBlendFactor = VK_BLEND_FACTOR_ZERO;
  make();
  EXPECT_EQ(count(code.fragment, Opcode::load_color), 0u);
  blend[0].srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
  blend[0].dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
  blend[0].colorWriteMask = 0x7;
  make();
  EXPECT_EQ(count(code.fragment, Opcode::load_color), 0u);
  EXPECT_EQ(all(code.fragment, Opcode::blend_color)[0].imm2 & 15, 7u);
  // What is not of blend_color's kind is written out.
  blend[0].dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_COLOR;
  make();
  EXPECT_EQ(count(code.fragment, Opcode::load_color), 1u);
  EXPECT_EQ(count(code.fragment, Opcode::fma), 3u);
  EXPECT_EQ(count(code.fragment, Opcode::blend_color), 0u);
  EXPECT_EQ(all(code.fragment, Opcode::store_color)[0].imm2, 7u);
  blend[0].srcColorBlendFactor = VK_BLEND_FACTOR_SRC1_COLOR;
  const ShaderStage vertex{parse_or_fail(shaders::kInterfaceVert), "main", {}};
  const ShaderStage fragment{parse_or_fail(shaders::kInterfaceFrag), "main", {}};
  state.blend = blend;
  const Result<GraphicsCode> refused = make_graphics_code(vertex, &fragment, state, {slots, 0});
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("second source colour"), std::string::npos);
}

TEST_F(Stage, DepthIsLateWhereDiscardDecides) {
  state.depth_test = state.depth_write = true;
  state.depth_compare = VK_COMPARE_OP_LESS;
  specialization = {{0, 1, 4}};  // discard
  make();
  EXPECT_EQ(count(code.fragment, Opcode::kill), 1u);
  EXPECT_EQ(all(code.fragment, Opcode::depth_test)[0].imm, 8u | VK_COMPARE_OP_LESS);
  EXPECT_GT(place(code.fragment, Opcode::depth_test), place(code.fragment, Opcode::kill));
  EXPECT_LT(place(code.fragment, Opcode::depth_test), place(code.fragment, Opcode::count_samples));
  state.depth_write = false;
  make();
  EXPECT_TRUE(code.early_depth);
  EXPECT_EQ(count(code.fragment, Opcode::depth_test), 0u);
  EXPECT_GT(place(code.fragment, Opcode::count_samples), place(code.fragment, Opcode::kill));
}

TEST_F(Stage, EarlyDepthIsLeftToTheRasterizer) {
  state.depth_test = state.depth_write = true;
  state.depth_compare = VK_COMPARE_OP_LESS;
  make();
  EXPECT_EQ(count(code.fragment, Opcode::depth_test), 0u);
  EXPECT_EQ(count(code.fragment, Opcode::frag_depth), 0u);
  EXPECT_TRUE(code.depth_test && code.early_depth && code.depth_write);
  EXPECT_EQ(code.depth_compare, VK_COMPARE_OP_LESS);
  specialization = {{0, 1, 4}};  // discard
  make();
  EXPECT_EQ(count(code.fragment, Opcode::depth_test), 1u);
  EXPECT_TRUE(code.depth_test && !code.early_depth && code.depth_write);
  state.depth_write = false;
  state.depth_compare = VK_COMPARE_OP_ALWAYS;
  make();
  EXPECT_FALSE(code.depth_test || code.early_depth || code.depth_write);
}

TEST_F(Stage, DeferrableIfNothingButTheLastColourCanBeSeen) {
  formats[1] = VK_FORMAT_UNDEFINED;  // the shader does not write it
  state.depth_test = state.depth_write = true;
  state.depth_compare = VK_COMPARE_OP_LESS;
  make();
  EXPECT_TRUE(code.deferrable && code.writes_color);
  blend[0].colorWriteMask = 0x7;
  make();
  EXPECT_FALSE(code.deferrable);
  formats[0] = VK_FORMAT_R8G8_UNORM;  // has no blue and no alpha
  blend[0].colorWriteMask = 0x3;
  make();
  EXPECT_TRUE(code.deferrable);
  blend[0].blendEnable = VK_TRUE;
  make();
  EXPECT_FALSE(code.deferrable);
  blend[0].blendEnable = VK_FALSE;
  formats[1] = VK_FORMAT_R8G8B8A8_UNORM;
  make();
  EXPECT_FALSE(code.deferrable);
  formats[1] = VK_FORMAT_UNDEFINED;
  specialization = {{0, 1, 4}};  // discard
  make();
  EXPECT_FALSE(code.deferrable);
  specialization.clear();
  formats.assign(3, VK_FORMAT_UNDEFINED);
  make();
  EXPECT_FALSE(code.deferrable || code.writes_color);
}

TEST_F(Stage, PixelsStandAloneUnlessTheProgramLooksAtOtherLanesOrItsDepth) {
  make();
  EXPECT_FALSE(code.deferrable || code.pixels_alone);
  formats[1] = VK_FORMAT_UNDEFINED;  // the shader does not write it
  make();
  EXPECT_TRUE(code.deferrable && code.pixels_alone);
  formats[2] = VK_FORMAT_UNDEFINED;
  make(shaders::kTextureFrag);
  EXPECT_TRUE(code.deferrable);
  EXPECT_FALSE(code.pixels_alone);
  make(shaders::kDepthFrag);
  EXPECT_EQ(count(code.fragment, Opcode::frag_depth), 1u);
  EXPECT_TRUE(code.deferrable);
  EXPECT_FALSE(code.pixels_alone);
}

// Each fragment's store has to happen, hidden later or not; the depth test comes after it.
TEST_F(Stage, StoresAreNotDeferred) {
  slots.push_back({1, 4, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_ALL, 40, 1, -1});
  formats = {VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_UNDEFINED, VK_FORMAT_UNDEFINED};
  make(shaders::kCountingFrag);
  EXPECT_TRUE(code.writes_color);
  EXPECT_FALSE(code.deferrable);
  state.depth_test = state.depth_write = true;
  state.depth_compare = VK_COMPARE_OP_LESS;
  make(shaders::kCountingFrag);
  EXPECT_FALSE(code.deferrable || code.early_depth);
  EXPECT_GT(place(code.fragment, Opcode::depth_test), place(code.fragment, Opcode::store_buffer));
}

TEST_F(Stage, WithoutFragmentShader) {
  const ShaderStage vertex{parse_or_fail(shaders::kInterfaceVert), "main", {}};
  state.depth_test = state.depth_write = true;
  state.depth_compare = VK_COMPARE_OP_GREATER;
  state.attributes = attributes;
  const Result<GraphicsCode> made = make_graphics_code(vertex, nullptr, state, {slots, 0});
  ASSERT_TRUE(made.ok());
  EXPECT_EQ(verify(made->fragment), "");
  EXPECT_TRUE(made->fragment_reads_nothing);
  EXPECT_TRUE(made->early_depth);
  EXPECT_EQ(count(made->fragment, Opcode::depth_test), 0u);
  EXPECT_EQ(made->output_slots, kSlotVaryings);
  EXPECT_EQ(count(made->vertex, Opcode::fetch), 1u);
}

TEST_F(Stage, TexturesAndSamplers) {
  make(shaders::kTextureFrag);
  std::map<std::pair<uint32_t, uint32_t>, int> pairs;  // first descriptors of texture and sampler
  for (const Opcode op : {Opcode::sample_2d, Opcode::sample_2d_lod}) {
    for (const Instruction& sample : all(code.fragment, op))
      ++pairs[{code.fragment.resources[sample.imm].first, code.fragment.resources[sample.imm2].first}];
  }
  const std::map<std::pair<uint32_t, uint32_t>, int> expected{
      {{1, 1}, 1},    // both[1]
      {{0, 0}, 2},    // both[which] as an array, and the gradient's both[0]
      {{20, 31}, 1},  // pictures[which] with samplers[1]
  };
  EXPECT_EQ(pairs, expected);
  EXPECT_EQ(count(code.fragment, Opcode::fetch_2d), 1u);
}

}  // namespace
}  // namespace lapilli
