// Draws and dispatches whose parameters lie in buffers, and the forms of direct draws. Specification: "Drawing
// Commands", "Dispatching Commands".
#include <gtest/gtest.h>

#include "features/drawing_fixture.h"
#include "shaders/draw_parameters.vert.h"

namespace lapilli::conformance {
namespace {

constexpr uint32_t kRed = 0xFF0000FF, kGreen = 0xFF00FF00, kNothing = 0;
// Three rectangles of 10 x 10 pixels side by side.
constexpr VkRect2D kAreas[] = {{{0, 0}, {10, 10}}, {{10, 0}, {10, 10}}, {{20, 0}, {10, 10}}};

class Draws : public testing::Test {
 protected:
  Canvas canvas{subject(), {.width = 30, .height = 10}};
  FlatPipeline flat{canvas};
  samples::Buffer vertices = make_vertices();

  samples::Buffer make_vertices() const {
    std::vector<ColoredVertex> list;
    add_rectangle(list, canvas, kAreas[0], 0, {1, 0, 0, 1});
    add_rectangle(list, canvas, kAreas[1], 0, {0, 1, 0, 1});
    add_rectangle(list, canvas, kAreas[2], 0, {1, 0, 0, 1});
    return {subject(), std::span<const ColoredVertex>(list), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT};
  }
  template <class T>
  static samples::Buffer buffer_of(const std::vector<T>& values, VkBufferUsageFlags usage) {
    return {subject(), std::span<const T>(values), usage};
  }
  // What the middle of each rectangle holds after `record`.
  template <class Record>
  std::array<uint32_t, 3> draw(Record record) const {
    VkCommandBuffer commands = subject().begin_commands();
    canvas.begin(commands, {});
    flat.bind(commands, vertices);
    record(commands);
    Canvas::end(commands);
    subject().submit_and_wait(commands);
    const auto image = canvas.read_color<uint32_t>();
    return {image[5 * 30 + 5], image[5 * 30 + 15], image[5 * 30 + 25]};
  }
};

TEST_F(Draws, FirstVertexAndCount) {
  EXPECT_EQ(draw([](VkCommandBuffer c) { vkCmdDraw(c, 6, 1, 6, 0); }),
            (std::array<uint32_t, 3>{kNothing, kGreen, kNothing}));
  EXPECT_EQ(draw([](VkCommandBuffer c) {
              vkCmdDraw(c, 0, 1, 0, 0);
              vkCmdDraw(c, 6, 0, 0, 0);
            }),
            (std::array<uint32_t, 3>{kNothing, kNothing, kNothing}));
}

TEST_F(Draws, IndexedWithFirstIndexAndVertexOffset) {
  const auto wide = buffer_of<uint32_t>({99, 0, 1, 2, 3, 4, 5}, VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
  const auto narrow = buffer_of<uint16_t>({99, 12, 13, 14, 15, 16, 17}, VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
  EXPECT_EQ(draw([&](VkCommandBuffer c) {
              vkCmdBindIndexBuffer(c, wide.get(), 4, VK_INDEX_TYPE_UINT32);
              vkCmdDrawIndexed(c, 6, 1, 0, 6, 0);
              vkCmdBindIndexBuffer(c, narrow.get(), 0, VK_INDEX_TYPE_UINT16);
              vkCmdDrawIndexed(c, 6, 1, 1, -12, 0);
            }),
            (std::array<uint32_t, 3>{kRed, kGreen, kNothing}));
}

TEST_F(Draws, Indirect) {
  const auto parameters = buffer_of<VkDrawIndirectCommand>({{1, 1, 0, 0}, {6, 1, 6, 0}, {6, 1, 12, 0}},
                                                           VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT);
  const uint32_t size = sizeof(VkDrawIndirectCommand);
  EXPECT_EQ(draw([&](VkCommandBuffer c) {
              vkCmdDrawIndirect(c, parameters.get(), size, 1, size);
              vkCmdDrawIndirect(c, parameters.get(), 0, 0, size);
            }),
            (std::array<uint32_t, 3>{kNothing, kGreen, kNothing}));
}

TEST_F(Draws, IndexedIndirect) {
  const auto indices = buffer_of<uint32_t>({0, 1, 2, 3, 4, 5}, VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
  const auto parameters =
      buffer_of<VkDrawIndexedIndirectCommand>({{6, 1, 0, 12, 0}}, VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT);
  EXPECT_EQ(draw([&](VkCommandBuffer c) {
              vkCmdBindIndexBuffer(c, indices.get(), 0, VK_INDEX_TYPE_UINT32);
              vkCmdDrawIndexedIndirect(c, parameters.get(), 0, 1, sizeof(VkDrawIndexedIndirectCommand));
            }),
            (std::array<uint32_t, 3>{kNothing, kNothing, kRed}));
}

// gl_BaseVertex, gl_BaseInstance, gl_DrawID and gl_VertexIndex of the provoking vertex, also of draws that differ in
// nothing else.
TEST_F(Draws, ParametersInTheVertexShader) {
  using Texel = std::array<float, 4>;
  const Canvas target(subject(), {.width = 30, .height = 10, .color_format = VK_FORMAT_R32G32B32A32_SFLOAT});
  const samples::PipelineLayout layout = create_layout(subject());
  PipelineState state;
  state.vertex_shader = shaders::kDrawParametersVert;
  state.fragment_shader = shaders::kFlatColorFrag;
  state.layout = layout.get();
  state.render_pass = target.render_pass();
  const samples::Pipeline pipeline = create_pipeline(subject(), state);
  const auto indices = buffer_of<uint32_t>({6, 7, 8, 9, 10, 11}, VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
  const auto plain = buffer_of<VkDrawIndirectCommand>({{6, 1, 0, 0}, {6, 1, 6, 0}, {6, 1, 0, 0}, {6, 1, 12, 9}},
                                                      VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT);
  const auto indexed = buffer_of<VkDrawIndexedIndirectCommand>({{6, 1, 0, -6, 3}, {6, 1, 0, 0, 3}, {6, 1, 0, 6, 3}},
                                                               VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT);
  const auto draw = [&](auto record) {
    VkCommandBuffer commands = subject().begin_commands();
    target.begin(commands, {});
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
    const VkBuffer buffer = vertices.get();
    const VkDeviceSize offset = 0;
    vkCmdBindVertexBuffers(commands, 0, 1, &buffer, &offset);
    vkCmdBindIndexBuffer(commands, indices.get(), 0, VK_INDEX_TYPE_UINT32);
    record(commands);
    Canvas::end(commands);
    subject().submit_and_wait(commands);
    const auto image = target.read_color<Texel>();
    return std::array<Texel, 3>{image[5 * 30 + 4], image[5 * 30 + 14], image[5 * 30 + 24]};
  };
  const auto of_triangle = [](std::array<Texel, 3> texels) {  // which of the two it was does not matter
    for (Texel& texel : texels) texel[3] -= float(int(texel[3]) % 6);
    return texels;
  };
  const auto direct = draw([](VkCommandBuffer c) {
    vkCmdDraw(c, 6, 1, 0, 0);
    vkCmdDraw(c, 6, 1, 6, 7);
    vkCmdDrawIndexed(c, 6, 1, 0, 6, 1);
  });
  EXPECT_EQ(of_triangle(direct), (std::array<Texel, 3>{Texel{0, 0, 0, 0}, {6, 7, 0, 6}, {6, 1, 0, 12}}));
  const auto indirect =
      draw([&](VkCommandBuffer c) { vkCmdDrawIndirect(c, plain.get(), 0, 4, sizeof(VkDrawIndirectCommand)); });
  EXPECT_EQ(of_triangle(indirect), (std::array<Texel, 3>{Texel{0, 0, 2, 0}, {6, 0, 1, 6}, {12, 9, 3, 12}}));
  const auto both = draw([&](VkCommandBuffer c) {
    vkCmdDrawIndexedIndirect(c, indexed.get(), 0, 3, sizeof(VkDrawIndexedIndirectCommand));
  });
  EXPECT_EQ(of_triangle(both), (std::array<Texel, 3>{Texel{-6, 3, 0, 0}, {0, 3, 1, 6}, {6, 3, 2, 12}}));
}

// The parameters are read when the command is executed, not when it is recorded.
TEST_F(Draws, IndirectParametersMayBeWrittenByTheQueue) {
  const samples::Buffer parameters(subject(), sizeof(VkDrawIndirectCommand),
                                   VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  const VkDrawIndirectCommand command = {6, 1, 6, 0};
  VkCommandBuffer commands = subject().begin_commands();
  vkCmdUpdateBuffer(commands, parameters.get(), 0, sizeof(command), &command);
  VkMemoryBarrier barrier = {};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_INDIRECT_COMMAND_READ_BIT;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT, 0, 1, &barrier, 0,
                       nullptr, 0, nullptr);
  canvas.begin(commands, {});
  flat.bind(commands, vertices);
  vkCmdDrawIndirect(commands, parameters.get(), 0, 1, sizeof(command));
  Canvas::end(commands);
  subject().submit_and_wait(commands);
  EXPECT_EQ(canvas.read_color<uint32_t>()[5 * 30 + 15], kGreen);
}

}  // namespace
}  // namespace lapilli::conformance
