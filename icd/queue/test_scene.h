// For tests of the queue: a device, a colour and a depth attachment, and pipelines that draw coloured rectangles.
// Objects are put together by hand; how the entry points make them is tested elsewhere.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "object/test_context.h"
#include "queue/device.h"

namespace lapilli {

struct TestScene {
  // The colours are what the uniform buffer holds; a draw names one by its number.
  TestScene(uint32_t width, uint32_t height, std::vector<std::array<float, 4>> colors);

  // Depth test: less, and written.
  const Pipeline& add_pipeline(VkCullModeFlags cull = VK_CULL_MODE_NONE, VkColorComponentFlags color_mask = 0xF);
  CommandBuffer& add_commands();
  void begin_pass(CommandBuffer& commands);  // clears to 0 and depth 1
  // Where, in clip space, and in which colour the next draws are.
  void place(CommandBuffer& commands, float left, float top, float right, float bottom, float depth, uint32_t color);
  // place(), and a draw of two triangles of six vertices. Needs a bound pipeline.
  void draw(CommandBuffer& commands, float left, float top, float right, float bottom, float depth, uint32_t color);
  void submit(CommandBuffer& commands);  // and waits until it is done
  const uint8_t* pixel(uint32_t x, uint32_t y) const;

  TestContext context;
  ObjectPtr<Device> device;
  const uint32_t width, height;
  ObjectPtr<RenderPass> pass;
  ObjectPtr<Framebuffer> framebuffer;

 private:
  struct Attachment {
    ObjectPtr<Image> image;
    ObjectPtr<ImageView> view;
    std::vector<std::byte> texels;
  };
  void add_attachment(VkFormat format, VkImageUsageFlags usage);

  // Constants of the application's own: kColorStride bytes apart.
  std::vector<std::byte> color_bytes_;
  ObjectPtr<Buffer> corners_;
  ObjectPtr<DescriptorPool> descriptor_pool_;
  ObjectPtr<DescriptorSet> set_;
  ObjectPtr<PipelineLayout> layout_;
  ObjectPtr<CommandPool> command_pool_;
  ObjectPtr<Fence> fence_;
  std::vector<Attachment> attachments_;
  std::vector<ObjectPtr<Pipeline>> pipelines_;
};

}  // namespace lapilli
