// What vkGetPhysicalDeviceImageFormatProperties says, and that images keep to it.
#include <gtest/gtest.h>

#include "object/image.h"
#include "object/test_context.h"

namespace lapilli {
namespace {

constexpr VkImageUsageFlags kSampledUsage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
constexpr ImageParameters kTexture = {VK_FORMAT_R8G8B8A8_UNORM, VK_IMAGE_TYPE_2D, VK_IMAGE_TILING_OPTIMAL,
                                      kSampledUsage, 0};

VkResult ask(const ImageParameters& image) {
  VkImageFormatProperties properties;
  return image_format_properties(image, &properties);
}

TEST(ImageSupport, OfWhatThereIs) {
  VkImageFormatProperties properties;
  ASSERT_EQ(image_format_properties(kTexture, &properties), VK_SUCCESS);
  EXPECT_GE(properties.maxExtent.width, 4096u);
  EXPECT_GE(properties.maxExtent.height, 4096u);
  EXPECT_EQ(properties.maxExtent.depth, 1u);
  EXPECT_EQ(properties.sampleCounts, VkSampleCountFlags{VK_SAMPLE_COUNT_1_BIT});
  EXPECT_GE(properties.maxResourceSize, uint64_t{1} << 31);  // required minimum
}

TEST(ImageSupport, RefusesWhatThereIsNot) {
  ImageParameters image = kTexture;
  image.type = VK_IMAGE_TYPE_3D;
  EXPECT_EQ(ask(image), VK_ERROR_FORMAT_NOT_SUPPORTED);
  image = kTexture;
  image.usage |= VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
  EXPECT_EQ(ask(image), VK_ERROR_FORMAT_NOT_SUPPORTED);
  image = kTexture;
  image.usage |= VK_IMAGE_USAGE_STORAGE_BIT;
  EXPECT_EQ(ask(image), VK_SUCCESS);
  image.format = VK_FORMAT_B8G8R8A8_UNORM;
  EXPECT_EQ(ask(image), VK_ERROR_FORMAT_NOT_SUPPORTED);
  image = kTexture;
  image.flags = VK_IMAGE_CREATE_SPARSE_BINDING_BIT;
  EXPECT_EQ(ask(image), VK_ERROR_FORMAT_NOT_SUPPORTED);
  image = kTexture;
  image.format = VK_FORMAT_BC1_RGB_UNORM_BLOCK;
  EXPECT_EQ(ask(image), VK_ERROR_FORMAT_NOT_SUPPORTED);
  image.format = VK_FORMAT_UNDEFINED;
  EXPECT_EQ(ask(image), VK_ERROR_FORMAT_NOT_SUPPORTED);
  image.format = VK_FORMAT_R32G32B32_SFLOAT;  // vertex buffers only
  EXPECT_EQ(ask(image), VK_ERROR_FORMAT_NOT_SUPPORTED);
}

class Images : public testing::Test {
 protected:
  TestContext context;
  VkImageCreateInfo info = {};
  void SetUp() override {
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = VK_FORMAT_R8G8B8A8_UNORM;
    info.extent = {16, 8, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = kSampledUsage;
  }
  VkResult create(VkImage* image) { return create_image(*context.device, info, nullptr, image); }
};

TEST_F(Images, OfNoSizeAreRefused) {
  VkImage image = VK_NULL_HANDLE;
  info.extent.width = 0;
  EXPECT_NE(create(&image), VK_SUCCESS);
  info.extent = {1u << 20, 1, 1};
  EXPECT_NE(create(&image), VK_SUCCESS);
}

TEST_F(Images, AreBoundInsideTheirMemoryOnly) {
  VkImage handle = VK_NULL_HANDLE;
  ASSERT_EQ(create(&handle), VK_SUCCESS);
  const ObjectPtr<Image> image(Image::from(handle));
  const VkMemoryRequirements needs = memory_requirements(*image);
  EXPECT_GE(needs.size, 16u * 8 * 4);
  VkMemoryAllocateInfo allocate = {};
  allocate.allocationSize = needs.size;
  VkDeviceMemory raw = VK_NULL_HANDLE;
  ASSERT_EQ(allocate_memory(*context.device, allocate, nullptr, &raw), VK_SUCCESS);
  const ObjectPtr<DeviceMemory> memory(DeviceMemory::from(raw));
  EXPECT_NE(bind_memory(*image, *memory, needs.alignment), VK_SUCCESS);
  EXPECT_EQ(image->data, nullptr);
  EXPECT_EQ(bind_memory(*image, *memory, 0), VK_SUCCESS);
  EXPECT_EQ(image->data, memory->data);
}

TEST(Memory, BeyondTheHeapIsRefused) {
  TestContext context;
  VkMemoryAllocateInfo info = {};
  info.allocationSize = UINT64_MAX;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  EXPECT_EQ(allocate_memory(*context.device, info, nullptr, &memory), VK_ERROR_OUT_OF_DEVICE_MEMORY);
  info.allocationSize = context.instance->physical_device.heap_size + 1;
  EXPECT_EQ(allocate_memory(*context.device, info, nullptr, &memory), VK_ERROR_OUT_OF_DEVICE_MEMORY);
  EXPECT_EQ(context.device->allocated_bytes, 0u);
  EXPECT_EQ(context.device->allocation_count, 0u);
}

}  // namespace
}  // namespace lapilli
