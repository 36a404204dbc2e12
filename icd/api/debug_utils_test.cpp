// VK_EXT_debug_utils through the entry points: what the driver says reaches the application's messengers.
#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

#include "api/command_table.h"
#include "base/log.h"

namespace lapilli {
namespace {

template <class F>
F command(const char* name) {
  return reinterpret_cast<F>(find_command(name)->function);
}
#define CALL(name) command<PFN_##name>(#name)

using Messages = std::vector<std::string>;

VkBool32 VKAPI_PTR listen(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                          const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  static_cast<Messages*>(user)->emplace_back(data->pMessage);
  return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(Messages& messages) {
  VkDebugUtilsMessengerCreateInfoEXT info = {};
  info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
  info.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT;
  info.pfnUserCallback = listen;
  info.pUserData = &messages;
  return info;
}

VkResult create_instance(const void* chain, const char* extension, VkInstance* instance) {
  VkInstanceCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pNext = chain;
  info.enabledExtensionCount = 1;
  info.ppEnabledExtensionNames = &extension;
  return CALL(vkCreateInstance)(&info, nullptr, instance);
}

TEST(DebugUtils, ListensDuringInstanceCreation) {
  Messages messages;
  const VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_info(messages);
  VkInstance instance = nullptr;
  EXPECT_EQ(create_instance(&messenger, "VK_KHR_nothing", &instance), VK_ERROR_EXTENSION_NOT_PRESENT);
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_NE(messages[0].find("VK_KHR_nothing"), std::string::npos);
  log_error("after it nobody listens");
  EXPECT_EQ(messages.size(), 1u);
}

TEST(DebugUtils, AMessengerHearsWhatItAskedForUntilItIsDestroyed) {
  Messages messages;
  VkInstance instance = nullptr;
  ASSERT_EQ(create_instance(nullptr, VK_EXT_DEBUG_UTILS_EXTENSION_NAME, &instance), VK_SUCCESS);
  const VkDebugUtilsMessengerCreateInfoEXT info = messenger_info(messages);
  VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
  ASSERT_EQ(CALL(vkCreateDebugUtilsMessengerEXT)(instance, &info, nullptr, &messenger), VK_SUCCESS);
  log_error("heard");
  log_warning("not asked for");
  VkDebugUtilsMessengerCallbackDataEXT data = {};
  data.pMessage = "the application's own";
  CALL(vkSubmitDebugUtilsMessageEXT)
  (instance, VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT, VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT, &data);
  CALL(vkSubmitDebugUtilsMessageEXT)
  (instance, VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT, VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT, &data);
  EXPECT_EQ(messages, (Messages{"heard", "the application's own"}));
  CALL(vkDestroyDebugUtilsMessengerEXT)(instance, messenger, nullptr);
  log_error("not heard");
  EXPECT_EQ(messages.size(), 2u);
  CALL(vkDestroyInstance)(instance, nullptr);
}

// Another thread does with instances and messages what it likes while a callback runs.
TEST(DebugUtils, ACallbackMayWaitForAnotherThreadThatCreatesAnInstance) {
  VkInstance instance = nullptr;
  ASSERT_EQ(create_instance(nullptr, VK_EXT_DEBUG_UTILS_EXTENSION_NAME, &instance), VK_SUCCESS);
  Messages messages;
  VkDebugUtilsMessengerCreateInfoEXT info = messenger_info(messages);
  info.pfnUserCallback = [](VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                            const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) -> VkBool32 {
    static_cast<Messages*>(user)->emplace_back(data->pMessage);
    std::thread([] {
      Messages inner;
      const VkDebugUtilsMessengerCreateInfoEXT chain = messenger_info(inner);
      VkInstance other = nullptr;
      EXPECT_EQ(create_instance(&chain, VK_EXT_DEBUG_UTILS_EXTENSION_NAME, &other), VK_SUCCESS);
      CALL(vkDestroyInstance)(other, nullptr);
    }).join();
    return VK_FALSE;
  };
  VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
  ASSERT_EQ(CALL(vkCreateDebugUtilsMessengerEXT)(instance, &info, nullptr, &messenger), VK_SUCCESS);
  log_error("heard");
  EXPECT_EQ(messages, Messages{"heard"});
  CALL(vkDestroyDebugUtilsMessengerEXT)(instance, messenger, nullptr);
  CALL(vkDestroyInstance)(instance, nullptr);
}

}  // namespace
}  // namespace lapilli
