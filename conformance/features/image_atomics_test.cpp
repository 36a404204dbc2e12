// Atomic operations on images and texel buffers: of many workgroups on few texels, and of fragments. Texels outside do
// not exist: nothing happens, the result is 0. Specification: "Image Operations"; SPIR-V, OpImageTexelPointer.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "common/pipeline.h"
#include "harness/canvas.h"
#include "harness/compute.h"
#include "harness/descriptors.h"
#include "harness/devices.h"
#include "harness/graphics.h"
#include "harness/texture.h"
#include "shaders/image_atomics.comp.h"
#include "shaders/image_atomics.frag.h"
#include "shaders/position_color.vert.h"

namespace lapilli::conformance {
namespace {

DescriptorSlot image_slot(uint32_t binding, const samples::Image& image) {
  DescriptorSlot slot = {binding, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE};
  slot.image = {VK_NULL_HANDLE, image.view(), VK_IMAGE_LAYOUT_GENERAL};
  return slot;
}
DescriptorSlot buffer_slot(uint32_t binding, const samples::Buffer& buffer) {
  DescriptorSlot slot = {binding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
  slot.buffer = {buffer.get(), 0, VK_WHOLE_SIZE};
  return slot;
}

TEST(ImageAtomics, AreAdvertised) {
  for (const VkFormat format : {VK_FORMAT_R32_UINT, VK_FORMAT_R32_SINT}) {
    VkFormatProperties properties;
    vkGetPhysicalDeviceFormatProperties(subject().physical_device(), format, &properties);
    EXPECT_NE(properties.optimalTilingFeatures & VK_FORMAT_FEATURE_STORAGE_IMAGE_ATOMIC_BIT, 0u);
    EXPECT_NE(properties.bufferFeatures & VK_FORMAT_FEATURE_STORAGE_TEXEL_BUFFER_ATOMIC_BIT, 0u);
  }
}

TEST(ImageAtomics, AllOperations) {
  constexpr uint32_t kGroups = 50, kCount = kGroups * 64, kTexels = 9;
  std::mt19937 random(61);
  std::vector<uint32_t> values(kCount);
  for (uint32_t& value : values) value = uint32_t(random());
  const std::vector<uint32_t> start = {0, ~0u, 0, ~0u, 0, 77, 77, 77, 77, 77, 0, 0};
  const std::vector<int32_t> signed_start = {0, 0, 0, 0, 0, 0, INT32_MAX, INT32_MIN, 0, 0, 0, 0};
  const samples::Image unsigned_image =
      storage_image(subject(), {6, 2}, VK_FORMAT_R32_UINT, std::as_bytes(std::span(start)));
  const samples::Image signed_image =
      storage_image(subject(), {6, 2}, VK_FORMAT_R32_SINT, std::as_bytes(std::span(signed_start)));
  const std::vector<uint32_t> empty(kTexels + 7, 0);
  const samples::Buffer texels(subject(), std::span(empty), VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT);
  VkBufferViewCreateInfo view_info = {};
  view_info.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
  view_info.buffer = texels.get();
  view_info.format = VK_FORMAT_R32_UINT;
  view_info.range = kTexels * 4;
  VkBufferView view = VK_NULL_HANDLE;
  samples::check(vkCreateBufferView(subject().device(), &view_info, nullptr, &view), "vkCreateBufferView");
  const samples::Buffer in(subject(), std::span<const uint32_t>(values), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  const samples::Buffer out(subject(), kCount * 8, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  DescriptorSlot texel_buffer = {2, VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER};
  texel_buffer.view = view;
  const std::array<DescriptorSlot, 5> slots = {image_slot(0, unsigned_image), image_slot(1, signed_image), texel_buffer,
                                               buffer_slot(3, in), buffer_slot(4, out)};
  const Descriptors descriptors(subject(), slots);
  const VkDescriptorSetLayout set_layout = descriptors.layout();
  const samples::PipelineLayout layout = create_layout(subject(), {&set_layout, 1});
  const samples::Pipeline pipeline =
      samples::create_compute_pipeline(subject(), shaders::kImageAtomicsComp, layout.get());
  dispatch(subject(), pipeline, layout.get(), descriptors.get(), kGroups);
  vkDestroyBufferView(subject().device(), view, nullptr);

  std::vector<uint32_t> want = start;
  std::vector<int32_t> signed_want = signed_start;
  uint32_t inside = 0;
  for (uint32_t n = 0; n < kCount; ++n) {
    if (n % 5 == 0) continue;
    const uint32_t value = values[n];
    want[0] += value;
    want[1] = std::min(want[1], value);
    want[2] = std::max(want[2], value);
    want[3] &= value | 0xFF;
    want[4] |= value & 0xFFFF00;
    want[11] ^= value;
    want[10] += 1;
    signed_want[6] = std::min(signed_want[6], int32_t(value));
    signed_want[7] = std::max(signed_want[7], int32_t(value));
    ++inside;
  }
  EXPECT_EQ(from_bytes<uint32_t>(download(subject(), unsigned_image, 4)), want);
  EXPECT_EQ(from_bytes<int32_t>(download(subject(), signed_image, 4)), signed_want);
  std::vector<uint32_t> row(texels.size() / 4);
  std::memcpy(row.data(), texels.data(), texels.size());
  EXPECT_EQ(row[7], inside);
  EXPECT_EQ(row[8], 3 * kCount);
  for (uint32_t i = 0; i < 7; ++i) EXPECT_EQ(row[i] % 7, i);
  for (size_t i = kTexels; i < row.size(); ++i) EXPECT_EQ(row[i], 0u);
  // The old values of each counter are all numbers below its last one, each once.
  std::vector<uint32_t> old(kCount * 2), tickets[2];
  std::memcpy(old.data(), out.data(), out.size());
  for (uint32_t n = 0; n < kCount; ++n) {
    for (uint32_t k = 0; k < 2; ++k) {
      if (n % 5 == 0) {
        EXPECT_EQ(old[2 * n + k], 0u);
      } else {
        tickets[k].push_back(old[2 * n + k]);
      }
    }
  }
  for (std::vector<uint32_t>& each : tickets) {
    std::sort(each.begin(), each.end());
    for (uint32_t i = 0; i < inside; ++i) ASSERT_EQ(each[i], i);
  }
}

// Each fragment once, whoever draws it; helper lanes do not count.
TEST(ImageAtomics, FragmentsCount) {
  constexpr uint32_t kSize = 150;
  const samples::Image counts = storage_image(subject(), {kSize, 1}, VK_FORMAT_R32_UINT, Bytes(kSize * 4));
  const std::array<DescriptorSlot, 1> slots = {image_slot(0, counts)};
  const Descriptors descriptors(subject(), slots);
  const Canvas canvas(subject(), {.width = kSize, .height = kSize});
  PipelineState state;
  state.vertex_shader = shaders::kPositionColorVert;
  state.fragment_shader = shaders::kImageAtomicsFrag;
  // Two triangles with a common edge, three times: every pixel three times.
  std::vector<std::array<float, 8>> vertices;
  for (int n = 0; n < 3; ++n) {
    const float corners[6][2] = {{-1, -1}, {1, -1}, {-1, 1}, {-1, 1}, {1, -1}, {1, 1}};
    for (const auto& [x, y] : corners) vertices.push_back({x, y, 0, 1, 0.5f, 0, 0, 1});
  }
  draw_with(canvas, state, descriptors, std::as_bytes(std::span(vertices)));
  EXPECT_EQ(from_bytes<uint32_t>(download(subject(), counts, 4)), std::vector<uint32_t>(kSize, 3 * kSize));
}

}  // namespace
}  // namespace lapilli::conformance
