// Objects that cannot be: the results the specification names (VK_ERROR_UNKNOWN where it names none), no crash.
#include <gtest/gtest.h>

#include <vector>

#include "harness/devices.h"
#include "input/messages.h"

namespace lapilli::conformance {
namespace {

class BadObjects : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    context = new_subject(true).release();
    log = new MessageLog(context->instance());
  }
  static void TearDownTestSuite() {
    delete log;
    delete context;
  }
  static VkImageCreateInfo image_info() {
    VkImageCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = VK_FORMAT_R8G8B8A8_UNORM;
    info.extent = {16, 16, 1};
    info.mipLevels = info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = VK_IMAGE_USAGE_SAMPLED_BIT;
    return info;
  }
  static void expect_no_image(const VkImageCreateInfo& info, const char* what) {
    log->take_errors();
    VkImage image = VK_NULL_HANDLE;
    const VkResult result = vkCreateImage(context->device(), &info, nullptr, &image);
    EXPECT_LT(result, 0) << what;
    EXPECT_TRUE(result == VK_ERROR_UNKNOWN || result == VK_ERROR_FORMAT_NOT_SUPPORTED ||
                result == VK_ERROR_OUT_OF_DEVICE_MEMORY)
        << what << " gave " << result;
    if (result >= 0) vkDestroyImage(context->device(), image, nullptr);
    EXPECT_FALSE(log->take_errors().empty()) << "no message: " << what;
  }
  static inline samples::Context* context;
  static inline MessageLog* log;
};

TEST_F(BadObjects, ImagesWithoutPixels) {
  for (int zero = 0; zero < 5; ++zero) {
    VkImageCreateInfo info = image_info();
    uint32_t* const fields[] = {&info.extent.width, &info.extent.height, &info.extent.depth, &info.mipLevels,
                                &info.arrayLayers};
    *fields[zero] = 0;
    expect_no_image(info, "an image with a size of 0");
  }
}

TEST_F(BadObjects, ImagesOfUnsupportedFormats) {
  for (const VkFormat format : {VK_FORMAT_UNDEFINED, VK_FORMAT_R64G64B64A64_SFLOAT, VkFormat(0x7FFFFFF0)}) {
    VkFormatProperties properties;
    vkGetPhysicalDeviceFormatProperties(context->physical_device(), format, &properties);
    EXPECT_EQ(properties.optimalTilingFeatures, 0u);
    VkImageFormatProperties limits;
    EXPECT_EQ(vkGetPhysicalDeviceImageFormatProperties(context->physical_device(), format, VK_IMAGE_TYPE_2D,
                                                       VK_IMAGE_TILING_OPTIMAL, VK_IMAGE_USAGE_SAMPLED_BIT, 0, &limits),
              VK_ERROR_FORMAT_NOT_SUPPORTED);
    VkImageCreateInfo info = image_info();
    info.format = format;
    expect_no_image(info, "an unsupported format");
  }
}

TEST_F(BadObjects, AbsurdSizes) {
  VkImageCreateInfo info = image_info();
  info.extent = {0xFFFFFFFF, 0xFFFFFFFF, 1};
  expect_no_image(info, "an image of 2^64 pixels");
  info.extent = {0x80000000, 1, 1};
  expect_no_image(info, "an image 2^31 pixels wide");

  VkBufferCreateInfo buffer_info = {};
  buffer_info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  buffer_info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  for (const VkDeviceSize size : {VkDeviceSize{1} << 62, ~VkDeviceSize{0}}) {
    buffer_info.size = size;
    VkBuffer buffer = VK_NULL_HANDLE;
    const VkResult result = vkCreateBuffer(context->device(), &buffer_info, nullptr, &buffer);
    if (result == VK_SUCCESS) {  // no memory stands behind it yet: allowed
      VkMemoryRequirements requirements;
      vkGetBufferMemoryRequirements(context->device(), buffer, &requirements);
      EXPECT_GE(requirements.size, size);
      vkDestroyBuffer(context->device(), buffer, nullptr);
    } else {
      EXPECT_EQ(result, VK_ERROR_OUT_OF_DEVICE_MEMORY);
    }
  }

  VkMemoryAllocateInfo memory_info = {};
  memory_info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  for (const VkDeviceSize size : {VkDeviceSize{1} << 50, ~VkDeviceSize{0}, ~VkDeviceSize{0} - 4095}) {
    memory_info.allocationSize = size;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    EXPECT_EQ(vkAllocateMemory(context->device(), &memory_info, nullptr, &memory), VK_ERROR_OUT_OF_DEVICE_MEMORY)
        << size;
  }
}

TEST_F(BadObjects, DevicesWithWhatIsNotOffered) {
  const float priority = 1;
  VkDeviceQueueCreateInfo queue = {};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueFamilyIndex = context->queue_family();
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkDeviceCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  const char* extension = "VK_NOBODY_has_this";
  info.enabledExtensionCount = 1;
  info.ppEnabledExtensionNames = &extension;
  VkDevice device = VK_NULL_HANDLE;
  EXPECT_EQ(vkCreateDevice(context->physical_device(), &info, nullptr, &device), VK_ERROR_EXTENSION_NOT_PRESENT);
  info.enabledExtensionCount = 0;
  VkPhysicalDeviceFeatures offered, wanted = {};
  vkGetPhysicalDeviceFeatures(context->physical_device(), &offered);
  // Each feature alone: accepted if it is offered, refused if not.
  auto* const want = reinterpret_cast<VkBool32*>(&wanted);
  const auto* const have = reinterpret_cast<const VkBool32*>(&offered);
  info.pEnabledFeatures = &wanted;
  for (size_t i = 0; i < sizeof(VkPhysicalDeviceFeatures) / sizeof(VkBool32); ++i) {
    wanted = {};
    want[i] = VK_TRUE;
    const VkResult result = vkCreateDevice(context->physical_device(), &info, nullptr, &device);
    EXPECT_EQ(result, have[i] ? VK_SUCCESS : VK_ERROR_FEATURE_NOT_PRESENT) << "feature " << i;
    if (result == VK_SUCCESS) vkDestroyDevice(device, nullptr);
  }
}

TEST_F(BadObjects, InstancesWithWhatIsNotOffered) {
  VkInstanceCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  const char* name = "VK_NOBODY_has_this";
  info.enabledExtensionCount = 1;
  info.ppEnabledExtensionNames = &name;
  VkInstance instance = VK_NULL_HANDLE;
  EXPECT_EQ(vkCreateInstance(&info, nullptr, &instance), VK_ERROR_EXTENSION_NOT_PRESENT);
}

TEST_F(BadObjects, NullHandlesAreDestroyedSilently) {
  const VkDevice d = context->device();
  vkDestroyBuffer(d, VK_NULL_HANDLE, nullptr);
  vkDestroyImage(d, VK_NULL_HANDLE, nullptr);
  vkDestroyImageView(d, VK_NULL_HANDLE, nullptr);
  vkFreeMemory(d, VK_NULL_HANDLE, nullptr);
  vkDestroySampler(d, VK_NULL_HANDLE, nullptr);
  vkDestroyShaderModule(d, VK_NULL_HANDLE, nullptr);
  vkDestroyPipeline(d, VK_NULL_HANDLE, nullptr);
  vkDestroyPipelineLayout(d, VK_NULL_HANDLE, nullptr);
  vkDestroyPipelineCache(d, VK_NULL_HANDLE, nullptr);
  vkDestroyDescriptorPool(d, VK_NULL_HANDLE, nullptr);
  vkDestroyDescriptorSetLayout(d, VK_NULL_HANDLE, nullptr);
  vkDestroyRenderPass(d, VK_NULL_HANDLE, nullptr);
  vkDestroyFramebuffer(d, VK_NULL_HANDLE, nullptr);
  vkDestroyCommandPool(d, VK_NULL_HANDLE, nullptr);
  vkDestroyFence(d, VK_NULL_HANDLE, nullptr);
  vkDestroySemaphore(d, VK_NULL_HANDLE, nullptr);
  vkDestroyEvent(d, VK_NULL_HANDLE, nullptr);
  vkDestroyQueryPool(d, VK_NULL_HANDLE, nullptr);
  vkDestroyBufferView(d, VK_NULL_HANDLE, nullptr);
  vkDestroyDevice(VK_NULL_HANDLE, nullptr);
}

TEST_F(BadObjects, EnumerationsSayIncomplete) {
  uint32_t count = 0;
  ASSERT_EQ(vkEnumerateDeviceExtensionProperties(context->physical_device(), nullptr, &count, nullptr), VK_SUCCESS);
  if (count > 0) {
    uint32_t fewer = count - 1;
    std::vector<VkExtensionProperties> list(count);
    EXPECT_EQ(vkEnumerateDeviceExtensionProperties(context->physical_device(), nullptr, &fewer, list.data()),
              VK_INCOMPLETE);
    EXPECT_EQ(fewer, count - 1);
  }
  uint32_t families = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(context->physical_device(), &families, nullptr);
  ASSERT_GE(families, 1u);
  VkQueueFamilyProperties family;
  families = 1;
  vkGetPhysicalDeviceQueueFamilyProperties(context->physical_device(), &families, &family);
  EXPECT_EQ(families, 1u);
  constexpr VkQueueFlags kAll = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  EXPECT_EQ(family.queueFlags & kAll, kAll);
}

}  // namespace
}  // namespace lapilli::conformance
