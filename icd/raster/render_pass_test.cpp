// Whole passes with hand-built programs: order, load and store, several sets of bins, threads.
#include "raster/render_pass.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <random>

#include "raster/scene_fixture.h"

namespace lapilli {
namespace {

struct Pass {
  GraphicsPrograms programs;
  ThreadPool pool;
  Renderer renderer;
  uint32_t width, height;
  std::vector<float> color;
  std::vector<float> depth;
  AttachmentTarget color_target, depth_target;
  VkRect2D area;
  std::vector<std::vector<Vertex>> vertices;  // per draw
  uint64_t samples = 0;
  uint32_t instances = 1;
  bool out_of_time = false;

  Pass(uint32_t w, uint32_t h, unsigned threads, bool with_depth, bool accumulate)
      : pool(threads), renderer(pool), width(w), height(h), color(size_t{w} * h * 4, 0.0f), depth(size_t{w} * h, 1.0f) {
    programs.vertex = vertex_program();
    programs.depth_test = programs.early_depth = programs.depth_write = with_depth;
    programs.depth_compare = with_depth ? VK_COMPARE_OP_LESS : VK_COMPARE_OP_ALWAYS;
    programs.writes_color = true;
    programs.deferrable = !accumulate;
    programs.fragment = fragment_program(programs, accumulate);
    programs.varyings.assign(4, Interpolation::linear);
    programs.output_slots = kSlotVaryings + 4;
    color_target.data = reinterpret_cast<std::byte*>(color.data());
    color_target.format = find_format(VK_FORMAT_R32G32B32A32_SFLOAT);
    color_target.row_pitch = uint64_t{w} * 16;
    if (with_depth) {
      depth_target.data = reinterpret_cast<std::byte*>(depth.data());
      depth_target.format = find_format(VK_FORMAT_D32_SFLOAT);
      depth_target.row_pitch = uint64_t{w} * 4;
    }
    area = {{0, 0}, {w, h}};
  }

  VkResult run() {
    DrawState state;
    state.programs = &programs;
    state.viewport = {0, 0, static_cast<float>(width), static_cast<float>(height), 0, 1};
    state.scissor = {{0, 0}, {width, height}};
    const ResourceTable resources;
    std::vector<std::array<VertexBinding, kMaxVertexBindings>> bindings(vertices.size());
    std::vector<DrawCall> draws(vertices.size());
    for (size_t i = 0; i < draws.size(); ++i) {
      bindings[i][0] = {reinterpret_cast<const std::byte*>(vertices[i].data()), vertices[i].size() * sizeof(Vertex),
                        sizeof(Vertex), false};
      draws[i].state = &state;
      draws[i].bindings = bindings[i].data();
      draws[i].resources = &resources;
      draws[i].count = static_cast<uint32_t>(vertices[i].size());
      draws[i].instance_count = instances;
      draws[i].samples_passed = &samples;
    }
    PassTarget target;
    target.width = width;
    target.height = height;
    target.render_area = area;
    target.color = std::span(&color_target, 1);
    target.depth = depth_target;
    ExecutionLimits limits;
    if (out_of_time) limits.deadline = std::chrono::steady_clock::now();
    return renderer.render(target, draws, limits);
  }
  const float* pixel(uint32_t x, uint32_t y) const { return &color[(size_t{y} * width + x) * 4]; }
};

TEST(RenderPass, LaterTrianglesWinInOneDrawAndBetweenDraws) {
  Pass pass(150, 70, 2, false, false);
  pass.vertices.resize(2);
  add_rectangle(pass.vertices[0], -1, -1, 1, 1, 0, 1);
  add_rectangle(pass.vertices[0], -1, -1, 1, 0, 0, 2);
  add_rectangle(pass.vertices[1], -1, -1, 0, 1, 0, 3);
  ASSERT_EQ(pass.run(), VK_SUCCESS);
  for (uint32_t y = 0; y < 70; ++y) {
    for (uint32_t x = 0; x < 150; ++x) ASSERT_EQ(pass.pixel(x, y)[0], x < 75 ? 3.0f : y < 35 ? 2.0f : 1.0f);
  }
  EXPECT_EQ(pass.samples, 150u * 70 + 150u * 35 + 75u * 70);
}

TEST(RenderPass, DepthKeepsTheNearest) {
  Pass pass(100, 100, 2, true, false);
  pass.vertices.resize(1);
  add_rectangle(pass.vertices[0], -1, -1, 1, 1, 0.5f, 1);
  add_rectangle(pass.vertices[0], -1, -1, 0, 1, 0.75f, 2);  // hidden
  add_rectangle(pass.vertices[0], 0, -1, 1, 1, 0.25f, 3);
  ASSERT_EQ(pass.run(), VK_SUCCESS);
  for (uint32_t x = 0; x < 100; ++x) {
    EXPECT_EQ(pass.pixel(x, 42)[0], x < 50 ? 1.0f : 3.0f);
    EXPECT_EQ(pass.depth[4200 + x], x < 50 ? 0.5f : 0.25f);
  }
}

// 300 layers on the same pixels, added up: a pixel must never be twice in one batch, and nothing may be lost.
TEST(RenderPass, AccumulatesEveryLayer) {
  Pass pass(70, 40, 2, false, true);
  pass.vertices.resize(1);
  for (int i = 0; i < 300; ++i) add_rectangle(pass.vertices[0], -0.03f, -0.06f, 0.03f, 0.06f, 0, 1);
  ASSERT_EQ(pass.run(), VK_SUCCESS);
  double sum = 0;
  for (uint32_t y = 0; y < 40; ++y) {
    for (uint32_t x = 0; x < 70; ++x) {
      const float value = pass.pixel(x, y)[0];
      ASSERT_TRUE(value == 0 || value == 300);
      sum += static_cast<double>(value);
    }
  }
  EXPECT_EQ(sum, 300.0 * static_cast<double>(pass.samples) / 300);
  EXPECT_GT(sum, 0);
}

TEST(RenderPass, RenderAreaBoundsLoadDrawAndStore) {
  for (const VkAttachmentLoadOp load : {VK_ATTACHMENT_LOAD_OP_LOAD, VK_ATTACHMENT_LOAD_OP_CLEAR}) {
    Pass pass(130, 70, 1, false, false);
    std::fill(pass.color.begin(), pass.color.end(), 7.0f);
    pass.color_target.load_op = load;
    pass.color_target.clear.color = {{9, 9, 9, 9}};
    pass.area = {{10, 20}, {110, 30}};
    pass.vertices.resize(1);
    add_rectangle(pass.vertices[0], -1, -1, 0, 1, 0, 5);  // x < 65
    ASSERT_EQ(pass.run(), VK_SUCCESS);
    for (uint32_t y = 0; y < 70; ++y) {
      for (uint32_t x = 0; x < 130; ++x) {
        const bool inside = x >= 10 && x < 120 && y >= 20 && y < 50;
        const float background = inside && load == VK_ATTACHMENT_LOAD_OP_CLEAR ? 9.0f : 7.0f;
        ASSERT_EQ(pass.pixel(x, y)[0], inside && x < 65 ? 5.0f : background) << x << ", " << y;
      }
    }
  }
}

TEST(RenderPass, StoreDontCareLeavesTheImage) {
  Pass pass(64, 64, 1, true, false);
  pass.depth_target.store_op = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  pass.depth_target.load_op = VK_ATTACHMENT_LOAD_OP_CLEAR;
  pass.depth_target.clear.depthStencil.depth = 0.6f;
  pass.vertices.resize(1);
  add_rectangle(pass.vertices[0], -1, -1, 1, 1, 0.5f, 1);
  ASSERT_EQ(pass.run(), VK_SUCCESS);
  EXPECT_EQ(pass.pixel(30, 30)[0], 1.0f);
  EXPECT_EQ(pass.depth[30 * 64 + 30], 1.0f);
}

// More triangles than one set of bins holds: the tiles are stored and loaded in between, in order.
TEST(RenderPass, ManySetsOfBins) {
  Pass pass(64, 64, 2, false, true);
  pass.color_target.load_op = VK_ATTACHMENT_LOAD_OP_CLEAR;
  pass.color_target.clear.color = {{1, 1, 1, 1}};
  pass.vertices.resize(1);
  constexpr int kRectangles = 300000;  // 600,000 triangles
  for (int i = 0; i < kRectangles; ++i) {
    const float x = -1 + 2.0f / 64 * static_cast<float>(i % 64);
    const float y = -1 + 2.0f / 64 * static_cast<float>(i / 64 % 64);
    add_rectangle(pass.vertices[0], x, y, x + 2.0f / 64, y + 2.0f / 64, 0, 1);
  }
  ASSERT_EQ(pass.run(), VK_SUCCESS);
  for (uint32_t i = 0; i < 64 * 64; ++i) {
    const uint32_t layers = kRectangles / 4096 + (i < kRectangles % 4096 ? 1 : 0);
    ASSERT_EQ(pass.color[i * 4], 1.0f + static_cast<float>(layers));
  }
  EXPECT_EQ(pass.samples, static_cast<uint64_t>(kRectangles));
}

// Two vertices make no triangle, however many instances there are.
// A quad that waits for its batch while whole blocks of 200 other triangles are shaded is still shaded with its own.
TEST(RenderPass, PendingQuadsKeepTheirTriangle) {
  Pass pass(16, 8, 1, false, true);
  std::vector<Vertex>& vertices = pass.vertices.emplace_back();
  const auto add = [&](float x, float y, float value) {  // pixels
    vertices.push_back({{x / 8 - 1, y / 4 - 1, 0, 1}, {value, value, value, value}});
  };
  add(2.2f, 2.2f, 1);
  add(2.9f, 2.2f, 1);
  add(2.5f, 3.0f, 1);
  for (int i = 0; i < 200; ++i) {
    add(8, -20, 0.5f);
    add(60, 4, 0.5f);
    add(8, 28, 0.5f);
  }
  ASSERT_EQ(pass.run(), VK_SUCCESS);
  EXPECT_EQ(pass.pixel(2, 2)[0], 1);
  EXPECT_EQ(pass.pixel(12, 4)[0], 100);
  EXPECT_EQ(pass.pixel(3, 2)[0], 0);
}

TEST(RenderPass, TheTimeLimitHoldsOutsideOfShaders) {
  Pass pass(64, 64, 2, false, false);
  add_rectangle(pass.vertices.emplace_back(), 2, 2, 3, 3, 0, 1);  // outside: no shader runs on it
  pass.instances = ~0u;
  pass.out_of_time = true;
  EXPECT_EQ(pass.run(), VK_ERROR_DEVICE_LOST);
}

TEST(RenderPass, DrawsWithoutATriangleCostNothing) {
  Pass pass(8, 8, 1, false, false);
  pass.vertices.resize(1);
  pass.vertices[0].resize(2);
  pass.instances = UINT32_MAX;
  ASSERT_EQ(pass.run(), VK_SUCCESS);
  EXPECT_EQ(pass.samples, 0u);
}

TEST(RenderPass, SameBitsWithAnyNumberOfThreads) {
  std::vector<float> first;
  for (const unsigned threads : {1u, 2u, 7u}) {
    Pass pass(333, 217, threads, true, true);
    std::mt19937 random(5);
    std::uniform_real_distribution<float> coordinate(-1.5f, 1.5f);
    pass.vertices.resize(3);
    for (auto& draw : pass.vertices) {
      for (int i = 0; i < 3 * 2000; ++i) {
        Vertex vertex{};
        for (float& p : vertex.position) p = coordinate(random);
        for (float& c : vertex.color) c = coordinate(random);
        vertex.position[2] = vertex.position[2] * 0.3f + 0.5f;
        vertex.position[3] = vertex.position[3] + 1.3f;
        draw.push_back(vertex);
      }
    }
    ASSERT_EQ(pass.run(), VK_SUCCESS);
    std::vector<float> result = pass.color;
    result.insert(result.end(), pass.depth.begin(), pass.depth.end());
    if (first.empty()) first = result;
    EXPECT_EQ(std::memcmp(first.data(), result.data(), result.size() * sizeof(float)), 0) << threads;
  }
}

}  // namespace
}  // namespace lapilli
