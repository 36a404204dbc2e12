// An instance, one of its physical devices, a device and its one queue: Vulkan 1.0, no surface, no optional feature.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "common/handle.h"

namespace lapilli::samples {

struct ContextOptions {
  std::string device_name;  // a part of VkPhysicalDeviceProperties::deviceName; empty: the first device
  bool validation = false;  // VK_LAYER_KHRONOS_validation, if it is installed
  bool messages = false;    // collect what VK_EXT_debug_utils reports, if it is there; validation implies it
};

// Throws std::runtime_error if there is no such device or a call fails.
class Context {
 public:
  explicit Context(const ContextOptions& options = {});
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  VkInstance instance() const { return instance_; }
  VkPhysicalDevice physical_device() const { return physical_device_; }
  VkDevice device() const { return device_; }
  VkQueue queue() const { return queue_; }
  uint32_t queue_family() const { return queue_family_; }
  const VkPhysicalDeviceProperties& properties() const { return properties_; }

  // Warnings and errors of the layers and the driver so far, one line each.
  const std::vector<std::string>& messages() const { return messages_; }
  bool validation_active() const { return validation_active_; }

  // A memory type of `type_bits` that has all `flags`. Throws if there is none.
  uint32_t memory_type(uint32_t type_bits, VkMemoryPropertyFlags flags) const;

  // Starts a command buffer of this context's pool for one submission.
  VkCommandBuffer begin_commands() const;
  // Ends, submits and waits until the queue has done it; then the command buffer is gone.
  void submit_and_wait(VkCommandBuffer commands) const;

 private:
  void create_instance(const ContextOptions& options);
  void choose_physical_device(std::string_view name);
  void create_device();

  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_device_ = VK_NULL_HANDLE;
  VkPhysicalDeviceProperties properties_ = {};
  VkPhysicalDeviceMemoryProperties memory_ = {};
  uint32_t queue_family_ = 0;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  CommandPool pool_;
  Fence fence_;
  std::vector<std::string> messages_;
  bool validation_active_ = false;
};

// Names of all physical devices that the loader offers.
std::vector<std::string> device_names();

}  // namespace lapilli::samples
