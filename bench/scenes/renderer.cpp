// See renderer.h. Specification: Command Buffers.
#include "scenes/renderer.h"

#include <chrono>

namespace lapilli::bench {
namespace {

using Clock = std::chrono::steady_clock;
using samples::check;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

SceneRenderer::SceneRenderer(const samples::Context& context, std::unique_ptr<Scene> scene)
    : context_(context), scene_(std::move(scene)) {
  scene_->create_resources(context);
  const Clock::time_point start = Clock::now();
  scene_->create_pipelines(context);
  pipelines_ms_ = milliseconds_since(start);

  VkCommandPoolCreateInfo pool = {};
  pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
  pool.queueFamilyIndex = context.queue_family();
  VkCommandPool raw_pool = VK_NULL_HANDLE;
  check(vkCreateCommandPool(context.device(), &pool, nullptr, &raw_pool), "vkCreateCommandPool");
  pool_ = samples::CommandPool(context.device(), raw_pool);
  VkCommandBufferAllocateInfo allocate = {};
  allocate.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  allocate.commandPool = raw_pool;
  allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  allocate.commandBufferCount = 1;
  check(vkAllocateCommandBuffers(context.device(), &allocate, &commands_), "vkAllocateCommandBuffers");
  VkFenceCreateInfo fence = {};
  fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  VkFence raw_fence = VK_NULL_HANDLE;
  check(vkCreateFence(context.device(), &fence, nullptr, &raw_fence), "vkCreateFence");
  fence_ = samples::Fence(context.device(), raw_fence);
}

FrameTime SceneRenderer::draw_frame() {
  FrameTime time;
  Clock::time_point start = Clock::now();
  VkCommandBufferBeginInfo begin = {};
  begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(commands_, &begin), "vkBeginCommandBuffer");
  scene_->record(commands_);
  check(vkEndCommandBuffer(commands_), "vkEndCommandBuffer");
  time.record = milliseconds_since(start);

  start = Clock::now();
  VkSubmitInfo submit = {};
  submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands_;
  check(vkQueueSubmit(context_.queue(), 1, &submit, fence_.get()), "vkQueueSubmit");
  check(vkWaitForFences(context_.device(), 1, fence_.address(), VK_TRUE, UINT64_MAX), "vkWaitForFences");
  time.frame = milliseconds_since(start);
  check(vkResetFences(context_.device(), 1, fence_.address()), "vkResetFences");
  return time;
}

samples::Frame draw_once(const samples::Context& context, const SceneEntry& entry, VkExtent2D extent) {
  std::unique_ptr<Scene> scene = create_scene(entry, {extent, entry.small_count});
  if (!scene->missing(context).empty()) return {};
  SceneRenderer renderer(context, std::move(scene));
  renderer.draw_frame();
  return renderer.read_back();
}

}  // namespace lapilli::bench
