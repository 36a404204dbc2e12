// Deferred shading, early and hierarchical depth against the plain way: every pixel of every triangle shaded and tested
// by its program, in order. Not one bit may differ.
#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <utility>

#include "base/removals.h"
#include "base/simd_dispatch.h"
#include "raster/scene_fixture.h"

namespace lapilli {
namespace {

struct Kept {
  explicit Kept(uint32_t bits) { set_kept_removals(bits); }
  ~Kept() { set_kept_removals(0); }
};
constexpr uint32_t bit_of_removal(Removal removal) { return 1u << static_cast<uint32_t>(removal); }

// Large and small triangles, some of one depth, some steep, in draws of all kinds.
void make_scene(ScenePass& pass, uint32_t seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](float low, float high) { return std::uniform_real_distribution<float>(low, high)(random); };
  const auto pick = [&](uint32_t count) { return std::uniform_int_distribution<uint32_t>(0, count - 1)(random); };
  const uint32_t favourite = pick(8);
  pass.draws.resize(3 + pick(10));
  for (ScenePass::Draw& draw : pass.draws) {
    draw.plan.depth_test = pick(8) != 0;
    draw.plan.early_depth = draw.plan.depth_test && pick(6) != 0;
    draw.plan.depth_compare = VK_COMPARE_OP_ALWAYS;
    if (draw.plan.depth_test) draw.plan.depth_compare = static_cast<VkCompareOp>(pick(2) == 0 ? pick(8) : favourite);
    draw.plan.depth_write = draw.plan.depth_test && pick(4) != 0;
    draw.plan.writes_color = pick(8) != 0;
    draw.accumulate = pick(4) == 0;
    draw.plan.deferrable = draw.plan.writes_color && !draw.accumulate && draw.plan.early_depth == draw.plan.depth_test;
    draw.plan.pixels_alone = draw.plan.deferrable && pick(3) != 0;
    const bool swarm = pick(3) == 0;  // many small ones in few blocks
    const uint32_t triangles = swarm ? 400 : 1 + pick(40);
    const float middle_x = uniform(-1, 1), middle_y = uniform(-1, 1);
    for (uint32_t i = 0; i < triangles; ++i) {
      const float size = swarm ? 0.04f : pick(3) == 0 ? 3.0f : pick(2) == 0 ? 0.3f : 0.03f;
      const float x = swarm ? middle_x + uniform(-0.15f, 0.15f) : uniform(-1, 1);
      const float y = swarm ? middle_y + uniform(-0.15f, 0.15f) : uniform(-1, 1);
      const float level = static_cast<float>(pick(5)) * 0.25f;
      const bool flat = pick(2) == 0;
      for (int v = 0; v < 3; ++v) {
        Vertex vertex{};
        vertex.position[0] = x + uniform(-size, size);
        vertex.position[1] = y + uniform(-size, size);
        vertex.position[2] = flat ? level : uniform(-0.2f, 1.2f);
        vertex.position[3] = 1;
        for (float& c : vertex.color) c = uniform(0, 1);
        draw.vertices.push_back(vertex);
      }
    }
  }
  pass.color_target.load_op = pick(2) == 0 ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_CLEAR;
  pass.depth_target.load_op = pick(2) == 0 ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_CLEAR;
  pass.color_target.clear.color = {{0.25f, 0.5f, 0.75f, 1.0f}};
  pass.depth_target.clear.depthStencil.depth = static_cast<float>(pick(3)) * 0.5f;
  for (float& c : pass.color) c = uniform(0, 1);
  for (float& d : pass.depth) d = static_cast<float>(pick(5)) * 0.25f;
  if (pick(3) == 0) pass.area = {{3, 5}, {pass.width - 10, pass.height - 20}};
}

struct Image {
  std::vector<float> color, depth;
  std::vector<uint64_t> samples;
};

Image render(uint32_t seed, uint32_t width, uint32_t height, unsigned threads, bool in_order) {
  ScenePass pass(width, height, threads);
  make_scene(pass, seed);
  pass.build_draws(in_order);
  EXPECT_EQ(pass.run(), VK_SUCCESS);
  Image image{pass.color, pass.depth, {}};
  for (const ScenePass::Draw& draw : pass.draws) image.samples.push_back(draw.samples);
  return image;
}

void expect_same(const Image& image, const Image& expected, const char* what) {
  EXPECT_EQ(std::memcmp(image.color.data(), expected.color.data(), image.color.size() * sizeof(float)), 0) << what;
  EXPECT_EQ(std::memcmp(image.depth.data(), expected.depth.data(), image.depth.size() * sizeof(float)), 0) << what;
  EXPECT_EQ(image.samples, expected.samples) << what;
}

TEST(Hidden, RandomScenesKeepTheirBits) {
  for (uint32_t seed = 1; seed <= 150; ++seed) {
    SCOPED_TRACE(seed);
    const uint32_t width = 40 + seed * 7 % 150;
    const uint32_t height = 30 + seed * 13 % 120;
    const Image expected = render(seed, width, height, 1, true);
    expect_same(render(seed, width, height, 1, false), expected, "one thread");
    expect_same(render(seed, width, height, 3, false), expected, "three threads");
    for (const uint32_t kept : {bit_of_removal(Removal::hidden), bit_of_removal(Removal::blocks),
                                bit_of_removal(Removal::hidden) | bit_of_removal(Removal::blocks)}) {
      const Kept keep(kept);
      expect_same(render(seed, width, height, 1, false), expected, "kept");
    }
    if (HasFailure()) break;
  }
}

TEST(Hidden, TheSameOnEveryTarget) {
  const SimdTarget before = simd_target();
  for (uint32_t seed = 1000; seed < 1020; ++seed) {
    SCOPED_TRACE(seed);
    const Image expected = render(seed, 150, 90, 1, true);
    for (const SimdTarget target : supported_simd_targets()) {
      ASSERT_TRUE(set_simd_target(target));
      expect_same(render(seed, 150, 90, 1, false), expected, simd_target_name(target));
    }
    set_simd_target(before);
  }
}

// What is hidden is not shaded: 64 layers cost the programs as much as one, and the ledger has the rest.
TEST(Hidden, LayersAreShadedOnce) {
  for (const bool back_to_front : {false, true}) {
    ScenePass pass(128, 96, 2);
    pass.depth_target.load_op = VK_ATTACHMENT_LOAD_OP_CLEAR;
    pass.depth_target.clear.depthStencil.depth = 1;
    pass.draws.resize(64);
    for (size_t i = 0; i < 64; ++i) {
      const size_t layer = back_to_front ? 63 - i : i;
      ScenePass::Draw& draw = pass.draws[i];
      static_cast<FragmentPlan&>(draw.plan) = {true, true, true, VK_COMPARE_OP_LESS, true, true};
      const float z = 0.25f + static_cast<float>(layer) / 128, c = static_cast<float>(layer);
      for (const auto& [x, y] : {std::pair{-1.0f, -1.0f}, {3.0f, -1.0f}, {-1.0f, 3.0f}}) {
        draw.vertices.push_back({{x, y, z, 1}, {c, c, c, c}});
      }
    }
    pass.build_draws(false);
    ASSERT_EQ(pass.run(true), VK_SUCCESS);
    uint64_t hidden = 0, run = 0;
    for (const ScenePass::Draw& draw : pass.draws) {
      hidden += draw.ledger.lines[static_cast<size_t>(Removal::hidden)].count;
      run += draw.ledger.lane_ops_run;
    }
    EXPECT_EQ(hidden, 63u * 128 * 96);
    const GraphicsPrograms& programs = pass.draws[0].programs;
    EXPECT_EQ(run, uint64_t{128} * 96 * lane_cost(*programs.fragment) + uint64_t{64} * 3 * lane_cost(*programs.vertex));
    for (size_t i = 0; i < pass.color.size(); ++i) ASSERT_EQ(pass.color[i], 0.0f);
    for (const ScenePass::Draw& draw : pass.draws) {
      const bool seen = back_to_front || &draw == &pass.draws[0];
      EXPECT_EQ(draw.samples, seen ? 128u * 96 : 0u);
    }
  }
}

}  // namespace
}  // namespace lapilli
