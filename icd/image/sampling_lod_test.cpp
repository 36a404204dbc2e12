// Level of detail: which levels and filters a lane reads, and derivatives.
// Specification: "Scale Factor Operation, LOD Operation and Image Level(s) Selection".
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "image/sampling_fixture.h"

namespace lapilli {
namespace {

using namespace sampling_test;

class SamplingLod : public Sampling {};

INSTANTIATE_TEST_SUITE_P(Targets, SamplingLod, testing::ValuesIn(supported_simd_targets()),
                         [](const auto& target) { return std::string(simd_target_name(target.param)); });

// Red of level i is i.
Texture numbered_levels(uint32_t levels) {
  Texture texture(VK_FORMAT_R32G32B32A32_SFLOAT, 64, 32, levels);
  for (uint32_t i = 0; i < levels; ++i) texture.fill_level(i, static_cast<float>(i));
  return texture;
}

TEST_P(SamplingLod, LevelsFollowTheSpecification) {
  const Texture texture = numbered_levels(6);
  Lanes centre, lod;
  for (float& value : centre.lane) value = 0.5f;
  std::mt19937 random(6);
  for (VkFilter filter : {VK_FILTER_NEAREST, VK_FILTER_LINEAR}) {
    for (int round = 0; round < 40; ++round) {
      SamplerState sampler = sampler_of(filter, VK_SAMPLER_ADDRESS_MODE_REPEAT, VK_SAMPLER_ADDRESS_MODE_REPEAT);
      sampler.mipmap_mode = round % 2 == 0 ? VK_SAMPLER_MIPMAP_MODE_NEAREST : VK_SAMPLER_MIPMAP_MODE_LINEAR;
      sampler.lod_bias = round % 3 == 0 ? 0.0f : static_cast<float>(random() % 33) * 0.125f - 2.0f;
      sampler.min_lod = round % 4 == 0 ? 0.75f : 0.0f;
      sampler.max_lod = round % 5 == 0 ? 3.25f : 1000.0f;
      for (size_t lane = 0; lane < 64; ++lane) lod[lane] = static_cast<float>(random() % 145) * 0.0625f - 1.5f;
      Rgba out;
      sample(texture, sampler, centre, centre, out, &lod);
      for (size_t lane = 0; lane < 64; ++lane) {
        const double lambda =
            std::clamp(double{lod[lane]} + double{sampler.lod_bias}, double{sampler.min_lod}, double{sampler.max_lod});
        const double d = std::clamp(lambda, 0.0, 5.0);
        const double expected = round % 2 == 0 ? std::ceil(d + 0.5) - 1.0 : d;  // the levels' values rise linearly
        EXPECT_EQ(out.component[0][lane], static_cast<float>(expected)) << lod[lane] << " round " << round;
      }
    }
  }
}

TEST_P(SamplingLod, ExtremeLodsStayInTheView) {
  const Texture texture = numbered_levels(6);
  Lanes centre, lod;
  for (float& value : centre.lane) value = 0.5f;
  for (size_t lane = 0; lane < 64; ++lane) lod[lane] = extremes()[lane % extremes().size()];
  for (VkSamplerMipmapMode mode : {VK_SAMPLER_MIPMAP_MODE_NEAREST, VK_SAMPLER_MIPMAP_MODE_LINEAR}) {
    for (float bound : {0.0f, kNan, kInfinity, -kInfinity}) {
      SamplerState sampler =
          sampler_of(VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_REPEAT, VK_SAMPLER_ADDRESS_MODE_REPEAT);
      sampler.mipmap_mode = mode;
      if (bound != 0.0f) sampler.min_lod = sampler.max_lod = sampler.lod_bias = bound;
      Rgba out;
      sample(texture, sampler, centre, centre, out, &lod);
      for (size_t lane = 0; lane < 64; ++lane) {
        ASSERT_TRUE(out.component[0][lane] >= 0.0f && out.component[0][lane] <= 5.0f);
        if (bound != 0.0f) continue;
        if (lod[lane] <= 0.0f || std::isnan(lod[lane])) {
          EXPECT_EQ(out.component[0][lane], 0.0f) << lod[lane];
        }
        if (lod[lane] > 5.0f) {
          EXPECT_EQ(out.component[0][lane], 5.0f) << lod[lane];
        }
      }
    }
  }
}

TEST_P(SamplingLod, MagnificationHasItsOwnFilter) {
  Texture texture(VK_FORMAT_R32G32B32A32_SFLOAT, 2, 1, 2);
  texture.set(0, 0, 0, {0, 0, 0, 0});
  texture.set(0, 1, 0, {1, 0, 0, 0});
  texture.set(1, 0, 0, {7, 0, 0, 0});
  Lanes u, v, lod;
  for (size_t lane = 0; lane < 64; ++lane) {
    u[lane] = 0.375f;  // texel 0.75: nearest is 0, linear a quarter of the way
    v[lane] = 0.5f;
    lod[lane] = lane % 4 == 0 ? 0.0f : lane % 4 == 1 ? 0.25f : lane % 4 == 2 ? -3.0f : 1.0f;
  }
  for (bool linear_magnifies : {false, true}) {
    SamplerState sampler =
        sampler_of(VK_FILTER_NEAREST, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE);
    (linear_magnifies ? sampler.mag_filter : sampler.min_filter) = VK_FILTER_LINEAR;
    Rgba out;
    sample(texture, sampler, u, v, out, &lod);
    for (size_t lane = 0; lane < 64; ++lane) {
      const bool magnified = lod[lane] <= 0.0f;
      const float level0 = magnified == linear_magnifies ? 0.25f : 0.0f;
      EXPECT_EQ(out.component[0][lane], lane % 4 == 3 ? 7.0f : level0) << lod[lane];
    }
  }
}

// A batch whose lanes read one level takes a shorter way; a lane that reads another one changes nothing for them.
TEST_P(SamplingLod, OneLevelForAllLanesGivesTheSameBits) {
  Texture texture(VK_FORMAT_R8G8B8A8_UNORM, 64, 32, 6);
  std::mt19937 random(8);
  for (uint32_t level = 0; level < 6; ++level) {
    for (uint32_t i = 0; i < (64u >> level) * std::max(32u >> level, 1u); ++i) {
      const float value = static_cast<float>(random() % 256) / 255.0f;
      texture.set(level, i % (64u >> level), i / (64u >> level), {value, 1 - value, value, 1});
    }
  }
  for (VkSamplerMipmapMode mode : {VK_SAMPLER_MIPMAP_MODE_NEAREST, VK_SAMPLER_MIPMAP_MODE_LINEAR}) {
    for (float level : {-1.0f, 0.0f, 0.25f, 1.0f, 3.0f, 5.0f, 9.0f}) {
      SamplerState sampler =
          sampler_of(VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_REPEAT, VK_SAMPLER_ADDRESS_MODE_REPEAT);
      sampler.mag_filter = VK_FILTER_NEAREST;
      sampler.mipmap_mode = mode;
      Lanes u, v, lod;
      for (size_t lane = 0; lane < 64; ++lane) {
        u[lane] = static_cast<float>(random() % 1000) * 0.01f;
        v[lane] = static_cast<float>(random() % 1000) * 0.01f;
        lod[lane] = level;
      }
      Rgba same, other;
      sample(texture, sampler, u, v, same, &lod);
      lod[17] = level > 2.0f ? 0.5f : 4.0f;
      sample(texture, sampler, u, v, other, &lod);
      for (size_t c = 0; c < 4; ++c) {
        for (size_t lane = 0; lane < 64; ++lane) {
          if (lane == 17) continue;
          EXPECT_EQ(same.component[c][lane], other.component[c][lane]) << level << ' ' << lane;
        }
      }
    }
  }
}

TEST_P(SamplingLod, DerivativesGiveTheLod) {
  Texture texture(VK_FORMAT_R8G8B8A8_UNORM, 64, 32, 6);
  const SamplerState sampler =
      sampler_of(VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_REPEAT, VK_SAMPLER_ADDRESS_MODE_REPEAT);
  Lanes u, v, lod;
  double expected[16];
  std::mt19937 random(7);
  std::uniform_real_distribution<float> step(-0.2f, 0.2f);
  for (size_t quad = 0; quad < 16; ++quad) {
    const float ux = step(random), uy = step(random), vx = step(random), vy = step(random);
    for (size_t lane = 0; lane < 4; ++lane) {
      u[quad * 4 + lane] = 0.5f + static_cast<float>(lane % 2) * ux + static_cast<float>(lane / 2) * uy;
      v[quad * 4 + lane] = 0.5f + static_cast<float>(lane % 2) * vx + static_cast<float>(lane / 2) * vy;
    }
    const auto along = [&](size_t lane) {
      return std::hypot((double{u[quad * 4 + lane]} - double{u[quad * 4]}) * 64,
                        (double{v[quad * 4 + lane]} - double{v[quad * 4]}) * 32);
    };
    expected[quad] = std::log2(std::max(along(1), along(2)));
  }
  functions().lod_from_derivatives(texture.view, sampler, u.lane, v.lane, lod.lane);
  for (size_t lane = 0; lane < 64; ++lane) EXPECT_NEAR(lod[lane], expected[lane / 4], 1e-5);

  // Powers of two are exact; no change gives -Inf; NaN 0.
  for (size_t lane = 0; lane < 64; ++lane) {
    u[lane] = lane < 32 ? static_cast<float>(lane % 2) * 4.0f / 64.0f : lane < 48 ? 3.0f : kNan;
    v[lane] = 0.0f;
  }
  functions().lod_from_derivatives(texture.view, sampler, u.lane, v.lane, lod.lane);
  EXPECT_EQ(lod[0], 2.0f);
  EXPECT_EQ(lod[31], 2.0f);
  EXPECT_EQ(lod[32], -kInfinity);
  EXPECT_EQ(lod[63], 0.0f);
}

TEST_P(SamplingLod, ImplicitLodReadsTheLevelOfTheFootprint) {
  const Texture texture = numbered_levels(6);
  SamplerState sampler = sampler_of(VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_REPEAT, VK_SAMPLER_ADDRESS_MODE_REPEAT);
  sampler.mipmap_mode = VK_SAMPLER_MIPMAP_MODE_LINEAR;
  Lanes u, v, bias;
  for (size_t lane = 0; lane < 64; ++lane) {
    const float texels = static_cast<float>(1 << (lane / 16));  // 1, 2, 4, 8 texels a pixel: lod 0 … 3
    u[lane] = static_cast<float>(lane % 2) * texels / 64.0f;
    v[lane] = 0.25f;
    bias[lane] = 0.5f;
  }
  Rgba out;
  functions().sample_2d(&texture.view, &sampler, {u.lane, v.lane, bias.lane, LodSource::derivatives, kAll},
                        out.pointers);
  for (size_t lane = 0; lane < 64; ++lane) {
    EXPECT_EQ(out.component[0][lane], static_cast<float>(lane / 16) + 0.5f) << lane;
  }
}

}  // namespace
}  // namespace lapilli
