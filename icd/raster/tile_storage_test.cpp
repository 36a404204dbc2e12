// Loads, clears and stores block by block, for one and for four samples; coverage and depth of each sample.
#include "raster/tile_storage.h"

#include <gtest/gtest.h>

#include <cstring>

#include "raster/tile_depth.h"

namespace lapilli {
namespace {

constexpr uint32_t kWidth = 100, kHeight = 70;
constexpr TileArea kArea = {64, 3, 90, 61};  // of the second tile

struct Storage {
  std::vector<uint32_t> texels;  // [sample][y][x]
  AttachmentTarget target;
  PassAttachment attachment;
  TileStorage storage;

  Storage(uint32_t samples, VkAttachmentLoadOp load_op) : texels(size_t{samples} * kWidth * kHeight) {
    for (size_t i = 0; i < texels.size(); ++i) texels[i] = static_cast<uint32_t>(i);
    target.data = reinterpret_cast<std::byte*>(texels.data());
    target.format = find_format(VK_FORMAT_R8G8B8A8_UNORM);
    target.row_pitch = kWidth * 4;
    target.sample_pitch = uint64_t{kWidth} * kHeight * 4;
    target.load_op = load_op;
    VkClearValue clear;
    clear.color = {{1, 1, 1, 1}};
    attachment = {&target, 0, false, pack_clear_value(*target.format, clear)};
    storage.reserve(std::span(&attachment, 1), samples);
  }
  uint32_t* plane(uint32_t sample) { return reinterpret_cast<uint32_t*>(storage.plane(0, sample)); }
};

bool in_area(uint32_t x, uint32_t y) { return x >= kArea.x0 && x < kArea.x1 && y >= kArea.y0 && y < kArea.y1; }
uint32_t block_of(uint32_t x, uint32_t y) { return bit_of(x % 64 / 8, y % 64 / 8); }

// One block is read and changed, one is overwritten, the others are left alone.
TEST(TileStorage, MovesOnlyWhatIsTouched) {
  for (const uint32_t samples : {1u, 4u}) {
    for (const VkAttachmentLoadOp load : {VK_ATTACHMENT_LOAD_OP_LOAD, VK_ATTACHMENT_LOAD_OP_CLEAR}) {
      Storage test(samples, load);
      const std::vector<uint32_t> before = test.texels;
      test.storage.begin_tile(kArea, true, true);
      const uint32_t changed = bit_of(1, 0), overwritten = bit_of(3, 7);
      test.storage.fetch_colors(uint64_t{1} << changed);
      test.storage.overwrite_colors(uint64_t{1} << overwritten);
      for (uint32_t sample = 0; sample < samples; ++sample) {
        uint32_t* const plane = test.plane(sample);
        for (uint32_t i = 0; i < 64; ++i) {
          plane[first_texel_of_block(changed) + i] += 1000000;
          plane[first_texel_of_block(overwritten) + i] = 7000 + sample;
        }
      }
      test.storage.store_colors();
      for (uint32_t sample = 0; sample < samples; ++sample) {
        for (uint32_t y = 0; y < kHeight; ++y) {
          for (uint32_t x = 0; x < kWidth; ++x) {
            const size_t i = (size_t{sample} * kHeight + y) * kWidth + x;
            uint32_t expected = before[i];
            if (in_area(x, y)) {
              if (load == VK_ATTACHMENT_LOAD_OP_CLEAR) expected = 0xFFFFFFFF;
              if (block_of(x, y) == changed) expected += 1000000;
              if (block_of(x, y) == overwritten) expected = 7000 + sample;
            }
            ASSERT_EQ(test.texels[i], expected) << samples << " samples: " << sample << ", " << x << ", " << y;
          }
        }
      }
    }
  }
}

TEST(TileStorage, StoresNothingAtTheEndIfNobodyCares) {
  Storage test(4, VK_ATTACHMENT_LOAD_OP_CLEAR);
  const std::vector<uint32_t> before = test.texels;
  test.target.store_op = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  test.storage.begin_tile(kArea, true, true);
  test.storage.store_colors();
  EXPECT_EQ(test.texels, before);
  // Between two sets of bins it has to.
  test.storage.begin_tile(kArea, true, false);
  test.storage.store_colors();
  EXPECT_NE(test.texels, before);
}

// The standard sample locations in 1/256 pixel from the pixel's centre; a sample sees the triangle moved the other way.
constexpr int32_t kSamples[4][2] = {{-32, -96}, {96, -32}, {-96, 32}, {32, 96}};

TEST(TileStorage, CoverageAndDepthOfFourSamples) {
  const int32_t x[3] = {5 * 256 + 40, 50 * 256 + 7, 9 * 256}, y[3] = {3 * 256 + 99, 10 * 256, 47 * 256 + 128};
  uint64_t covered = 0;
  for (const auto& [sx, sy] : kSamples) {
    BinChunk chunk;
    chunk.runs.push_back({});
    for (int i = 0; i < 3; ++i) chunk.vertices.push_back({x[i] - sx, y[i] - sy, 0.25 * i, 1, 0});
    const BinTriangle triangle{{0, 1, 2}, 0, 0, 0, 64, 64};
    TileCoverage coverage;
    ASSERT_TRUE(coverage.begin(make_edges(chunk, triangle), 0, 0, {0, 0, 64, 64}));
    const TriangleDepth depth = triangle_depth(make_triangle_setup(chunk, triangle));
    for (uint32_t block = 0; block < 64; ++block) {
      const uint64_t pixels = coverage.pixels(block);
      alignas(64) float z[64];
      block_depth_functions().depth(depth, column_of_bit(block) * 8, row_of_bit(block) * 8, z);
      for (uint32_t bit = 0; bit < 64; ++bit) {
        const double px = 256.0 * (column_of_bit(block) * 8 + column_of_bit(bit)) + 128 + sx;
        const double py = 256.0 * (row_of_bit(block) * 8 + row_of_bit(bit)) + 128 + sy;
        const auto edge = [&](int p, int q) { return (x[q] - x[p]) * (py - y[p]) - (y[q] - y[p]) * (px - x[p]); };
        const double e[3] = {edge(1, 2), edge(2, 0), edge(0, 1)};
        if (e[0] == 0 || e[1] == 0 || e[2] == 0) continue;
        const bool inside = e[0] > 0 && e[1] > 0 && e[2] > 0;
        ASSERT_EQ((pixels >> bit & 1) != 0, inside);
        covered += inside;
        if (inside) {
          ASSERT_NEAR(z[bit], (0.25 * e[1] + 0.5 * e[2]) / (e[0] + e[1] + e[2]), 1e-7);
        }
      }
    }
  }
  EXPECT_GT(covered, 3000u);
}

}  // namespace
}  // namespace lapilli
