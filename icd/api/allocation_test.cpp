// The application's allocator, through the entry points: everything comes from it and goes back to it, also when any
// one allocation is refused. Specification: chapter "Memory Allocation", section "Host Memory".
#include <gtest/gtest.h>

#include <cstdlib>
#include <mutex>
#include <set>

#include "api/command_table.h"

namespace lapilli {
namespace {

template <class F>
F command(const char* name) {
  return reinterpret_cast<F>(find_command(name)->function);
}
#define CALL(name) command<PFN_##name>(#name)

class Allocator {
 public:
  explicit Allocator(int fail_at) : fail_at_(fail_at) {
    callbacks_.pUserData = this;
    callbacks_.pfnAllocation = [](void* user, size_t size, size_t, VkSystemAllocationScope) {
      return static_cast<Allocator*>(user)->allocate(size);
    };
    callbacks_.pfnFree = [](void* user, void* memory) { static_cast<Allocator*>(user)->free(memory); };
  }
  const VkAllocationCallbacks* callbacks() const { return &callbacks_; }
  int count() const { return count_; }
  size_t live() const { return live_.size(); }
  bool misused() const { return misused_; }

 private:
  void* allocate(size_t size) {
    const std::scoped_lock lock(mutex_);
    if (count_++ == fail_at_) return nullptr;
    void* memory = std::aligned_alloc(64, (size + 63) / 64 * 64);
    live_.insert(memory);
    return memory;
  }
  void free(void* memory) {
    const std::scoped_lock lock(mutex_);
    if (memory == nullptr) return;
    misused_ |= live_.erase(memory) != 1;
    std::free(memory);
  }
  VkAllocationCallbacks callbacks_ = {};
  int fail_at_;
  int count_ = 0;
  bool misused_ = false;
  std::mutex mutex_;
  std::set<void*> live_;
};

// Creates one thing after the other, until all are there or one is refused; then destroys what there is.
class Scenario {
 public:
  explicit Scenario(const VkAllocationCallbacks* callbacks) : callbacks_(callbacks) {}

  VkResult run() {
    const VkResult result = create();
    destroy();
    return result;
  }

 private:
  VkResult create() {
    VkInstanceCreateInfo instance_info = {};
    instance_info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    VkResult result = CALL(vkCreateInstance)(&instance_info, callbacks_, &instance_);
    if (result != VK_SUCCESS) return result;
    uint32_t count = 1;
    VkPhysicalDevice physical = nullptr;
    result = CALL(vkEnumeratePhysicalDevices)(instance_, &count, &physical);
    if (result != VK_SUCCESS) return result;
    const float priority = 1;
    VkDeviceQueueCreateInfo queue = {};
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo device_info = {};
    device_info.queueCreateInfoCount = 1;
    device_info.pQueueCreateInfos = &queue;
    result = CALL(vkCreateDevice)(physical, &device_info, callbacks_, &device_);
    return result == VK_SUCCESS ? create_objects() : result;
  }
  VkResult create_objects() {
    const VkDescriptorSetLayoutBinding binding = {0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 2, VK_SHADER_STAGE_ALL,
                                                  nullptr};
    VkDescriptorSetLayoutCreateInfo layout = {};
    layout.bindingCount = 1;
    layout.pBindings = &binding;
    VkResult result = CALL(vkCreateDescriptorSetLayout)(device_, &layout, callbacks_, &layout_);
    if (result != VK_SUCCESS) return result;
    const VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 2};
    VkDescriptorPoolCreateInfo pool = {};
    pool.maxSets = 1;
    pool.poolSizeCount = 1;
    pool.pPoolSizes = &size;
    result = CALL(vkCreateDescriptorPool)(device_, &pool, callbacks_, &pool_);
    if (result != VK_SUCCESS) return result;
    VkDescriptorSetAllocateInfo sets = {};
    sets.descriptorPool = pool_;
    sets.descriptorSetCount = 1;
    sets.pSetLayouts = &layout_;
    VkDescriptorSet set = VK_NULL_HANDLE;
    result = CALL(vkAllocateDescriptorSets)(device_, &sets, &set);
    return result == VK_SUCCESS ? record() : result;
  }
  VkResult record() {
    const VkCommandPoolCreateInfo info = {};
    VkResult result = CALL(vkCreateCommandPool)(device_, &info, callbacks_, &commands_);
    if (result != VK_SUCCESS) return result;
    VkCommandBufferAllocateInfo allocate = {};
    allocate.commandPool = commands_;
    allocate.commandBufferCount = 1;
    VkCommandBuffer buffer = nullptr;
    result = CALL(vkAllocateCommandBuffers)(device_, &allocate, &buffer);
    if (result != VK_SUCCESS) return result;
    const VkCommandBufferBeginInfo begin = {};
    CALL(vkBeginCommandBuffer)(buffer, &begin);
    for (int i = 0; i < 1000; ++i) CALL(vkCmdDispatch)(buffer, 0, 0, 0);
    return CALL(vkEndCommandBuffer)(buffer);
  }
  void destroy() {
    if (device_ != nullptr) {
      CALL(vkDestroyCommandPool)(device_, commands_, callbacks_);
      CALL(vkDestroyDescriptorPool)(device_, pool_, callbacks_);
      CALL(vkDestroyDescriptorSetLayout)(device_, layout_, callbacks_);
      CALL(vkDestroyDevice)(device_, callbacks_);
    }
    CALL(vkDestroyInstance)(instance_, callbacks_);
  }

  const VkAllocationCallbacks* callbacks_;
  VkInstance instance_ = nullptr;
  VkDevice device_ = nullptr;
  VkDescriptorSetLayout layout_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkCommandPool commands_ = VK_NULL_HANDLE;
};

TEST(Allocation, EverythingGoesBack) {
  Allocator allocator(-1);
  EXPECT_EQ(Scenario(allocator.callbacks()).run(), VK_SUCCESS);
  EXPECT_GT(allocator.count(), 8);
  EXPECT_EQ(allocator.live(), 0u);
  EXPECT_FALSE(allocator.misused());
}

TEST(Allocation, AnyOneMayBeRefused) {
  Allocator all(-1);
  ASSERT_EQ(Scenario(all.callbacks()).run(), VK_SUCCESS);
  for (int i = 0; i < all.count(); ++i) {
    Allocator allocator(i);
    EXPECT_EQ(Scenario(allocator.callbacks()).run(), VK_ERROR_OUT_OF_HOST_MEMORY) << "allocation " << i;
    EXPECT_EQ(allocator.live(), 0u) << "allocation " << i;
    EXPECT_FALSE(allocator.misused()) << "allocation " << i;
  }
}

}  // namespace
}  // namespace lapilli
