// Divergent control flow in all three stages. The functions are one text, compiled by glslang and by this compiler.
#include <gtest/gtest.h>

#include <cstdint>
#include <random>

#include "harness/canvas.h"
#include "harness/compute.h"
#include "harness/devices.h"
#include "harness/graphics.h"
#include "shaders/control_flow.comp.h"
#include "shaders/control_flow.frag.h"
#include "shaders/control_flow.vert.h"
#include "shaders/flat_color.frag.h"
#include "shaders/position_color.vert.h"

namespace lapilli::conformance {
namespace {

namespace glsl {
using uint = uint32_t;
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wimplicit-fallthrough"
#pragma GCC diagnostic ignored "-Wparentheses"
#ifdef __clang__
#pragma GCC diagnostic ignored "-Wlogical-op-parentheses"
#endif
#include "control_flow_body.glsl"
#pragma GCC diagnostic pop
}  // namespace glsl

constexpr uint32_t kFunctions = 13, kMixed = 99;
constexpr VkShaderStageFlags kAllStages =
    VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT | VK_SHADER_STAGE_COMPUTE_BIT;

class ControlFlow : public testing::TestWithParam<uint32_t> {};

TEST_P(ControlFlow, InComputeShaders) {
  std::mt19937 random(GetParam());
  std::vector<uint32_t> inputs;
  // Neighbours that agree, neighbours that differ a little, and noise; no multiple of 64.
  for (uint32_t i = 0; i < 5000; ++i) inputs.push_back(i < 1000 ? i : i < 2000 ? i / 64 : uint32_t(random()));
  ComputeRun run;
  run.shader = shaders::kControlFlowComp;
  run.buffers = {to_bytes(inputs), Bytes(inputs.size() * 4)};
  run.groups[0] = uint32_t((inputs.size() + 63) / 64);
  run.push_constants = to_bytes(std::vector<uint32_t>{GetParam()});
  const std::vector<uint32_t> got = from_bytes<uint32_t>(run_compute(subject(), run)[1]);
  int wrong = 0;
  for (size_t i = 0; i < inputs.size(); ++i) {
    const uint32_t which = GetParam() == kMixed ? (inputs[i] >> 7) % 13 : GetParam();
    const uint32_t want = glsl::flow_dispatch(which, inputs[i]);
    if (got[i] != want && ++wrong <= 3) {
      ADD_FAILURE() << "invocation " << i << ", input " << inputs[i] << ": " << got[i] << " instead of " << want;
    }
  }
  EXPECT_EQ(wrong, 0);
}

// Draws 4096 triangles of one pixel each, or one big triangle; returns the 64 x 64 image.
std::vector<std::array<float, 4>> draw(uint32_t function, bool in_vertex_shader) {
  const Canvas canvas(subject(), {.width = 64, .height = 64, .color_format = VK_FORMAT_R32G32B32A32_SFLOAT});
  const samples::PipelineLayout layout = create_layout(subject(), {}, 4);
  PipelineState state;
  if (in_vertex_shader) {
    state.vertex_shader = shaders::kControlFlowVert;
    state.fragment_shader = shaders::kFlatColorFrag;
    state.bindings.clear();
    state.attributes.clear();
  } else {
    state.vertex_shader = shaders::kPositionColorVert;
    state.fragment_shader = shaders::kControlFlowFrag;
  }
  state.layout = layout.get();
  state.render_pass = canvas.render_pass();
  const samples::Pipeline pipeline = create_pipeline(subject(), state);
  const std::vector<std::array<float, 8>> vertices = {{-1, -1, 0, 1, 7, 1}, {3, -1, 0, 1, 7, 1}, {-1, 3, 0, 1, 7, 1}};
  const samples::Buffer buffer(subject(), std::span<const std::array<float, 8>>(vertices),
                               VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  const VkBuffer vertex_buffer = buffer.get();
  const VkDeviceSize offset = 0;
  VkCommandBuffer commands = subject().begin_commands();
  canvas.begin(commands, {{-5, -5, -5, -5}});
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
  vkCmdPushConstants(commands, layout.get(), kAllStages, 0, 4, &function);
  vkCmdBindVertexBuffers(commands, 0, 1, &vertex_buffer, &offset);
  vkCmdDraw(commands, in_vertex_shader ? 64 * 64 * 3 : 3, 1, 0, 0);
  Canvas::end(commands);
  subject().submit_and_wait(commands);
  return canvas.read_color<std::array<float, 4>>();
}

TEST_P(ControlFlow, InFragmentShadersWithDiscard) {
  const auto image = draw(GetParam(), false);
  int wrong = 0;
  for (uint32_t x = 0; x < 4096; ++x) {
    const uint32_t r = glsl::flow_dispatch(GetParam() == kMixed ? (x >> 2) % 13 : GetParam(), x);
    std::array<float, 4> want = {float(r & 0xFFFF), float(r >> 16), 7, 1};
    if (x % 17 == 3) want = {-5, -5, -5, -5};
    wrong += image[x] != want;
    if (image[x] != want && wrong <= 3) {
      ADD_FAILURE() << "pixel " << x << ": " << image[x][0] << " " << image[x][1] << " instead of " << want[0] << " "
                    << want[1];
    }
  }
  EXPECT_EQ(wrong, 0);
}

TEST_P(ControlFlow, InVertexShaders) {
  const auto image = draw(GetParam(), true);
  int wrong = 0;
  for (uint32_t pixel = 0; pixel < 4096; ++pixel) {
    const uint32_t x = pixel * 3;
    const uint32_t r = glsl::flow_dispatch(GetParam() == kMixed ? (x >> 2) % 13 : GetParam(), x);
    const std::array<float, 4> want = {float(r & 0xFFFF), float(r >> 16), 0, 1};
    wrong += image[pixel] != want;
    if (image[pixel] != want && wrong <= 3) {
      ADD_FAILURE() << "vertex of pixel " << pixel << ": " << image[pixel][0] << " " << image[pixel][1]
                    << " instead of " << want[0] << " " << want[1];
    }
  }
  EXPECT_EQ(wrong, 0);
}

INSTANTIATE_TEST_SUITE_P(Function, ControlFlow, testing::Range(0u, kFunctions));
INSTANTIATE_TEST_SUITE_P(Mixed, ControlFlow, testing::Values(kMixed));

}  // namespace
}  // namespace lapilli::conformance
