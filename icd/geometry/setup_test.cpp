// Setup: facing, culling, edge functions, depth bias, attributes, bins.
#include "geometry/setup.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace lapilli {
namespace {

constexpr PixelRect kArea = {0, 0, 200, 100};

struct Fixture {
  GraphicsPrograms programs;
  DrawState bound;
  uint32_t removed = 0;                                               // TriangleList::removed of the last run
  alignas(64) float outputs[(kSlotVaryings + 4) * kBatchLanes] = {};  // lanes 0..2 are the vertices

  Fixture() {
    bound.programs = &programs;
    bound.viewport = {0, 0, 200, 100, 0, 1};
    bound.scissor = {{0, 0}, {200, 100}};
  }
  void vertex(size_t lane, float x, float y, float z, float w, float varying = 0) {
    const float values[] = {x, y, z, w};
    for (size_t i = 0; i < 4; ++i) outputs[i * kBatchLanes + lane] = values[i];
    outputs[kSlotVaryings * kBatchLanes + lane] = varying;
  }
  BinChunk run() {
    const SetupState state = make_setup_state(bound, kArea);
    BinChunk chunk;
    begin_run(state, 0, chunk);
    ClipInputs inputs;
    append_vertices(state, outputs, 3, chunk, inputs);
    const uint32_t corners[3 + 3 * TriangleList::kPadding] = {0, 1, 2};
    const uint32_t runs[1 + TriangleList::kPadding] = {};
    removed = 0;
    append_triangles(state, {corners, runs, 1, 0, &inputs, &removed}, chunk);
    finish_chunk({4, 2}, chunk);
    return chunk;
  }
};

// The only triangle, ready to be shaded.
TriangleSetup setup_of(const BinChunk& chunk) { return make_triangle_setup(chunk, chunk.triangles[0]); }

// A triangle that is not culled lies where it would without cull distances, and so does what clipping leaves.
TEST(Setup, DistancesMoveNoVertex) {
  for (const bool cull : {false, true}) {
    Fixture f;
    f.vertex(0, -0.3f, -0.7f, 0.1f, 1.1f);
    f.vertex(1, 2.1f, -1.3f, 0.5f, 3.7f);
    f.vertex(2, -0.2f, 0.9f, 1, 1.3f);
    const BinChunk plain = f.run();
    (cull ? f.programs.cull_distances : f.programs.clip_distances) = 1;
    float* const distances = f.outputs + kSlotVaryings * kBatchLanes;
    distances[0] = -1, distances[1] = 3, distances[2] = 2;
    const BinChunk chunk = f.run();
    ASSERT_EQ(chunk.triangles.size(), cull ? 1u : 2u);
    for (size_t v = cull ? 0 : 1; v < 3; ++v) {
      const BinVertex& expected = plain.vertices[v];
      EXPECT_TRUE(std::any_of(chunk.vertices.begin() + 3, chunk.vertices.end(), [&](const BinVertex& got) {
        return got.x == expected.x && got.y == expected.y && got.z == expected.z && got.inverse_w == expected.inverse_w;
      })) << v;
    }
    distances[1] = distances[2] = -1;
    EXPECT_TRUE(f.run().triangles.empty());
  }
}

// Top left, top right, bottom left in clip space: clockwise on the screen.
void clockwise(Fixture& f) {
  f.vertex(0, -1, -1, 0, 1);
  f.vertex(1, 1, -1, 0.5f, 1);
  f.vertex(2, -1, 1, 1, 1);
}

TEST(Setup, FacingAndCulling) {
  for (const VkFrontFace front_face : {VK_FRONT_FACE_CLOCKWISE, VK_FRONT_FACE_COUNTER_CLOCKWISE}) {
    const bool front = front_face == VK_FRONT_FACE_CLOCKWISE;
    for (const VkCullModeFlags cull :
         {VK_CULL_MODE_NONE, VK_CULL_MODE_FRONT_BIT, VK_CULL_MODE_BACK_BIT, VK_CULL_MODE_FRONT_AND_BACK}) {
      Fixture f;
      clockwise(f);
      f.bound.raster.front_face = front_face;
      f.bound.raster.cull_mode = cull;
      const BinChunk chunk = f.run();
      const bool culled = (cull & (front ? VK_CULL_MODE_FRONT_BIT : VK_CULL_MODE_BACK_BIT)) != 0;
      ASSERT_EQ(chunk.triangles.size(), culled ? 0u : 1u);
      if (!culled) {
        EXPECT_EQ(setup_of(chunk).front_facing, front ? ~0u : 0u);
      }
    }
  }
}

TEST(Setup, EdgesSumToTheAreaAndVanishAtVertices) {
  Fixture f;
  clockwise(f);
  const BinChunk chunk = f.run();
  ASSERT_EQ(chunk.triangles.size(), 1u);
  const TriangleSetup setup = setup_of(chunk);
  const double area2 = 200.0 * 256 * 100 * 256;
  EXPECT_EQ(setup.inverse_area2, 1 / area2);
  EXPECT_EQ(setup.edge_c[0] + setup.edge_c[1] + setup.edge_c[2], area2);
  // Vertex 0 is half a pixel up and left of the centre of pixel (0, 0): there E_0 is the area, E_1 and E_2 vanish.
  for (int i = 0; i < 3; ++i) {
    const double at_vertex = setup.edge_c[i] - 0.5 * setup.edge_a[i] - 0.5 * setup.edge_b[i];
    EXPECT_EQ(at_vertex, i == 0 ? area2 : 0);
  }
  EXPECT_EQ(setup.depth.z0, 0);
  EXPECT_DOUBLE_EQ((setup.depth.k1 + setup.depth.k2) * area2, 1.5);
}

TEST(Setup, InvalidPositionsAreDropped) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity()}) {
    for (size_t component = 0; component < 4; ++component) {
      Fixture f;
      clockwise(f);
      f.outputs[component * kBatchLanes + 1] = bad;
      EXPECT_TRUE(f.run().triangles.empty());
    }
  }
}

TEST(Setup, ScissorViewportAndAreaLimitPixels) {
  Fixture f;
  clockwise(f);
  f.bound.scissor = {{10, 20}, {1000, 30}};
  BinChunk chunk = f.run();
  ASSERT_EQ(chunk.triangles.size(), 1u);
  EXPECT_EQ(chunk.triangles[0].x0, 10);
  EXPECT_EQ(chunk.triangles[0].y0, 20);
  EXPECT_EQ(chunk.triangles[0].x1, 200);
  EXPECT_EQ(chunk.triangles[0].y1, 50);
  f.bound.scissor = {{0, 0}, {0, 100}};
  EXPECT_TRUE(f.run().triangles.empty());
  // A triangle larger than the viewport covers pixels with centres in [x, x + width) only.
  f.bound.scissor = {{0, 0}, {200, 100}};
  f.bound.viewport = {10.5f, 20.25f, 50, 40, 0, 1};
  f.vertex(0, -9, -9, 0, 1);
  f.vertex(1, 9, -9, 0, 1);
  f.vertex(2, -9, 99, 0, 1);
  chunk = f.run();
  ASSERT_EQ(chunk.triangles.size(), 1u);
  EXPECT_EQ(chunk.triangles[0].x0, 10);
  EXPECT_EQ(chunk.triangles[0].x1, 60);
  EXPECT_EQ(chunk.triangles[0].y0, 20);
  EXPECT_EQ(chunk.triangles[0].y1, 60);
}

TEST(Setup, DepthBias) {
  Fixture f;
  f.vertex(0, -1, -1, 0.5f, 1);
  f.vertex(1, 1, -1, 0.5f, 1);
  f.vertex(2, -1, 1, 0.75f, 1);  // dz/dy = 0.25 / 100 pixels
  f.bound.raster.depth_bias = true;
  f.bound.raster.depth_bias_slope = 2;
  f.bound.raster.depth_bias_constant = 3;
  BinChunk chunk = f.run();
  ASSERT_EQ(chunk.triangles.size(), 1u);
  // o = m * slope + r * constant, r = 2^(e - 23) with e the exponent of the largest z, 0.75 = 1.5 * 2^-1.
  EXPECT_NEAR(setup_of(chunk).depth.z0, 0.5 + 2 * 0.0025 + 3 * std::ldexp(1.0, -24), 1e-15);
  f.bound.raster.depth_bias_clamp = 0.001f;
  chunk = f.run();
  EXPECT_EQ(setup_of(chunk).depth.z0, 0.5 + static_cast<double>(0.001f));
}

TEST(Setup, FlatVaryingsKeepTheBitsOfTheProvokingVertex) {
  Fixture f;
  clockwise(f);
  f.programs.varyings = {Interpolation::flat, Interpolation::perspective};
  const uint32_t integer = 0xFFFFFFFEu;  // a NaN if taken for a float
  f.outputs[kSlotVaryings * kBatchLanes] = std::bit_cast<float>(integer);
  for (size_t lane = 0; lane < 3; ++lane)
    f.outputs[(kSlotVaryings + 1) * kBatchLanes + lane] = static_cast<float>(lane);
  const BinChunk chunk = f.run();
  ASSERT_EQ(chunk.triangles.size(), 1u);
  float varyings[6];
  make_varying_planes(chunk, chunk.triangles[0], varyings);
  EXPECT_EQ(std::bit_cast<uint32_t>(varyings[0]), integer);
  EXPECT_EQ(varyings[3], 0);
  EXPECT_EQ(varyings[4] + varyings[5], 3);  // differences to vertex 0, in either order
}

// A clipped triangle keeps the values that its plane had.
TEST(Setup, ClippingKeepsTheAttributePlane) {
  Fixture f;
  f.programs.varyings = {Interpolation::perspective};
  f.vertex(0, -1, -1, -0.5f, 1, 1);
  f.vertex(1, 1, -1, 0.5f, 1, 2);
  f.vertex(2, -1, 1, 0.5f, 1, 3);
  const BinChunk chunk = f.run();
  ASSERT_EQ(chunk.triangles.size(), 2u);
  for (const BinTriangle& triangle : chunk.triangles) {
    const TriangleSetup s = make_triangle_setup(chunk, triangle);
    float plane[3];
    make_varying_planes(chunk, triangle, plane);
    for (const auto& [x, y] : {std::pair{20.0, 30.0}, std::pair{150.0, 60.0}}) {
      const double e1 = s.edge_a[1] * x + s.edge_b[1] * y + s.edge_c[1];
      const double e2 = s.edge_a[2] * x + s.edge_b[2] * y + s.edge_c[2];
      const double u = (x + 0.5) / 200;
      const double v = (y + 0.5) / 100;
      EXPECT_NEAR(static_cast<double>(plane[0]) +
                      (e1 * static_cast<double>(plane[1]) + e2 * static_cast<double>(plane[2])) * s.inverse_area2,
                  1 + u + 2 * v, 0.01);  // corners are snapped to 1/256 pixel
      EXPECT_NEAR(s.depth.z0 + e1 * s.depth.k1 + e2 * s.depth.k2, -0.5 + u + v, 0.01);
    }
  }
}

TEST(Setup, TilesListTrianglesInOrder) {
  Fixture f;
  clockwise(f);
  const BinChunk chunk = f.run();
  // 200x100 pixels are 4x2 tiles; the hypotenuse runs from (200, 0) to (0, 100).
  const bool expected[8] = {true, true, true, true, true, true, false, false};
  for (uint32_t tile = 0; tile < 8; ++tile) EXPECT_EQ(chunk.tile(tile).size(), expected[tile] ? 1u : 0u) << tile;
}

}  // namespace
}  // namespace lapilli
