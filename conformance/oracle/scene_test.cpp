// Tests of the scene oracle: depth order, culling, discard and blending on hand-made scenes.
#include "oracle/scene.h"

#include <gtest/gtest.h>

namespace lapilli::oracle {
namespace {

using samples::Attribute;
using samples::Color;
using samples::DrawGeometry;
using samples::SceneGeometry;

// Covers the whole framebuffer at depth z, in one colour.
DrawGeometry full(float z, Color color) {
  DrawGeometry d;
  d.positions = {{-1, -1, z, 1}, {3, -1, z, 1}, {-1, 3, z, 1}};
  d.indices = {0, 1, 2};
  d.depth_test = true;
  d.shade = [color](const double*) { return color; };
  return d;
}

SceneGeometry scene(std::vector<DrawGeometry> draws) {
  SceneGeometry s;
  s.width = s.height = 4;
  s.clear_color = {0.1, 0.2, 0.3, 1};
  s.draws = std::move(draws);
  return s;
}

TEST(SceneOracle, NearerDrawWinsInAnyOrder) {
  const DrawGeometry near = full(0.25f, {1, 0, 0, 1}), far = full(0.75f, {0, 1, 0, 1});
  for (const auto& s : {scene({near, far}), scene({far, near})}) {
    const Expected e = resolve(s);
    for (size_t i = 0; i < 16; ++i) {
      EXPECT_EQ(e.color[i], (Color{1, 0, 0, 1}));
      EXPECT_EQ(e.depth[i], 0.25);
      EXPECT_FALSE(e.either[i]);
    }
  }
}

TEST(SceneOracle, EqualDepthIsUndecided) {
  const Expected e = resolve(scene({full(0.5f, {1, 0, 0, 1}), full(0.5f, {0, 1, 0, 1})}));
  EXPECT_TRUE(e.either[5]);
}

TEST(SceneOracle, CulledAndDiscardedLeaveTheClearColour) {
  DrawGeometry culled = full(0.5f, {1, 1, 1, 1});
  culled.cull_back_faces = true;  // full() turns clockwise
  DrawGeometry discarded = full(0.5f, {1, 1, 1, 1});
  discarded.shade = [](const double*) { return std::nullopt; };
  const Expected e = resolve(scene({culled, discarded}));
  EXPECT_FALSE(e.covered(1, 1));
  EXPECT_EQ(e.color[0], (Color{0.1, 0.2, 0.3, 1}));
  EXPECT_EQ(e.depth[0], 1.0);
}

TEST(SceneOracle, BlendingReadsTheRoundedColour) {
  DrawGeometry d = full(0.5f, {1, 0, 0, 0.5});
  d.blend = true;
  const Expected e = resolve(scene({d}));
  EXPECT_NEAR(e.color[3][0], 0.5 + 0.5 * 26.0 / 255.0, 1e-12);  // 0.1 * 255 = 25.5 rounds to even
  EXPECT_NEAR(e.color[3][3], 1.0, 1e-12);
}

TEST(SceneOracle, ComparisonFindsTheWorstPixel) {
  const SceneGeometry s = scene({full(0.25f, {1, 0, 0, 1})});
  const Expected e = resolve(s);
  std::vector<uint8_t> image;
  for (int i = 0; i < 16; ++i) image.insert(image.end(), {255, 0, 0, 255});
  EXPECT_EQ(compare_color(e, image).max_abs, 0);
  image[4 * 6 + 1] = 51;
  const ImageError error = compare_color(e, image);
  EXPECT_NEAR(error.max_abs, 0.2, 1e-12);
  EXPECT_EQ(error.x, 2);
  EXPECT_EQ(error.y, 1);
  EXPECT_EQ(error.channel, 1);
  EXPECT_EQ(error.beyond, 1);
  EXPECT_EQ(error.compared, 16);
  std::vector<float> depth(16, 0.25f);
  depth[9] = 0.5f;
  EXPECT_EQ(compare_depth(e, depth).beyond, 1);
}

}  // namespace
}  // namespace lapilli::oracle
