// Interpolation of fragment inputs and the fragment shader's built-ins against the float64 oracle. Specification:
// "Rasterization", Basic Polygon Rasterization; "Shaders", Interpolation Decorations.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "harness/canvas.h"
#include "harness/devices.h"
#include "harness/graphics.h"
#include "oracle/interpolate.h"
#include "shaders/interpolate_at.frag.h"
#include "shaders/interpolate_list.frag.h"
#include "shaders/interpolation.frag.h"
#include "shaders/interpolation.vert.h"
#include "shaders/many_varyings.frag.h"
#include "shaders/many_varyings.vert.h"

namespace lapilli::conformance {
namespace {

constexpr uint32_t kSide = 48;
enum Mode { kSmooth, kLinear, kFlat, kFlatInt, kFragCoord, kFrontFacing, kDerivativesOfPosition, kDerivativesOfInput };

using Texel = std::array<float, 4>;
struct Vertex {
  oracle::ClipVertex position;
  Texel value;
};
static_assert(sizeof(Vertex) == 32);

oracle::RasterState raster_state() {
  oracle::RasterState s;
  s.viewport = {0, 0, kSide, kSide, 0, 1};
  s.scissor = {0, 0, kSide, kSide};
  return s;
}

std::vector<Texel> draw(const std::array<Vertex, 3>& triangle, int mode, bool many = false,
                        std::span<const uint32_t> fragment_shader = {}) {
  const Canvas canvas(subject(), {.width = kSide, .height = kSide, .color_format = VK_FORMAT_R32G32B32A32_SFLOAT});
  const samples::PipelineLayout layout = create_layout(subject(), {}, 4);
  PipelineState state;
  state.vertex_shader = many ? std::span<const uint32_t>(shaders::kManyVaryingsVert) : shaders::kInterpolationVert;
  state.fragment_shader = many ? std::span<const uint32_t>(shaders::kManyVaryingsFrag) : shaders::kInterpolationFrag;
  if (!fragment_shader.empty()) state.fragment_shader = fragment_shader;
  state.layout = layout.get();
  state.render_pass = canvas.render_pass();
  const samples::Pipeline pipeline = create_pipeline(subject(), state);
  const samples::Buffer buffer(subject(), std::span<const Vertex>(triangle), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  VkCommandBuffer commands = subject().begin_commands();
  canvas.begin(commands, {{-99, -99, -99, -99}});
  const VkBuffer vertex_buffer = buffer.get();
  const VkDeviceSize offset = 0;
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
  vkCmdPushConstants(commands, layout.get(),
                     VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT | VK_SHADER_STAGE_COMPUTE_BIT, 0, 4,
                     &mode);
  vkCmdBindVertexBuffers(commands, 0, 1, &vertex_buffer, &offset);
  vkCmdDraw(commands, 3, 1, 0, 0);
  Canvas::end(commands);
  subject().submit_and_wait(commands);
  return canvas.read_color<Texel>();
}

std::array<Vertex, 3> random_triangle(std::mt19937& random, float reach, bool clipped) {
  std::uniform_real_distribution<float> xy(-reach, reach), depth(clipped ? -1.0f : 0.0f, 1), weight(0.2f, 5),
      value(-3, 3);
  std::array<Vertex, 3> out;
  for (Vertex& v : out) {
    const float w = weight(random);
    v.position = {xy(random) * w, xy(random) * w, depth(random) * w, w};
    v.value = {value(random), value(random), value(random), value(random)};
  }
  return out;
}

// Calls visit(x, y, weights, texel) for all pixels that are surely covered.
template <typename Visit>
int for_covered(const std::array<Vertex, 3>& triangle, const std::vector<Texel>& image, Visit visit) {
  const oracle::Triangle t = {triangle[0].position, triangle[1].position, triangle[2].position};
  const oracle::RasterState state = raster_state();
  const oracle::TriangleCoverage c = oracle::cover(t, state);
  int count = 0;
  for (int y = 0; y < int(kSide); ++y) {
    for (int x = 0; x < int(kSide); ++x) {
      if (c.at(x, y) != oracle::Coverage::kInside) continue;
      ++count;
      visit(x, y, oracle::interpolate(t, state, oracle::Positions::kSnapped, x + 0.5, y + 0.5),
            image[size_t(y) * kSide + size_t(x)]);
    }
  }
  return count;
}

double mixed(const std::array<Vertex, 3>& t, const double* weights, size_t c) {
  double sum = 0;
  for (size_t i = 0; i < 3; ++i) sum += weights[i] * double(t[i].value[c]);
  return sum;
}

// Float32 rounding of barycentric coordinates and sums: values are below 3. (lavapipe: 1e-2 for small, steep
// triangles.)
constexpr double kTolerance = 4e-6;

TEST(Interpolation, SmoothAndLinear) {
  std::mt19937 random(1);
  int covered = 0;
  for (int round = 0; round < 30; ++round) {
    const auto t = random_triangle(random, round % 3 == 0 ? 20.0f : 1.2f, false);
    for (const Mode mode : {kSmooth, kLinear}) {
      covered += for_covered(t, draw(t, mode), [&](int x, int y, const oracle::Weights& w, const Texel& got) {
        const double* weights = mode == kSmooth ? w.perspective : w.linear;
        for (size_t c = 0; c < 4; ++c) {
          EXPECT_NEAR(double(got[c]), mixed(t, weights, c), kTolerance) << "mode " << mode << " " << x << "," << y;
        }
      });
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(covered, 5000);
}

// Of clipped triangles the attribute may be off by what snapping the clip points (half a subpixel) does to it.
TEST(Interpolation, ClippedTriangles) {
  std::mt19937 random(2);
  int covered = 0;
  for (int round = 0; round < 30; ++round) {
    const auto t = random_triangle(random, 1.5f, true);
    const oracle::Triangle positions = {t[0].position, t[1].position, t[2].position};
    for (const Mode mode : {kSmooth, kLinear}) {
      covered += for_covered(t, draw(t, mode), [&](int x, int y, const oracle::Weights& w, const Texel& got) {
        double slack[4] = {};
        for (const auto& [dx, dy] : {std::pair{1.0, 0.0}, {-1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}}) {
          const oracle::Weights n = oracle::interpolate(positions, raster_state(), oracle::Positions::kExact,
                                                        x + 0.5 + dx / 128, y + 0.5 + dy / 128);
          for (size_t c = 0; c < 4; ++c) {
            const double moved = mixed(t, mode == kSmooth ? n.perspective : n.linear, c);
            slack[c] = std::max(slack[c], std::abs(moved - mixed(t, mode == kSmooth ? w.perspective : w.linear, c)));
          }
        }
        for (size_t c = 0; c < 4; ++c) {
          EXPECT_NEAR(double(got[c]), mixed(t, mode == kSmooth ? w.perspective : w.linear, c),
                      kTolerance + 2 * slack[c])
              << "mode " << mode << " " << x << "," << y;
        }
      });
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(covered, 1000);
}

TEST(Interpolation, FlatTakesTheProvokingVertexExactly) {
  std::mt19937 random(3);
  for (int round = 0; round < 10; ++round) {
    const auto t = random_triangle(random, 1.2f, round % 2 == 0);
    for_covered(t, draw(t, kFlat),
                [&](int, int, const oracle::Weights&, const Texel& got) { EXPECT_EQ(got, t[0].value); });
    for_covered(t, draw(t, kFlatInt), [&](int, int, const oracle::Weights&, const Texel& got) {
      const int value = int(t[0].value[0] * 1000.0f);
      EXPECT_EQ(got[0], float(value));
      EXPECT_EQ(got[1], float(value >> 31));
    });
  }
}

TEST(Interpolation, FragCoord) {
  std::mt19937 random(4);
  for (int round = 0; round < 10; ++round) {
    const auto t = random_triangle(random, 1.2f, false);
    for_covered(t, draw(t, kFragCoord), [&](int x, int y, const oracle::Weights& w, const Texel& got) {
      EXPECT_EQ(got[0], float(x) + 0.5f);
      EXPECT_EQ(got[1], float(y) + 0.5f);
      EXPECT_NEAR(double(got[2]), w.depth, 2e-7);
      EXPECT_NEAR(double(got[3]) / w.inverse_w, 1, 2e-6);
    });
  }
}

TEST(Interpolation, FrontFacing) {
  std::mt19937 random(5);
  for (int round = 0; round < 10; ++round) {
    const auto t = random_triangle(random, 1.2f, false);
    const oracle::Triangle positions = {t[0].position, t[1].position, t[2].position};
    const bool front = oracle::cover(positions, raster_state()).facing == oracle::Facing::kFront;
    for_covered(t, draw(t, kFrontFacing),
                [&](int, int, const oracle::Weights&, const Texel& got) { EXPECT_EQ(got[0], front ? 1.0f : -1.0f); });
  }
}

TEST(Interpolation, Derivatives) {
  std::mt19937 random(6);
  int covered = 0;
  for (int round = 0; round < 10; ++round) {
    auto t = random_triangle(random, 1.2f, false);
    covered += for_covered(t, draw(t, kDerivativesOfPosition), [&](int, int, const oracle::Weights&, const Texel& got) {
      EXPECT_EQ(got, (Texel{1, 0, 0, 1}));
    });
    // A noperspective input is affine: its derivatives are the same in the whole triangle, helper lanes included.
    const oracle::Triangle p = {t[0].position, t[1].position, t[2].position};
    const oracle::RasterState state = raster_state();
    const auto value = [&](double x, double y, size_t c) {
      return mixed(t, oracle::interpolate(p, state, oracle::Positions::kSnapped, x, y).linear, c);
    };
    double gradient[2][2];  // [component][axis]
    for (size_t c = 0; c < 2; ++c) {
      gradient[c][0] = value(21, 20, c) - value(20, 20, c);
      gradient[c][1] = value(20, 21, c) - value(20, 20, c);
    }
    for_covered(t, draw(t, kDerivativesOfInput), [&](int, int, const oracle::Weights&, const Texel& got) {
      const double tolerance = 1e-5 * (1 + std::abs(gradient[0][0]) + std::abs(gradient[0][1]));
      EXPECT_NEAR(double(got[0]), gradient[0][0], tolerance);
      EXPECT_NEAR(double(got[1]), gradient[0][1], tolerance);
      EXPECT_NEAR(double(got[2]), std::abs(gradient[1][0]) + std::abs(gradient[1][1]),
                  1e-5 * (1 + std::abs(gradient[1][0]) + std::abs(gradient[1][1])));
    });
    if (HasFailure()) return;
  }
  EXPECT_GT(covered, 1000);
}

// interpolateAtOffset, interpolateAtSample and interpolateAtCentroid; with one sample a pixel the last two mean its
// centre.
TEST(Interpolation, AtOtherPlaces) {
  enum { kSmoothAt, kLinearAt, kFlatAt, kCentroid, kSample, kMixed };
  std::mt19937 random(8);
  int covered = 0;
  for (int round = 0; round < 12; ++round) {
    const auto t = random_triangle(random, round % 3 == 0 ? 20.0f : 1.2f, false);
    const oracle::Triangle p = {t[0].position, t[1].position, t[2].position};
    const auto at = [&](double x, double y) {
      return oracle::interpolate(p, raster_state(), oracle::Positions::kSnapped, x + 0.5, y + 0.5);
    };
    // 1/w of a point outside may come close to 0, and the value grow without bound.
    const auto tolerance = [&](double value, const oracle::Weights& w, const oracle::Weights& here) {
      return kTolerance * (1 + std::abs(value)) * std::max(1.0, 4 * here.inverse_w / std::max(w.inverse_w, 1e-3));
    };
    for (int mode = kSmoothAt; mode <= kMixed; ++mode) {
      covered += for_covered(
          t, draw(t, mode, false, shaders::kInterpolateAtFrag),
          [&](int x, int y, const oracle::Weights& here, const Texel& got) {
            const bool moved = mode < kCentroid;
            const oracle::Weights w =
                moved ? at(x + (x * 7 % 16) / 16.0 - 0.5, y + (y * 5 % 16) / 16.0 - 0.5) : at(x, y);
            const double* weights = mode == kSmoothAt || mode == kCentroid ? w.perspective : w.linear;
            if (mode == kFlatAt) {
              EXPECT_EQ(got, t[0].value);
            }
            if (mode == kFlatAt || w.inverse_w < 1e-3) return;
            for (size_t c = 0; c < 4 && mode != kMixed; ++c) {
              const double want = mixed(t, weights, c);
              EXPECT_NEAR(double(got[c]), want, tolerance(want, w, here)) << "mode " << mode << " " << x << "," << y;
            }
            if (mode != kMixed) return;
            const oracle::Weights there = at(x + 0.25, y - 0.5);
            if (there.inverse_w < 1e-3) return;
            const double want[] = {mixed(t, there.perspective, 2), mixed(t, there.perspective, 3),
                                   mixed(t, at(x + 1, y).linear, 0) - mixed(t, w.linear, 0),
                                   mixed(t, w.perspective, 1)};
            for (size_t c = 0; c < 4; ++c)
              EXPECT_NEAR(double(got[c]), want[c], 4 * tolerance(want[c], there, here)) << c;
          });
      if (HasFailure()) return;
    }
    const auto list = draw(t, round, true, shaders::kInterpolateListFrag);
    for_covered(t, list, [&](int x, int y, const oracle::Weights& here, const Texel& got) {
      const oracle::Weights there = at(x + 0.25, y - 0.375);
      if (there.inverse_w < 1e-3) return;
      const int i = (x + round) % 5;
      const double value[4] = {mixed(t, there.perspective, 0), mixed(t, there.perspective, 1), 0,
                               mixed(t, there.perspective, 3)};
      const double columns[3][2] = {{value[0], value[1]}, {value[3], 2}, {4, 5}};
      const double want[] = {(i + 1) * value[0], (i + 1) * mixed(t, here.perspective, 0), columns[i % 3][0],
                             columns[i % 3][1]};
      for (size_t c = 0; c < 4; ++c) EXPECT_NEAR(double(got[c]), want[c], 4 * tolerance(want[c], there, here)) << c;
    });
    if (HasFailure()) return;
  }
  EXPECT_GT(covered, 5000);
}

// Matrices, arrays and blocks as varyings.
TEST(Interpolation, AggregateInputs) {
  std::mt19937 random(7);
  for (int round = 0; round < 5; ++round) {
    const auto t = random_triangle(random, 1.2f, false);
    for_covered(t, draw(t, 0, true), [&](int x, int y, const oracle::Weights& w, const Texel& got) {
      double v[4];
      for (size_t c = 0; c < 4; ++c) v[c] = mixed(t, w.perspective, c);
      // matrix columns: (x, y, z), (w, 2, 3), (4, 5, 6); times (1, 2, 3), then dot (1, -1, 0.5).
      const double row[3] = {v[0] + 2 * v[3] + 12, v[1] + 4 + 15, v[2] + 6 + 18};
      const double want[4] = {15 * v[0], row[0] - row[1] + 0.5 * row[2], v[2] - v[3], 2 * (v[0] + v[1] + v[2])};
      for (size_t c = 0; c < 4; ++c) EXPECT_NEAR(double(got[c]), want[c], 5e-5) << x << "," << y << " " << c;
    });
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace lapilli::conformance
