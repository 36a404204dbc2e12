// Sampling against the float64 reference, extreme coordinates, and the same bits on every target.
#include "image/sampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "image/sampling_fixture.h"

namespace lapilli {
namespace {

using namespace sampling_test;

INSTANTIATE_TEST_SUITE_P(Targets, Sampling, testing::ValuesIn(supported_simd_targets()),
                         [](const auto& target) { return std::string(simd_target_name(target.param)); });

// Coordinates near the image, on texel centres and boundaries, and some periods away.
Lanes coordinates(uint32_t seed, uint32_t size) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> wide(-3.0f, 4.0f);
  Lanes lanes;
  for (size_t i = 0; i < 64; ++i) {
    const float step = static_cast<float>(static_cast<int32_t>(random() % (6 * size)) - static_cast<int32_t>(2 * size));
    lanes[i] = i < 48   ? wide(random)
               : i < 56 ? (step + 0.5f) / static_cast<float>(size)
                        : step / static_cast<float>(size);
  }
  return lanes;
}

bool near(const Color& expected, const Rgba& out, size_t lane, double tolerance) {
  for (size_t c = 0; c < 4; ++c) {
    if (!(std::fabs(expected[c] - double{out.component[c][lane]}) <= tolerance)) return false;
  }
  return true;
}

std::string text(const Color& color) {
  return std::to_string(color[0]) + ' ' + std::to_string(color[1]) + ' ' + std::to_string(color[2]) + ' ' +
         std::to_string(color[3]);
}

// u = s · size is rounded at most twice: to half a unit in the last place of the wrapped coordinate (below 2) and of
// the position (below 2 · size).
double position_error(uint32_t size) { return size * 0x1p-22; }

TEST_P(Sampling, LinearMatchesTheReference) {
  for (VkFormat format : kSampledFormats) {
    Texture texture(format, 67, 13);
    texture.fill_random(1);
    for (VkSamplerAddressMode mode_u : kModes) {
      for (VkSamplerAddressMode mode_v : kModes) {
        SamplerState sampler = sampler_of(VK_FILTER_LINEAR, mode_u, mode_v);
        sampler.border = {kOne, 0, kOne, 0};
        for (uint32_t seed = 0; seed < 20; ++seed) {
          const Lanes u = coordinates(2 * seed, 67);
          const Lanes v = coordinates(2 * seed + 1, 13);
          Rgba out;
          sample(texture, sampler, u, v, out);
          // The values differ by at most 1 from texel to texel; five roundings of values up to 1.
          const double tolerance = position_error(67) + position_error(13) + 5 * 0x1p-24;
          for (size_t lane = 0; lane < 64; ++lane) {
            const Color expected = reference::linear(texture, sampler, 0, double{u[lane]} * 67, double{v[lane]} * 13);
            ASSERT_TRUE(near(expected, out, lane, tolerance))
                << u[lane] << ' ' << v[lane] << " modes " << mode_u << ' ' << mode_v << " expected " << text(expected)
                << " got " << out.component[0][lane] << ' ' << out.component[1][lane];
          }
        }
      }
    }
  }
}

TEST_P(Sampling, NearestMatchesTheReference) {
  for (VkFormat format : kSampledFormats) {
    Texture texture(format, 67, 13);
    texture.fill_random(2);
    for (VkSamplerAddressMode mode_u : kModes) {
      for (VkSamplerAddressMode mode_v : kModes) {
        const SamplerState sampler = sampler_of(VK_FILTER_NEAREST, mode_u, mode_v);
        for (uint32_t seed = 0; seed < 20; ++seed) {
          const Lanes u = coordinates(2 * seed, 67);
          const Lanes v = coordinates(2 * seed + 1, 13);
          Rgba out;
          sample(texture, sampler, u, v, out);
          for (size_t lane = 0; lane < 64; ++lane) {
            // On a boundary, rounding may choose either side.
            bool found = false;
            for (double du : {-position_error(67), position_error(67)}) {
              for (double dv : {-position_error(13), position_error(13)}) {
                const Color expected =
                    reference::nearest(texture, sampler, 0, double{u[lane]} * 67 + du, double{v[lane]} * 13 + dv);
                found = found || near(expected, out, lane, 0x1p-24);
              }
            }
            ASSERT_TRUE(found) << u[lane] << ' ' << v[lane] << " modes " << mode_u << ' ' << mode_v;
          }
        }
      }
    }
  }
}

// Sides that are powers of two: every position is exact, and so must be the texel, on boundaries too.
TEST_P(Sampling, NearestIsExactOnTexelBoundaries) {
  Texture texture(VK_FORMAT_R32G32B32A32_SFLOAT, 16, 4);
  texture.fill_random(3);
  for (VkSamplerAddressMode mode : kModes) {
    const SamplerState sampler = sampler_of(VK_FILTER_NEAREST, mode, mode);
    for (int32_t start = -96; start < 96; start += 16) {
      Lanes u, v;
      for (size_t lane = 0; lane < 64; ++lane) {
        u[lane] = (static_cast<float>(start) + static_cast<float>(lane) * 0.25f) / 16.0f;
        v[lane] = (static_cast<float>(start) * 0.25f + static_cast<float>(63 - lane) * 0.25f) / 4.0f;
      }
      Rgba out;
      sample(texture, sampler, u, v, out);
      for (size_t lane = 0; lane < 64; ++lane) {
        const Color expected = reference::nearest(texture, sampler, 0, double{u[lane]} * 16, double{v[lane]} * 4);
        ASSERT_TRUE(near(expected, out, lane, 0)) << u[lane] * 16 << ' ' << v[lane] * 4 << " mode " << mode;
      }
    }
  }
}

// Weights 0 and 1: the decoded texel, bit for bit.
TEST_P(Sampling, LinearIsExactOnTexelCentres) {
  Texture texture(VK_FORMAT_R8G8B8A8_UNORM, 16, 16);
  for (uint32_t i = 0; i < 256; ++i) {
    for (uint32_t c = 0; c < 4; ++c) texture.texel(0, i % 16, i / 16)[c] = static_cast<std::byte>(i * (2 * c + 1) + c);
  }
  for (VkSamplerAddressMode mode : kModes) {
    const SamplerState sampler = sampler_of(VK_FILTER_LINEAR, mode, mode);
    for (uint32_t first = 0; first < 256; first += 64) {
      Lanes u, v;
      for (uint32_t lane = 0; lane < 64; ++lane) {
        u[lane] = (static_cast<float>((first + lane) % 16) + 0.5f) / 16.0f;
        v[lane] = (static_cast<float>((first + lane) / 16) + 0.5f) / 16.0f;
      }
      Rgba out;
      sample(texture, sampler, u, v, out);
      for (uint32_t lane = 0; lane < 64; ++lane) {
        for (uint32_t c = 0; c < 4; ++c) {
          const uint32_t i = first + lane;
          EXPECT_EQ(out.component[c][lane], static_cast<float>(static_cast<uint8_t>(i * (2 * c + 1) + c)) / 255.0f);
        }
      }
    }
  }
}

TEST_P(Sampling, ExtremeCoordinatesStayInside) {
  for (VkFormat format : kSampledFormats) {
    for (uint32_t width : {1u, 3u, 64u, 67u}) {
      Texture texture(format, width, 5);  // its memory ends with its last texel
      texture.fill_random(4);
      for (VkFilter filter : {VK_FILTER_NEAREST, VK_FILTER_LINEAR}) {
        for (VkSamplerAddressMode mode : kModes) {
          for (bool unnormalized : {false, true}) {
            SamplerState sampler = sampler_of(filter, mode, mode);
            sampler.unnormalized = unnormalized;
            for (size_t shift = 0; shift < extremes().size(); ++shift) {
              Lanes u, v;
              for (size_t lane = 0; lane < 64; ++lane) {
                u[lane] = extremes()[lane % extremes().size()];
                v[lane] = extremes()[(lane + shift) % extremes().size()];
              }
              Rgba out;
              sample(texture, sampler, u, v, out);
              for (size_t lane = 0; lane < 64; ++lane) {
                for (const Lanes& component : out.component) {
                  ASSERT_TRUE(component[lane] >= 0.0f && component[lane] <= 1.0f) << u[lane] << ' ' << v[lane];
                }
              }
            }
          }
        }
      }
    }
  }
}

TEST_P(Sampling, ClampedExtremesAreTheEdgeOrTheBorder) {
  Texture texture(VK_FORMAT_R32G32B32A32_SFLOAT, 5, 1);
  for (uint32_t x = 0; x < 5; ++x) texture.set(0, x, 0, {static_cast<float>(x), 0, 0, 1});
  Lanes u, v;
  const float ends[] = {kInfinity, -kInfinity, 1e30f, -1e30f};
  for (size_t lane = 0; lane < 64; ++lane) {
    u[lane] = ends[lane % 4];
    v[lane] = 0.5f;
  }
  for (VkFilter filter : {VK_FILTER_NEAREST, VK_FILTER_LINEAR}) {
    for (bool border : {false, true}) {
      const VkSamplerAddressMode mode =
          border ? VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER : VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
      SamplerState sampler = sampler_of(filter, mode, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE);
      sampler.border = {std::bit_cast<uint32_t>(0.25f), 0, 0, 0};
      Rgba out;
      sample(texture, sampler, u, v, out);
      for (size_t lane = 0; lane < 64; ++lane) {
        EXPECT_EQ(out.component[0][lane], border ? 0.25f : u[lane] > 0 ? 4.0f : 0.0f);
        EXPECT_EQ(out.component[3][lane], border ? 0.0f : 1.0f);
      }
    }
  }
}

TEST_P(Sampling, UnnormalizedCoordinatesAreTexels) {
  Texture texture(VK_FORMAT_R32G32B32A32_SFLOAT, 9, 7);
  texture.fill_random(5);
  for (VkFilter filter : {VK_FILTER_NEAREST, VK_FILTER_LINEAR}) {
    SamplerState sampler =
        sampler_of(filter, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER);
    sampler.unnormalized = true;
    Lanes u, v;
    for (size_t lane = 0; lane < 64; ++lane) {
      u[lane] = static_cast<float>(lane) * 0.25f - 3.0f;
      v[lane] = static_cast<float>(lane % 19) * 0.5f - 1.0f;
    }
    Rgba out;
    sample(texture, sampler, u, v, out);
    for (size_t lane = 0; lane < 64; ++lane) {
      const Color expected = filter == VK_FILTER_NEAREST
                                 ? reference::nearest(texture, sampler, 0, double{u[lane]}, double{v[lane]})
                                 : reference::linear(texture, sampler, 0, double{u[lane]}, double{v[lane]});
      EXPECT_TRUE(near(expected, out, lane, 0x1p-22)) << u[lane] << ' ' << v[lane];
    }
  }
}

TEST_P(Sampling, OtherLanesKeepTheirValue) {
  Texture texture(VK_FORMAT_R8G8B8A8_UNORM, 8, 8, 4);
  texture.fill_random(8);
  std::mt19937_64 random(9);
  for (int round = 0; round < 40; ++round) {
    const uint64_t lanes = round == 0 ? 0 : random() & random();
    SamplerState sampler = sampler_of(round % 2 == 0 ? VK_FILTER_LINEAR : VK_FILTER_NEAREST,
                                      VK_SAMPLER_ADDRESS_MODE_REPEAT, VK_SAMPLER_ADDRESS_MODE_REPEAT);
    sampler.mipmap_mode = VK_SAMPLER_MIPMAP_MODE_LINEAR;
    const Lanes u = coordinates(static_cast<uint32_t>(round), 8);
    const Lanes v = coordinates(static_cast<uint32_t>(round) + 100, 8);
    Lanes lod;
    for (size_t lane = 0; lane < 64; ++lane) lod[lane] = static_cast<float>(random() % 4);
    Rgba all, some;
    for (Lanes& component : some.component) {
      for (float& value : component.lane) value = 77.0f;
    }
    TextureView view = texture.view;
    if (round % 4 >= 2) view.level_count = 1;
    functions().sample_2d(&view, &sampler, {u.lane, v.lane, lod.lane, LodSource::operand, kAll}, all.pointers);
    functions().sample_2d(&view, &sampler, {u.lane, v.lane, lod.lane, LodSource::operand, lanes}, some.pointers);
    for (size_t c = 0; c < 4; ++c) {
      for (size_t lane = 0; lane < 64; ++lane) {
        EXPECT_EQ(some.component[c][lane], (lanes >> lane & 1) != 0 ? all.component[c][lane] : 77.0f);
      }
    }
  }
}

TEST_P(Sampling, ResultMayTakeTheOperandsRegisters) {
  Texture texture(VK_FORMAT_R8G8B8A8_UNORM, 16, 16, 5);
  texture.fill_random(10);
  for (uint32_t levels : {1u, 5u}) {
    TextureView view = texture.view;
    view.level_count = levels;
    SamplerState sampler = sampler_of(VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_REPEAT, VK_SAMPLER_ADDRESS_MODE_REPEAT);
    sampler.mipmap_mode = VK_SAMPLER_MIPMAP_MODE_LINEAR;
    const Lanes u = coordinates(1, 16);
    const Lanes v = coordinates(2, 16);
    const Lanes lod = coordinates(3, 16);
    Rgba apart, same;
    functions().sample_2d(&view, &sampler, {u.lane, v.lane, lod.lane, LodSource::operand, kAll}, apart.pointers);
    same.component[0] = v;
    same.component[1] = lod;
    same.component[2] = u;
    functions().sample_2d(&view, &sampler,
                          {same.pointers[2], same.pointers[0], same.pointers[1], LodSource::operand, kAll},
                          same.pointers);
    for (size_t c = 0; c < 4; ++c) EXPECT_EQ(std::memcmp(apart.pointers[c], same.pointers[c], 256), 0);
  }
}

TEST_P(Sampling, SwizzleAppliesToTexelsAndBorder) {
  const VkComponentMapping mapping = {VK_COMPONENT_SWIZZLE_A, VK_COMPONENT_SWIZZLE_ONE, VK_COMPONENT_SWIZZLE_R,
                                      VK_COMPONENT_SWIZZLE_ZERO};
  Texture texture(VK_FORMAT_R32G32B32A32_SFLOAT, 1, 1, 1, mapping);
  texture.set(0, 0, 0, {2, 3, 4, 5});
  SamplerState sampler =
      sampler_of(VK_FILTER_NEAREST, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER, VK_SAMPLER_ADDRESS_MODE_REPEAT);
  sampler.border = {0, 0, 0, kOne};
  Lanes u, v;
  u[1] = 2.0f;
  Rgba out;
  sample(texture, sampler, u, v, out);
  const float inside[4] = {5, 1, 2, 0};
  const float border[4] = {1, 1, 0, 0};
  for (size_t c = 0; c < 4; ++c) {
    EXPECT_EQ(out.component[c][0], inside[c]);
    EXPECT_EQ(out.component[c][1], border[c]);
  }
}

TEST_P(Sampling, FetchReadsTexelsAndZeroOutside) {
  for (VkFormat format : kSampledFormats) {
    Texture texture(format, 13, 6, 3);
    texture.fill_random(11);
    std::mt19937 random(12);
    const int32_t far_away[] = {INT32_MIN, INT32_MAX, -1, 0x10000, 13, 6};
    for (int round = 0; round < 50; ++round) {
      alignas(64) int32_t x[64], y[64], level[64];
      for (size_t lane = 0; lane < 64; ++lane) {
        x[lane] = static_cast<int32_t>(random() % 15) - 1;
        y[lane] = static_cast<int32_t>(random() % 8) - 1;
        level[lane] = static_cast<int32_t>(random() % 5) - 1;
        if (lane % 16 == 3) x[lane] = far_away[random() % 6];
        if (lane % 16 == 7) y[lane] = far_away[random() % 6];
        if (lane % 16 == 11) level[lane] = far_away[random() % 6];
      }
      const uint64_t lanes = random() | uint64_t{random()} << 32;
      Rgba out;
      functions().fetch_2d(&texture.view, {x, y, round == 0 ? nullptr : level, lanes}, out.pointers);
      for (size_t lane = 0; lane < 64; ++lane) {
        const uint32_t i = round == 0 ? 0 : static_cast<uint32_t>(level[lane]);
        Color expected = {0, 0, 0, 0};
        if ((lanes >> lane & 1) != 0 && i < 3 && x[lane] >= 0 && y[lane] >= 0 &&
            static_cast<uint32_t>(x[lane]) < texture.layout.levels[i].width &&
            static_cast<uint32_t>(y[lane]) < texture.layout.levels[i].height) {
          expected = texture.get(i, x[lane], y[lane]);
        }
        for (size_t c = 0; c < 4; ++c) ASSERT_EQ(out.component[c][lane], static_cast<float>(expected[c]));
      }
    }
  }
}

TEST_P(Sampling, SizeOfLevels) {
  const Texture texture(VK_FORMAT_R8G8B8A8_UNORM, 13, 6, 3);
  alignas(64) int32_t level[64] = {0, 1, 2, 3, -1, INT32_MAX};
  int32_t width[64], height[64];
  int32_t levels[64];
  int32_t* const out[3] = {width, height, levels};
  functions().size_2d(&texture.view, level, kAll, out);
  const int32_t widths[] = {13, 6, 3, 0, 0, 0};
  const int32_t heights[] = {6, 3, 1, 0, 0, 0};
  for (size_t lane = 0; lane < 6; ++lane) {
    EXPECT_EQ(width[lane], widths[lane]);
    EXPECT_EQ(height[lane], heights[lane]);
    EXPECT_EQ(levels[lane], 3);
  }
}

TEST_P(Sampling, NothingBoundReadsZero) {
  const SamplerState sampler;
  const TextureView empty;
  const Texture texture(VK_FORMAT_R8G8B8A8_UNORM, 1, 1);
  alignas(64) const int32_t zeros[64] = {};
  const Lanes u;
  const SampleOperands operands = {u.lane, u.lane, nullptr, LodSource::derivatives, kAll};
  const auto zero_where = [](Rgba& out, uint64_t lanes) {
    bool fine = true;
    for (Lanes& component : out.component) {
      for (size_t lane = 0; lane < 64; ++lane) fine = fine && (component[lane] == 0.0f) == ((lanes >> lane & 1) != 0);
      for (float& value : component.lane) value = 9.0f;
    }
    return fine;
  };
  Rgba out;
  zero_where(out, kAll);
  functions().sample_2d(nullptr, &sampler, operands, out.pointers);
  EXPECT_TRUE(zero_where(out, kAll));
  functions().sample_2d(&texture.view, nullptr, operands, out.pointers);
  EXPECT_TRUE(zero_where(out, kAll));
  functions().sample_2d(&empty, &sampler, operands, out.pointers);
  EXPECT_TRUE(zero_where(out, kAll));
  functions().fetch_2d(nullptr, {zeros, zeros, zeros, 0xFF}, out.pointers);
  EXPECT_TRUE(zero_where(out, 0xFF));
  int32_t width[64], height[64];
  int32_t* const size[3] = {width, height, width};
  functions().size_2d(nullptr, zeros, kAll, size);
  EXPECT_EQ(width[63], 0);
  EXPECT_EQ(height[0], 0);
}

// Anything at all, on every target.
TEST(SamplingTargets, GiveTheSameBits) {
  const std::vector<SimdTarget> targets = supported_simd_targets();
  std::mt19937 random(13);
  const auto any_float = [&random] {
    const uint32_t kind = static_cast<uint32_t>(random() % 4);
    const float unit = static_cast<float>(random()) * 0x1p-32f;
    if (kind == 0) return std::bit_cast<float>(static_cast<uint32_t>(random()));
    return kind == 1 ? unit : (unit - 0.5f) * (kind == 2 ? 8.0f : 1000.0f);
  };
  for (VkFormat format : kSampledFormats) {
    Texture texture(format, 61, 32, 6);
    texture.fill_random(14);
    for (int round = 0; round < 2000; ++round) {
      SamplerState sampler;
      sampler.mag_filter = static_cast<VkFilter>(random() % 2);
      sampler.min_filter = static_cast<VkFilter>(random() % 2);
      sampler.mipmap_mode = static_cast<VkSamplerMipmapMode>(random() % 2);
      sampler.address_u = kModes[random() % 4];
      sampler.address_v = kModes[random() % 4];
      sampler.max_lod = 100.0f;
      sampler.border = {kOne, 0, kOne, kOne};
      Lanes u, v, lod;
      for (size_t lane = 0; lane < 64; ++lane) {
        u[lane] = any_float();
        v[lane] = any_float();
        lod[lane] = any_float();
      }
      const LodSource source = round % 2 == 0 ? LodSource::operand : LodSource::derivatives;
      const SampleOperands operands = {u.lane, v.lane, round % 3 == 0 ? nullptr : lod.lane, source, kAll};
      TextureView view = texture.view;
      if (round % 5 == 0) view.level_count = 1;
      Rgba first;
      sampling_functions(targets[0]).sample_2d(&view, &sampler, operands, first.pointers);
      for (SimdTarget target : targets) {
        Rgba other;
        sampling_functions(target).sample_2d(&view, &sampler, operands, other.pointers);
        for (size_t c = 0; c < 4; ++c) {
          ASSERT_EQ(std::memcmp(first.pointers[c], other.pointers[c], 256), 0) << simd_target_name(target);
        }
      }
    }
  }
}

}  // namespace
}  // namespace lapilli
