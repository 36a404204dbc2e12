// Blending and colour write masks. Specification: "The Framebuffer", Blending and Color Write Mask.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "harness/canvas.h"
#include "harness/devices.h"
#include "harness/graphics.h"
#include "shaders/flat_color.frag.h"
#include "shaders/position_color.vert.h"

namespace lapilli::conformance {
namespace {

using Color = std::array<double, 4>;

struct Vertex {
  float position[4];
  float color[4];
};

// The image is 16 columns wide: column x shows source x over destination x.
constexpr uint32_t kColumns = 16, kRows = 2;
constexpr std::array<float, 4> kConstants = {0.2f, 0.55f, 0.85f, 0.4f};

struct Inputs {
  std::array<Color, kColumns> source, destination;  // destination: multiples of 1/255
};

Inputs random_inputs(std::mt19937& random, bool out_of_range) {
  std::uniform_real_distribution<double> unit(0, 1), wide(-0.5, 1.5);
  Inputs in;
  for (size_t x = 0; x < kColumns; ++x) {
    for (size_t c = 0; c < 4; ++c) {
      in.source[x][c] = double(float(out_of_range ? wide(random) : unit(random)));
      in.destination[x][c] = std::round(unit(random) * 255) / 255;
    }
  }
  in.source[0] = {0, 0, 0, 0};
  in.source[1] = {1, 1, 1, 1};
  in.destination[2] = {0, 0, 0, 0};
  in.destination[3] = {1, 1, 1, 1};
  return in;
}

// Two triangles over column x.
void add_column(std::vector<Vertex>* out, size_t x, const Color& color) {
  const float left = float(x) / kColumns * 2 - 1, right = float(x + 1) / kColumns * 2 - 1;
  const float corners[6][2] = {{left, -1}, {right, -1}, {left, 1}, {left, 1}, {right, -1}, {right, 1}};
  for (const auto& p : corners) {
    out->push_back({{p[0], p[1], 0, 1}, {float(color[0]), float(color[1]), float(color[2]), float(color[3])}});
  }
}

template <typename Texel>
std::vector<Texel> draw(const Inputs& in, const VkPipelineColorBlendAttachmentState& blend, VkFormat format) {
  const Canvas canvas(subject(), {.width = kColumns, .height = kRows, .color_format = format});
  const samples::PipelineLayout layout = create_layout(subject());
  PipelineState state;
  state.vertex_shader = shaders::kPositionColorVert;
  state.fragment_shader = shaders::kFlatColorFrag;
  state.layout = layout.get();
  state.render_pass = canvas.render_pass();
  const samples::Pipeline plain = create_pipeline(subject(), state);
  state.blend = blend;
  state.blend_constants = kConstants;
  const samples::Pipeline blended = create_pipeline(subject(), state);
  std::vector<Vertex> vertices;
  for (size_t x = 0; x < kColumns; ++x) add_column(&vertices, x, in.destination[x]);
  for (size_t x = 0; x < kColumns; ++x) add_column(&vertices, x, in.source[x]);
  const samples::Buffer buffer(subject(), std::span<const Vertex>(vertices), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  VkCommandBuffer commands = subject().begin_commands();
  canvas.begin(commands, {});
  const VkBuffer vertex_buffer = buffer.get();
  const VkDeviceSize offset = 0;
  vkCmdBindVertexBuffers(commands, 0, 1, &vertex_buffer, &offset);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, plain.get());
  vkCmdDraw(commands, kColumns * 6, 1, 0, 0);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, blended.get());
  vkCmdDraw(commands, kColumns * 6, 1, kColumns * 6, 0);
  Canvas::end(commands);
  subject().submit_and_wait(commands);
  return canvas.read_color<Texel>();
}

double factor(VkBlendFactor f, size_t c, const Color& s, const Color& d) {
  const double constant = double(kConstants[c]), constant_alpha = double(kConstants[3]);
  switch (f) {
    case VK_BLEND_FACTOR_ZERO:
      return 0;
    case VK_BLEND_FACTOR_ONE:
      return 1;
    case VK_BLEND_FACTOR_SRC_COLOR:
      return s[c];
    case VK_BLEND_FACTOR_ONE_MINUS_SRC_COLOR:
      return 1 - s[c];
    case VK_BLEND_FACTOR_DST_COLOR:
      return d[c];
    case VK_BLEND_FACTOR_ONE_MINUS_DST_COLOR:
      return 1 - d[c];
    case VK_BLEND_FACTOR_SRC_ALPHA:
      return s[3];
    case VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA:
      return 1 - s[3];
    case VK_BLEND_FACTOR_DST_ALPHA:
      return d[3];
    case VK_BLEND_FACTOR_ONE_MINUS_DST_ALPHA:
      return 1 - d[3];
    case VK_BLEND_FACTOR_CONSTANT_COLOR:
      return constant;
    case VK_BLEND_FACTOR_ONE_MINUS_CONSTANT_COLOR:
      return 1 - constant;
    case VK_BLEND_FACTOR_CONSTANT_ALPHA:
      return constant_alpha;
    case VK_BLEND_FACTOR_ONE_MINUS_CONSTANT_ALPHA:
      return 1 - constant_alpha;
    case VK_BLEND_FACTOR_SRC_ALPHA_SATURATE:
      return c == 3 ? 1 : std::min(s[3], 1 - d[3]);
    default:
      return NAN;
  }
}

double combine(VkBlendOp op, double s, double sf, double d, double df) {
  switch (op) {
    case VK_BLEND_OP_ADD:
      return s * sf + d * df;
    case VK_BLEND_OP_SUBTRACT:
      return s * sf - d * df;
    case VK_BLEND_OP_REVERSE_SUBTRACT:
      return d * df - s * sf;
    case VK_BLEND_OP_MIN:
      return std::min(s, d);
    default:
      return std::max(s, d);
  }
}

Color expected(const VkPipelineColorBlendAttachmentState& b, Color s, const Color& d, bool unorm) {
  // Source colours of fixed-point attachments are clamped before blending.
  if (unorm) {
    for (double& v : s) v = std::clamp(v, 0.0, 1.0);
  }
  Color out;
  for (size_t c = 0; c < 4; ++c) {
    const bool alpha = c == 3;
    const double sf = factor(alpha ? b.srcAlphaBlendFactor : b.srcColorBlendFactor, c, s, d);
    const double df = factor(alpha ? b.dstAlphaBlendFactor : b.dstColorBlendFactor, c, s, d);
    out[c] = combine(alpha ? b.alphaBlendOp : b.colorBlendOp, s[c], sf, d[c], df);
    if (unorm) out[c] = std::clamp(out[c], 0.0, 1.0);
  }
  return out;
}

// lavapipe blends 8-bit targets in integers: one to two steps off where this asks for one of the two nearest.
constexpr double kStep8 = 0.502;

void check_unorm(const VkPipelineColorBlendAttachmentState& b, const Inputs& in, VkFormat format) {
  const auto image = draw<std::array<uint8_t, 4>>(in, b, format);
  for (size_t x = 0; x < kColumns; ++x) {
    const Color want = expected(b, in.source[x], in.destination[x], true);
    for (size_t c = 0; c < 4; ++c) {
      const size_t byte = format == VK_FORMAT_B8G8R8A8_UNORM && c != 3 ? 2 - c : c;
      ASSERT_LE(std::abs(double(image[x][byte]) - want[c] * 255), kStep8)
          << "factors " << b.srcColorBlendFactor << " " << b.dstColorBlendFactor << " / " << b.srcAlphaBlendFactor
          << " " << b.dstAlphaBlendFactor << " op " << b.colorBlendOp << " " << b.alphaBlendOp << " channel " << c
          << " column " << x << " source " << in.source[x][c] << " destination " << in.destination[x][c];
    }
  }
}

TEST(Blending, AllFactorsOnBothSides) {
  std::mt19937 random(1);
  for (int f = VK_BLEND_FACTOR_ZERO; f <= VK_BLEND_FACTOR_SRC_ALPHA_SATURATE; ++f) {
    const VkBlendFactor factor_under_test = VkBlendFactor(f);
    const VkBlendFactor other = VkBlendFactor(VK_BLEND_FACTOR_ONE + int(random() % 13));
    const Inputs in = random_inputs(random, f % 2 == 0);
    check_unorm({VK_TRUE, factor_under_test, other, VK_BLEND_OP_ADD, other, factor_under_test, VK_BLEND_OP_ADD, 0xF},
                in, VK_FORMAT_R8G8B8A8_UNORM);
    check_unorm({VK_TRUE, other, factor_under_test, VK_BLEND_OP_ADD, factor_under_test, other, VK_BLEND_OP_ADD, 0xF},
                in, VK_FORMAT_R8G8B8A8_UNORM);
  }
}

TEST(Blending, AllOperations) {
  std::mt19937 random(2);
  for (int op = VK_BLEND_OP_ADD; op <= VK_BLEND_OP_MAX; ++op) {
    const Inputs in = random_inputs(random, true);
    const VkBlendOp alpha_op = VkBlendOp((op + 1) % 5);
    for (const VkFormat format : {VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_B8G8R8A8_UNORM}) {
      check_unorm({VK_TRUE, VK_BLEND_FACTOR_SRC_ALPHA, VK_BLEND_FACTOR_ONE_MINUS_SRC_COLOR, VkBlendOp(op),
                   VK_BLEND_FACTOR_ONE, VK_BLEND_FACTOR_DST_ALPHA, alpha_op, 0xF},
                  in, format);
    }
  }
}

TEST(Blending, FloatAttachmentIsNeitherClampedNorRounded) {
  VkFormatProperties properties;
  vkGetPhysicalDeviceFormatProperties(subject().physical_device(), VK_FORMAT_R32G32B32A32_SFLOAT, &properties);
  if ((properties.optimalTilingFeatures & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT) == 0) {
    GTEST_SKIP() << "R32G32B32A32_SFLOAT cannot be blended";
  }
  std::mt19937 random(3);
  Inputs in = random_inputs(random, true);
  for (Color& d : in.destination) {
    for (double& v : d) v = double(float(v * 3 - 1));
  }
  for (int op = VK_BLEND_OP_ADD; op <= VK_BLEND_OP_MAX; ++op) {
    const VkPipelineColorBlendAttachmentState b = {VK_TRUE,
                                                   VK_BLEND_FACTOR_SRC_ALPHA,
                                                   VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
                                                   VkBlendOp(op),
                                                   VK_BLEND_FACTOR_ONE,
                                                   VK_BLEND_FACTOR_DST_COLOR,
                                                   VkBlendOp(op),
                                                   0xF};
    const auto image = draw<std::array<float, 4>>(in, b, VK_FORMAT_R32G32B32A32_SFLOAT);
    for (size_t x = 0; x < kColumns; ++x) {
      const Color want = expected(b, in.source[x], in.destination[x], false);
      for (size_t c = 0; c < 4; ++c) ASSERT_NEAR(double(image[x][c]), want[c], 1e-6) << "op " << op;
    }
  }
}

TEST(Blending, WriteMasksKeepTheOtherComponents) {
  std::mt19937 random(4);
  for (const VkBool32 enable : {VK_FALSE, VK_TRUE}) {
    for (VkColorComponentFlags mask = 0; mask < 16; ++mask) {
      const Inputs in = random_inputs(random, false);
      VkPipelineColorBlendAttachmentState b = {enable,
                                               VK_BLEND_FACTOR_SRC_ALPHA,
                                               VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
                                               VK_BLEND_OP_ADD,
                                               VK_BLEND_FACTOR_ONE,
                                               VK_BLEND_FACTOR_ONE,
                                               VK_BLEND_OP_ADD,
                                               mask};
      const auto image = draw<std::array<uint8_t, 4>>(in, b, VK_FORMAT_R8G8B8A8_UNORM);
      for (size_t x = 0; x < kColumns; ++x) {
        const Color drawn = enable ? expected(b, in.source[x], in.destination[x], true) : in.source[x];
        for (size_t c = 0; c < 4; ++c) {
          const double want = (mask >> c & 1) != 0 ? drawn[c] : in.destination[x][c];
          ASSERT_LE(std::abs(double(image[x][c]) - want * 255), kStep8) << "mask " << mask << " channel " << c;
        }
      }
    }
  }
}

// Many layers at once: each must see the one before it.
TEST(Blending, OrderOfOverlappingTrianglesInOneDraw) {
  const Canvas canvas(subject(), {.width = 48, .height = 48});
  const samples::PipelineLayout layout = create_layout(subject());
  PipelineState state;
  state.vertex_shader = shaders::kPositionColorVert;
  state.fragment_shader = shaders::kFlatColorFrag;
  state.layout = layout.get();
  state.render_pass = canvas.render_pass();
  state.blend = {VK_TRUE,
                 VK_BLEND_FACTOR_SRC_ALPHA,
                 VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
                 VK_BLEND_OP_ADD,
                 VK_BLEND_FACTOR_ONE,
                 VK_BLEND_FACTOR_ZERO,
                 VK_BLEND_OP_ADD,
                 0xF};
  const samples::Pipeline pipeline = create_pipeline(subject(), state);
  std::mt19937 random(5);
  std::vector<Vertex> vertices;
  Color want = {0, 0, 0, 0};
  for (int layer = 0; layer < 40; ++layer) {
    Color color;
    for (double& v : color) v = std::round(double(random() % 256)) / 255;
    color[3] = 0.25 + 0.5 * color[3];
    for (const auto& [x, y] : {std::pair{-1.f, -1.f}, {3.f, -1.f}, {-1.f, 3.f}}) {
      vertices.push_back({{x, y, 0, 1}, {float(color[0]), float(color[1]), float(color[2]), float(color[3])}});
    }
    for (size_t c = 0; c < 3; ++c) {
      want[c] = std::round((color[3] * color[c] + (1 - color[3]) * want[c]) * 255) / 255;
    }
  }
  draw_vertices(canvas, pipeline, std::as_bytes(std::span(vertices)));
  const auto image = canvas.read_color<std::array<uint8_t, 4>>();
  for (const auto& p : image) {
    ASSERT_EQ(p, image[0]);
    for (size_t c = 0; c < 3; ++c) ASSERT_NEAR(double(p[c]), want[c] * 255, 1.01);
  }
}

}  // namespace
}  // namespace lapilli::conformance
