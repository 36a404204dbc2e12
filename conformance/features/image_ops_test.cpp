// The instructions on sampled images beside plain ones: offsets, gradients, projection, gathers, depth comparison,
// queries, separate images and samplers, against the float64 oracle. Specification: "Image Operations".
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/pipeline.h"
#include "harness/canvas.h"
#include "harness/compute.h"
#include "harness/descriptors.h"
#include "harness/devices.h"
#include "harness/graphics.h"
#include "harness/texture.h"
#include "oracle/sampling.h"
#include "shaders/image_ops.comp.h"
#include "shaders/image_ops.frag.h"
#include "shaders/textured.vert.h"

namespace lapilli::conformance {
namespace {

using oracle::Address;
using oracle::Offset;
using oracle::Texture;
using Float4 = std::array<float, 4>;

constexpr uint32_t kSize = 16, kLevels = 5;
constexpr float kBias = 0.5f;  // of the sampler

struct Picture {
  std::vector<Texture> levels;
  samples::Image image;
};

Picture random_picture(std::mt19937& random) {
  Picture out;
  std::vector<std::byte> bytes;
  for (uint32_t level = 0; level < kLevels; ++level) {
    Texture& texture = out.levels.emplace_back();
    texture.width = texture.height = int(kSize >> level);
    for (int i = 0; i < texture.width * texture.height; ++i) {
      std::array<double, 4> texel;
      for (double& value : texel) {
        const auto code = uint8_t(random());
        bytes.push_back(std::byte(code));
        value = double(code) / 255;
      }
      texture.texels.push_back(texel);
    }
  }
  out.image = upload(subject(), {kSize, kSize}, VK_FORMAT_R8G8B8A8_UNORM, bytes, kLevels, 4);
  return out;
}

Picture random_depth(std::mt19937& random) {
  Picture out;
  std::vector<float> depths;
  Texture& texture = out.levels.emplace_back();
  texture.width = texture.height = kSize;
  for (uint32_t i = 0; i < kSize * kSize; ++i) {
    depths.push_back(std::uniform_real_distribution<float>(0, 1)(random));
    texture.texels.push_back({double(depths.back()), 0, 0, 1});
  }
  out.image = upload(subject(), {kSize, kSize}, VK_FORMAT_D32_SFLOAT, std::as_bytes(std::span(depths)));
  return out;
}

struct Scene {
  std::mt19937 random;
  Picture picture = random_picture(random), other = random_picture(random), depth = random_depth(random);
  explicit Scene(uint32_t seed) : random(seed) {}
};

struct Modes {
  VkSamplerAddressMode vk_u, vk_v;
  Address u, v;
};
constexpr Modes kModes[] = {
    {VK_SAMPLER_ADDRESS_MODE_REPEAT, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, Address::kRepeat, Address::kClampToEdge},
    {VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER, Address::kMirroredRepeat,
     Address::kClampToBorder}};
struct Comparison {
  VkCompareOp vk;
  oracle::Compare op;
};
constexpr Comparison kComparisons[] = {{VK_COMPARE_OP_LESS, oracle::Compare::kLess},
                                       {VK_COMPARE_OP_LESS_OR_EQUAL, oracle::Compare::kLessOrEqual},
                                       {VK_COMPARE_OP_GREATER, oracle::Compare::kGreater},
                                       {VK_COMPARE_OP_GREATER_OR_EQUAL, oracle::Compare::kGreaterOrEqual}};

DescriptorSlot image_slot(uint32_t binding, VkDescriptorType type, const samples::Image& image,
                          VkSampler sampler = VK_NULL_HANDLE, uint32_t element = 0) {
  DescriptorSlot slot = {binding, type};
  slot.image = {sampler, image.view(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
  slot.element = element;
  return slot;
}
DescriptorSlot buffer_slot(uint32_t binding, const samples::Buffer& buffer) {
  DescriptorSlot slot = {binding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
  slot.buffer = {buffer.get(), 0, VK_WHOLE_SIZE};
  return slot;
}

constexpr size_t kResults = 16;

std::vector<Float4> run(const Scene& scene, const samples::Sampler& linear, const samples::Sampler& nearest,
                        const samples::Sampler& shadow, const std::vector<Float4>& at, Offset offset) {
  constexpr VkBufferUsageFlags kUsage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  const samples::Buffer in(subject(), std::span<const Float4>(at), kUsage);
  const samples::Buffer out(subject(), at.size() * kResults * 16, kUsage);
  const std::array<int32_t, 2> offset_bytes = {offset.x, offset.y};
  const samples::Buffer offsets(subject(), std::span<const int32_t>(offset_bytes), kUsage);
  constexpr VkDescriptorType kCombined = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
  constexpr VkDescriptorType kImage = VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, kSampler = VK_DESCRIPTOR_TYPE_SAMPLER;
  const std::array<DescriptorSlot, 9> slots = {image_slot(0, kCombined, scene.picture.image, linear.get()),
                                               image_slot(1, kCombined, scene.depth.image, shadow.get()),
                                               image_slot(2, kImage, scene.picture.image),
                                               image_slot(2, kImage, scene.other.image, VK_NULL_HANDLE, 1),
                                               image_slot(3, kSampler, scene.picture.image, linear.get()),
                                               image_slot(3, kSampler, scene.picture.image, nearest.get(), 1),
                                               buffer_slot(4, in),
                                               buffer_slot(5, out),
                                               buffer_slot(6, offsets)};
  const Descriptors descriptors(subject(), slots);
  const VkDescriptorSetLayout set_layout = descriptors.layout();
  const samples::PipelineLayout layout = create_layout(subject(), {&set_layout, 1});
  const samples::Pipeline pipeline = samples::create_compute_pipeline(subject(), shaders::kImageOpsComp, layout.get());
  dispatch(subject(), pipeline, layout.get(), descriptors.get(), uint32_t(at.size() + 63) / 64);
  std::vector<Float4> result(at.size() * kResults);
  std::memcpy(result.data(), out.data(), result.size() * 16);
  return result;
}

constexpr double kTolerance = 2e-4;

struct Expectation {
  const Float4* got;
  std::string where;

  void near(size_t result, const std::array<double, 4>& want, double tolerance = kTolerance) const {
    for (size_t c = 0; c < 4; ++c)
      ASSERT_NEAR(double(got[result][c]), want[c], tolerance) << where << " result " << result << " channel " << c;
  }
};

std::array<double, 4> channel(const oracle::Gathered& gathered, size_t c) {
  return {gathered.texels[0][c], gathered.texels[1][c], gathered.texels[2][c], gathered.texels[3][c]};
}

TEST(ImageOps, ExplicitLevels) {
  Scene scene(31);
  for (const Modes& modes : kModes) {
    for (const Comparison& comparison : kComparisons) {
      constexpr VkFilter kLinear = VK_FILTER_LINEAR;
      constexpr VkSamplerMipmapMode kMix = VK_SAMPLER_MIPMAP_MODE_LINEAR;
      SamplerState state = {kLinear, kLinear, modes.vk_u, modes.vk_v, VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE};
      state.mipmap = kMix;
      state.max_lod = 3.25f;
      state.lod_bias = kBias;
      const samples::Sampler linear = make_sampler(subject(), state);
      state.compare = comparison.vk;
      const samples::Sampler shadow = make_sampler(subject(), state);
      const samples::Sampler nearest = make_sampler(subject(), {VK_FILTER_NEAREST, VK_FILTER_NEAREST, modes.vk_u,
                                                                modes.vk_v, VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE});
      for (auto* picture : {&scene.picture, &scene.other, &scene.depth}) {
        for (Texture& level : picture->levels) level.border = {1, 1, 1, 1};
      }
      std::vector<Float4> at;
      std::uniform_real_distribution<float> place(-2, 2), lods(-1, 5), unit(0, 1);
      for (int i = 0; i < 300; ++i)
        at.push_back({place(scene.random), place(scene.random), lods(scene.random), unit(scene.random)});
      const Offset offset = {int(scene.random() % 16) - 8, int(scene.random() % 16) - 8};
      const std::vector<Float4> got = run(scene, linear, nearest, shadow, at, offset);
      for (size_t i = 0; i < at.size(); ++i) {
        const double u = double(at[i][0]), v = double(at[i][1]), z = double(at[i][3]);
        const double lod = std::clamp(double(at[i][2]) + double(kBias), 0.0, 3.25);
        const Expectation expect = {&got[i * kResults], "at " + std::to_string(u) + ", " + std::to_string(v)};
        const std::vector<Texture>& levels = scene.picture.levels;
        const Texture& base = levels[0];
        const Texture compared = oracle::compare(scene.depth.levels[0], comparison.op, z);
        const auto trilinear = [&](Offset o) {
          return oracle::sample_trilinear(levels, modes.u, modes.v, u, v, lod, o).value;
        };
        expect.near(0, trilinear({3, -2}));
        expect.near(1, trilinear({}), 1e-3);
        expect.near(2, trilinear({-8, 7}), 1e-3);
        expect.near(3, trilinear({}));
        expect.near(4, trilinear({1, 0}));
        if (const auto texels = oracle::gather(base, modes.u, modes.v, u, v); !texels.tie) {
          expect.near(5, channel(texels, 1), 1e-6);
          expect.near(6, channel(oracle::gather(base, modes.u, modes.v, u, v, offset), 2), 1e-6);
          std::array<double, 4> corners;
          constexpr Offset kFour[] = {{0, 0}, {-8, 7}, {3, 1}, {-1, -5}};
          for (size_t k = 0; k < 4; ++k)
            corners[k] = oracle::gather(base, modes.u, modes.v, u, v, kFour[k]).texels[3][3];
          expect.near(7, corners, 1e-6);
          expect.near(9, channel(oracle::gather(compared, modes.u, modes.v, u, v), 0), 0);
          expect.near(10, channel(oracle::gather(compared, modes.u, modes.v, u, v, offset), 0), 0);
        }
        const double lit = oracle::sample_linear(compared, modes.u, modes.v, u, v).value[0];
        expect.near(8, {lit, lit, lit, oracle::sample_linear(compared, modes.u, modes.v, u, v, {-3, 2}).value[0]});
        expect.near(11, {8, 8, kLevels, kSize}, 0);
        const auto inside = [](int x, int y, const Texture& t) {
          return x >= 0 && y >= 0 && x < t.width && y < t.height ? t.texels[size_t(y * t.width + x)]
                                                                 : std::array<double, 4>{};
        };
        const auto texel = [](double s, double size) { return int(std::floor(float(s) * float(size))); };
        expect.near(12, inside(texel(u, 8) + 1, texel(v, 8) - 1, levels[1]), 1e-6);
        if (i / 64 % 2 == 0) {
          const auto read = oracle::sample_nearest(base, modes.u, modes.v, u, v);
          if (!read.tie) expect.near(13, read.value, 1e-6);
        } else {
          expect.near(13, oracle::sample_trilinear(scene.other.levels, modes.u, modes.v, u, v, lod).value);
        }
        expect.near(14, trilinear({}));
        expect.near(15, inside(texel(u, 16), texel(v, 16), scene.other.levels[0]), 1e-6);
        if (testing::Test::HasFatalFailure()) return;
      }
    }
  }
}

// A screen full of one triangle; the picture is `texels` base texels wide for each pixel.
std::vector<Float4> draw(const Scene& scene, const samples::Sampler& sampler, const samples::Sampler& shadow, int which,
                         float texels) {
  constexpr uint32_t kPixels = 32;
  constexpr VkDescriptorType kCombined = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
  const std::array<DescriptorSlot, 2> slots = {image_slot(0, kCombined, scene.picture.image, sampler.get()),
                                               image_slot(1, kCombined, scene.depth.image, shadow.get())};
  const Descriptors descriptors(subject(), slots);
  const VkDescriptorSetLayout set_layout = descriptors.layout();
  const samples::PipelineLayout layout = create_layout(subject(), {&set_layout, 1});
  const Canvas canvas(subject(), {.width = kPixels, .height = kPixels, .color_format = VK_FORMAT_R32G32B32A32_SFLOAT});
  const VkSpecializationMapEntry entry = {0, 0, 4};
  const VkSpecializationInfo specialization = {1, &entry, 4, &which};
  PipelineState state;
  state.vertex_shader = shaders::kTexturedVert;
  state.fragment_shader = shaders::kImageOpsFrag;
  state.specialization = &specialization;
  state.layout = layout.get();
  state.render_pass = canvas.render_pass();
  const samples::Pipeline pipeline = create_pipeline(subject(), state);
  const float end = 2 * texels * float(kPixels) / float(kSize);
  const std::vector<std::array<float, 8>> vertices = {
      {-1, -1, 0, 1, 0, 0, 0, 0}, {3, -1, 0, 1, end, 0, 0, 0}, {-1, 3, 0, 1, 0, end, 0, 0}};
  draw_vertices(canvas, pipeline, std::as_bytes(std::span(vertices)), layout.get(), descriptors.get());
  return canvas.read_color<Float4>();
}

TEST(ImageOps, ImplicitLevels) {
  Scene scene(32);
  SamplerState state = {VK_FILTER_LINEAR, VK_FILTER_LINEAR};
  state.mipmap = VK_SAMPLER_MIPMAP_MODE_LINEAR;
  state.max_lod = 100;
  state.lod_bias = kBias;
  const samples::Sampler sampler = make_sampler(subject(), state);
  state.compare = VK_COMPARE_OP_LESS;
  const samples::Sampler shadow = make_sampler(subject(), state);
  const Texture compared = oracle::compare(scene.depth.levels[0], oracle::Compare::kLess, 0.5);
  for (const float texels : {1.0f, 0.375f, 3.0f}) {
    const double lod = std::log2(double(texels)) + double(kBias);
    for (int which = 0; which < 5; ++which) {
      const std::vector<Float4> got = draw(scene, sampler, shadow, which, texels);
      for (int i = 0; i < 32 * 32; ++i) {
        const double u = (i % 32 + 0.5) * double(texels) / kSize, v = (i / 32 + 0.5) * double(texels) / kSize;
        const auto trilinear = [&](double bias, Offset offset) {
          return oracle::sample_trilinear(scene.picture.levels, Address::kRepeat, Address::kRepeat, u, v, lod + bias,
                                          offset)
              .value;
        };
        const auto lit = [&](Offset offset) {
          return oracle::sample_linear(compared, Address::kRepeat, Address::kRepeat, u, v, offset).value[0];
        };
        const std::array<double, 4> want = which == 0   ? trilinear(1, {})
                                           : which == 1 ? trilinear(0, {2, -3})
                                           : which == 2 ? trilinear(-1, {})
                                           : which == 3
                                               ? std::array<double, 4>{std::clamp(lod, 0.0, kLevels - 1.0), lod, 0, 1}
                                               : std::array<double, 4>{lit({}), lit({}), lit({-8, 7}), 1};
        const Expectation expect = {&got[size_t(i)], "pixel " + std::to_string(i) + " texels " +
                                                         std::to_string(texels) + " case " + std::to_string(which)};
        expect.near(0, want, 1e-3);
        if (testing::Test::HasFatalFailure()) return;
      }
    }
  }
}

}  // namespace
}  // namespace lapilli::conformance
