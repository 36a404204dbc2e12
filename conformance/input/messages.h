// Listens to VK_EXT_debug_utils: every message of the driver (and the loader) with its severity.
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "common/context.h"

namespace lapilli::conformance {

class MessageLog {
 public:
  // Null messenger (listening() false) where the instance does not have the extension.
  explicit MessageLog(VkInstance instance);
  ~MessageLog();
  MessageLog(const MessageLog&) = delete;
  MessageLog& operator=(const MessageLog&) = delete;

  bool listening() const { return messenger_ != VK_NULL_HANDLE; }
  // Messages with ERROR severity since the last call.
  std::vector<std::string> take_errors();

 private:
  static VkBool32 VKAPI_PTR receive(VkDebugUtilsMessageSeverityFlagBitsEXT severity, VkDebugUtilsMessageTypeFlagsEXT,
                                    const VkDebugUtilsMessengerCallbackDataEXT* data, void* user);
  VkInstance instance_;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  std::mutex mutex_;
  std::vector<std::string> errors_;
};

}  // namespace lapilli::conformance
