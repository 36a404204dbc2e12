// Messengers and how messages reach them.
#include "object/debug_utils.h"

#include <algorithm>

#include "object/instance.h"
#include "object/structure_chain.h"

namespace lapilli {
namespace {

VkDebugUtilsMessageSeverityFlagsEXT severity_of(LogLevel level) {
  switch (level) {
    case LogLevel::kError:
      return VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    case LogLevel::kWarning:
      return VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT;
    case LogLevel::kInfo:
      return VK_DEBUG_UTILS_MESSAGE_SEVERITY_INFO_BIT_EXT;
    case LogLevel::kDebug:
      break;
  }
  return VK_DEBUG_UTILS_MESSAGE_SEVERITY_VERBOSE_BIT_EXT;
}

thread_local const ThreadLabels* thread_labels = nullptr;

}  // namespace

ThreadLabels::ThreadLabels(const Labels& queue, const Labels& commands) : queue_(queue), commands_(commands) {
  thread_labels = this;
}
ThreadLabels::~ThreadLabels() { thread_labels = nullptr; }

Messenger::Messenger(const HostMemory& memory, const VkDebugUtilsMessengerCreateInfoEXT& create_info)
    : Handle(memory), info(create_info) {
  info.pNext = nullptr;
}

MessengerList::MessengerList(const HostMemory& host)
    : messengers_(HostAllocator<Messenger*>(host, VK_SYSTEM_ALLOCATION_SCOPE_INSTANCE)) {
  sink_.write = write;
  sink_.user = this;
}

MessengerList::~MessengerList() {
  if (listening_) remove_log_sink(sink_);
}

// Asks the log for what the messengers want and no more: a message that nobody hears is not even formatted.
void MessengerList::listen() {
  VkDebugUtilsMessageSeverityFlagsEXT wanted = 0;
  {
    const std::scoped_lock lock(mutex_);
    for (const Messenger* messenger : messengers_) wanted |= messenger->info.messageSeverity;
  }
  if (wanted == 0) return;
  LogLevel level = LogLevel::kError;
  for (LogLevel more : {LogLevel::kWarning, LogLevel::kInfo, LogLevel::kDebug}) {
    if ((wanted & severity_of(more)) != 0) level = more;
  }
  if (listening_) return set_log_sink_level(sink_, level);
  sink_.level = level;
  listening_ = true;
  add_log_sink(sink_);
}

void MessengerList::add(Messenger& messenger) {
  {
    const std::scoped_lock lock(mutex_);
    messengers_.push_back(&messenger);
  }
  listen();
}

// Its callback is not running any more when this returns.
void MessengerList::remove(Messenger& messenger) {
  {
    const std::scoped_lock lock(mutex_);
    std::erase(messengers_, &messenger);
  }
  if (listening_) remove_log_sink(sink_);
  listening_ = false;
  listen();
}

void MessengerList::submit(VkDebugUtilsMessageSeverityFlagsEXT severity, VkDebugUtilsMessageTypeFlagsEXT types,
                           const VkDebugUtilsMessengerCallbackDataEXT& data) {
  // The callback runs without the lock, so that it may cause messages itself.
  for (size_t i = 0;; ++i) {
    VkDebugUtilsMessengerCreateInfoEXT info;
    {
      const std::scoped_lock lock(mutex_);
      if (i >= messengers_.size()) return;
      info = messengers_[i]->info;
    }
    if ((info.messageSeverity & severity) != 0 && (info.messageType & types) != 0) {
      info.pfnUserCallback(static_cast<VkDebugUtilsMessageSeverityFlagBitsEXT>(severity), types, &data, info.pUserData);
    }
  }
}

void MessengerList::write(void* user, LogLevel level, const char* message) {
  VkDebugUtilsMessengerCallbackDataEXT data = {};
  data.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CALLBACK_DATA_EXT;
  data.pMessageIdName = "Lapilli";
  data.pMessage = message;
  if (const ThreadLabels* labels = thread_labels) {
    data.queueLabelCount = static_cast<uint32_t>(labels->queue_.size());
    data.pQueueLabels = labels->queue_.data();
    data.cmdBufLabelCount = static_cast<uint32_t>(labels->commands_.size());
    data.pCmdBufLabels = labels->commands_.data();
  }
  // What the driver refuses is worth the attention of those who listen for validation messages only.
  const VkDebugUtilsMessageTypeFlagsEXT type = level <= LogLevel::kWarning
                                                   ? VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT
                                                   : VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT;
  static_cast<MessengerList*>(user)->submit(severity_of(level), type, data);
}

TemporaryMessengers::TemporaryMessengers(const HostMemory& host, const void* chain)
    : host_(host),
      list_(host_),
      messengers_(HostAllocator<ObjectPtr<Messenger>>(host_, VK_SYSTEM_ALLOCATION_SCOPE_COMMAND)) {
  for (const void* at = chain; at != nullptr;) {
    const auto* info =
        find_in_chain<VkDebugUtilsMessengerCreateInfoEXT>(at, VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
    if (info == nullptr) return;
    messengers_.push_back(make_object<Messenger>(host_, VK_SYSTEM_ALLOCATION_SCOPE_COMMAND, *info));
    list_.add(*messengers_.back());
    at = info->pNext;
  }
}

TemporaryMessengers::~TemporaryMessengers() {
  for (const ObjectPtr<Messenger>& messenger : messengers_) list_.remove(*messenger);
}

VkResult create_messenger(Instance& instance, const VkDebugUtilsMessengerCreateInfoEXT& info,
                          const VkAllocationCallbacks* callbacks, VkDebugUtilsMessengerEXT* handle) {
  auto messenger =
      make_object<Messenger>(HostMemory(callbacks, instance.host), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT, info);
  instance.messengers.add(*messenger);
  return publish(std::move(messenger), handle);
}

void destroy_messenger(Instance& instance, Messenger* messenger) {
  if (messenger == nullptr) return;
  instance.messengers.remove(*messenger);
  destroy(messenger);
}

VkResult set_object_name(const VkDebugUtilsObjectNameInfoEXT& info) {
  // Surfaces belong to the loader: their handles are not ours.
  if (info.objectHandle == 0 || info.objectType == VK_OBJECT_TYPE_SURFACE_KHR) return VK_SUCCESS;
  reinterpret_cast<Object*>(static_cast<uintptr_t>(info.objectHandle))->set_name(info.pObjectName);
  return VK_SUCCESS;
}

}  // namespace lapilli
