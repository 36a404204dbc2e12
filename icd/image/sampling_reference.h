// A slow sampler for the tests, written from the specification's integer and real equations in doubles, one texel at a
// time.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

#include "image/texture.h"

namespace lapilli::reference {

using Color = std::array<double, 4>;

// An image of its own memory, without a byte to spare behind it, with values that every format can hold.
struct Texture {
  ImageLayout layout;
  std::vector<std::byte> memory;
  TextureView view;

  Texture(VkFormat format, uint32_t width, uint32_t height, uint32_t levels = 1, VkComponentMapping mapping = {}) {
    layout = *make_layout(format, {.width = width, .height = height, .mip_levels = levels});
    const LevelLayout& last = layout.levels[levels - 1];
    const uint64_t used = last.offset + (last.height - 1) * last.row_pitch + last.width * layout.format->texel_size;
    memory.resize(used);
    view = *make_view(layout, memory.data(), format, mapping, {layout.format->aspects, 0, levels, 0, 1});
  }

  std::byte* texel(uint32_t level, uint32_t x, uint32_t y) {
    return memory.data() + layout.levels[level].offset + y * layout.levels[level].row_pitch +
           x * layout.format->texel_size;
  }

  void set(uint32_t level, uint32_t x, uint32_t y, const std::array<float, 4>& rgba) {
    for (size_t c = 0; c < 4; ++c) {
      const ComponentLayout& component = layout.format->components[c];
      std::byte* field = texel(level, x, y) + component.first_bit / 8;
      if (component.kind == ComponentKind::unorm) *field = static_cast<std::byte>(std::lround(rgba[c] * 255.0f));
      if (component.kind == ComponentKind::sfloat) std::memcpy(field, &rgba[c], 4);
    }
  }

  Color get(uint32_t level, int64_t x, int64_t y) const {
    Color color = {0, 0, 0, 1};
    const auto* self = const_cast<Texture*>(this)->texel(level, static_cast<uint32_t>(x), static_cast<uint32_t>(y));
    for (size_t c = 0; c < 4; ++c) {
      const ComponentLayout& component = layout.format->components[c];
      const std::byte* field = self + component.first_bit / 8;
      float value = 0;
      if (component.kind == ComponentKind::unorm) color[c] = std::to_integer<int>(*field) / 255.0;
      if (component.kind == ComponentKind::sfloat) {
        std::memcpy(&value, field, 4);
        color[c] = value;
      }
    }
    return color;
  }

  void fill_random(uint32_t seed) {
    std::mt19937 random(seed);
    for (uint32_t i = 0; i < layout.extent.mip_levels; ++i) {
      for (uint32_t y = 0; y < layout.levels[i].height; ++y) {
        for (uint32_t x = 0; x < layout.levels[i].width; ++x) {
          std::array<float, 4> rgba;
          for (float& value : rgba) value = static_cast<float>(random() % 1000) / 999.0f;
          set(i, x, y, rgba);
        }
      }
    }
  }
  void fill_level(uint32_t level, float value) {
    for (uint32_t y = 0; y < layout.levels[level].height; ++y) {
      for (uint32_t x = 0; x < layout.levels[level].width; ++x) set(level, x, y, {value, value, value, value});
    }
  }
};

// "Wrapping Operation". Outside of [0, size) only for CLAMP_TO_BORDER.
inline int64_t wrap(VkSamplerAddressMode mode, int64_t i, int64_t size) {
  const auto modulo = [](int64_t a, int64_t b) { return (a % b + b) % b; };
  switch (mode) {
    case VK_SAMPLER_ADDRESS_MODE_REPEAT:
      return modulo(i, size);
    case VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT: {
      const int64_t n = modulo(i, 2 * size) - size;
      return size - 1 - (n >= 0 ? n : -(1 + n));
    }
    case VK_SAMPLER_ADDRESS_MODE_MIRROR_CLAMP_TO_EDGE:
      return std::clamp<int64_t>(i >= 0 ? i : -(1 + i), 0, size - 1);
    case VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE:
      return std::clamp<int64_t>(i, 0, size - 1);
    default:
      return std::clamp<int64_t>(i, -1, size);
  }
}

// The texel at unwrapped integer coordinates, or the border in the components that the format has.
inline Color read(const Texture& texture, const SamplerState& sampler, uint32_t level, int64_t i, int64_t j) {
  const LevelLayout& size = texture.layout.levels[level];
  const int64_t x = wrap(sampler.address_u, i, size.width);
  const int64_t y = wrap(sampler.address_v, j, size.height);
  if (x >= 0 && x < size.width && y >= 0 && y < size.height) return texture.get(level, x, y);
  Color border = {0, 0, 0, 1};
  for (size_t c = 0; c < 4; ++c) {
    if (texture.layout.format->components[c].bits != 0) border[c] = std::bit_cast<float>(sampler.border[c]);
  }
  return border;
}

// u, v in texels.
inline Color nearest(const Texture& texture, const SamplerState& sampler, uint32_t level, double u, double v) {
  return read(texture, sampler, level, static_cast<int64_t>(std::floor(u)), static_cast<int64_t>(std::floor(v)));
}

inline Color linear(const Texture& texture, const SamplerState& sampler, uint32_t level, double u, double v) {
  const double i0 = std::floor(u - 0.5);
  const double j0 = std::floor(v - 0.5);
  const double alpha = u - 0.5 - i0;
  const double beta = v - 0.5 - j0;
  const int64_t i = static_cast<int64_t>(i0);
  const int64_t j = static_cast<int64_t>(j0);
  const Color t00 = read(texture, sampler, level, i, j);
  const Color t10 = read(texture, sampler, level, i + 1, j);
  const Color t01 = read(texture, sampler, level, i, j + 1);
  const Color t11 = read(texture, sampler, level, i + 1, j + 1);
  Color result;
  for (size_t c = 0; c < 4; ++c) {
    result[c] = (1 - alpha) * (1 - beta) * t00[c] + alpha * (1 - beta) * t10[c] + (1 - alpha) * beta * t01[c] +
                alpha * beta * t11[c];
  }
  return result;
}

}  // namespace lapilli::reference
