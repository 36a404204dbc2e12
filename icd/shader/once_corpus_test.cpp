// Every shader of the samples and of the conformance tests with and without the section that runs once per draw:
// the same bits come out.
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "base/removals.h"
#include "shader/spirv/test/run_shader.h"
#include "shaders/corpus.h"

namespace lapilli {
namespace {

constexpr uint32_t kBindings = 16, kSets = 4;
constexpr size_t kBufferBytes = 1 << 16;

// Descriptors of all sets and bindings that anyone uses: buffers of numbers between -2 and 2, no textures.
class Corpus : public testing::Test {
 protected:
  Corpus() {
    for (uint32_t set = 0; set < kSets; ++set) {
      for (uint32_t binding = 0; binding < kBindings; ++binding)
        slots.push_back(
            {set, binding, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_SHADER_STAGE_ALL, binding, 2, -1});  // arrays overlap
    }
    fill();
    table.push_constants = buffers[0].data();
    table.push_constant_bytes = 128;
    for (uint32_t location = 0; location < kMaxVertexAttributes; ++location)
      attributes.push_back({location, 0, 16 * location, VK_FORMAT_R32G32B32A32_SFLOAT});
    formats.assign(4, VK_FORMAT_R32G32B32A32_SFLOAT);
    blend.resize(4);
    for (VkPipelineColorBlendAttachmentState& each : blend)
      each = {VK_TRUE,
              VK_BLEND_FACTOR_CONSTANT_COLOR,
              VK_BLEND_FACTOR_SRC_ALPHA,
              VK_BLEND_OP_ADD,
              VK_BLEND_FACTOR_ONE,
              VK_BLEND_FACTOR_ONE,
              VK_BLEND_OP_ADD,
              0xF};
    state.attributes = attributes;
    state.color_formats = formats;
    state.blend = blend;
  }
  ~Corpus() override { set_kept_removals(0); }

  void fill() {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> reals(-2, 2);
    buffers.assign(kBindings, std::vector<std::byte>(kBufferBytes));
    for (std::vector<std::byte>& buffer : buffers) {
      for (size_t at = 0; at < kBufferBytes; at += 4) {
        const float value = reals(random);
        std::memcpy(buffer.data() + at, &value, 4);
      }
    }
    for (uint32_t binding = 0; binding < kBindings; ++binding) {
      descriptors[binding].data = buffers[binding].data();
      descriptors[binding].size = descriptors[binding].room = kBufferBytes;
    }
    for (uint32_t set = 0; set < kSets; ++set) table.sets[set] = descriptors;
  }

  std::vector<std::byte> run_vertices(const Program& program, uint32_t slot_count) {
    Execution execution;
    EXPECT_TRUE(execution.prepare(program, table, &limits));
    VertexBatch batch = {};
    const VertexBinding binding{buffers[1].data(), kBufferBytes, 256, false};
    const VertexBinding bindings[kMaxVertexBindings] = {binding};
    batch.bindings = bindings;
    for (uint32_t lane = 0; lane < kBatchLanes; ++lane) batch.vertex_index[lane] = batch.instance_index[lane] = lane;
    std::vector<std::byte> outputs(slot_count * kBatchLanes * sizeof(float) + 64);
    void* aligned = outputs.data();
    size_t room = outputs.size();
    batch.outputs = static_cast<float*>(std::align(64, room - 64, aligned, room));
    execution.run_vertices(batch, ~uint64_t{0});
    const std::byte* const first = reinterpret_cast<const std::byte*>(batch.outputs);
    return {first, first + slot_count * kBatchLanes * sizeof(float)};
  }

  std::vector<std::byte> run_fragments(const Program& program) {
    Execution execution;
    EXPECT_TRUE(execution.prepare(program, table, &limits));
    FragmentBatch batch = {};
    TriangleSetup triangle = {};
    triangle.edge_a[1] = 256, triangle.edge_b[2] = 256, triangle.edge_c[0] = 4096 * 256;
    triangle.inverse_area2 = 1.0 / (4096 * 256);
    for (float& each : triangle.inverse_w) each = 1;
    triangle.varyings = reinterpret_cast<const float*>(buffers[2].data());
    alignas(64) static std::byte colors[4][4096 * 16];
    std::memset(colors, 0, sizeof colors);
    for (uint32_t i = 0; i < 4; ++i) {
      batch.planes.color[i] = colors[i];
      batch.blend_constants[i] = 0.25f + 0.125f * static_cast<float>(i);
    }
    for (uint32_t q = 0; q < kBatchQuads; ++q) {
      batch.triangle[q] = &triangle;
      batch.x[q] = static_cast<uint16_t>(q % 4 * 16);
      batch.y[q] = static_cast<uint16_t>(q / 4 * 16);
      batch.quad_in_tile[q] = static_cast<uint16_t>(q);
    }
    batch.one_triangle = true;
    execution.run_fragments(batch, 0xFFFFFFFFFFFF7FF1);
    return {colors[0], colors[0] + sizeof colors};
  }

  std::vector<std::byte> run_invocations(const Program& program) {
    fill();
    Execution execution;
    EXPECT_TRUE(execution.prepare(program, table, &limits));
    const uint32_t first[3] = {}, groups[3] = {2, 2, 2};
    execution.run_workgroup(first, groups);
    std::vector<std::byte> all;
    for (const std::vector<std::byte>& buffer : buffers) all.insert(all.end(), buffer.begin(), buffer.end());
    return all;
  }

  std::vector<BindingSlot> slots;
  std::vector<std::vector<std::byte>> buffers;
  Descriptor descriptors[kBindings + 1];
  ResourceTable table;
  std::vector<VertexAttribute> attributes;
  std::vector<VkFormat> formats;
  std::vector<VkPipelineColorBlendAttachmentState> blend;
  GraphicsState state;
  ExecutionLimits limits;
};

TEST_F(Corpus, TheSameBitsWithAndWithoutTheOnceSection) {
  const ResourceLayout layout{slots, kMaxPushConstantBytes};
  size_t with_once = 0;
  for (const CorpusShader& shader : kCorpus) {
    std::vector<std::byte> results[2];
    for (int way = 0; way < 2; ++way) {
      set_kept_removals(way == 0 ? 0 : 1u << static_cast<uint32_t>(Removal::uniforms));
      limits.deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(500);
      limits.expired = false;
      const ShaderStage stage{parse_or_fail(shader.words), "main", {}};
      if (shader.is(".comp")) {
        const Result<ProgramPtr> made = build_compute(stage, layout);
        ASSERT_TRUE(made.ok()) << shader.name << made.error().message;
        results[way] = run_invocations(**made);
        with_once += way == 0 && once_cost(**made) > 0;
        EXPECT_TRUE(way == 0 || once_cost(**made) == 0);
        continue;
      }
      const ShaderStage vertex{parse_or_fail(shaders::kPositionColorVert), "main", {}};
      const bool fragment = shader.is(".frag");
      const Result<GraphicsPrograms> made =
          build_graphics(fragment ? vertex : stage, fragment ? &stage : nullptr, state, layout);
      ASSERT_TRUE(made.ok()) << shader.name << made.error().message;
      const Program& program = fragment ? *made->fragment : *made->vertex;
      results[way] = fragment ? run_fragments(program) : run_vertices(program, made->output_slots);
      with_once += way == 0 && once_cost(program) > 0;
      EXPECT_TRUE(way == 0 || once_cost(program) == 0);
    }
    if (limits.expired) continue;  // an endless loop: how far it came is not defined
    EXPECT_TRUE(results[0] == results[1]) << shader.name;
  }
  EXPECT_GT(with_once, std::size(kCorpus) / 3);
}

}  // namespace
}  // namespace lapilli
