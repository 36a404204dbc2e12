// Storage images: reads and writes in each format, texels outside, writes of fragments.
// Specification: "Storage Image", "Image Operations"; "Robust Buffer Access" for what lies outside.
#include <gtest/gtest.h>

#include <random>

#include "common/pipeline.h"
#include "harness/canvas.h"
#include "harness/compute.h"
#include "harness/descriptors.h"
#include "harness/devices.h"
#include "harness/graphics.h"
#include "harness/storage_formats.h"
#include "harness/texture.h"
#include "shaders/position_color.vert.h"
#include "shaders/storage_image.comp.h"
#include "shaders/storage_image.frag.h"

namespace lapilli::conformance {
namespace {

using oracle::Number;

constexpr uint32_t kWidth = 37, kHeight = 11, kGroupsX = 6, kGroupsY = 3;

DescriptorSlot image_slot(uint32_t binding, const samples::Image& image) {
  DescriptorSlot slot = {binding, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE};
  slot.image = {VK_NULL_HANDLE, image.view(), VK_IMAGE_LAYOUT_GENERAL};
  return slot;
}

// What the shader saw of `from`: a header of four integers, then four words for each invocation.
std::vector<uint32_t> run(const samples::Image& from, const samples::Image& to, int kind) {
  const samples::Buffer out(subject(), 16 + kGroupsX * kGroupsY * 64 * 16, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  DescriptorSlot buffer = {4, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
  buffer.buffer = {out.get(), 0, VK_WHOLE_SIZE};
  const std::array<DescriptorSlot, 5> slots = {image_slot(0, from), image_slot(1, to), image_slot(2, from),
                                               image_slot(3, to), buffer};
  const Descriptors descriptors(subject(), slots);
  const VkDescriptorSetLayout set_layout = descriptors.layout();
  const samples::PipelineLayout layout = create_layout(subject(), {&set_layout, 1});
  const VkSpecializationMapEntry entry = {0, 0, 4};
  const VkSpecializationInfo specialization = {1, &entry, 4, &kind};
  VkPipeline raw = VK_NULL_HANDLE;
  samples::check(
      try_create_compute_pipeline(subject(), shaders::kStorageImageComp, layout.get(), &raw, &specialization),
      "vkCreateComputePipelines");
  const samples::Pipeline pipeline(subject().device(), raw);
  dispatch(subject(), pipeline, layout.get(), descriptors.get(), kGroupsX, kGroupsY);
  std::vector<uint32_t> words(out.size() / 4);
  std::memcpy(words.data(), out.data(), out.size());
  return words;
}

TEST(StorageImage, EveryFormatIsReadAndWritten) {
  std::mt19937 random(41);
  for (const auto& [vk, format] : kStorageFormats) {
    VkFormatProperties properties;
    vkGetPhysicalDeviceFormatProperties(subject().physical_device(), vk, &properties);
    ASSERT_NE(properties.optimalTilingFeatures & VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT, 0u) << vk;
    const Bytes texels = random_texels(random, format, kWidth * kHeight);
    const samples::Image from = storage_image(subject(), {kWidth, kHeight}, vk, texels);
    const samples::Image to = storage_image(subject(), {kWidth, kHeight}, vk, Bytes(texels.size()));
    const std::vector<uint32_t> read = run(from, to, format.integer() ? 1 : 0);
    const Bytes written = download(subject(), to, format.bytes());
    EXPECT_EQ(std::vector<uint32_t>(read.begin(), read.begin() + 4),
              (std::vector<uint32_t>{kWidth, kHeight, kWidth, kHeight}));
    for (uint32_t i = 0; i < kGroupsX * 8 * kGroupsY * 8; ++i) {
      const int x = int(i % (kGroupsX * 8)) - 4, y = int(i / (kGroupsX * 8)) - 4;
      const bool inside = x >= 0 && y >= 0 && x < int(kWidth) && y < int(kHeight);
      const uint32_t* got = &read[4 + 4 * i];
      if (!inside) {
        for (int c = 0; c < 4; ++c) ASSERT_EQ(got[c], 0u) << vk << " at " << x << ", " << y;
        continue;
      }
      const size_t texel = size_t(y) * kWidth + size_t(x);
      const std::array<double, 4> want = oracle::decode(format, &texels[texel * format.bytes()]);
      for (size_t c = 0; c < 4; ++c) {
        const double value = format.integer() ? double(got[c]) : double(std::bit_cast<float>(got[c]));
        ASSERT_NEAR(value, want[c], format.kind == Number::kUnorm || format.kind == Number::kSnorm ? 1e-7 : 0) << vk;
        if (c >= format.components) continue;
        const uint32_t code = format.code(&written[texel * format.bytes()], unsigned(c));
        bool tie = false;
        const uint32_t expected = oracle::encode(format, unsigned(c), want[3 - c], &tie);
        ASSERT_TRUE(tie || code == expected) << vk << " component " << c << ": " << code << ", not " << expected;
      }
    }
  }
}

// Fragments write, helper lanes and those that were discarded do not; nothing is hidden by what is drawn later.
TEST(StorageImage, FragmentsWrite) {
  constexpr uint32_t kSize = 40;
  const Bytes empty(kSize * kSize * 16);
  const samples::Image image = storage_image(subject(), {kSize, kSize}, VK_FORMAT_R32G32B32A32_UINT, empty);
  const std::array<DescriptorSlot, 1> slots = {image_slot(0, image)};
  const Descriptors descriptors(subject(), slots);
  const Canvas canvas(subject(), {.width = kSize, .height = kSize});
  PipelineState state;
  state.vertex_shader = shaders::kPositionColorVert;
  state.fragment_shader = shaders::kStorageImageFrag;
  // The lower left half of the canvas, twice, and a corner of it once more: the last one wins.
  const std::vector<std::array<float, 8>> vertices = {
      {-1, -1, 0, 1, 0.25f, 0, 0, 1}, {-1, 1, 0, 1, 0.25f, 0, 0, 1}, {1, 1, 0, 1, 0.25f, 0, 0, 1},
      {-1, -1, 0, 1, 0.5f, 0, 0, 1},  {-1, 1, 0, 1, 0.5f, 0, 0, 1},  {1, 1, 0, 1, 0.5f, 0, 0, 1},
      {-1, 0, 0, 1, 0.75f, 0, 0, 1},  {-1, 1, 0, 1, 0.75f, 0, 0, 1}, {0, 1, 0, 1, 0.75f, 0, 0, 1}};
  draw_with(canvas, state, descriptors, std::as_bytes(std::span(vertices)));
  const auto drawn = canvas.read_color<uint32_t>();
  const auto texels = from_bytes<std::array<uint32_t, 4>>(download(subject(), image, 16));
  uint32_t covered = 0;
  for (uint32_t y = 0; y < kSize; ++y) {
    for (uint32_t x = 0; x < kSize; ++x) {
      const uint32_t red = drawn[y * kSize + x] & 255;
      const float value = red == 0 ? 0 : red == 128 ? 0.5f : 0.75f;
      const std::array<uint32_t, 4> want = {x, y, std::bit_cast<uint32_t>(value), 7};
      ASSERT_EQ(texels[y * kSize + x], red == 0 ? (std::array<uint32_t, 4>{}) : want) << x << ", " << y;
      covered += red != 0;
    }
  }
  EXPECT_NEAR(covered, kSize * kSize / 2 * 3 / 4, kSize);
}

}  // namespace
}  // namespace lapilli::conformance
