// What the scenes promise without a device: exact vertices, a closed mesh, and geometry that an oracle can use.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <tuple>
#include <utility>

#include "scenes/exact_transform.h"
#include "scenes/mesh.h"
#include "scenes/scene.h"
#include "scenes/triangle_blit.h"

namespace lapilli::samples {
namespace {

TEST(ExactTransform, GivesTheSameBitsInEveryOrderFusedOrNot) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> matrix_steps(-3000, 3000);  // below 1.5
  std::uniform_int_distribution<int> position_steps(-1200, 1200);
  for (int i = 0; i < 1000; ++i) {
    glm::mat4 matrix;
    for (int k = 0; k < 16; ++k) matrix[k / 4][k % 4] = static_cast<float>(matrix_steps(random)) * kMatrixStep;
    const auto coordinate = [&] { return static_cast<float>(position_steps(random)) * kPositionStep; };
    const glm::vec3 p = {coordinate(), coordinate(), coordinate()};
    const Position result = exact_transform(matrix, p);
    for (int row = 0; row < 4; ++row) {
      const float a = matrix[0][row], b = matrix[1][row], c = matrix[2][row], d = matrix[3][row];
      const float r = result[static_cast<size_t>(row)];
      EXPECT_EQ(r, std::fma(c, p.z, std::fma(b, p.y, std::fma(a, p.x, d))));
      EXPECT_EQ(r, (a * p.x + b * p.y) + (c * p.z + d));
      EXPECT_EQ(r, ((d + c * p.z) + b * p.y) + a * p.x);
      EXPECT_EQ(static_cast<double>(r),
                double{a} * double{p.x} + double{b} * double{p.y} + double{c} * double{p.z} + double{d});
    }
  }
}

TEST(ExactTransform, RefusesWhatCouldBeRounded) {
  EXPECT_THROW(exact_transform(glm::mat4(1.0f), {0.1f, 0, 0}), std::logic_error);
  EXPECT_THROW(exact_transform(glm::mat4(0.1f), {0.5f, 0, 0}), std::logic_error);
  EXPECT_THROW(exact_transform(glm::mat4(4.0f), {2.0f + kPositionStep, 0, 0}), std::logic_error);
  EXPECT_NO_THROW(exact_transform(glm::mat4(1.0f), {0.5f, 0, 0}));
}

using Corner = std::tuple<float, float, float>;

Corner corner(const glm::vec3& p) { return {p.x, p.y, p.z}; }

TEST(TorusKnot, IsClosedAndTurnsOutwards) {
  const Mesh mesh = torus_knot(180, 12);
  EXPECT_EQ(mesh.indices.size() / 3, 4320u);
  // In a closed, consistently wound surface each directed edge is there once, and once the other way.
  std::map<std::pair<Corner, Corner>, int> edges;
  double volume = 0;
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    const glm::vec3 a = mesh.vertices[mesh.indices[i]].position;
    const glm::vec3 b = mesh.vertices[mesh.indices[i + 1]].position;
    const glm::vec3 c = mesh.vertices[mesh.indices[i + 2]].position;
    ++edges[{corner(a), corner(b)}];
    ++edges[{corner(b), corner(c)}];
    ++edges[{corner(c), corner(a)}];
    volume += static_cast<double>(glm::dot(a, glm::cross(b, c))) / 6.0;
  }
  EXPECT_EQ(edges.size(), mesh.indices.size());
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
  EXPECT_GT(volume, 0.0);
}

TEST(TorusKnot, EachFaceHasAProvokingVertexOfItsOwn) {
  const Mesh mesh = torus_knot(24, 6);
  std::map<uint32_t, int> first;
  for (size_t i = 0; i < mesh.indices.size(); i += 3) ++first[mesh.indices[i]];
  EXPECT_EQ(first.size(), mesh.indices.size() / 3);
}

TEST(Scenes, DescribeThemselvesCompletely) {
  for (const SceneEntry& entry : scenes()) {
    for (const float angle : {0.0f, 1.0f, 2.5f, 4.0f}) {
      SCOPED_TRACE(std::string(entry.name) + " at " + std::to_string(angle));
      const SceneGeometry geometry = entry.create({320, 200, angle})->geometry();
      EXPECT_EQ(geometry.width, 320u);
      EXPECT_EQ(geometry.height, 200u);
      ASSERT_FALSE(geometry.draws.empty());
      for (const DrawGeometry& draw : geometry.draws) {
        ASSERT_FALSE(draw.indices.empty());
        EXPECT_EQ(draw.indices.size() % 3, 0u);
        for (const uint32_t index : draw.indices) ASSERT_LT(index, draw.positions.size());
        for (const Attribute& attribute : draw.attributes) {
          EXPECT_EQ(attribute.values.size(), draw.positions.size() * attribute.components);
        }
        EXPECT_TRUE(draw.shade != nullptr);
      }
    }
  }
}

TEST(Scenes, RefuseUnknownNames) { EXPECT_THROW(create_scene("teapot", {}), std::runtime_error); }

TEST(TriangleBlit, RefusesADegenerateSource) {
  TriangleBlitOptions blit;
  blit.source = {{{10, 10}, {20, 20}, {30, 30}}};
  EXPECT_THROW(create_triangle_blit({}, blit), std::invalid_argument);
}

}  // namespace
}  // namespace lapilli::samples
