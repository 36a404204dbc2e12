// The objects of TestScene.
#include "queue/test_scene.h"

#include <cstdlib>
#include <cstring>

#include "shaders/rectangle.frag.h"
#include "shaders/rectangle.vert.h"

namespace lapilli {
namespace {

constexpr VkSystemAllocationScope kScope = VK_SYSTEM_ALLOCATION_SCOPE_OBJECT;
constexpr uint32_t kColorStride = 64;  // bytes
// The unit square as two triangles with the same winding.
constexpr float kCorners[6][2] = {{0, 0}, {1, 0}, {0, 1}, {0, 1}, {1, 0}, {1, 1}};

// One thread, so that what runs where is always the same.
TestContext context_with_one_thread() {
  setenv("LAPILLI_THREADS", "1", 1);
  TestContext context;
  unsetenv("LAPILLI_THREADS");
  return context;
}

}  // namespace

TestScene::TestScene(uint32_t w, uint32_t h, std::vector<std::array<float, 4>> colors)
    : context(context_with_one_thread()),
      device(make_object<Device>(HostMemory(), VK_SYSTEM_ALLOCATION_SCOPE_DEVICE, context.instance->physical_device)),
      width(w),
      height(h),
      color_bytes_(colors.size() * kColorStride) {
  const HostMemory host;
  for (size_t i = 0; i < colors.size(); ++i) std::memcpy(&color_bytes_[i * kColorStride], colors[i].data(), 16);
  corners_ = make_object<Buffer>(host, kScope);
  corners_->data = const_cast<std::byte*>(reinterpret_cast<const std::byte*>(kCorners));
  corners_->size = sizeof(kCorners);

  layout_ = make_object<PipelineLayout>(host, kScope);
  layout_->slots.push_back({0, 0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, VK_SHADER_STAGE_VERTEX_BIT, 0, 1, 0});
  layout_->push_constant_bytes = 32;
  layout_->set_count = layout_->dynamic_count[0] = layout_->dynamic_total = 1;
  auto set_layout = make_object<DescriptorSetLayout>(host, kScope);
  set_layout->descriptor_count = set_layout->dynamic_count = 1;
  descriptor_pool_ = make_object<DescriptorPool>(host, kScope);
  set_ = make_object<DescriptorSet>(host, kScope, *descriptor_pool_, *set_layout);
  set_->descriptors[0].data = color_bytes_.data();
  set_->descriptors[0].size = 16;
  set_->descriptors[0].room = color_bytes_.size();

  pass = make_object<RenderPass>(host, kScope);
  framebuffer = make_object<Framebuffer>(host, kScope);
  framebuffer->width = width;
  framebuffer->height = height;
  add_attachment(VK_FORMAT_R8G8B8A8_UNORM, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
  add_attachment(VK_FORMAT_D32_SFLOAT, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
  Subpass& subpass = pass->subpasses.emplace_back(pass->host);
  subpass.color.push_back(0);
  subpass.depth = 1;
  command_pool_ = make_object<CommandPool>(host, kScope);
  fence_ = make_object<Fence>(host, kScope);
}

void TestScene::add_attachment(VkFormat format, VkImageUsageFlags usage) {
  Attachment& attachment = attachments_.emplace_back();
  attachment.image = make_object<Image>(HostMemory(), kScope);
  Image& image = *attachment.image;
  image.layout = *make_layout(format, {width, height, 1, 1, 1, 1});
  image.usage = usage;
  attachment.texels.resize(image.layout.size);
  image.data = attachment.texels.data();
  attachment.view = make_object<ImageView>(HostMemory(), kScope);
  attachment.view->image = &image;
  attachment.view->format = find_format(format);
  attachment.view->range = {0, 0, 1, 0, 1};
  framebuffer->attachments.push_back(attachment.view.get());
  VkAttachmentDescription description = {};
  description.format = format;
  description.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  description.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  pass->attachments.push_back(description);
}

const Pipeline& TestScene::add_pipeline(VkCullModeFlags cull, VkColorComponentFlags color_mask) {
  const auto module_of = [](std::span<const uint32_t> words) {
    auto made = make_object<ShaderModule>(HostMemory(), kScope);
    made->spirv = *parse_spirv(words);
    return made;
  };
  const auto vertex = module_of(shaders::kRectangleVert), fragment = module_of(shaders::kRectangleFrag);
  VkPipelineShaderStageCreateInfo stages[2] = {};
  stages[0].stage = VK_SHADER_STAGE_VERTEX_BIT;
  stages[0].module = vertex->handle();
  stages[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
  stages[1].module = fragment->handle();
  stages[0].pName = stages[1].pName = "main";
  const VkVertexInputBindingDescription binding = {0, sizeof(kCorners[0]), VK_VERTEX_INPUT_RATE_VERTEX};
  const VkVertexInputAttributeDescription attribute = {0, 0, VK_FORMAT_R32G32_SFLOAT, 0};
  VkPipelineVertexInputStateCreateInfo input = {};
  input.vertexBindingDescriptionCount = input.vertexAttributeDescriptionCount = 1;
  input.pVertexBindingDescriptions = &binding;
  input.pVertexAttributeDescriptions = &attribute;
  VkPipelineInputAssemblyStateCreateInfo assembly = {};
  assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  const VkViewport all = {0, 0, static_cast<float>(width), static_cast<float>(height), 0, 1};
  const VkRect2D scissor = {{0, 0}, {width, height}};
  VkPipelineViewportStateCreateInfo viewport = {};
  viewport.viewportCount = viewport.scissorCount = 1;
  viewport.pViewports = &all;
  viewport.pScissors = &scissor;
  VkPipelineRasterizationStateCreateInfo raster = {};
  raster.cullMode = cull;
  raster.lineWidth = 1;
  VkPipelineMultisampleStateCreateInfo samples = {};
  samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
  VkPipelineDepthStencilStateCreateInfo depth = {};
  depth.depthTestEnable = depth.depthWriteEnable = VK_TRUE;
  depth.depthCompareOp = VK_COMPARE_OP_LESS;
  VkPipelineColorBlendAttachmentState mask = {};
  mask.colorWriteMask = color_mask;
  VkPipelineColorBlendStateCreateInfo blend = {};
  blend.attachmentCount = 1;
  blend.pAttachments = &mask;

  VkGraphicsPipelineCreateInfo info = {};
  info.stageCount = 2;
  info.pStages = stages;
  info.pVertexInputState = &input;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &viewport;
  info.pRasterizationState = &raster;
  info.pMultisampleState = &samples;
  info.pDepthStencilState = &depth;
  info.pColorBlendState = &blend;
  info.layout = layout_->handle();
  info.renderPass = pass->handle();
  VkPipeline handle = VK_NULL_HANDLE;
  EXPECT_EQ(create_graphics_pipelines(*device, {&info, 1}, nullptr, &handle), VK_SUCCESS);
  return *pipelines_.emplace_back(Pipeline::from(handle));
}

CommandBuffer& TestScene::add_commands() {
  VkCommandBufferAllocateInfo info = {};
  info.commandPool = command_pool_->handle();
  info.commandBufferCount = 1;
  VkCommandBuffer handle = VK_NULL_HANDLE;
  EXPECT_EQ(allocate_command_buffers(info, &handle), VK_SUCCESS);
  return *CommandBuffer::from(handle);
}

void TestScene::begin_pass(CommandBuffer& commands) {
  VkClearValue clear[2] = {};
  clear[1].depthStencil.depth = 1;
  VkRenderPassBeginInfo info = {};
  info.renderPass = pass->handle();
  info.framebuffer = framebuffer->handle();
  info.renderArea = {{0, 0}, {width, height}};
  info.clearValueCount = 2;
  info.pClearValues = clear;
  record_begin_render_pass(commands, info);
  const VkBuffer corners = corners_->handle();
  const VkDeviceSize offset = 0;
  record_bind_vertex_buffers(commands, 0, {&corners, 1}, &offset);
}

void TestScene::place(CommandBuffer& commands, float left, float top, float right, float bottom, float depth,
                      uint32_t color) {
  const float place[5] = {left, top, right - left, bottom - top, depth};
  record_push_constants(commands, 0, std::as_bytes(std::span(place)));
  const VkDescriptorSet set = set_->handle();
  const uint32_t offset = color * kColorStride;
  record_bind_descriptor_sets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, *layout_, 0, {&set, 1}, {&offset, 1});
}

void TestScene::draw(CommandBuffer& commands, float left, float top, float right, float bottom, float depth,
                     uint32_t color) {
  place(commands, left, top, right, bottom, depth, color);
  record_draw(commands, {6, 1, 0, 0});
}

void TestScene::submit(CommandBuffer& commands) {
  const VkCommandBuffer handle = commands.handle();
  const VkFence fence = fence_->handle();
  VkSubmitInfo info = {};
  info.commandBufferCount = 1;
  info.pCommandBuffers = &handle;
  ASSERT_EQ(device->queue->submit({&info, 1}, fence_.get()), VK_SUCCESS);
  ASSERT_EQ(wait_for_fences(*device, {&fence, 1}, true, UINT64_MAX), VK_SUCCESS);
  ASSERT_EQ(reset_fences(*device, {&fence, 1}), VK_SUCCESS);
}

const uint8_t* TestScene::pixel(uint32_t x, uint32_t y) const {
  const Image& image = *attachments_[0].image;
  return reinterpret_cast<const uint8_t*>(image.data) + y * image.layout.levels[0].row_pitch + size_t{x} * 4;
}

}  // namespace lapilli
