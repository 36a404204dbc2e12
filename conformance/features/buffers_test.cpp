// What shaders read: uniform and storage buffers (static and dynamic offsets), push constants, vertex buffers.
// Specification: "Resource Descriptors", "Fixed-Function Vertex Processing".
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "harness/canvas.h"
#include "harness/compute.h"
#include "harness/descriptors.h"
#include "harness/devices.h"
#include "harness/graphics.h"
#include "shaders/buffers.frag.h"
#include "shaders/buffers.vert.h"
#include "shaders/flat_color.frag.h"
#include "shaders/formats.vert.h"
#include "shaders/instances.vert.h"
#include "shaders/storage_class.comp.h"

namespace lapilli::conformance {
namespace {

using Texel = std::array<float, 4>;
constexpr VkShaderStageFlags kAllStages =
    VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT | VK_SHADER_STAGE_COMPUTE_BIT;

struct StaticBlock {  // std140
  float colors[4][4];
  float matrix[4][4];  // columns
  int32_t index;
  int32_t padding[3];
};
struct Element {  // std430: vec3 a; float b; mat2 c
  float a[3], b, c[4];
};
struct Push {
  float color[4];
  int32_t element;
};

TEST(Buffers, UniformStorageDynamicOffsetsAndPushConstants) {
  StaticBlock block = {};
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 4; ++k) {
      block.colors[i][k] = float(i * 4 + k);
      block.matrix[i][k] = float((i + 1) * (k + 2));
    }
  }
  block.index = 2;
  const VkPhysicalDeviceLimits& limits = subject().properties().limits;
  const VkDeviceSize uniform_step = std::max<VkDeviceSize>(limits.minUniformBufferOffsetAlignment, 16);
  const VkDeviceSize storage_step = std::max<VkDeviceSize>(limits.minStorageBufferOffsetAlignment, 16);
  std::vector<float> dynamic(uniform_step / 4 * 5), moving(storage_step / 4 * 5);
  for (size_t i = 0; i < 5; ++i) {
    for (size_t k = 0; k < 4; ++k) {
      dynamic[i * uniform_step / 4 + k] = float(i + k);
      moving[i * storage_step / 4 + k] = float(i) * 0.5f + float(k) * 0.25f;
    }
  }
  std::vector<std::byte> storage(16 + sizeof(Element) * 6);
  std::array<Element, 6> elements;
  for (size_t i = 0; i < 6; ++i) {
    const float f = float(i);
    elements[i] = {{f, f + 1, f + 2}, f * 3, {f, f * 5, f * 7, f * 11}};
  }
  const uint32_t count = 77;
  std::memcpy(storage.data(), &count, 4);
  std::memcpy(storage.data() + 16, elements.data(), sizeof(elements));

  const samples::Context& c = subject();
  const samples::Buffer static_buffer(c, std::span<const StaticBlock>(&block, 1), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
  const samples::Buffer dynamic_buffer(c, std::span<const float>(dynamic), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
  const samples::Buffer storage_buffer(c, std::span<const std::byte>(storage), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  const samples::Buffer moving_buffer(c, std::span<const float>(moving), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  const std::array<DescriptorSlot, 2> slots0 = {
      {{0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, {static_buffer.get(), 0, VK_WHOLE_SIZE}},
       // The dynamic descriptor itself begins at element 1.
       {1, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, {dynamic_buffer.get(), uniform_step, 16}}}};
  const std::array<DescriptorSlot, 2> slots1 = {
      {{0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, {storage_buffer.get(), 0, VK_WHOLE_SIZE}},
       {3, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC, {moving_buffer.get(), 0, 16}}}};
  const Descriptors set0(c, slots0), set1(c, slots1);
  const std::array<VkDescriptorSetLayout, 2> set_layouts = {set0.layout(), set1.layout()};
  const samples::PipelineLayout layout = create_layout(c, set_layouts, sizeof(Push));
  const Canvas canvas(c, {.width = 8, .height = 1, .color_format = VK_FORMAT_R32G32B32A32_SFLOAT});
  PipelineState state;
  state.vertex_shader = shaders::kBuffersVert;
  state.fragment_shader = shaders::kBuffersFrag;
  state.bindings.clear();
  state.attributes.clear();
  state.layout = layout.get();
  state.render_pass = canvas.render_pass();
  const samples::Pipeline pipeline = create_pipeline(c, state);

  // Six draws, one column each, with other offsets and push constants; descriptors of set 0 stay bound between some.
  VkCommandBuffer commands = c.begin_commands();
  canvas.begin(commands, {});
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
  struct Expected {
    uint32_t dynamic, moving;
    Push push;
  };
  std::vector<Expected> draws;
  for (uint32_t i = 0; i < 6; ++i) {
    const Expected e = {i / 2 % 4, i % 5, {{float(i), 1, 2, float(i) * 2}, int32_t(i)}};
    draws.push_back(e);
    const VkRect2D column = {{int32_t(i), 0}, {1, 1}};
    vkCmdSetScissor(commands, 0, 1, &column);
    if (i % 2 == 0) {
      const VkDescriptorSet sets[] = {set0.get(), set1.get()};
      const uint32_t offsets[] = {uint32_t(e.dynamic * uniform_step), uint32_t(e.moving * storage_step)};
      vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout.get(), 0, 2, sets, 2, offsets);
    } else {
      const VkDescriptorSet set = set1.get();
      const uint32_t offset = uint32_t(e.moving * storage_step);
      vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout.get(), 1, 1, &set, 1, &offset);
    }
    if (i == 0) {
      vkCmdPushConstants(commands, layout.get(), kAllStages, 0, sizeof(Push), &e.push);
    } else {
      // In two parts: a range of its own keeps the rest.
      vkCmdPushConstants(commands, layout.get(), kAllStages, 0, 4, &e.push.color[0]);
      vkCmdPushConstants(commands, layout.get(), kAllStages, 12, 8, &e.push.color[3]);
    }
    vkCmdDraw(commands, 3, 1, 0, 0);
  }
  Canvas::end(commands);
  c.submit_and_wait(commands);
  const auto image = canvas.read_color<Texel>();
  for (size_t i = 0; i < draws.size(); ++i) {
    const Expected& e = draws[i];
    const Element& element = elements[size_t(e.push.element)];
    for (size_t k = 0; k < 4; ++k) {
      double want = 0;
      for (size_t j = 0; j < 4; ++j) want += double(block.matrix[j][k]) * double(block.colors[2][j]);
      want += double(dynamic[(e.dynamic + 1) * uniform_step / 4 + k]) * 10;
      want += double(k == 1 || k == 2 ? float(k) : e.push.color[k]) * 100;
      const double extra = double(element.b + element.c[2]) + 77 + 6;
      want += k < 3 ? double(element.a[k]) : extra;
      want += double(moving[e.moving * storage_step / 4 + k]);
      EXPECT_NEAR(double(image[i][k]), want, 1e-3) << "draw " << i << " component " << k;
    }
  }
}

// R32, R32G32, R32G32B32 and R32G32B32A32 from two bindings with odd strides; missing components are 0, 0, 1.
// VK_KHR_storage_buffer_storage_class and VK_KHR_relaxed_block_layout.
TEST(Buffers, StorageClassOfTheirOwnAndRelaxedLayout) {
  constexpr uint32_t kElements = 64, kWords = 8;
  std::vector<uint32_t> in, want;
  for (uint32_t i = 0; i < kElements; ++i) {
    const uint32_t n = 1000 * (i + 1);
    in.insert(in.end(), {n, n + 1, n + 2, n + 3, 0, n + 4, n + 5, 0});  // words
    want.insert(want.end(), {n + 5, n + 4, n + 3, n + 2, 7, n + 1, n, 7});
  }
  const std::vector<uint32_t> sevens(kElements * kWords, 7);
  const std::vector<Bytes> after =
      run_compute(subject(), {.shader = shaders::kStorageClassComp, .buffers = {to_bytes(in), to_bytes(sevens)}});
  EXPECT_EQ(from_bytes<uint32_t>(after[1]), want);
}

TEST(VertexInput, FloatFormatsStridesAndMissingComponents) {
  std::mt19937 random(1);
  const samples::Context& c = subject();
  struct Packed {
    float scalar, padding, pair[2];
  };
  struct Wide {
    float triple[3], four[4];
  };
  std::vector<Packed> first(192 + 3);
  std::vector<Wide> second(192);
  const auto value = [&] { return float(int(random() % 19) - 9); };
  for (Packed& p : first) p = {value(), 0, {value(), value()}};
  for (Wide& w : second) w = {{value(), value(), value()}, {value(), value(), value(), value()}};
  const samples::Buffer first_buffer(c, std::span<const Packed>(first), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  const samples::Buffer second_buffer(c, std::span<const Wide>(second), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  const Canvas canvas(c, {.width = 8, .height = 8, .color_format = VK_FORMAT_R32G32B32A32_SFLOAT});
  const samples::PipelineLayout layout = create_layout(c);
  PipelineState state;
  state.vertex_shader = shaders::kFormatsVert;
  state.fragment_shader = shaders::kFlatColorFrag;
  state.bindings = {{3, sizeof(Packed), VK_VERTEX_INPUT_RATE_VERTEX}, {1, sizeof(Wide), VK_VERTEX_INPUT_RATE_VERTEX}};
  state.attributes = {{0, 3, VK_FORMAT_R32_SFLOAT, 0},
                      {1, 3, VK_FORMAT_R32G32_SFLOAT, offsetof(Packed, pair)},
                      {2, 1, VK_FORMAT_R32G32B32_SFLOAT, 0},
                      {5, 1, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(Wide, four)}};
  state.layout = layout.get();
  state.render_pass = canvas.render_pass();
  const samples::Pipeline pipeline = create_pipeline(c, state);
  VkCommandBuffer commands = c.begin_commands();
  canvas.begin(commands, {});
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
  const VkBuffer buffers[] = {second_buffer.get(), first_buffer.get()};
  const VkDeviceSize zero = 0, skipped = 3 * sizeof(Packed);
  vkCmdBindVertexBuffers(commands, 1, 1, &buffers[0], &zero);
  vkCmdBindVertexBuffers(commands, 3, 1, &buffers[1], &skipped);
  // In two draws: firstVertex counts for gl_VertexIndex and for the fetch.
  vkCmdDraw(commands, 90, 1, 0, 0);
  vkCmdDraw(commands, 102, 1, 90, 0);
  Canvas::end(commands);
  c.submit_and_wait(commands);
  const auto image = canvas.read_color<Texel>();
  for (size_t pixel = 0; pixel < 64; ++pixel) {
    const Packed& p = first[3 + pixel * 3];  // the provoking vertex
    const Wide& w = second[pixel * 3];
    const Texel want = {p.scalar + 10 * p.pair[0] + 100 * w.triple[0] + 1000 * w.four[0],
                        10 * p.pair[1] + 100 * w.triple[1] + 1000 * w.four[1], 100 * w.triple[2] + 1000 * w.four[2],
                        1 + 10 + 100 + 1000 * w.four[3]};
    EXPECT_EQ(image[pixel], want) << pixel;
  }
}

// Instances: gl_InstanceIndex and attributes that advance per instance, firstInstance included.
TEST(VertexInput, InstancesAndInstanceRate) {
  const samples::Context& c = subject();
  const Canvas canvas(c, {.width = 8, .height = 1, .color_format = VK_FORMAT_R32G32B32A32_SFLOAT});
  const samples::PipelineLayout layout = create_layout(c);
  struct Vertex {
    float position[4];
  };
  const std::vector<Vertex> vertices = {{{-1, -1, 0, 1}}, {{3, -1, 0, 1}}, {{-1, 3, 0, 1}}};
  std::vector<float> colors;
  for (int i = 0; i < 12; ++i) colors.insert(colors.end(), {1, float(i), float(i * i), 1});
  const samples::Buffer vertex_buffer(c, std::span<const Vertex>(vertices), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  const samples::Buffer color_buffer(c, std::span<const float>(colors), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  PipelineState state;
  state.vertex_shader = shaders::kInstancesVert;
  state.fragment_shader = shaders::kFlatColorFrag;
  state.bindings = {{0, 16, VK_VERTEX_INPUT_RATE_VERTEX}, {1, 16, VK_VERTEX_INPUT_RATE_INSTANCE}};
  state.attributes = {{0, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 0}, {1, 1, VK_FORMAT_R32G32B32A32_SFLOAT, 0}};
  state.blend = {VK_TRUE,
                 VK_BLEND_FACTOR_ONE,
                 VK_BLEND_FACTOR_ONE,
                 VK_BLEND_OP_ADD,
                 VK_BLEND_FACTOR_ONE,
                 VK_BLEND_FACTOR_ONE,
                 VK_BLEND_OP_ADD,
                 0xF};
  state.layout = layout.get();
  state.render_pass = canvas.render_pass();
  const samples::Pipeline pipeline = create_pipeline(c, state);
  VkCommandBuffer commands = c.begin_commands();
  canvas.begin(commands, {});
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
  const VkBuffer buffers[] = {vertex_buffer.get(), color_buffer.get()};
  const VkDeviceSize offsets[] = {0, 0};
  vkCmdBindVertexBuffers(commands, 0, 2, buffers, offsets);
  vkCmdDraw(commands, 3, 5, 0, 4);  // instances 4..8
  Canvas::end(commands);
  c.submit_and_wait(commands);
  const auto image = canvas.read_color<Texel>();
  // Sums over i = 4..8 of (1, i, i^2, gl_InstanceIndex).
  for (const Texel& t : image) EXPECT_EQ(t, (Texel{5, 30, 190, 30}));
}

}  // namespace
}  // namespace lapilli::conformance
