// The loader's view: which commands are returned, and what the driver's file exports. Specification: "Initialization",
// Command Function Pointers; the loader's interface to drivers.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>

#include "harness/devices.h"

namespace lapilli::conformance {
namespace {

TEST(Loader, DeviceCommandsOfVulkan10AreThere) {
  for (const char* name : {"vkDestroyDevice",
                           "vkGetDeviceQueue",
                           "vkQueueSubmit",
                           "vkQueueWaitIdle",
                           "vkDeviceWaitIdle",
                           "vkAllocateMemory",
                           "vkMapMemory",
                           "vkFlushMappedMemoryRanges",
                           "vkInvalidateMappedMemoryRanges",
                           "vkCreateBuffer",
                           "vkCreateImage",
                           "vkCreateImageView",
                           "vkCreateShaderModule",
                           "vkCreateGraphicsPipelines",
                           "vkCreateComputePipelines",
                           "vkCreateSampler",
                           "vkUpdateDescriptorSets",
                           "vkCreateRenderPass",
                           "vkBeginCommandBuffer",
                           "vkCmdDraw",
                           "vkCmdDrawIndexed",
                           "vkCmdDispatch",
                           "vkCmdCopyBuffer",
                           "vkCmdCopyBufferToImage",
                           "vkCmdCopyImageToBuffer",
                           "vkCmdPipelineBarrier",
                           "vkCmdPushConstants",
                           "vkCmdBeginRenderPass",
                           "vkCmdEndRenderPass"}) {
    EXPECT_NE(vkGetDeviceProcAddr(subject().device(), name), nullptr) << name;
  }
}

TEST(Loader, CommandsThatAreNotThereAreNotReturned) {
  for (const char* name : {"vkNoSuchCommand", "", "vkCmdDraw2", "vkcmddraw", "vkCmdDrawMeshTasksEXT",
                           "vkCmdTraceRaysKHR", "vkCreateInstance", "vkEnumeratePhysicalDevices",
                           "vkGetPhysicalDeviceProperties", "vkCreateAccelerationStructureKHR"}) {
    EXPECT_EQ(vkGetDeviceProcAddr(subject().device(), name), nullptr) << name;
  }
  // Core commands of versions above the device's.
  if (subject().properties().apiVersion < VK_API_VERSION_1_2) {
    EXPECT_EQ(vkGetDeviceProcAddr(subject().device(), "vkCmdDrawIndirectCount"), nullptr);
    EXPECT_EQ(vkGetDeviceProcAddr(subject().device(), "vkCmdBeginRendering"), nullptr);
  }
}

class DriverFile : public testing::Test {
 protected:
  void SetUp() override {
    if (!subject_is_lapilli()) GTEST_SKIP() << "about Lapilli's own file";
    // The first manifest that the loader was pointed at is the driver's.
    const std::string list = std::getenv("VK_DRIVER_FILES");
    std::ifstream manifest(list.substr(0, list.find(':')));
    std::stringstream text;
    text << manifest.rdbuf();
    const std::string json = text.str();
    std::smatch match;
    ASSERT_TRUE(std::regex_search(json, match, std::regex("\"library_path\"\\s*:\\s*\"([^\"]+)\""))) << json;
    library = dlopen(match[1].str().c_str(), RTLD_NOW | RTLD_LOCAL);
    ASSERT_NE(library, nullptr) << dlerror();
  }
  void TearDown() override {
    if (library != nullptr) dlclose(library);
  }
  template <typename T>
  T symbol(const char* name) const {
    return reinterpret_cast<T>(dlsym(library, name));
  }
  void* library = nullptr;
};

TEST_F(DriverFile, NegotiatesTheInterface) {
  const auto negotiate = symbol<VkResult (*)(uint32_t*)>("vk_icdNegotiateLoaderICDInterfaceVersion");
  ASSERT_NE(negotiate, nullptr);
  uint32_t version = 99;  // a loader of the future
  EXPECT_EQ(negotiate(&version), VK_SUCCESS);
  EXPECT_GE(version, 5u);
  EXPECT_LE(version, 7u);
  version = 5;
  EXPECT_EQ(negotiate(&version), VK_SUCCESS);
  EXPECT_EQ(version, 5u);
}

TEST_F(DriverFile, ExportsOnlyTheLoadersEntryPoints) {
  EXPECT_NE(symbol<void*>("vk_icdGetInstanceProcAddr"), nullptr);
  EXPECT_NE(symbol<void*>("vk_icdGetPhysicalDeviceProcAddr"), nullptr);
  for (const char* name : {"vkCreateInstance", "vkGetInstanceProcAddr", "vkCmdDraw"}) {
    // Found only if this file defines it, not through the loader this program is linked with.
    void* address = dlsym(library, name);
    if (address == nullptr) continue;
    Dl_info defined_in, ours;
    ASSERT_NE(dladdr(address, &defined_in), 0);
    ASSERT_NE(dladdr(symbol<void*>("vk_icdGetInstanceProcAddr"), &ours), 0);
    EXPECT_NE(defined_in.dli_fbase, ours.dli_fbase) << name;
  }
}

TEST_F(DriverFile, GlobalCommandsWithoutAnInstance) {
  const auto get = symbol<PFN_vkGetInstanceProcAddr>("vk_icdGetInstanceProcAddr");
  ASSERT_NE(get, nullptr);
  EXPECT_NE(get(VK_NULL_HANDLE, "vkCreateInstance"), nullptr);
  EXPECT_NE(get(VK_NULL_HANDLE, "vkEnumerateInstanceExtensionProperties"), nullptr);
  EXPECT_EQ(get(VK_NULL_HANDLE, "vkCmdDraw"), nullptr);
  EXPECT_EQ(get(VK_NULL_HANDLE, "vkDestroyInstance"), nullptr);
  EXPECT_EQ(get(VK_NULL_HANDLE, "vkNoSuchCommand"), nullptr);
}

}  // namespace
}  // namespace lapilli::conformance
