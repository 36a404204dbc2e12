// Owners of Vulkan handles and the check of results, so that the samples read as the order of Vulkan calls they are.
#pragma once

#include <vulkan/vulkan_core.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace lapilli::samples {

// Throws std::runtime_error naming `what` and the VkResult unless it is VK_SUCCESS.
inline void check(VkResult result, const char* what) {
  if (result != VK_SUCCESS) throw std::runtime_error(std::string(what) + " gave VkResult " + std::to_string(result));
}

// A handle made from a device; destroyed with it, movable, never copied.
template <typename H, void (*Destroy)(VkDevice, H, const VkAllocationCallbacks*)>
class Owned {
 public:
  Owned() = default;
  Owned(VkDevice device, H handle) : device_(device), handle_(handle) {}
  Owned(Owned&& other) noexcept
      : device_(std::exchange(other.device_, VK_NULL_HANDLE)), handle_(std::exchange(other.handle_, VK_NULL_HANDLE)) {}
  Owned& operator=(Owned&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(handle_, other.handle_);
    return *this;
  }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  ~Owned() {
    if (handle_ != VK_NULL_HANDLE) Destroy(device_, handle_, nullptr);
  }

  H get() const { return handle_; }
  const H* address() const { return &handle_; }

 private:
  VkDevice device_ = VK_NULL_HANDLE;
  H handle_ = VK_NULL_HANDLE;
};

using CommandPool = Owned<VkCommandPool, vkDestroyCommandPool>;
using DescriptorPool = Owned<VkDescriptorPool, vkDestroyDescriptorPool>;
using DescriptorSetLayout = Owned<VkDescriptorSetLayout, vkDestroyDescriptorSetLayout>;
using DeviceMemory = Owned<VkDeviceMemory, vkFreeMemory>;
using Fence = Owned<VkFence, vkDestroyFence>;
using Framebuffer = Owned<VkFramebuffer, vkDestroyFramebuffer>;
using ImageView = Owned<VkImageView, vkDestroyImageView>;
using Pipeline = Owned<VkPipeline, vkDestroyPipeline>;
using PipelineLayout = Owned<VkPipelineLayout, vkDestroyPipelineLayout>;
using RawBuffer = Owned<VkBuffer, vkDestroyBuffer>;
using RawImage = Owned<VkImage, vkDestroyImage>;
using RenderPass = Owned<VkRenderPass, vkDestroyRenderPass>;
using Sampler = Owned<VkSampler, vkDestroySampler>;
using ShaderModule = Owned<VkShaderModule, vkDestroyShaderModule>;

}  // namespace lapilli::samples
