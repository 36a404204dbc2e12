// What may be looked up by whom. The list of core commands is read from vk.xml here once more, in another way.
#include "api/command_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "object/test_context.h"
#include "queue/device.h"

extern "C" VkResult vk_icdNegotiateLoaderICDInterfaceVersion(uint32_t* version);
extern "C" PFN_vkVoidFunction vk_icdGetInstanceProcAddr(VkInstance instance, const char* name);

namespace lapilli {
namespace {

std::set<std::string> core_commands() {
  std::ifstream file(LAPILLI_VK_REGISTRY);
  std::stringstream text;
  text << file.rdbuf();
  const std::string registry = text.str();
  const size_t begin = registry.find("name=\"VK_VERSION_1_0\"");
  const size_t end = registry.find("</feature>", begin);
  const std::string feature = registry.substr(begin, end - begin);
  std::set<std::string> names;
  const std::regex command("<command name=\"(vk\\w+)\"");
  for (std::sregex_iterator at(feature.begin(), feature.end(), command), none; at != none; ++at) {
    names.insert((*at)[1].str());
  }
  return names;
}

TEST(CommandTable, IsSortedByName) {
  const auto table = command_table();
  EXPECT_TRUE(std::is_sorted(table.begin(), table.end(),
                             [](const CommandEntry& a, const CommandEntry& b) { return a.name < b.name; }));
}

TEST(CommandTable, HasEveryCommandOfVulkan10) {
  const std::set<std::string> core = core_commands();
  ASSERT_EQ(core.size(), 137u);  // what the specification of 1.0 lists
  for (const std::string& name : core) EXPECT_NE(find_command(name), nullptr) << name;
}

TEST(CommandTable, LevelsFollowTheFirstParameter) {
  EXPECT_EQ(find_command("vkCreateInstance")->level, CommandLevel::global);
  EXPECT_EQ(find_command("vkDestroyInstance")->level, CommandLevel::instance);
  EXPECT_EQ(find_command("vkCreateDevice")->level, CommandLevel::physical_device);
  EXPECT_EQ(find_command("vkQueueSubmit")->level, CommandLevel::device);
  EXPECT_EQ(find_command("vkCmdDraw")->level, CommandLevel::device);
}

TEST(CommandTable, WithoutAnInstanceOnlyGlobalCommandsAreFound) {
  EXPECT_NE(instance_command(nullptr, "vkCreateInstance"), nullptr);
  EXPECT_NE(instance_command(nullptr, "vkEnumerateInstanceExtensionProperties"), nullptr);
  EXPECT_EQ(instance_command(nullptr, "vkEnumeratePhysicalDevices"), nullptr);
  EXPECT_EQ(instance_command(nullptr, "vkCmdDraw"), nullptr);
}

TEST(CommandTable, UnknownCommandsAreNotFound) {
  TestContext context;
  EXPECT_EQ(instance_command(context.instance.get(), "vkNoSuchCommand"), nullptr);
  EXPECT_EQ(instance_command(context.instance.get(), ""), nullptr);
  // Vulkan 1.1 is not there: asking the loader for it must say so.
  EXPECT_EQ(instance_command(nullptr, "vkEnumerateInstanceVersion"), nullptr);
}

TEST(CommandTable, ExtensionsHaveToBeEnabled) {
  constexpr const char* kCommand = "vkCreateDebugUtilsMessengerEXT";
  TestContext context;
  EXPECT_EQ(instance_command(context.instance.get(), kCommand), nullptr);
  EXPECT_EQ(physical_device_command(context.instance.get(), "vkGetPhysicalDeviceProperties2KHR"), nullptr);
  ASSERT_TRUE(context.instance->extensions.enable(VK_EXT_DEBUG_UTILS_EXTENSION_NAME, ExtensionLevel::instance));
  EXPECT_NE(instance_command(context.instance.get(), kCommand), nullptr);
  EXPECT_EQ(physical_device_command(context.instance.get(), "vkGetPhysicalDeviceProperties2KHR"), nullptr);
}

TEST(CommandTable, DevicesGiveDeviceCommandsOnly) {
  TestContext context;
  const auto device =
      make_object<Device>(HostMemory(), VK_SYSTEM_ALLOCATION_SCOPE_DEVICE, context.instance->physical_device);
  EXPECT_NE(device_command(*device, "vkCmdDraw"), nullptr);
  EXPECT_EQ(device_command(*device, "vkCreateInstance"), nullptr);
  EXPECT_EQ(device_command(*device, "vkGetPhysicalDeviceFeatures"), nullptr);
  EXPECT_EQ(device_command(*device, "vkCmdBeginDebugUtilsLabelEXT"), nullptr);
  ASSERT_TRUE(context.instance->extensions.enable(VK_EXT_DEBUG_UTILS_EXTENSION_NAME, ExtensionLevel::instance));
  EXPECT_NE(device_command(*device, "vkCmdBeginDebugUtilsLabelEXT"), nullptr);
}

TEST(Loader, NegotiatesVersionFiveAndLater) {
  for (uint32_t version : {0u, 1u, 4u}) {
    EXPECT_EQ(vk_icdNegotiateLoaderICDInterfaceVersion(&version), VK_ERROR_INCOMPATIBLE_DRIVER);
  }
  uint32_t version = 5;
  EXPECT_EQ(vk_icdNegotiateLoaderICDInterfaceVersion(&version), VK_SUCCESS);
  EXPECT_EQ(version, 5u);
  version = 99;
  EXPECT_EQ(vk_icdNegotiateLoaderICDInterfaceVersion(&version), VK_SUCCESS);
  EXPECT_EQ(version, 7u);
  EXPECT_NE(vk_icdGetInstanceProcAddr(nullptr, "vk_icdGetPhysicalDeviceProcAddr"), nullptr);
}

}  // namespace
}  // namespace lapilli
