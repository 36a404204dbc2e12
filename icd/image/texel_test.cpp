// Texels on lanes: all codes of UNORM8, quads of a tile plane, gathers and component masks, on every SIMD target.
#include "image/texel.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "image/tile.h"

namespace lapilli {
namespace {

constexpr uint64_t kAll = ~uint64_t{0};
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Registers {
  alignas(64) float value[4][64] = {};
  float* pointers[4] = {value[0], value[1], value[2], value[3]};
  const float* const_pointers[4] = {value[0], value[1], value[2], value[3]};
};

struct QuadIndices {
  uint16_t index[16];
  bool whole_block;
  explicit QuadIndices(uint32_t first = 0, uint32_t step = 1, bool block = false) : whole_block(block) {
    for (uint32_t q = 0; q < 16; ++q) index[q] = static_cast<uint16_t>(first + q * step);
  }
  QuadPlaces places() const { return {index, whole_block}; }
};
// A block of the plane, as one.
QuadIndices block(uint32_t number) { return QuadIndices(number * 16, 1, true); }

uint32_t bits(float value) { return std::bit_cast<uint32_t>(value); }

class Texels : public testing::TestWithParam<SimdTarget> {
 protected:
  const TexelFunctions& functions(VkFormat format) const { return texel_functions(*find_format(format), GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(Targets, Texels, testing::ValuesIn(supported_simd_targets()),
                         [](const auto& target) { return std::string(simd_target_name(target.param)); });

TEST_P(Texels, Unorm8DecodesToTheQuotient) {
  for (uint32_t first = 0; first < 256; first += 64) {
    // Red counts up, the others are other permutations of the codes.
    std::vector<uint8_t> texels;
    for (uint32_t i = first; i < first + 64; ++i) {
      for (uint32_t code : {i, 255 - i, i ^ 0x55, i * 77}) texels.push_back(static_cast<uint8_t>(code));
    }
    const auto* plane = reinterpret_cast<const std::byte*>(texels.data());
    for (VkFormat format : {VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_B8G8R8A8_UNORM}) {
      Registers out;
      functions(format).load_quads(plane, QuadIndices().places(), kAll, out.pointers);
      for (uint32_t lane = 0; lane < 64; ++lane) {
        for (uint32_t c = 0; c < 4; ++c) {
          const bool swapped = format == VK_FORMAT_B8G8R8A8_UNORM && c != 1 && c != 3;
          const float code = texels[lane * 4 + (swapped ? 2 - c : c)];
          EXPECT_EQ(bits(out.value[c][lane]), bits(code / 255.0f)) << code;
        }
      }
    }
  }
}

// The definition, in doubles: a float times 255 is exact there, so the only rounding to float is the one stated.
uint32_t unorm8_of(float value) {
  const double clamped = value > 0.0f ? std::min(double{value}, 1.0) : 0.0;
  return static_cast<uint32_t>(std::nearbyint(static_cast<float>(clamped * 255.0)));
}

void expect_encoded(const TexelFunctions& functions, const std::vector<float>& values) {
  Registers in;
  for (size_t first = 0; first < values.size(); first += 64) {
    for (size_t lane = 0; lane < 64; ++lane) {
      const float value = first + lane < values.size() ? values[first + lane] : 0.0f;
      for (size_t c = 0; c < 4; ++c) in.value[c][lane ^ c] = value;
    }
    uint8_t texels[256];
    functions.store_quads(reinterpret_cast<std::byte*>(texels), QuadIndices().places(), kAll, in.const_pointers, 15);
    for (size_t lane = 0; lane < 64; ++lane) {
      for (size_t c = 0; c < 4; ++c) {
        ASSERT_EQ(texels[lane * 4 + c], unorm8_of(in.value[c][lane])) << in.value[c][lane] << " component " << c;
      }
    }
  }
}

TEST_P(Texels, Unorm8EncodesToTheNearest) {
  std::vector<float> values = {0.0f,  -0.0f,     1.0f,       -1.0f,  2.0f,    kNan,
                               -kNan, kInfinity, -kInfinity, 1e-45f, -1e-45f, 1e30f};
  for (uint32_t code = 0; code < 256; ++code) {
    // Around each code and each midpoint between codes, 200 floats on both sides.
    for (float centre : {static_cast<float>(code) / 255.0f, (static_cast<float>(code) + 0.5f) / 255.0f}) {
      for (int32_t step = -200; step <= 200; ++step) {
        values.push_back(std::bit_cast<float>(static_cast<int32_t>(bits(centre)) + step));
      }
    }
  }
  for (uint64_t pattern = 0; pattern < uint64_t{1} << 32; pattern += 40503) {
    values.push_back(std::bit_cast<float>(static_cast<uint32_t>(pattern)));
  }
  expect_encoded(functions(VK_FORMAT_R8G8B8A8_UNORM), values);
}

TEST_P(Texels, Unorm8KeepsEveryCode) {
  for (uint32_t first = 0; first < 256; first += 64) {
    uint8_t texels[256];
    for (uint32_t i = 0; i < 256; ++i) texels[i] = static_cast<uint8_t>(first + i / 4 + 64 * (i % 4));
    for (VkFormat format : {VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_B8G8R8A8_UNORM}) {
      Registers registers;
      const auto* plane = reinterpret_cast<const std::byte*>(texels);
      functions(format).load_quads(plane, QuadIndices().places(), kAll, registers.pointers);
      uint8_t again[256] = {};
      functions(format).store_quads(reinterpret_cast<std::byte*>(again), QuadIndices().places(), kAll,
                                    registers.const_pointers, 15);
      EXPECT_EQ(std::memcmp(texels, again, 256), 0);
    }
  }
}

std::vector<std::byte> random_bytes(size_t size, uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<std::byte> bytes(size);
  for (std::byte& b : bytes) b = static_cast<std::byte>(random());
  return bytes;
}

// Random masks, all lanes, no lanes, one lane.
std::vector<uint64_t> masks() {
  std::vector<uint64_t> list = {0, kAll, 1, uint64_t{1} << 63, 0xF0F0F0F00F0F0F0F, 0x1111111111111111};
  std::mt19937_64 random(5);
  for (int i = 0; i < 20; ++i) list.push_back(random());
  for (int i = 0; i < 20; ++i) list.push_back(random() & random() & random());
  return list;
}

TEST_P(Texels, StoreWritesOnlyItsLanesAndComponents) {
  for (const QuadIndices& quads : {QuadIndices(1023, -67u), block(5)}) {  // 1023, 956, …, 18
    for (VkFormat format :
         {VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_D32_SFLOAT}) {
      const FormatInfo& info = *find_format(format);
      const size_t size = info.texel_size;
      const std::vector<std::byte> before = random_bytes(kTileTexels * size, 7);
      Registers in;
      std::mt19937 random(8);
      for (auto& reg : in.value) {
        for (float& value : reg) value = static_cast<float>(random() % 256) / 255.0f;
      }
      // What a store of everything writes, alone.
      std::vector<std::byte> full = before;
      functions(format).store_quads(full.data(), quads.places(), kAll, in.const_pointers, 15);
      for (uint64_t mask : masks()) {
        for (uint32_t components = 0; components < 16; ++components) {
          std::vector<std::byte> plane = before;
          functions(format).store_quads(plane.data(), quads.places(), mask, in.const_pointers, components);
          std::vector<std::byte> expected = before;
          for (uint32_t lane = 0; lane < 64; ++lane) {
            if ((mask >> lane & 1) == 0) continue;
            const size_t texel = (quads.index[lane / 4] * size_t{4} + lane % 4) * size;
            for (uint32_t c = 0; c < 4; ++c) {
              if ((components >> c & 1) == 0) continue;
              const size_t first = texel + info.components[c].first_bit / 8;  // whole bytes in these formats
              for (size_t byte = first; byte < first + info.components[c].bits / 8; ++byte) expected[byte] = full[byte];
            }
          }
          ASSERT_EQ(plane, expected) << info.name << " lanes " << mask << " components " << components;
        }
      }
    }
  }
}

TEST_P(Texels, FloatsKeepTheirBitsAndNansBecomeCanonical) {
  const float special[8] = {-0.0f,      1e-45f, -1e38f, kInfinity,
                            -kInfinity, kNan,   -kNan,  std::bit_cast<float>(0x7F800001u)};
  for (VkFormat format : {VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_D32_SFLOAT}) {
    for (const QuadIndices& quads : {QuadIndices(3, 5), block(63)}) {
      const uint32_t count = format == VK_FORMAT_D32_SFLOAT ? 1 : 4;
      Registers in;
      for (uint32_t c = 0; c < 4; ++c) {
        for (uint32_t lane = 0; lane < 64; ++lane) in.value[c][lane] = special[(lane + 3 * c) % 8];
      }
      std::vector<std::byte> plane(kTileTexels * 16);
      functions(format).store_quads(plane.data(), quads.places(), kAll, in.const_pointers, 15);
      Registers out;
      functions(format).load_quads(plane.data(), quads.places(), kAll, out.pointers);
      for (uint32_t lane = 0; lane < 64; ++lane) {
        for (uint32_t c = 0; c < 4; ++c) {
          const uint32_t stored = std::isnan(in.value[c][lane]) ? 0x7FC00000u : bits(in.value[c][lane]);
          EXPECT_EQ(bits(out.value[c][lane]), c < count ? stored : c < 3 ? 0 : bits(1.0f));
        }
      }
    }
  }
}

// R32G32 is no format of an attachment, but has two words.
TEST_P(Texels, LoadsAndStoresOfABlockAreThoseOfItsQuads) {
  for (const FormatInfo& info : kFormats) {
    if (!info.is_target()) continue;
    const std::vector<std::byte> before = random_bytes(kTileTexels * info.texel_size, 20);
    for (uint64_t mask : masks()) {
      Registers by_quads, by_block;
      std::vector<std::byte> plane = before, block_plane = before;
      const TexelFunctions& f = functions(info.format);
      f.load_quads(plane.data(), QuadIndices(32).places(), kAll, by_quads.pointers);
      f.load_quads(plane.data(), block(2).places(), mask, by_block.pointers);
      ASSERT_EQ(std::memcmp(by_quads.value, by_block.value, sizeof by_block.value), 0) << info.name;
      f.store_quads(plane.data(), QuadIndices(16).places(), mask, by_quads.const_pointers, 15);
      f.store_quads(block_plane.data(), block(1).places(), mask, by_quads.const_pointers, 15);
      ASSERT_EQ(plane, block_plane) << info.name << " lanes " << mask;
    }
  }
}

TEST_P(Texels, LoadTouchesOnlyLiveQuadsAndWantedRegisters) {
  const std::vector<std::byte> plane = random_bytes(kTileTexels * 4, 9);
  QuadIndices quads(0, 64);
  quads.index[5] = 0xFFFF;  // far outside: lanes 20 … 23 are not set
  const uint64_t lanes = 0x8421842184218421 & ~(uint64_t{15} << 20);
  Registers out;
  out.pointers[1] = nullptr;
  functions(VK_FORMAT_R8G8B8A8_UNORM).load_quads(plane.data(), quads.places(), lanes, out.pointers);
  for (uint32_t lane = 0; lane < 64; ++lane) {
    EXPECT_EQ(out.value[1][lane], 0.0f);
    if ((lanes >> lane & 1) == 0) continue;
    const auto code = std::to_integer<uint8_t>(plane[(quads.index[lane / 4] * size_t{4} + lane % 4) * 4 + 2]);
    EXPECT_EQ(out.value[2][lane], static_cast<float>(code) / 255.0f);
  }
}

double half_value(uint32_t half) {
  const double sign = (half & 0x8000) != 0 ? -1 : 1, fraction = half & 1023;
  const int exponent = half >> 10 & 31;
  if (exponent == 31) return fraction != 0 ? std::nan("") : sign * INFINITY;
  return sign * std::ldexp(exponent == 0 ? fraction : 1024 + fraction, std::max(exponent, 1) - 25);
}

// A component's bits in a register, from the format's definition.
uint32_t decoded(const ComponentLayout& layout, const std::byte* texel) {
  uint64_t bytes = 0;
  std::memcpy(&bytes, texel + layout.first_bit / 8, (layout.first_bit % 8u + layout.bits + 7u) / 8);
  const uint32_t unused = 32u - layout.bits;
  const uint32_t code = static_cast<uint32_t>(bytes >> layout.first_bit % 8) << unused >> unused;
  const int32_t number = static_cast<int32_t>(code << unused) >> unused;
  const double largest = std::exp2(layout.bits - (layout.kind == ComponentKind::snorm ? 1 : 0)) - 1;
  switch (layout.kind) {
    case ComponentKind::unorm:
      return bits(static_cast<float>(code / largest));
    case ComponentKind::snorm:
      return bits(static_cast<float>(std::max(number / largest, -1.0)));
    case ComponentKind::sint:
      return static_cast<uint32_t>(number);
    case ComponentKind::ufloat: {
      const double value = half_value(code << (15 - layout.bits));
      return std::isnan(value) ? 0x7FC00000 : bits(static_cast<float>(value));
    }
    case ComponentKind::sfloat:
      return layout.bits == 16 && (code & 0x7FFF) > 0x7C00 ? 0x7FC00000
             : layout.bits == 16                           ? bits(static_cast<float>(half_value(code)))
                                                           : code;
    default:
      return code;
  }
}

TEST_P(Texels, GathersEveryFormat) {
  std::vector<std::byte> memory = random_bytes(4096, 10);
  std::mt19937 random(11);
  for (int round = 0; round < 50; ++round) {
    for (const FormatInfo& info : kFormats) {
      alignas(64) uint32_t offsets[64];
      for (uint32_t& offset : offsets) offset = static_cast<uint32_t>(random() % (memory.size() - info.texel_size + 1));
      offsets[0] = static_cast<uint32_t>(memory.size()) - info.texel_size;  // up to the last byte
      const uint64_t lanes = 0xFEDCBA9876543211;
      for (uint32_t lane = 0; lane < 64; ++lane) {
        if ((lanes >> lane & 1) == 0) offsets[lane] = 0x7FFFFF00;
      }
      Registers out;
      texel_functions(info, GetParam()).load_gathered(memory.data(), offsets, lanes, out.pointers);
      const uint32_t one = info.is_integer() ? 1 : bits(1.0f);
      for (uint32_t lane = 0; lane < 64; ++lane) {
        for (uint32_t c = 0; c < 4; ++c) {
          uint32_t expected = c == 3 ? one : 0;
          if ((lanes >> lane & 1) != 0 && info.components[c].bits != 0)
            expected = decoded(info.components[c], &memory[offsets[lane]]);
          ASSERT_EQ(bits(out.value[c][lane]), expected) << info.name << " lane " << lane << " component " << c;
        }
      }
    }
  }
}

// Codes come back as they were; what lies beside them, and lanes that are not asked for, stay.
TEST_P(Texels, ScattersWhatGathersRead) {
  std::mt19937 random(13);
  for (const FormatInfo& info : kFormats) {
    if (!info.has(kStorage)) continue;
    std::vector<std::byte> from = random_bytes(64 * info.texel_size, 14), to(128 * info.texel_size), expected = to;
    alignas(64) uint32_t source[64], target[64];
    const uint64_t lanes = 0x8FFFFFFFFFFFFF7E;
    for (uint32_t lane = 0; lane < 64; ++lane) {
      source[lane] = lane * info.texel_size;
      target[lane] = (lanes >> lane & 1) != 0 ? (lane * 2 + 1) * info.texel_size : 0x7FFFFF00;
      std::byte* const texel = &from[source[lane]];
      for (const ComponentLayout& layout : info.components) {  // no NaN, no second code of -1
        if (layout.kind == ComponentKind::sfloat) texel[(layout.first_bit + layout.bits) / 8u - 1] &= std::byte{0xBF};
        const uint32_t top = layout.first_bit + layout.bits - 1u;
        if (layout.kind == ComponentKind::ufloat) texel[top / 8] &= ~std::byte(1 << top % 8);
        if (layout.kind == ComponentKind::snorm) texel[layout.first_bit / 8] |= std::byte{1};
      }
      if ((lanes >> lane & 1) != 0) std::memcpy(&expected[target[lane]], texel, info.texel_size);
    }
    Registers values;
    const TexelFunctions& f = functions(info.format);
    f.load_gathered(from.data(), source, kAll, values.pointers);
    f.store_scattered(to.data(), target, lanes, values.const_pointers);
    ASSERT_EQ(to, expected) << info.name;
  }
}

// The scalar code of a clear and the lanes of a draw agree on every value.
TEST_P(Texels, ClearsPackLikeStores) {
  std::mt19937 random(12);
  for (const FormatInfo& info : kFormats) {
    if (!info.has(kStorage)) continue;
    alignas(64) uint32_t offsets[64];
    for (uint32_t lane = 0; lane < 64; ++lane) offsets[lane] = lane * info.texel_size;
    for (int round = 0; round < 500; ++round) {
      Registers in;
      for (auto& reg : in.value) {
        for (float& value : reg) {
          const uint32_t pattern = static_cast<uint32_t>(random());
          value = round % 2 == 0 ? std::bit_cast<float>(pattern) : static_cast<float>(pattern) * 0x1p-31f - 1.0f;
        }
      }
      std::vector<std::byte> plane(64 * info.texel_size);
      functions(info.format).store_scattered(plane.data(), offsets, kAll, in.const_pointers);
      for (uint32_t lane = 0; lane < 64; ++lane) {
        VkClearValue clear = {};
        for (uint32_t c = 0; c < 4; ++c) clear.color.float32[c] = in.value[c][lane];
        const PackedTexel packed = pack_clear_value(info, clear);
        ASSERT_EQ(std::memcmp(packed.data(), &plane[lane * info.texel_size], info.texel_size), 0) << info.name;
      }
    }
  }
}

TEST(TexelFunctions, FollowTheTargetInForce) {
  const SimdTarget before = simd_target();
  for (SimdTarget target : supported_simd_targets()) {
    ASSERT_TRUE(set_simd_target(target));
    EXPECT_EQ(&texel_functions(kFormats[0]), &texel_functions(kFormats[0], target));
  }
  set_simd_target(before);
}

}  // namespace
}  // namespace lapilli
