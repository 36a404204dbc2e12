// What the tests of sampling share: registers, samplers, extreme coordinates and the fixture for each SIMD target.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cfloat>
#include <limits>
#include <string>
#include <vector>

#include "image/sampling.h"
#include "image/sampling_reference.h"

namespace lapilli::sampling_test {

using reference::Color;
using reference::Texture;

inline constexpr uint64_t kAll = ~uint64_t{0};
inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
inline constexpr uint32_t kOne = std::bit_cast<uint32_t>(1.0f);
inline constexpr VkSamplerAddressMode kModes[] = {
    VK_SAMPLER_ADDRESS_MODE_REPEAT, VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
    VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER};
inline constexpr VkFormat kSampledFormats[] = {VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_B8G8R8A8_UNORM,
                                               VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_D32_SFLOAT,
                                               VK_FORMAT_R32G32_SFLOAT};

struct Lanes {
  alignas(64) float lane[64] = {};
  float& operator[](size_t i) { return lane[i]; }
  float operator[](size_t i) const { return lane[i]; }
};
struct Rgba {
  Lanes component[4];
  float* pointers[4] = {component[0].lane, component[1].lane, component[2].lane, component[3].lane};
};

inline SamplerState sampler_of(VkFilter filter, VkSamplerAddressMode u, VkSamplerAddressMode v) {
  SamplerState sampler;
  sampler.mag_filter = sampler.min_filter = filter;
  sampler.address_u = u;
  sampler.address_v = v;
  sampler.max_lod = 1000.0f;
  return sampler;
}

class Sampling : public testing::TestWithParam<SimdTarget> {
 protected:
  const SamplingFunctions& functions() const { return sampling_functions(GetParam()); }

  void sample(const Texture& texture, const SamplerState& sampler, const Lanes& u, const Lanes& v, Rgba& out,
              const Lanes* lod = nullptr) const {
    const SampleOperands operands = {u.lane, v.lane, lod != nullptr ? lod->lane : nullptr, LodSource::operand, kAll};
    functions().sample_2d(&texture.view, &sampler, operands, out.pointers);
  }
};

inline const std::vector<float>& extremes() {
  static const std::vector<float> values = {
      kNan,      -kNan, kInfinity,     -kInfinity, FLT_MAX,        -FLT_MAX,   1e30f,          -1e30f,
      0.0f,      -0.0f, 1e-45f,        -1e-45f,    0x1p31f,        -0x1p31f,   0x1p32f,        -0x1p32f,
      0x1p23f,   1e9f,  -1e9f,         16777215.f, -16777215.5f,   1.0f,       0x1.FFFFFEp-1f, -0x1p-25f,
      -0x1p-30f, 2.0f,  0x1.FFFFFEp0f, -1.0f,      -0x1.000002p0f, 8388607.5f, -8388607.5f,    3.0e38f};
  return values;
}

}  // namespace lapilli::sampling_test
