// Sampled images against the float64 oracle. Specification: "Image Operations".
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/pipeline.h"
#include "harness/canvas.h"
#include "harness/compute.h"
#include "harness/devices.h"
#include "harness/graphics.h"
#include "harness/texture.h"
#include "oracle/sampling.h"
#include "shaders/fetch.comp.h"
#include "shaders/sample.comp.h"
#include "shaders/textured.frag.h"
#include "shaders/textured.vert.h"

namespace lapilli::conformance {
namespace {

using oracle::Address;
using oracle::Texture;

struct Uploaded {
  Texture texture;
  samples::Image image;
};

Uploaded random_texture(std::mt19937& random, int width, int height, VkFormat format) {
  Uploaded out;
  out.texture.width = width;
  out.texture.height = height;
  std::vector<std::byte> bytes;
  const auto append = [&](const auto& texel) {
    const auto* raw = reinterpret_cast<const std::byte*>(&texel);
    bytes.insert(bytes.end(), raw, raw + sizeof(texel));
  };
  for (int i = 0; i < width * height; ++i) {
    std::array<double, 4> value;
    if (format == VK_FORMAT_R32G32B32A32_SFLOAT) {
      std::array<float, 4> texel;
      for (size_t c = 0; c < 4; ++c) texel[c] = std::uniform_real_distribution<float>(-2, 2)(random);
      for (size_t c = 0; c < 4; ++c) value[c] = double(texel[c]);
      append(texel);
    } else {
      std::array<uint8_t, 4> texel;
      for (uint8_t& v : texel) v = uint8_t(random());
      for (size_t c = 0; c < 4; ++c) {
        value[c] = double(texel[format == VK_FORMAT_B8G8R8A8_UNORM && c != 3 ? 2 - c : c]) / 255;
      }
      append(texel);
    }
    out.texture.texels.push_back(value);
  }
  out.image = upload(subject(), {uint32_t(width), uint32_t(height)}, format, bytes);
  return out;
}

using Coordinates = std::vector<std::array<float, 2>>;

std::vector<std::array<float, 4>> sample(const samples::Image& image, const samples::Sampler& sampler,
                                         const Coordinates& coordinates) {
  const samples::Buffer in(subject(), std::span<const std::array<float, 2>>(coordinates),
                           VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  const samples::Buffer out(subject(), coordinates.size() * 16, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  constexpr VkShaderStageFlags kStage = VK_SHADER_STAGE_COMPUTE_BIT;
  const std::array<samples::Binding, 3> bindings = {
      samples::ImageBinding{kStage, &image, &sampler},
      samples::BufferBinding{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kStage, &in},
      samples::BufferBinding{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kStage, &out}};
  const samples::DescriptorSet descriptors(subject(), bindings);
  const VkDescriptorSetLayout set_layout = descriptors.layout();
  const samples::PipelineLayout layout = create_layout(subject(), {&set_layout, 1});
  const samples::Pipeline pipeline = samples::create_compute_pipeline(subject(), shaders::kSampleComp, layout.get());
  dispatch(subject(), pipeline, layout.get(), descriptors.get(), uint32_t(coordinates.size() + 63) / 64);
  std::vector<std::array<float, 4>> result(coordinates.size());
  std::memcpy(result.data(), out.data(), result.size() * 16);
  return result;
}

Coordinates random_coordinates(std::mt19937& random, size_t count) {
  Coordinates out;
  for (size_t i = 0; i < count; ++i) {
    const float reach = i % 2 == 0 ? 1.2f : 4.0f;
    std::uniform_real_distribution<float> u(-reach, reach);
    out.push_back({u(random), u(random)});
  }
  return out;
}

struct Mode {
  VkSamplerAddressMode vk;
  Address address;
};
constexpr Mode kModes[] = {{VK_SAMPLER_ADDRESS_MODE_REPEAT, Address::kRepeat},
                           {VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT, Address::kMirroredRepeat},
                           {VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, Address::kClampToEdge},
                           {VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER, Address::kClampToBorder}};

// Weights in full float32: what is left is the rounding of u * width (|u| <= 4, 64 texels: 2^-16 texel) times the
// difference of neighbours, and of the sum.
constexpr double kLinearTolerance = 4e-5;

void check(VkFormat format, VkFilter filter) {
  std::mt19937 random(uint32_t(filter) + 10 * uint32_t(format));
  for (const auto& [width, height] : {std::pair{16, 16}, {7, 13}, {1, 1}, {64, 3}}) {
    Uploaded t = random_texture(random, width, height, format);
    for (const Mode& u : kModes) {
      for (const Mode& v : kModes) {
        const samples::Sampler sampler =
            make_sampler(subject(), {filter, filter, u.vk, v.vk, VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE});
        t.texture.border = {1, 1, 1, 1};
        const Coordinates at = random_coordinates(random, 500);
        const auto got = sample(t.image, sampler, at);
        for (size_t i = 0; i < at.size(); ++i) {
          const auto oracle_sample = filter == VK_FILTER_NEAREST ? oracle::sample_nearest : oracle::sample_linear;
          const oracle::Sample want =
              oracle_sample(t.texture, u.address, v.address, double(at[i][0]), double(at[i][1]), {});
          if (want.tie) continue;
          for (size_t c = 0; c < 4; ++c) {
            ASSERT_NEAR(double(got[i][c]), want.value[c], filter == VK_FILTER_NEAREST ? 1e-7 : kLinearTolerance)
                << width << "x" << height << " modes " << u.vk << " " << v.vk << " at " << at[i][0] << ", " << at[i][1]
                << " channel " << c;
          }
        }
      }
    }
  }
}

TEST(Sampling, NearestRgba8) { check(VK_FORMAT_R8G8B8A8_UNORM, VK_FILTER_NEAREST); }
TEST(Sampling, LinearRgba8) { check(VK_FORMAT_R8G8B8A8_UNORM, VK_FILTER_LINEAR); }
TEST(Sampling, LinearBgra8) { check(VK_FORMAT_B8G8R8A8_UNORM, VK_FILTER_LINEAR); }
TEST(Sampling, NearestRgba32f) { check(VK_FORMAT_R32G32B32A32_SFLOAT, VK_FILTER_NEAREST); }

TEST(Sampling, LinearRgba32f) {
  VkFormatProperties properties;
  vkGetPhysicalDeviceFormatProperties(subject().physical_device(), VK_FORMAT_R32G32B32A32_SFLOAT, &properties);
  if ((properties.optimalTilingFeatures & VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT) == 0) {
    GTEST_SKIP() << "R32G32B32A32_SFLOAT cannot be filtered";
  }
  check(VK_FORMAT_R32G32B32A32_SFLOAT, VK_FILTER_LINEAR);
}

TEST(Sampling, BorderColours) {
  std::mt19937 random(5);
  const Uploaded t = random_texture(random, 4, 4, VK_FORMAT_R8G8B8A8_UNORM);
  const std::pair<VkBorderColor, std::array<float, 4>> cases[] = {
      {VK_BORDER_COLOR_FLOAT_TRANSPARENT_BLACK, {0, 0, 0, 0}},
      {VK_BORDER_COLOR_FLOAT_OPAQUE_BLACK, {0, 0, 0, 1}},
      {VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE, {1, 1, 1, 1}}};
  for (const auto& [border, color] : cases) {
    const VkSamplerAddressMode mode = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER;
    const samples::Sampler sampler = make_sampler(subject(), {VK_FILTER_LINEAR, VK_FILTER_LINEAR, mode, mode, border});
    const auto got = sample(t.image, sampler, {{-1, 0.5f}, {0.5f, 2}, {-7, 30}});
    for (const auto& texel : got) EXPECT_EQ(texel, color);
  }
}

// Coordinates that are no places: the result is any value the texture could give, and nothing is read elsewhere.
TEST(Sampling, NonFiniteAndHugeCoordinatesStayInside) {
  std::mt19937 random(6);
  const Uploaded t = random_texture(random, 8, 8, VK_FORMAT_R8G8B8A8_UNORM);
  const float inf = INFINITY, nan = NAN;
  const Coordinates at = {{inf, 0},       {-inf, 0},    {nan, nan}, {0, nan},        {1e30f, 1e30f},
                          {-1e30f, 0.5f}, {3e9f, 0.1f}, {-3e9f, 2}, {1e38f, -1e38f}, {16777216, 0.5f}};
  for (const Mode& mode : kModes) {
    for (const VkFilter filter : {VK_FILTER_NEAREST, VK_FILTER_LINEAR}) {
      const samples::Sampler sampler = make_sampler(subject(), {filter, filter, mode.vk, mode.vk});
      for (const auto& texel : sample(t.image, sampler, at)) {
        for (const float v : texel) EXPECT_TRUE(std::isnan(v) || (v >= 0 && v <= 1)) << v;
      }
    }
  }
}

TEST(Sampling, FetchAndSize) {
  std::mt19937 random(7);
  for (const VkFormat format : {VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_R32G32B32A32_SFLOAT}) {
    const Uploaded t = random_texture(random, 37, 11, format);
    const samples::Sampler sampler = make_sampler(subject(), {});
    const samples::Buffer out(subject(), 16 + 37 * 11 * 16, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    const std::array<samples::Binding, 2> bindings = {
        samples::ImageBinding{VK_SHADER_STAGE_COMPUTE_BIT, &t.image, &sampler},
        samples::BufferBinding{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_COMPUTE_BIT, &out}};
    const samples::DescriptorSet descriptors(subject(), bindings);
    const VkDescriptorSetLayout set_layout = descriptors.layout();
    const samples::PipelineLayout layout = create_layout(subject(), {&set_layout, 1});
    const samples::Pipeline pipeline = samples::create_compute_pipeline(subject(), shaders::kFetchComp, layout.get());
    dispatch(subject(), pipeline, layout.get(), descriptors.get(), 5, 3);
    int32_t size[2];
    std::memcpy(size, out.data(), sizeof(size));
    EXPECT_EQ(size[0], 37);
    EXPECT_EQ(size[1], 11);
    std::vector<std::array<float, 4>> texels(37 * 11);
    std::memcpy(texels.data(), static_cast<const std::byte*>(out.data()) + 16, texels.size() * 16);
    for (size_t i = 0; i < texels.size(); ++i) {
      for (size_t c = 0; c < 4; ++c) ASSERT_NEAR(double(texels[i][c]), t.texture.texels[i][c], 1.2e-7);
    }
  }
}

// Fragment shader, texture(): texels land exactly on pixels one to one, and filtered when enlarged.
TEST(Sampling, TexturedQuadInAFragmentShader) {
  std::mt19937 random(8);
  const Uploaded t = random_texture(random, 32, 32, VK_FORMAT_R8G8B8A8_UNORM);
  for (const float zoom : {1.0f, 0.37f}) {
    const VkFilter filter = zoom == 1.0f ? VK_FILTER_NEAREST : VK_FILTER_LINEAR;
    const samples::Sampler sampler = make_sampler(subject(), {filter, filter});
    const std::array<samples::Binding, 1> bindings = {
        samples::ImageBinding{VK_SHADER_STAGE_FRAGMENT_BIT, &t.image, &sampler}};
    const samples::DescriptorSet descriptors(subject(), bindings);
    const VkDescriptorSetLayout set_layout = descriptors.layout();
    const samples::PipelineLayout layout = create_layout(subject(), {&set_layout, 1});
    const Canvas canvas(subject(), {.width = 32, .height = 32});
    PipelineState state;
    state.vertex_shader = shaders::kTexturedVert;
    state.fragment_shader = shaders::kTexturedFrag;
    state.layout = layout.get();
    state.render_pass = canvas.render_pass();
    const samples::Pipeline pipeline = create_pipeline(subject(), state);
    const std::vector<std::array<float, 8>> vertices = {
        {-1, -1, 0, 1, 0, 0, 0, 0}, {3, -1, 0, 1, 2 * zoom, 0, 0, 0}, {-1, 3, 0, 1, 0, 2 * zoom, 0, 0}};
    draw_vertices(canvas, pipeline, std::as_bytes(std::span(vertices)), layout.get(), descriptors.get());
    const auto image = canvas.read_color<std::array<uint8_t, 4>>();
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 32; ++x) {
        const double u = (x + 0.5) / 32 * double(zoom), v = (y + 0.5) / 32 * double(zoom);
        const auto oracle_sample = zoom == 1.0f ? oracle::sample_nearest : oracle::sample_linear;
        const oracle::Sample want = oracle_sample(t.texture, Address::kRepeat, Address::kRepeat, u, v, {});
        for (size_t c = 0; c < 4; ++c) {
          ASSERT_NEAR(double(image[size_t(y * 32 + x)][c]), want.value[c] * 255, 0.51) << x << "," << y;
        }
      }
    }
  }
}

}  // namespace
}  // namespace lapilli::conformance
