// Offsets, depth comparison, gathers, storage and queries of the level of detail, against the slow sampler of
// sampling_reference.h. Specification: "Image Operations".
#include <gtest/gtest.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstring>
#include <random>

#include "image/sampling_fixture.h"

namespace lapilli {
namespace {

using namespace sampling_test;

class SamplingGeneral : public Sampling {};

INSTANTIATE_TEST_SUITE_P(Targets, SamplingGeneral, testing::ValuesIn(supported_simd_targets()),
                         [](const auto& target) { return std::string(simd_target_name(target.param)); });

// Coordinates that lie between texels and between texel centres, so that rounding decides nothing.
struct Places {
  Lanes u, v;
  double x[64], y[64];  // the same in texels
  alignas(64) int32_t dx[64], dy[64];

  Places(std::mt19937& random, const Texture& texture) {
    const auto pick = [&](uint32_t size, float& s, double& texels) {
      const double fraction = (random() & 1) != 0 ? 0.25 : 0.75;
      texels = static_cast<double>(static_cast<int>(random() % (4 * size + 8)) - static_cast<int>(2 * size)) + fraction;
      s = static_cast<float>(texels / size);
    };
    for (size_t lane = 0; lane < 64; ++lane) {
      pick(texture.layout.extent.width, u[lane], x[lane]);
      pick(texture.layout.extent.height, v[lane], y[lane]);
      dx[lane] = static_cast<int32_t>(random() % 16) - 8;
      dy[lane] = static_cast<int32_t>(random() % 16) - 8;
    }
  }
};

double depth_test(VkCompareOp op, double reference, double depth) {
  const bool passed[] = {false, reference<depth, reference == depth, reference <= depth, reference> depth,
                         reference != depth, reference >= depth, true};
  return passed[op] ? 1 : 0;
}

// The four texels of a footprint (upper left, right, lower left, right) with an offset, compared if there is a
// reference.
std::array<Color, 4> footprint(const Texture& texture, const SamplerState& sampler, double x, double y, int32_t dx,
                               int32_t dy, const float* reference) {
  const int64_t i = static_cast<int64_t>(std::floor(x - 0.5)) + dx, j = static_cast<int64_t>(std::floor(y - 0.5)) + dy;
  std::array<Color, 4> texels;
  for (int t = 0; t < 4; ++t) {
    Color& texel = texels[static_cast<size_t>(t)];
    texel = reference::read(texture, sampler, 0, i + (t & 1), j + (t >> 1));
    if (reference != nullptr) texel = {depth_test(sampler.compare_op, double{*reference}, texel[0]), 0, 0, 1};
  }
  return texels;
}

// With the one of VK_KHR_sampler_mirror_clamp_to_edge.
VkSamplerAddressMode any_mode(std::mt19937& random) {
  const size_t mode = random() % (std::size(kModes) + 1);
  return mode < std::size(kModes) ? kModes[mode] : VK_SAMPLER_ADDRESS_MODE_MIRROR_CLAMP_TO_EDGE;
}

constexpr VkFormat kFormats[] = {VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_R32G32_SFLOAT,
                                 VK_FORMAT_D32_SFLOAT};

struct Round {
  Texture texture;
  SamplerState sampler;
  Round(std::mt19937& random, VkFormat format, VkFilter filter, uint32_t width, uint32_t height)
      : texture(format, width, height), sampler(sampler_of(filter, any_mode(random), any_mode(random))) {
    texture.fill_random(static_cast<uint32_t>(random()));
    sampler.border = {kOne, kOne, kOne, kOne};
  }
};

TEST_P(SamplingGeneral, OffsetsMoveTheTexels) {
  std::mt19937 random(21);
  for (VkFormat format : kFormats) {
    for (int n = 0; n < 60; ++n) {
      const bool linear = n % 2 != 0;
      const Round round(random, format, linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST, n % 3 == 0 ? 7 : 16,
                        n % 5 == 0 ? 1 : 5);
      const Places at(random, round.texture);
      Rgba out;
      SampleOperands operands = {at.u.lane, at.v.lane, nullptr, LodSource::operand, kAll};
      operands.offset_x = at.dx;
      operands.offset_y = at.dy;
      functions().sample_2d(&round.texture.view, &round.sampler, operands, out.pointers);
      for (size_t lane = 0; lane < 64; ++lane) {
        const auto texels =
            footprint(round.texture, round.sampler, at.x[lane], at.y[lane], at.dx[lane], at.dy[lane], nullptr);
        const Color nearest =
            reference::read(round.texture, round.sampler, 0, static_cast<int64_t>(std::floor(at.x[lane])) + at.dx[lane],
                            static_cast<int64_t>(std::floor(at.y[lane])) + at.dy[lane]);
        const double alpha = at.x[lane] - 0.5 - std::floor(at.x[lane] - 0.5);
        const double beta = at.y[lane] - 0.5 - std::floor(at.y[lane] - 0.5);
        for (size_t c = 0; c < 4; ++c) {
          const double upper = (1 - alpha) * texels[0][c] + alpha * texels[1][c];
          const double lower = (1 - alpha) * texels[2][c] + alpha * texels[3][c];
          const double expected = linear ? (1 - beta) * upper + beta * lower : nearest[c];
          ASSERT_NEAR(double{out.component[c][lane]}, expected, 1e-5)
              << n << " lane " << lane << " at " << at.x[lane] << ", " << at.y[lane];
        }
      }
    }
  }
}

TEST_P(SamplingGeneral, ComparisonsAreFiltered) {
  std::mt19937 random(22);
  for (uint32_t op = VK_COMPARE_OP_NEVER; op <= VK_COMPARE_OP_ALWAYS; ++op) {
    for (VkFilter filter : {VK_FILTER_NEAREST, VK_FILTER_LINEAR}) {
      Round round(random, VK_FORMAT_D32_SFLOAT, filter, 9, 6);
      round.sampler.compare = true;
      round.sampler.compare_op = static_cast<VkCompareOp>(op);
      const Places at(random, round.texture);
      Lanes reference;
      for (float& value : reference.lane) {  // equal to a texel now and then
        value = static_cast<float>(round.texture.get(0, static_cast<int64_t>(random() % 9), 0)[0]);
      }
      reference[7] = kNan;
      Rgba out;
      SampleOperands operands = {at.u.lane, at.v.lane, nullptr, LodSource::operand, kAll};
      operands.reference = reference.lane;
      functions().sample_2d(&round.texture.view, &round.sampler, operands, out.pointers);
      for (size_t lane = 0; lane < 64; ++lane) {
        const auto texels =
            footprint(round.texture, round.sampler, at.x[lane], at.y[lane], 0, 0, &reference.lane[lane]);
        const double alpha = at.x[lane] - 0.5 - std::floor(at.x[lane] - 0.5);
        const double beta = at.y[lane] - 0.5 - std::floor(at.y[lane] - 0.5);
        double expected = (1 - beta) * ((1 - alpha) * texels[0][0] + alpha * texels[1][0]) +
                          beta * ((1 - alpha) * texels[2][0] + alpha * texels[3][0]);
        if (filter == VK_FILTER_NEAREST) {
          const Color texel = reference::nearest(round.texture, round.sampler, 0, at.x[lane], at.y[lane]);
          expected = depth_test(round.sampler.compare_op, double{reference[lane]}, texel[0]);
        }
        ASSERT_NEAR(double{out.component[0][lane]}, expected, 1e-6) << op << " lane " << lane;
        ASSERT_EQ(out.component[1][lane], 0.0f);
        ASSERT_EQ(out.component[3][lane], 1.0f);
      }
    }
  }
}

TEST_P(SamplingGeneral, GathersTheFootprint) {
  std::mt19937 random(23);
  constexpr size_t kOrder[] = {2, 3, 1, 0};
  for (int n = 0; n < 60; ++n) {
    const bool compares = n % 4 == 3;
    Round round(random, compares ? VK_FORMAT_D32_SFLOAT : kFormats[n % 3], VK_FILTER_NEAREST, 8, 5);
    round.sampler.compare_op = VK_COMPARE_OP_LESS_OR_EQUAL;
    const Places at(random, round.texture);
    Lanes reference;
    for (float& value : reference.lane) value = 0.5f;
    Rgba out;
    SampleOperands operands = {at.u.lane, at.v.lane, nullptr, LodSource::operand, kAll};
    if (n % 2 != 0) operands.offset_x = at.dx, operands.offset_y = at.dy;
    if (compares) operands.reference = reference.lane;
    const uint32_t component = compares ? 0 : random() % 4;
    functions().gather_2d(&round.texture.view, &round.sampler, operands, component, out.pointers);
    for (size_t lane = 0; lane < 64; ++lane) {
      const bool moved = operands.offset_x != nullptr;
      const auto texels = footprint(round.texture, round.sampler, at.x[lane], at.y[lane], moved ? at.dx[lane] : 0,
                                    moved ? at.dy[lane] : 0, compares ? &reference.lane[lane] : nullptr);
      for (size_t i = 0; i < 4; ++i) {
        ASSERT_EQ(out.component[i][lane], static_cast<float>(texels[kOrder[i]][component])) << n << " lane " << lane;
      }
    }
  }
}

TEST_P(SamplingGeneral, GathersAfterTheSwizzle) {
  Texture texture(
      VK_FORMAT_R8G8B8A8_UNORM, 2, 2, 1,
      {VK_COMPONENT_SWIZZLE_ONE, VK_COMPONENT_SWIZZLE_R, VK_COMPONENT_SWIZZLE_ZERO, VK_COMPONENT_SWIZZLE_G});
  texture.set(0, 1, 1, {0.2f, 0.6f, 0, 0});
  const SamplerState sampler = sampler_of(VK_FILTER_NEAREST, kModes[2], kModes[2]);
  Lanes centre;
  for (float& value : centre.lane) value = 0.5f;
  constexpr float kExpected[] = {1.0f, 0.2f, 0.0f, 0.6f};
  for (uint32_t component = 0; component < 4; ++component) {
    Rgba out;
    functions().gather_2d(&texture.view, &sampler, {centre.lane, centre.lane, nullptr, LodSource::operand, kAll},
                          component, out.pointers);
    EXPECT_NEAR(out.component[1][5], kExpected[component], 1e-6) << component;
  }
}

// Nothing outside of the texture is read (it ends with its memory), and the result is one of its values.
TEST_P(SamplingGeneral, ExtremesStayInside) {
  std::mt19937 random(24);
  for (VkFormat format : kFormats) {
    for (uint32_t size : {1u, 3u, 8u}) {
      for (VkSamplerAddressMode mode : kModes) {
        Texture texture(format, size, size);
        texture.fill_random(1);
        SamplerState sampler = sampler_of(size == 3 ? VK_FILTER_NEAREST : VK_FILTER_LINEAR, mode, mode);
        sampler.unnormalized = size == 8 && mode == VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
        Lanes u, v;
        alignas(64) int32_t dx[64], dy[64];
        constexpr int32_t kFar[] = {INT_MAX, INT_MIN, -1, 1000000, 32768, 0};
        for (size_t lane = 0; lane < 64; ++lane) {
          u[lane] = extremes()[random() % extremes().size()];
          v[lane] = extremes()[random() % extremes().size()];
          dx[lane] = kFar[random() % std::size(kFar)];
          dy[lane] = kFar[random() % std::size(kFar)];
        }
        SampleOperands operands = {u.lane, v.lane, nullptr, LodSource::operand, kAll};
        operands.offset_x = dx;
        operands.offset_y = dy;
        Rgba out;
        functions().sample_2d(&texture.view, &sampler, operands, out.pointers);
        for (float value : out.component[0].lane) ASSERT_TRUE(value >= 0.0f && value <= 1.0f) << value;
        operands.reference = u.lane;
        functions().sample_2d(&texture.view, &sampler, operands, out.pointers);
        for (float value : out.component[0].lane) ASSERT_TRUE(value >= 0.0f && value <= 1.0f) << value;
        functions().gather_2d(&texture.view, &sampler, operands, 0xFFFFFFFF, out.pointers);
        for (float value : out.component[0].lane) ASSERT_EQ(value, 1.0f);
      }
    }
  }
}

TEST_P(SamplingGeneral, QueriesGiveLevelAndUnclampedLod) {
  const Texture texture(VK_FORMAT_R8G8B8A8_UNORM, 64, 64, 4);
  SamplerState sampler = sampler_of(VK_FILTER_LINEAR, kModes[0], kModes[0]);
  sampler.mipmap_mode = VK_SAMPLER_MIPMAP_MODE_LINEAR;
  sampler.lod_bias = 0.5f;
  sampler.max_lod = 2.25f;
  Lanes u, v, level, lod;
  for (size_t lane = 0; lane < 64; ++lane) {  // quad q: 2^(q/2 - 2) texels a pixel
    u[lane] = static_cast<float>(lane & 1) * std::exp2(static_cast<float>(lane / 4) / 2.0f - 8.0f);
    v[lane] = 0.25f;
  }
  const SampleOperands operands = {u.lane, v.lane, nullptr, LodSource::derivatives, kAll};
  functions().query_lod_2d(&texture.view, &sampler, operands, level.lane, lod.lane);
  for (size_t lane = 0; lane < 64; ++lane) {
    const float expected = static_cast<float>(lane / 4) / 2.0f - 2.0f + 0.5f;
    EXPECT_NEAR(lod[lane], expected, 1e-5);
    EXPECT_NEAR(level[lane], std::clamp(expected, 0.0f, 2.25f), 1e-5);
  }
  sampler.mipmap_mode = VK_SAMPLER_MIPMAP_MODE_NEAREST;
  functions().query_lod_2d(&texture.view, &sampler, operands, level.lane, lod.lane);
  for (size_t lane = 0; lane < 64; ++lane) EXPECT_EQ(level[lane], std::floor(level[lane]));
  functions().query_lod_2d(nullptr, &sampler, operands, level.lane, lod.lane);
  EXPECT_EQ(level[3], 0.0f);
}

TEST_P(SamplingGeneral, StoresTexelsInsideOnly) {
  Texture texture(VK_FORMAT_R32G32B32A32_UINT, 5, 3);
  std::vector<std::byte> expected = texture.memory;
  alignas(64) int32_t x[64], y[64];
  alignas(64) uint32_t value[4][64];
  for (int lane = 0; lane < 64; ++lane) {
    x[lane] = lane % 8 - 1;
    y[lane] = lane == 63 ? INT_MIN : lane / 8 - 1;
    for (uint32_t c = 0; c < 4; ++c) value[c][lane] = static_cast<uint32_t>(lane) * 16 + c;
  }
  const float* const rgba[4] = {reinterpret_cast<const float*>(value[0]), reinterpret_cast<const float*>(value[1]),
                                reinterpret_cast<const float*>(value[2]), reinterpret_cast<const float*>(value[3])};
  const uint64_t lanes = ~(uint64_t{1} << 10);
  functions().store_2d(&texture.view, {x, y, nullptr, lanes}, rgba);
  for (uint32_t row = 0; row < 3; ++row) {
    for (uint32_t column = 0; column < 5; ++column) {
      const uint32_t lane = (row + 1) * 8 + column + 1;
      uint32_t texel[4];
      std::memcpy(texel, texture.texel(0, column, row), 16);
      for (uint32_t c = 0; c < 4; ++c) EXPECT_EQ(texel[c], lane == 10 ? 0 : lane * 16 + c) << lane;
      std::memcpy(expected.data() + (texture.texel(0, column, row) - texture.memory.data()), texel, 16);
    }
  }
  EXPECT_EQ(texture.memory, expected);  // nothing beside the texels
  functions().store_2d(nullptr, {x, y, nullptr, kAll}, rgba);
  Texture depth(VK_FORMAT_D32_SFLOAT, 5, 3);  // not a format to store to
  functions().store_2d(&depth.view, {x, y, nullptr, kAll}, rgba);
}

TEST(SamplingGeneralTargets, GiveTheSameBits) {
  std::mt19937 random(25);
  for (VkFormat format : kFormats) {
    for (int n = 0; n < 20; ++n) {
      Round round(random, format, n % 2 != 0 ? VK_FILTER_LINEAR : VK_FILTER_NEAREST, 13, 7);
      round.sampler.compare_op = static_cast<VkCompareOp>(n % 8);
      Lanes u, v;
      alignas(64) int32_t dx[64], dy[64];
      for (size_t lane = 0; lane < 64; ++lane) {
        u[lane] = n == 0 ? extremes()[lane % extremes().size()] : static_cast<float>(random()) * 0x1p-29f - 4.0f;
        v[lane] = static_cast<float>(random()) * 0x1p-29f - 4.0f;
        dx[lane] = static_cast<int32_t>(random() % 16) - 8;
        dy[lane] = static_cast<int32_t>(random());
      }
      SampleOperands operands = {u.lane, v.lane, nullptr, LodSource::operand, kAll};
      operands.offset_x = dx;
      operands.offset_y = dy;
      if (n % 3 == 0) operands.reference = v.lane;
      std::vector<Rgba> results(2 * supported_simd_targets().size());
      size_t next = 0;
      for (SimdTarget target : supported_simd_targets()) {
        const SamplingFunctions& functions = sampling_functions(target);
        functions.sample_2d(&round.texture.view, &round.sampler, operands, results[next++].pointers);
        functions.gather_2d(&round.texture.view, &round.sampler, operands, 0, results[next++].pointers);
      }
      for (size_t i = 2; i < results.size(); ++i) {
        for (size_t c = 0; c < 4; ++c) {
          ASSERT_EQ(std::memcmp(results[i].component[c].lane, results[i % 2].component[c].lane, 256), 0) << n;
        }
      }
    }
  }
}

}  // namespace
}  // namespace lapilli
