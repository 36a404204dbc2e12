// Clip and cull distances against half-planes of the picture. Specification: "Fixed-Function Vertex Post-Processing",
// Primitive Clipping.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "features/drawing_fixture.h"
#include "oracle/interpolate.h"
#include "shaders/distances.frag.h"
#include "shaders/distances.vert.h"

namespace lapilli::conformance {
namespace {

constexpr int kSide = 64;
constexpr int kClipPlanes = 5, kCullPlanes = 3;
using Plane = std::array<float, 4>;
constexpr Plane kEverywhere = {0, 0, 0, 1};  // w: positive in all vertices here

struct Push {
  std::array<Plane, kClipPlanes + kCullPlanes> planes;
  int32_t first = 0;
  Push() { planes.fill(kEverywhere); }
};

template <class Texel>
std::vector<Texel> draw(const Context& context, const Push& push, const std::vector<ColoredVertex>& vertices,
                        const std::vector<uint32_t>& indices, VkFormat format, bool reads_distances) {
  const Canvas canvas(context, {.width = kSide, .height = kSide, .color_format = format});
  const samples::PipelineLayout layout = create_layout(context, {}, sizeof(Push));
  PipelineState state;
  state.vertex_shader = shaders::kDistancesVert;
  state.fragment_shader =
      reads_distances ? std::span<const uint32_t>(shaders::kDistancesFrag) : shaders::kFlatColorFrag;
  state.layout = layout.get();
  state.render_pass = canvas.render_pass();
  if (!reads_distances) {  // count
    state.blend.blendEnable = VK_TRUE;
    state.blend.dstColorBlendFactor = state.blend.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
  }
  const samples::Pipeline pipeline = create_pipeline(context, state);
  const samples::Buffer buffer(context, std::span<const ColoredVertex>(vertices), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  const samples::Buffer index_buffer(context, std::span<const uint32_t>(indices), VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
  VkCommandBuffer commands = context.begin_commands();
  canvas.begin(commands, {});
  const VkBuffer vertex_buffer = buffer.get();
  const VkDeviceSize offset = 0;
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
  vkCmdPushConstants(commands, layout.get(),
                     VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT | VK_SHADER_STAGE_COMPUTE_BIT, 0,
                     sizeof(Push), &push);
  vkCmdBindVertexBuffers(commands, 0, 1, &vertex_buffer, &offset);
  vkCmdBindIndexBuffer(commands, index_buffer.get(), 0, VK_INDEX_TYPE_UINT32);
  vkCmdDrawIndexed(commands, static_cast<uint32_t>(indices.size()), 1, 0, 0, 0);
  Canvas::end(commands);
  context.submit_and_wait(commands);
  return canvas.read_color<Texel>();
}

// How often each pixel was drawn.
std::vector<uint32_t> count(const Context& context, const Push& push, const std::vector<ColoredVertex>& vertices,
                            const std::vector<uint32_t>& indices) {
  auto image = draw<uint32_t>(context, push, vertices, indices, VK_FORMAT_R8G8B8A8_UNORM, false);
  for (uint32_t& pixel : image) pixel &= 0xFF;
  return image;
}

ColoredVertex vertex(float x, float y, float z, float w) { return {x * w, y * w, z * w, w, 1.0f / 255, 0, 0, 0}; }

// Covers the canvas and more, in crooked cells; each vertex at a w of its own.
void make_mesh(std::mt19937& random, std::vector<ColoredVertex>& vertices, std::vector<uint32_t>& indices) {
  constexpr uint32_t kCells = 9;
  std::uniform_real_distribution<float> shift(-0.08f, 0.08f), depth(0, 1), weight(0.3f, 4);
  for (uint32_t y = 0; y <= kCells; ++y) {
    for (uint32_t x = 0; x <= kCells; ++x) {
      const float at_x = float(x) / kCells * 2.4f - 1.2f, at_y = float(y) / kCells * 2.4f - 1.2f;
      vertices.push_back(vertex(at_x + shift(random), at_y + shift(random), depth(random), weight(random)));
    }
  }
  for (uint32_t y = 0; y < kCells; ++y) {
    for (uint32_t x = 0; x < kCells; ++x) {
      const uint32_t corner = y * (kCells + 1) + x;
      for (const uint32_t each : {0u, 1u, kCells + 1, kCells + 1, 1u, kCells + 2}) indices.push_back(corner + each);
    }
  }
}

// Where the plane, which has no z, has the pixel's centre: -1 or 1, and 0 if an edge moved by `slack` pixels decides.
int side_of(const Plane& plane, int x, int y, double slack) {
  const double value = double(plane[0]) * ((x + 0.5) / kSide * 2 - 1) + double(plane[1]) * ((y + 0.5) / kSide * 2 - 1) +
                       double(plane[3]);
  const double pixel = std::hypot(double(plane[0]), double(plane[1])) * 2 / kSide;
  if (std::abs(value) <= pixel * slack) return 0;
  return value < 0 ? -1 : 1;
}

// A mesh is cut where the planes are: neither gaps nor overlaps between cut triangles and their neighbours.
TEST(Distances, ClipAMesh) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> slope(-1, 1), offset(-0.4f, 0.8f);
  int inside = 0, outside = 0;
  for (int round = 0; round < 40; ++round) {
    std::vector<ColoredVertex> vertices;
    std::vector<uint32_t> indices;
    make_mesh(random, vertices, indices);
    Push push;
    push.first = round & 3;
    for (int i = 0; i <= round % kClipPlanes; ++i) {
      push.planes[size_t(i + round) % kClipPlanes] = {slope(random), slope(random), 0, offset(random)};
    }
    for (const Context* context : {&subject(), peer()}) {
      if (context == nullptr || (context == peer() && round >= 8)) continue;
      const std::vector<uint32_t> image = count(*context, push, vertices, indices);
      for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
          int side = 1;
          for (int i = 0; i < kClipPlanes; ++i) side = std::min(side, side_of(push.planes[size_t(i)], x, y, 1.0 / 64));
          const uint32_t got = image[size_t(y) * kSide + size_t(x)];
          if (context != &subject() && (got == 2 || side == 0)) continue;  // lavapipe overlaps itself here and there
          if (side == 0) {
            EXPECT_LE(got, 1u) << "round " << round << " " << x << "," << y;
          } else {
            EXPECT_EQ(got, side > 0 ? 1u : 0u) << "round " << round << " " << x << "," << y;
          }
          ++(side > 0 ? inside : outside);
        }
      }
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(inside, 10000);
  EXPECT_GT(outside, 10000);
}

// A triangle goes if all its vertices are on the wrong side of one plane, and stays whole otherwise.
TEST(Distances, CullTriangles) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> slope(-1, 1), offset(-0.1f, 0.6f);
  int kept = 0, culled = 0;
  for (int round = 0; round < 20; ++round) {
    std::vector<ColoredVertex> vertices;
    std::vector<uint32_t> indices;
    make_mesh(random, vertices, indices);
    Push push;
    for (int i = 0; i <= round % kCullPlanes; ++i) {
      push.planes[size_t(kClipPlanes + i)] = {slope(random), slope(random), slope(random), offset(random)};
    }
    const std::vector<uint32_t> image = count(subject(), push, vertices, indices);
    std::vector<uint32_t> expected(image.size());
    for (size_t t = 0; t < indices.size(); t += 3) {
      oracle::Triangle triangle;
      bool goes = false;
      for (size_t plane = kClipPlanes; plane < push.planes.size(); ++plane) {
        bool all = true;
        for (size_t v = 0; v < 3; ++v) {
          const ColoredVertex& at = vertices[indices[t + v]];
          triangle[v] = {at[0], at[1], at[2], at[3]};
          double distance = 0;
          for (size_t c = 0; c < 4; ++c) distance += double(push.planes[plane][c]) * double(at[c]);
          all = all && distance < 0;
        }
        goes = goes || all;
      }
      ++(goes ? culled : kept);
      if (goes) continue;
      const oracle::TriangleCoverage covered =
          oracle::cover(triangle, {.viewport = {0, 0, kSide, kSide, 0, 1}, .scissor = {0, 0, kSide, kSide}});
      for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x)
          expected[size_t(y) * kSide + size_t(x)] += covered.at(x, y) == oracle::Coverage::kInside;
      }
    }
    EXPECT_EQ(image, expected) << "round " << round;
  }
  EXPECT_GT(kept, 500);
  EXPECT_GT(culled, 100);
}

// In the fragment shader distances are interpolated like other inputs, also between points made by clipping.
TEST(Distances, AreInputsOfTheFragmentShader) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> xy(-1.2f, 1.2f), depth(0, 1), weight(0.3f, 4), slope(-1, 1),
      offset(-0.2f, 0.8f);
  const oracle::RasterState state = {.viewport = {0, 0, kSide, kSide, 0, 1}, .scissor = {0, 0, kSide, kSide}};
  using Texel = std::array<float, 4>;
  int checked = 0;
  for (int round = 0; round < 40; ++round) {
    std::vector<ColoredVertex> vertices;
    oracle::Triangle triangle;
    for (oracle::ClipVertex& v : triangle) {
      vertices.push_back(vertex(xy(random), xy(random), depth(random), weight(random)));
      v = {vertices.back()[0], vertices.back()[1], vertices.back()[2], vertices.back()[3]};
    }
    Push push;
    push.first = round % kClipPlanes;
    for (int i = 0; i < kClipPlanes; ++i) push.planes[size_t(i)] = {slope(random), slope(random), 0, offset(random)};
    for (size_t i = 0; i < kCullPlanes; ++i) push.planes[kClipPlanes + i] = {slope(random), slope(random), 0, 3};
    const auto image = draw<Texel>(subject(), push, vertices, {0, 1, 2}, VK_FORMAT_R32G32B32A32_SFLOAT, true);
    const oracle::TriangleCoverage covered = oracle::cover(triangle, state);
    const size_t shown[] = {size_t(push.first), kClipPlanes + size_t(push.first) % kCullPlanes, 0, 7};
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        int side = 1;
        for (int i = 0; i < kClipPlanes; ++i) side = std::min(side, side_of(push.planes[size_t(i)], x, y, 1.0 / 64));
        const bool sure = std::abs(oracle::edge_distance(triangle, state, x, y)) > 1.0 / 64;
        if (covered.at(x, y) != oracle::Coverage::kInside || side <= 0 || !sure) continue;
        ++checked;
        for (size_t c = 0; c < 4; ++c) {
          const auto at = [&](double px, double py) {
            const oracle::Weights w = oracle::interpolate(triangle, state, oracle::Positions::kExact, px, py);
            double sum = 0;
            for (size_t v = 0; v < 3; ++v) {
              for (size_t k = 0; k < 4; ++k)
                sum += w.perspective[v] * double(push.planes[shown[c]][k]) * double(vertices[v][k]);
            }
            return sum;
          };
          const double here = at(x + 0.5, y + 0.5);
          double slack = 4e-6;
          for (const auto& [dx, dy] : {std::pair{1.0, 0.0}, {-1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}})
            slack = std::max(slack, 2 * std::abs(at(x + 0.5 + dx / 128, y + 0.5 + dy / 128) - here));
          EXPECT_NEAR(double(image[size_t(y) * kSide + size_t(x)][c]), here, slack)
              << "round " << round << " " << x << "," << y << " " << c;
        }
      }
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(checked, 2000);
}

// Infinite distances are far away; a NaN clips all of its triangle, and culls nothing.
TEST(Distances, ThatAreNoNumbers) {
  const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  std::mt19937 random(4);
  std::vector<ColoredVertex> vertices;
  std::vector<uint32_t> indices;
  make_mesh(random, vertices, indices);
  const auto all_are = [&](size_t plane, float distance) {
    Push push;
    push.planes[plane] = {0, 0, 0, distance};
    const std::vector<uint32_t> image = count(subject(), push, vertices, indices);
    const bool same = std::ranges::count(image, image[0]) == kSide * kSide;
    return same ? int(image[0]) : -1;
  };
  EXPECT_EQ(all_are(1, inf), 1);
  EXPECT_EQ(all_are(1, -inf), 0);
  EXPECT_EQ(all_are(1, nan), 0);
  EXPECT_EQ(all_are(1, 0.0f), 1);
  EXPECT_EQ(all_are(1, -0.0f), 1);
  EXPECT_EQ(all_are(1, -1e-40f), 0);
  EXPECT_EQ(all_are(kClipPlanes, inf), 1);
  EXPECT_EQ(all_are(kClipPlanes, -inf), 0);
  EXPECT_EQ(all_are(kClipPlanes, nan), 1);
}

}  // namespace
}  // namespace lapilli::conformance
