// VK_EXT_debug_utils: messengers of an instance, and the driver's own messages on their way to them.
// Specification: chapter "Debugging".
#pragma once

#include <mutex>

#include "base/log.h"
#include "object/handle.h"

namespace lapilli {

struct Messenger : Handle<Messenger, VkDebugUtilsMessengerEXT> {
  Messenger(const HostMemory& memory, const VkDebugUtilsMessengerCreateInfoEXT& create_info);

  VkDebugUtilsMessengerCreateInfoEXT info;
};

// The messengers of one instance. While there are any it listens to the driver's log.
class MessengerList {
 public:
  explicit MessengerList(const HostMemory& host);
  ~MessengerList();
  MessengerList(const MessengerList&) = delete;
  MessengerList& operator=(const MessengerList&) = delete;

  // Throws std::bad_alloc.
  void add(Messenger& messenger);
  void remove(Messenger& messenger);
  // Calls every messenger that asked for this severity and one of these types.
  void submit(VkDebugUtilsMessageSeverityFlagsEXT severity, VkDebugUtilsMessageTypeFlagsEXT types,
              const VkDebugUtilsMessengerCallbackDataEXT& data);

 private:
  static void write(void* user, LogLevel level, const char* message);
  void listen();

  std::mutex mutex_;
  HostVector<Messenger*> messengers_;
  LogSink sink_;
  bool listening_ = false;
};

// The messengers in the pNext chain of VkInstanceCreateInfo, listening while the object exists: that is during
// vkCreateInstance or vkDestroyInstance.
class TemporaryMessengers {
 public:
  // Throws std::bad_alloc.
  TemporaryMessengers(const HostMemory& host, const void* chain);
  ~TemporaryMessengers();
  TemporaryMessengers(const TemporaryMessengers&) = delete;
  TemporaryMessengers& operator=(const TemporaryMessengers&) = delete;

 private:
  HostMemory host_;
  MessengerList list_;
  HostVector<ObjectPtr<Messenger>> messengers_;
};

// While it exists, messages from this thread carry these labels.
class ThreadLabels {
 public:
  using Labels = std::vector<VkDebugUtilsLabelEXT>;
  ThreadLabels(const Labels& queue, const Labels& commands);
  ~ThreadLabels();
  ThreadLabels(const ThreadLabels&) = delete;
  ThreadLabels& operator=(const ThreadLabels&) = delete;

 private:
  friend class MessengerList;
  const Labels& queue_;
  const Labels& commands_;
};

struct Instance;
VkResult create_messenger(Instance& instance, const VkDebugUtilsMessengerCreateInfoEXT& info,
                          const VkAllocationCallbacks* callbacks, VkDebugUtilsMessengerEXT* handle);
void destroy_messenger(Instance& instance, Messenger* messenger);

VkResult set_object_name(const VkDebugUtilsObjectNameInfoEXT& info);

}  // namespace lapilli
