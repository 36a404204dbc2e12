// Application allocators: honoured, balanced, and allowed to fail at any call. Specification: "Memory Allocation", Host
// Memory.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <string>

#include "harness/devices.h"
#include "harness/graphics.h"
#include "shaders/flat_color.frag.h"
#include "shaders/position_color.vert.h"
#include "shaders/small.comp.h"

namespace lapilli::conformance {
namespace {

// Counts what is alive; fails at the call number `fail_at` (counted from 0).
class Allocator {
 public:
  explicit Allocator(int64_t fail_at = -1) : fail_at_(fail_at) {
    callbacks_.pUserData = this;
    callbacks_.pfnAllocation = [](void* self, size_t size, size_t alignment, VkSystemAllocationScope) {
      return static_cast<Allocator*>(self)->allocate(nullptr, size, alignment);
    };
    callbacks_.pfnReallocation = [](void* self, void* old, size_t size, size_t alignment, VkSystemAllocationScope) {
      return static_cast<Allocator*>(self)->allocate(old, size, alignment);
    };
    callbacks_.pfnFree = [](void* self, void* memory) { static_cast<Allocator*>(self)->free(memory); };
  }
  ~Allocator() { EXPECT_TRUE(alive_.empty()) << alive_.size() << " allocations were never freed"; }
  Allocator(const Allocator&) = delete;
  Allocator& operator=(const Allocator&) = delete;

  const VkAllocationCallbacks* get() const { return &callbacks_; }
  int64_t calls() const { return calls_; }
  size_t alive() const { return alive_.size(); }
  bool failed() const { return fail_at_ >= 0 && calls_ > fail_at_; }

 private:
  void* allocate(void* old, size_t size, size_t alignment) {
    const std::lock_guard lock(mutex_);
    EXPECT_TRUE(alignment != 0 && (alignment & (alignment - 1)) == 0) << "alignment " << alignment;
    EXPECT_TRUE(old == nullptr || alive_.contains(old)) << "reallocated what is not alive";
    if (old != nullptr && size == 0) {
      release(old);
      return nullptr;
    }
    if (calls_++ == fail_at_) return nullptr;
    const size_t at_least = std::max(alignment, sizeof(void*));
    void* memory = std::aligned_alloc(at_least, (std::max<size_t>(size, 1) + at_least - 1) / at_least * at_least);
    std::memset(memory, 0xA5, size);  // nobody may rely on zeroes
    alive_[memory] = size;
    if (old != nullptr) {
      std::memcpy(memory, old, std::min(size, alive_[old]));
      release(old);
    }
    return memory;
  }
  void free(void* memory) {
    if (memory == nullptr) return;
    const std::lock_guard lock(mutex_);
    EXPECT_TRUE(alive_.contains(memory)) << "freed what is not alive";
    if (alive_.contains(memory)) release(memory);
  }
  void release(void* memory) {
    alive_.erase(memory);
    std::free(memory);
  }

  VkAllocationCallbacks callbacks_ = {};
  std::mutex mutex_;
  std::map<void*, size_t> alive_;
  int64_t calls_ = 0;
  int64_t fail_at_;
};

template <typename T>
T info_of(VkStructureType type) {
  T info = {};
  info.sType = type;
  return info;
}

// Makes and destroys one object of a kind with the allocator.
struct Kind {
  const char* name;
  VkResult (*make)(const samples::Context&, const VkAllocationCallbacks*);
};

template <typename Handle, typename Info, typename Create, typename Destroy>
VkResult make(const samples::Context& c, const Info& info, const VkAllocationCallbacks* a, Create create,
              Destroy destroy) {
  Handle handle = VK_NULL_HANDLE;
  const VkResult result = create(c.device(), &info, a, &handle);
  if (result == VK_SUCCESS) destroy(c.device(), handle, a);
  return result;
}

const Kind kKinds[] = {
    {"buffer",
     [](const samples::Context& c, const VkAllocationCallbacks* a) {
       auto info = info_of<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
       info.size = 64;
       info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
       return make<VkBuffer>(c, info, a, vkCreateBuffer, vkDestroyBuffer);
     }},
    {"image",
     [](const samples::Context& c, const VkAllocationCallbacks* a) {
       auto info = info_of<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
       info.imageType = VK_IMAGE_TYPE_2D;
       info.format = VK_FORMAT_R8G8B8A8_UNORM;
       info.extent = {4, 4, 1};
       info.mipLevels = info.arrayLayers = 1;
       info.samples = VK_SAMPLE_COUNT_1_BIT;
       info.usage = VK_IMAGE_USAGE_SAMPLED_BIT;
       return make<VkImage>(c, info, a, vkCreateImage, vkDestroyImage);
     }},
    {"memory",
     [](const samples::Context& c, const VkAllocationCallbacks* a) {
       auto info = info_of<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
       info.allocationSize = 4096;
       return make<VkDeviceMemory>(c, info, a, vkAllocateMemory, vkFreeMemory);
     }},
    {"sampler",
     [](const samples::Context& c, const VkAllocationCallbacks* a) {
       const auto info = info_of<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
       return make<VkSampler>(c, info, a, vkCreateSampler, vkDestroySampler);
     }},
    {"fence",
     [](const samples::Context& c, const VkAllocationCallbacks* a) {
       const auto info = info_of<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
       return make<VkFence>(c, info, a, vkCreateFence, vkDestroyFence);
     }},
    {"semaphore",
     [](const samples::Context& c, const VkAllocationCallbacks* a) {
       const auto info = info_of<VkSemaphoreCreateInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO);
       return make<VkSemaphore>(c, info, a, vkCreateSemaphore, vkDestroySemaphore);
     }},
    {"descriptor set layout",
     [](const samples::Context& c, const VkAllocationCallbacks* a) {
       const VkDescriptorSetLayoutBinding bindings[] = {
           {0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_ALL, nullptr},
           {5, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 3, VK_SHADER_STAGE_ALL, nullptr}};
       auto info = info_of<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
       info.bindingCount = 2;
       info.pBindings = bindings;
       return make<VkDescriptorSetLayout>(c, info, a, vkCreateDescriptorSetLayout, vkDestroyDescriptorSetLayout);
     }},
    {"descriptor pool",
     [](const samples::Context& c, const VkAllocationCallbacks* a) {
       const VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 10};
       auto info = info_of<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
       info.maxSets = 4;
       info.poolSizeCount = 1;
       info.pPoolSizes = &size;
       return make<VkDescriptorPool>(c, info, a, vkCreateDescriptorPool, vkDestroyDescriptorPool);
     }},
    {"shader module",
     [](const samples::Context& c, const VkAllocationCallbacks* a) {
       auto info = info_of<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
       info.codeSize = sizeof(shaders::kSmallComp);
       info.pCode = shaders::kSmallComp;
       return make<VkShaderModule>(c, info, a, vkCreateShaderModule, vkDestroyShaderModule);
     }},
    {"pipeline layout",
     [](const samples::Context& c, const VkAllocationCallbacks* a) {
       const auto info = info_of<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
       return make<VkPipelineLayout>(c, info, a, vkCreatePipelineLayout, vkDestroyPipelineLayout);
     }},
    {"pipeline cache",
     [](const samples::Context& c, const VkAllocationCallbacks* a) {
       const auto info = info_of<VkPipelineCacheCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO);
       return make<VkPipelineCache>(c, info, a, vkCreatePipelineCache, vkDestroyPipelineCache);
     }},
    {"command pool with a buffer",
     [](const samples::Context& c, const VkAllocationCallbacks* a) {
       auto info = info_of<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
       info.queueFamilyIndex = c.queue_family();
       VkCommandPool pool = VK_NULL_HANDLE;
       VkResult result = vkCreateCommandPool(c.device(), &info, a, &pool);
       if (result != VK_SUCCESS) return result;
       auto allocate = info_of<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
       allocate.commandPool = pool;
       allocate.commandBufferCount = 3;
       std::array<VkCommandBuffer, 3> buffers = {};
       result = vkAllocateCommandBuffers(c.device(), &allocate, buffers.data());
       vkDestroyCommandPool(c.device(), pool, a);
       return result;
     }},
    {"graphics pipeline",
     [](const samples::Context& c, const VkAllocationCallbacks* a) {
       const samples::PipelineLayout layout = create_layout(c);
       VkAttachmentDescription attachment = {};
       attachment.format = VK_FORMAT_R8G8B8A8_UNORM;
       attachment.samples = VK_SAMPLE_COUNT_1_BIT;
       attachment.finalLayout = VK_IMAGE_LAYOUT_GENERAL;
       const VkAttachmentReference reference = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
       VkSubpassDescription subpass = {};
       subpass.colorAttachmentCount = 1;
       subpass.pColorAttachments = &reference;
       auto pass_info = info_of<VkRenderPassCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO);
       pass_info.attachmentCount = pass_info.subpassCount = 1;
       pass_info.pAttachments = &attachment;
       pass_info.pSubpasses = &subpass;
       VkRenderPass raw = VK_NULL_HANDLE;
       VkResult result = vkCreateRenderPass(c.device(), &pass_info, a, &raw);
       if (result != VK_SUCCESS) return result;
       PipelineState state;
       state.vertex_shader = shaders::kPositionColorVert;
       state.fragment_shader = shaders::kFlatColorFrag;
       state.layout = layout.get();
       state.render_pass = raw;
       VkPipeline pipeline = VK_NULL_HANDLE;
       result = try_create_pipeline(c, state, &pipeline, a);
       EXPECT_EQ(result == VK_SUCCESS, pipeline != VK_NULL_HANDLE);
       vkDestroyPipeline(c.device(), pipeline, a);
       vkDestroyRenderPass(c.device(), raw, a);
       return result;
     }},
};

TEST(Allocators, AreUsedAndBalancedForEveryKindOfObject) {
  for (const Kind& kind : kKinds) {
    Allocator allocator;
    EXPECT_EQ(kind.make(subject(), allocator.get()), VK_SUCCESS) << kind.name;
    EXPECT_GT(allocator.calls(), 0) << kind.name << " ignores the application's allocator";
    EXPECT_EQ(allocator.alive(), 0u) << kind.name;
  }
}

TEST(Allocators, MayFailAtAnyCall) {
  for (const Kind& kind : kKinds) {
    for (int64_t n = 0; n < 10000; ++n) {
      Allocator allocator(n);
      const VkResult result = kind.make(subject(), allocator.get());
      if (!allocator.failed()) {
        EXPECT_EQ(result, VK_SUCCESS) << kind.name;
        break;
      }
      EXPECT_EQ(result, VK_ERROR_OUT_OF_HOST_MEMORY) << kind.name << ", allocation " << n;
      EXPECT_EQ(allocator.alive(), 0u) << kind.name << ", allocation " << n;
      if (HasFailure()) break;
    }
  }
}

// Instance and device through the loader, which uses the allocator as well.
VkResult instance_and_device(const VkAllocationCallbacks* a) {
  auto info = info_of<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
  VkInstance instance = VK_NULL_HANDLE;
  VkResult result = vkCreateInstance(&info, a, &instance);
  if (result != VK_SUCCESS) return result;
  uint32_t count = 8;
  VkPhysicalDevice devices[8];
  result = vkEnumeratePhysicalDevices(instance, &count, devices);
  for (uint32_t i = 0; result == VK_SUCCESS && i < count; ++i) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(devices[i], &properties);
    if (std::string(properties.deviceName).find(subject_name()) == std::string::npos) continue;
    const float priority = 1;
    auto queue = info_of<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    auto device_info = info_of<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
    device_info.queueCreateInfoCount = 1;
    device_info.pQueueCreateInfos = &queue;
    VkDevice device = VK_NULL_HANDLE;
    result = vkCreateDevice(devices[i], &device_info, a, &device);
    if (result == VK_SUCCESS) vkDestroyDevice(device, a);
    break;
  }
  vkDestroyInstance(instance, a);
  return result;
}

TEST(Allocators, InstanceAndDeviceAreBalanced) {
  Allocator allocator;
  EXPECT_EQ(instance_and_device(allocator.get()), VK_SUCCESS);
  EXPECT_GT(allocator.calls(), 0);
}

}  // namespace
}  // namespace lapilli::conformance
