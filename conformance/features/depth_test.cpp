// Depth test: compare operations, writes, the viewport's depth range, discard and exported depth. Specification:
// "Fragment Operations", Depth Test.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "harness/canvas.h"
#include "harness/devices.h"
#include "harness/graphics.h"
#include "oracle/interpolate.h"
#include "shaders/depth_export.frag.h"
#include "shaders/discard_checker.frag.h"
#include "shaders/flat_color.frag.h"
#include "shaders/position_color.vert.h"
#include "shaders/sample_mask.frag.h"

namespace lapilli::conformance {
namespace {

struct Vertex {
  float position[4];
  float color[4];
};

constexpr uint32_t kSide = 32;
constexpr uint32_t kBlack = 0, kDrawn = 0xFFFFFFFF;

// Covers the viewport at depth z.
std::vector<Vertex> layer(float z) {
  std::vector<Vertex> out;
  for (const auto& [x, y] : {std::pair{-1.f, -1.f}, {3.f, -1.f}, {-1.f, 3.f}}) {
    out.push_back({{x, y, z, 1}, {1, 1, 1, 1}});
  }
  return out;
}

struct Result {
  std::vector<uint32_t> color;
  std::vector<float> depth;
};

Result draw(const std::vector<Vertex>& vertices, PipelineState state, float clear_depth, const VkViewport* viewport) {
  const Canvas canvas(subject(), {.width = kSide, .height = kSide, .depth = true});
  const samples::PipelineLayout layout = create_layout(subject());
  if (state.vertex_shader.empty()) state.vertex_shader = shaders::kPositionColorVert;
  if (state.fragment_shader.empty()) state.fragment_shader = shaders::kFlatColorFrag;
  state.layout = layout.get();
  state.render_pass = canvas.render_pass();
  const samples::Pipeline pipeline = create_pipeline(subject(), state);
  const samples::Buffer buffer(subject(), std::span<const Vertex>(vertices), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  VkCommandBuffer commands = subject().begin_commands();
  canvas.begin(commands, {}, clear_depth);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
  if (viewport != nullptr) vkCmdSetViewport(commands, 0, 1, viewport);
  const VkBuffer vertex_buffer = buffer.get();
  const VkDeviceSize offset = 0;
  vkCmdBindVertexBuffers(commands, 0, 1, &vertex_buffer, &offset);
  vkCmdDraw(commands, uint32_t(vertices.size()), 1, 0, 0);
  Canvas::end(commands);
  subject().submit_and_wait(commands);
  return {canvas.read_color<uint32_t>(), canvas.read_depth()};
}

bool passes(VkCompareOp op, float fragment, float stored) {
  switch (op) {
    case VK_COMPARE_OP_NEVER:
      return false;
    case VK_COMPARE_OP_LESS:
      return fragment < stored;
    case VK_COMPARE_OP_EQUAL:
      return fragment == stored;
    case VK_COMPARE_OP_LESS_OR_EQUAL:
      return fragment <= stored;
    case VK_COMPARE_OP_GREATER:
      return fragment > stored;
    case VK_COMPARE_OP_NOT_EQUAL:
      return fragment != stored;
    case VK_COMPARE_OP_GREATER_OR_EQUAL:
      return fragment >= stored;
    default:
      return true;
  }
}

TEST(DepthTest, AllCompareOperationsWithAndWithoutWrites) {
  for (int op = VK_COMPARE_OP_NEVER; op <= VK_COMPARE_OP_ALWAYS; ++op) {
    for (const bool write : {false, true}) {
      for (const float z : {0.0f, 0.25f, 0.5f, 0.75f, 1.0f}) {
        PipelineState state;
        state.depth_test = true;
        state.depth_write = write;
        state.depth_compare = VkCompareOp(op);
        const Result r = draw(layer(z), state, 0.5f, nullptr);
        const bool pass = passes(VkCompareOp(op), z, 0.5f);
        for (size_t i = 0; i < r.color.size(); ++i) {
          ASSERT_EQ(r.color[i], pass ? kDrawn : kBlack) << "op " << op << " z " << z;
          ASSERT_EQ(r.depth[i], pass && write ? z : 0.5f) << "op " << op << " z " << z << " write " << write;
        }
      }
    }
  }
}

TEST(DepthTest, DisabledTestNeitherRejectsNorWrites) {
  PipelineState state;
  state.depth_test = false;
  state.depth_write = true;  // has no effect without the test
  state.depth_compare = VK_COMPARE_OP_NEVER;
  const Result r = draw(layer(0.75f), state, 0.5f, nullptr);
  for (size_t i = 0; i < r.color.size(); ++i) {
    ASSERT_EQ(r.color[i], kDrawn);
    ASSERT_EQ(r.depth[i], 0.5f);
  }
}

// z_f = z_d * (maxDepth - minDepth) + minDepth, also reversed.
TEST(DepthTest, ViewportDepthRange) {
  for (const auto& [low, high] : {std::pair{0.25f, 0.75f}, {0.75f, 0.25f}, {0.5f, 0.5f}, {1.0f, 0.0f}}) {
    for (const float z : {0.0f, 0.5f, 1.0f}) {
      PipelineState state;
      state.depth_test = state.depth_write = true;
      state.depth_compare = VK_COMPARE_OP_ALWAYS;
      const VkViewport viewport = {0, 0, kSide, kSide, low, high};
      const Result r = draw(layer(z), state, 1, &viewport);
      ASSERT_EQ(r.depth[5 * kSide + 7], z * (high - low) + low) << low << " " << high << " " << z;
    }
  }
}

TEST(DepthTest, InterpolatedDepthIsAffineOnTheScreenAndPreciseToAMillionth) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> xy(-1.2f, 1.2f), depth(0, 1), weight(0.2f, 5);
  PipelineState state;
  state.depth_test = state.depth_write = true;
  oracle::RasterState raster;
  raster.viewport = {0, 0, kSide, kSide, 0, 1};
  raster.scissor = {0, 0, kSide, kSide};
  int compared = 0;
  double worst = 0;
  for (int round = 0; round < 40; ++round) {
    oracle::Triangle t;
    std::vector<Vertex> vertices;
    for (oracle::ClipVertex& v : t) {
      const float w = weight(random);
      v = {xy(random) * w, xy(random) * w, depth(random) * w, w};
      vertices.push_back({{v.x, v.y, v.z, v.w}, {1, 1, 1, 1}});
    }
    const Result r = draw(vertices, state, 1, nullptr);
    const oracle::TriangleCoverage c = oracle::cover(t, raster);
    for (int y = 0; y < int(kSide); ++y) {
      for (int x = 0; x < int(kSide); ++x) {
        const size_t at = size_t(y) * kSide + size_t(x);
        if (c.at(x, y) != oracle::Coverage::kInside || r.color[at] == kBlack) continue;
        const double want = oracle::interpolate(t, raster, oracle::Positions::kSnapped, x + 0.5, y + 0.5).depth;
        worst = std::max(worst, std::abs(want - double(r.depth[at])));
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 1000);
  // lavapipe: up to 1e-2 (planes from unsnapped vertices, anchored at (0, 0), for triangles seen nearly edge-on).
  EXPECT_LE(worst, 2e-7);
  RecordProperty("worst", std::to_string(worst));
}

void expect_checker(std::span<const uint32_t> fragment_shader) {
  PipelineState state;
  state.depth_test = state.depth_write = true;
  state.fragment_shader = fragment_shader;
  const Result r = draw(layer(0.25f), state, 1, nullptr);
  for (uint32_t y = 0; y < kSide; ++y) {
    for (uint32_t x = 0; x < kSide; ++x) {
      const bool kept = (x + y) % 2 == 0;
      ASSERT_EQ(r.color[y * kSide + x], kept ? kDrawn : kBlack);
      ASSERT_EQ(r.depth[y * kSide + x], kept ? 0.25f : 1.0f);
    }
  }
}

TEST(DepthTest, DiscardedFragmentsLeaveDepthAndColour) { expect_checker(shaders::kDiscardCheckerFrag); }

// A fragment whose only sample is not in gl_SampleMask.
TEST(DepthTest, MaskedFragmentsLeaveDepthAndColour) { expect_checker(shaders::kSampleMaskFrag); }

// gl_FragDepth replaces the interpolated depth before the test; the shader writes x / 32.
TEST(DepthTest, ExportedDepthIsTestedAndWritten) {
  PipelineState state;
  state.depth_test = state.depth_write = true;
  state.fragment_shader = shaders::kDepthExportFrag;
  const Result r = draw(layer(0.9f), state, 0.5f, nullptr);
  for (uint32_t y = 0; y < kSide; ++y) {
    for (uint32_t x = 0; x < kSide; ++x) {
      const float exported = (float(x) + 0.5f) / 32;
      ASSERT_EQ(r.color[y * kSide + x], exported < 0.5f ? kDrawn : kBlack) << x;
      ASSERT_EQ(r.depth[y * kSide + x], std::min(exported, 0.5f)) << x;
    }
  }
}

// Overlapping triangles of one draw are tested in order, pixel by pixel.
TEST(DepthTest, OrderWithinADraw) {
  std::vector<Vertex> vertices;
  const float depths[] = {0.5f, 0.75f, 0.25f, 0.25f, 0.4f};
  for (size_t i = 0; i < 5; ++i) {
    for (Vertex v : layer(depths[i])) {
      v.color[0] = float(i + 1) / 255;
      vertices.push_back(v);
    }
  }
  const struct {
    VkCompareOp op;
    uint32_t winner;  // counted from 1
    float depth;
  } cases[] = {
      {VK_COMPARE_OP_LESS, 3, 0.25f}, {VK_COMPARE_OP_LESS_OR_EQUAL, 4, 0.25f}, {VK_COMPARE_OP_ALWAYS, 5, 0.4f}};
  for (const auto& c : cases) {
    PipelineState state;
    state.depth_test = state.depth_write = true;
    state.depth_compare = c.op;
    const Result r = draw(vertices, state, 1, nullptr);
    for (size_t i = 0; i < r.color.size(); ++i) {
      ASSERT_EQ(r.color[i] & 0xFF, c.winner) << c.op;
      ASSERT_EQ(r.depth[i], c.depth);
    }
  }
}

}  // namespace
}  // namespace lapilli::conformance
