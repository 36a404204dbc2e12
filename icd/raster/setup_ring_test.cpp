// Triangles that lie where the one before did share its barycentric coordinates.
#include "raster/setup_ring.h"

#include <gtest/gtest.h>

#include <random>

#include "base/simd_dispatch.h"
#include "raster/scene_fixture.h"

namespace lapilli {
namespace {

// A triangle that lies over all tiles: of the first two the edges are the same, but not w; the third one lies
// elsewhere.
void add_triangle(std::vector<Vertex>& out, int place, const std::array<float, 3>& values) {
  constexpr float kW[3][3] = {{1, 1, 1}, {2, 1, 4}, {1, 1, 1}};
  constexpr float kXY[2][3][2] = {{{-1.25f, -1}, {3, -1}, {-1, 3}}, {{-1, -1.5f}, {3.5f, -1}, {-1.5f, 3}}};
  for (size_t v = 0; v < 3; ++v) {
    const float w = kW[place][v], value = values[v];
    const float* const xy = kXY[place / 2][v];
    out.push_back({{xy[0] * w, xy[1] * w, 0.5f * w, w}, {value, 2 * value, -value, value + 1}});
    if (value == 0) out.back().color[3] = 0;
  }
}

// `apart`: between two layers a triangle that lies elsewhere, and adds nothing.
std::vector<float> draw_layers(bool apart, bool one_draw) {
  ScenePass pass(150, 100, 2);
  std::mt19937 random(11);
  for (const int place : {0, 0, 0, 1, 1, 2, 2, 0, 1, 0, 0, 0}) {
    if (pass.draws.empty() || !one_draw) {
      pass.draws.emplace_back().accumulate = true;
      pass.draws.back().plan.writes_color = true;
      pass.draws.back().plan.depth_compare = VK_COMPARE_OP_ALWAYS;
    }
    std::array<float, 3> values;
    for (float& value : values) value = std::uniform_real_distribution<float>(1, 2)(random);
    add_triangle(pass.draws.back().vertices, place, values);
    if (apart) add_triangle(pass.draws.back().vertices, place == 2 ? 0 : 2, {});
  }
  pass.color_target.load_op = pass.depth_target.load_op = VK_ATTACHMENT_LOAD_OP_LOAD;
  pass.build_draws(false);
  EXPECT_EQ(pass.run(), VK_SUCCESS);
  return pass.color;
}

TEST(SetupRing, LayersInTheSamePlaceKeepTheirBits) {
  const SimdTarget before = simd_target();
  for (const SimdTarget target : supported_simd_targets()) {
    set_simd_target(target);
    for (const bool one_draw : {false, true}) {
      const std::vector<float> apart = draw_layers(true, one_draw);
      EXPECT_GT(apart[0], 12);
      EXPECT_EQ(draw_layers(false, one_draw), apart);
    }
  }
  set_simd_target(before);
}

}  // namespace
}  // namespace lapilli
