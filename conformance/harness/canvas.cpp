// Render target of the tests: see canvas.h.
#include "harness/canvas.h"

#include <array>

namespace lapilli::conformance {
namespace {

constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;

VkAttachmentDescription attachment(VkFormat format, const CanvasOptions& options) {
  VkAttachmentDescription a = {};
  a.format = format;
  a.samples = VK_SAMPLE_COUNT_1_BIT;
  a.loadOp = options.load;
  a.storeOp = options.store;
  a.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  a.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  // Loading needs the contents, which read() leaves as a source of copies.
  a.initialLayout =
      options.load == VK_ATTACHMENT_LOAD_OP_LOAD ? VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL : VK_IMAGE_LAYOUT_UNDEFINED;
  a.finalLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
  return a;
}

}  // namespace

uint32_t texel_bytes(VkFormat format) {
  switch (format) {
    case VK_FORMAT_R32G32B32A32_SFLOAT:
      return 16;
    case VK_FORMAT_R32G32_SFLOAT:
      return 8;
    default:
      return 4;
  }
}

Canvas::Canvas(const samples::Context& context, const CanvasOptions& options) : context_(context), options_(options) {
  const VkExtent2D extent = {options.width, options.height};
  constexpr VkImageUsageFlags kCopies = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  if (options.color) {
    color_ = samples::Image(context, extent, options.color_format,
                            VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | kCopies | options.extra_usage);
  }
  if (options.depth) {
    depth_ = samples::Image(context, extent, kDepthFormat, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | kCopies);
  }
  create_render_pass();
  std::vector<VkImageView> views;
  if (options.color) views.push_back(color_.view());
  if (options.depth) views.push_back(depth_.view());
  VkFramebufferCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
  info.renderPass = render_pass_.get();
  info.attachmentCount = uint32_t(views.size());
  info.pAttachments = views.data();
  info.width = options.width;
  info.height = options.height;
  info.layers = 1;
  VkFramebuffer framebuffer = VK_NULL_HANDLE;
  samples::check(vkCreateFramebuffer(context.device(), &info, nullptr, &framebuffer), "vkCreateFramebuffer");
  framebuffer_ = samples::Framebuffer(context.device(), framebuffer);
}

void Canvas::create_render_pass() {
  std::vector<VkAttachmentDescription> attachments;
  if (options_.color) {
    attachments.push_back(attachment(options_.color_format, options_));
  }
  if (options_.depth) {
    attachments.push_back(attachment(kDepthFormat, options_));
  }
  const VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  const VkAttachmentReference depth = {options_.color ? 1u : 0u, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
  VkSubpassDescription subpass = {};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = options_.color ? 1 : 0;
  subpass.pColorAttachments = &color;
  subpass.pDepthStencilAttachment = options_.depth ? &depth : nullptr;

  constexpr VkPipelineStageFlags kEverything = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
  constexpr VkPipelineStageFlags kGraphics = VK_PIPELINE_STAGE_ALL_GRAPHICS_BIT;
  constexpr VkAccessFlags kAllAccess = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
  constexpr VkPipelineStageFlags kVertices = VK_PIPELINE_STAGE_VERTEX_SHADER_BIT;
  constexpr VkAccessFlags kStores = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT;
  const std::array<VkSubpassDependency, 3> dependencies = {
      {{VK_SUBPASS_EXTERNAL, 0, kEverything, kGraphics, kAllAccess, kAllAccess, 0},
       {0, 0, kVertices, kVertices, kStores, kStores, 0},
       {0, VK_SUBPASS_EXTERNAL, kGraphics, kEverything, kAllAccess, kAllAccess, 0}}};
  VkRenderPassCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
  info.attachmentCount = uint32_t(attachments.size());
  info.pAttachments = attachments.data();
  info.subpassCount = 1;
  info.pSubpasses = &subpass;
  info.dependencyCount = uint32_t(dependencies.size());
  info.pDependencies = dependencies.data();
  VkRenderPass render_pass = VK_NULL_HANDLE;
  samples::check(vkCreateRenderPass(context_.device(), &info, nullptr, &render_pass), "vkCreateRenderPass");
  render_pass_ = samples::RenderPass(context_.device(), render_pass);
}

void Canvas::begin(VkCommandBuffer commands, const VkClearColorValue& clear, float clear_depth,
                   std::optional<VkRect2D> area) const {
  std::vector<VkClearValue> values;
  if (options_.color) values.emplace_back().color = clear;
  if (options_.depth) values.emplace_back().depthStencil = {clear_depth, 0};
  const VkRect2D everything = {{0, 0}, {options_.width, options_.height}};
  VkRenderPassBeginInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
  info.renderPass = render_pass_.get();
  info.framebuffer = framebuffer_.get();
  info.renderArea = area.value_or(everything);
  info.clearValueCount = uint32_t(values.size());
  info.pClearValues = values.data();
  vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
  const VkViewport viewport = {0, 0, float(options_.width), float(options_.height), 0, 1};
  vkCmdSetViewport(commands, 0, 1, &viewport);
  vkCmdSetScissor(commands, 0, 1, &everything);
}

std::vector<std::byte> Canvas::read(const samples::Image& image, VkImageAspectFlags aspect,
                                    uint32_t bytes_per_texel) const {
  const VkDeviceSize size = VkDeviceSize{options_.width} * options_.height * bytes_per_texel;
  const samples::Buffer buffer(context_, size, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  VkCommandBuffer commands = context_.begin_commands();
  VkBufferImageCopy region = {};
  region.imageSubresource = {aspect, 0, 0, 1};
  region.imageExtent = {options_.width, options_.height, 1};
  vkCmdCopyImageToBuffer(commands, image.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer.get(), 1, &region);
  VkMemoryBarrier for_host = {};
  for_host.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  for_host.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  for_host.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &for_host, 0,
                       nullptr, 0, nullptr);
  context_.submit_and_wait(commands);
  std::vector<std::byte> out(size);
  std::memcpy(out.data(), buffer.data(), size);
  return out;
}

std::vector<std::byte> Canvas::read_color_bytes() const {
  return read(color_, VK_IMAGE_ASPECT_COLOR_BIT, texel_bytes(options_.color_format));
}

std::vector<float> Canvas::read_depth() const {
  const std::vector<std::byte> bytes = read(depth_, VK_IMAGE_ASPECT_DEPTH_BIT, 4);
  std::vector<float> out(bytes.size() / 4);
  std::memcpy(out.data(), bytes.data(), bytes.size());
  return out;
}

}  // namespace lapilli::conformance
