// Uniform and storage texel buffers: reads and writes in each format, views of a part of a
// buffer, indices outside. Specification: "Buffer Views", "Image Operations", "Robust Buffer Access".
#include <gtest/gtest.h>

#include "common/pipeline.h"
#include "harness/descriptors.h"
#include "harness/devices.h"
#include "harness/graphics.h"
#include "harness/storage_formats.h"
#include "shaders/texel_buffer.comp.h"

namespace lapilli::conformance {
namespace {

constexpr uint32_t kTexels = 101, kGroups = 2;
constexpr VkDeviceSize kOffset = 256;  // of the views in their buffers
constexpr uint8_t kUntouched = 0xA5;

struct View {
  samples::Buffer buffer;
  VkBufferView handle = VK_NULL_HANDLE;

  View(VkFormat format, const Bytes& texels)
      : buffer(subject(), kOffset + texels.size() + 64,
               VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT) {
    std::memset(buffer.data(), kUntouched, buffer.size());
    std::memcpy(bytes() + kOffset, texels.data(), texels.size());
    VkBufferViewCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
    info.buffer = buffer.get();
    info.format = format;
    info.offset = kOffset;
    info.range = texels.size();
    samples::check(vkCreateBufferView(subject().device(), &info, nullptr, &handle), "vkCreateBufferView");
  }
  View(const View&) = delete;
  View& operator=(const View&) = delete;
  ~View() { vkDestroyBufferView(subject().device(), handle, nullptr); }
  std::byte* bytes() const { return static_cast<std::byte*>(buffer.data()); }
};

DescriptorSlot view_slot(uint32_t binding, VkDescriptorType type, const View& view) {
  DescriptorSlot slot = {binding, type};
  slot.view = view.handle;
  return slot;
}

// What the shader saw: a header of four integers, then four words for each invocation.
std::vector<uint32_t> run(const View& from, const View& to, int kind) {
  const samples::Buffer out(subject(), 16 + kGroups * 64 * 16, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  DescriptorSlot buffer = {6, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
  buffer.buffer = {out.get(), 0, VK_WHOLE_SIZE};
  constexpr VkDescriptorType kUniform = VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
  constexpr VkDescriptorType kStorage = VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER;
  const std::array<DescriptorSlot, 7> slots = {view_slot(0, kUniform, from),
                                               view_slot(1, kUniform, from),
                                               view_slot(2, kStorage, from),
                                               view_slot(3, kStorage, from),
                                               view_slot(4, kStorage, to),
                                               view_slot(5, kStorage, to),
                                               buffer};
  const Descriptors descriptors(subject(), slots);
  const VkDescriptorSetLayout set_layout = descriptors.layout();
  const samples::PipelineLayout layout = create_layout(subject(), {&set_layout, 1});
  const VkSpecializationMapEntry entry = {0, 0, 4};
  const VkSpecializationInfo specialization = {1, &entry, 4, &kind};
  VkPipeline raw = VK_NULL_HANDLE;
  samples::check(try_create_compute_pipeline(subject(), shaders::kTexelBufferComp, layout.get(), &raw, &specialization),
                 "vkCreateComputePipelines");
  const samples::Pipeline pipeline(subject().device(), raw);
  dispatch(subject(), pipeline, layout.get(), descriptors.get(), kGroups);
  std::vector<uint32_t> words(out.size() / 4);
  std::memcpy(words.data(), out.data(), out.size());
  return words;
}

TEST(TexelBuffer, EveryFormatIsReadAndWritten) {
  std::mt19937 random(51);
  for (const auto& [vk, format] : kStorageFormats) {
    VkFormatProperties properties;
    vkGetPhysicalDeviceFormatProperties(subject().physical_device(), vk, &properties);
    constexpr VkFormatFeatureFlags kBoth =
        VK_FORMAT_FEATURE_UNIFORM_TEXEL_BUFFER_BIT | VK_FORMAT_FEATURE_STORAGE_TEXEL_BUFFER_BIT;
    ASSERT_EQ(properties.bufferFeatures & kBoth, kBoth) << vk;
    const Bytes texels = random_texels(random, format, kTexels);
    const View from(vk, texels);
    for (int storage = 0; storage < 2; ++storage) {
      const View to(vk, Bytes(texels.size()));
      const std::vector<uint32_t> read = run(from, to, (format.integer() ? 1 : 0) + 2 * storage);
      EXPECT_EQ(std::vector<uint32_t>(read.begin(), read.begin() + 3),
                (std::vector<uint32_t>{kTexels, kTexels, kTexels}));
      for (int i = 0; i < int(kGroups * 64); ++i) {
        const int texel = i - 5;
        const uint32_t* got = &read[4 + 4 * size_t(i)];
        const bool inside = texel >= 0 && texel < int(kTexels);
        const std::array<double, 4> want =
            inside ? oracle::decode(format, &texels[size_t(texel) * format.bytes()]) : std::array<double, 4>{};
        for (size_t c = 0; c < 4; ++c) {
          const double value = format.integer() ? double(got[c]) : double(std::bit_cast<float>(got[c]));
          ASSERT_NEAR(value, want[c], format.kind == Number::kUnorm || format.kind == Number::kSnorm ? 1e-7 : 0)
              << vk << " texel " << texel;
          if (!inside || c >= format.components) continue;
          const uint32_t code = format.code(to.bytes() + kOffset + size_t(texel) * format.bytes(), unsigned(c));
          bool tie = false;
          const uint32_t expected = oracle::encode(format, unsigned(c), want[3 - c], &tie);
          ASSERT_TRUE(tie || code == expected) << vk << " component " << c << ": " << code << ", not " << expected;
        }
      }
      for (VkDeviceSize i = 0; i < to.buffer.size(); ++i) {
        if (i == kOffset) i += texels.size();
        ASSERT_EQ(to.bytes()[i], std::byte{kUntouched}) << vk << " byte " << i;
      }
    }
  }
}

}  // namespace
}  // namespace lapilli::conformance
