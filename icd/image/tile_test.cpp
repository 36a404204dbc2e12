// Tiles there and back at odd sizes, against the definition of the block-major order.
#include "image/tile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <vector>

namespace lapilli {
namespace {

using Bytes = std::vector<std::byte>;

Bytes random_bytes(uint64_t size, uint32_t seed) {
  std::mt19937 random(seed);
  Bytes bytes(size);
  for (std::byte& b : bytes) b = static_cast<std::byte>(random());
  return bytes;
}

// Blocks row by row, in them quads row by row, four texels each: counted out in order.
std::vector<uint32_t> counted_order() {
  std::vector<uint32_t> texel_of_pixel(kTileTexels);
  uint32_t texel = 0;
  for (uint32_t block = 0; block < 64; ++block) {
    for (uint32_t quad = 0; quad < 16; ++quad) {
      const uint32_t x = block % 8 * 8 + quad % 4 * 2;
      const uint32_t y = block / 8 * 8 + quad / 4 * 2;
      for (uint32_t lane = 0; lane < 4; ++lane) texel_of_pixel[(y + lane / 2) * 64 + x + lane % 2] = texel++;
    }
  }
  return texel_of_pixel;
}

TEST(Tile, TexelInPlaneCountsBlockByBlock) {
  const std::vector<uint32_t> order = counted_order();
  for (uint32_t y = 0; y < 64; ++y) {
    for (uint32_t x = 0; x < 64; ++x) {
      EXPECT_EQ(texel_in_plane(x, y), order[y * 64 + x]);
      EXPECT_EQ(texel_in_plane(x + 128, y + 64), order[y * 64 + x]);
    }
  }
}

struct Case {
  uint32_t texel_size;
  uint32_t width, height;  // of the image
  TileArea area;
};

class TileRoundTrip : public testing::TestWithParam<Case> {};

TEST_P(TileRoundTrip, MovesTheAreaOnly) {
  const auto [size, width, height, area] = GetParam();
  const std::vector<uint32_t> order = counted_order();
  const uint64_t pitch = (uint64_t{width} * size + 63) / 64 * 64;
  const Bytes image = random_bytes(pitch * height, 1);
  const Bytes plane_before = random_bytes(uint64_t{kTileTexels} * size, 2);
  Bytes plane = plane_before;
  load_tile(image.data(), pitch, size, area, plane.data());
  const uint32_t origin_x = area.x0 / 64 * 64;
  const uint32_t origin_y = area.y0 / 64 * 64;
  for (uint32_t y = 0; y < 64; ++y) {
    for (uint32_t x = 0; x < 64; ++x) {
      const uint32_t px = origin_x + x;
      const uint32_t py = origin_y + y;
      const bool inside = px >= area.x0 && px < area.x1 && py >= area.y0 && py < area.y1;
      const uint64_t texel = uint64_t{order[y * 64 + x]} * size;
      const std::byte* expected =
          inside ? image.data() + py * pitch + uint64_t{px} * size : plane_before.data() + texel;
      ASSERT_EQ(std::memcmp(plane.data() + texel, expected, size), 0) << x << ' ' << y;
    }
  }

  const Bytes target_before = random_bytes(image.size(), 3);
  Bytes target = target_before;
  store_tile(plane.data(), size, area, target.data(), pitch);
  for (uint64_t i = 0; i < image.size(); ++i) {
    const uint32_t x = static_cast<uint32_t>(i % pitch / size);
    const uint32_t y = static_cast<uint32_t>(i / pitch);
    const bool inside = x >= area.x0 && x < area.x1 && y >= area.y0 && y < area.y1;
    ASSERT_EQ(target[i], inside ? image[i] : target_before[i]) << x << ' ' << y;
  }
}

std::vector<Case> cases() {
  std::vector<Case> list;
  for (uint32_t size : {1u, 2u, 4u, 8u, 16u}) {
    list.push_back({size, 64, 64, {0, 0, 64, 64}});
    list.push_back({size, 200, 130, {64, 64, 128, 128}});
    list.push_back({size, 67, 65, {64, 64, 67, 65}});  // the corner tile of an odd image
    list.push_back({size, 1, 1, {0, 0, 1, 1}});
    list.push_back({size, 128, 64, {65, 3, 100, 40}});  // render areas that start and end at odd pixels
    list.push_back({size, 128, 64, {65, 3, 66, 4}});
    list.push_back({size, 128, 64, {66, 2, 97, 63}});
    list.push_back({size, 64, 64, {10, 10, 10, 20}});    // empty
    list.push_back({size, 160, 80, {71, 65, 121, 79}});  // starts and ends one pixel beside a block
  }
  return list;
}

INSTANTIATE_TEST_SUITE_P(Sizes, TileRoundTrip, testing::ValuesIn(cases()));

TEST(Tile, FillReachesEveryTexelOfThePlane) {
  PackedTexel texel;
  for (size_t i = 0; i < texel.size(); ++i) texel[i] = static_cast<std::byte>(i * 3 + 1);
  for (uint32_t size : {1u, 2u, 4u, 8u, 16u}) {
    Bytes plane(uint64_t{kTileTexels} * size + 1);
    fill_tile(plane.data(), size, texel);
    for (uint64_t i = 0; i + 1 < plane.size(); ++i) ASSERT_EQ(plane[i], texel[i % size]);
    EXPECT_EQ(plane.back(), std::byte{0});
  }
}

TEST(Tile, FillImageAreaStaysInside) {
  PackedTexel texel;
  texel.fill(std::byte{0xAB});
  texel[1] = std::byte{1};
  Bytes image(512 * 70);
  fill_image_area(image.data(), 512, 4, {67, 3, 100, 64}, texel);
  for (uint32_t y = 0; y < 70; ++y) {
    for (uint32_t x = 0; x < 128; ++x) {
      const bool inside = x >= 67 && x < 100 && y >= 3 && y < 64;
      const std::byte zero[4] = {};
      ASSERT_EQ(std::memcmp(&image[y * 512 + x * 4], inside ? texel.data() : zero, 4), 0) << x << ' ' << y;
    }
  }
}

}  // namespace
}  // namespace lapilli
