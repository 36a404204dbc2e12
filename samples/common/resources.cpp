// Buffers, images, samplers and descriptor sets of the samples. Specification: Resource Creation; Memory Allocation.
#include "common/resources.h"

#include <cstring>

#include "common/barriers.h"

namespace lapilli::samples {
namespace {

DeviceMemory allocate(const Context& context, const VkMemoryRequirements& needs, VkMemoryPropertyFlags flags) {
  VkMemoryAllocateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  info.allocationSize = needs.size;
  info.memoryTypeIndex = context.memory_type(needs.memoryTypeBits, flags);
  VkDeviceMemory memory = VK_NULL_HANDLE;
  check(vkAllocateMemory(context.device(), &info, nullptr, &memory), "vkAllocateMemory");
  return {context.device(), memory};
}

VkDescriptorType type_of(const Binding& binding) {
  const auto* buffer = std::get_if<BufferBinding>(&binding);
  return buffer != nullptr ? buffer->type : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
}

VkShaderStageFlags stages_of(const Binding& binding) {
  return std::visit([](const auto& either) { return either.stages; }, binding);
}

}  // namespace

Buffer::Buffer(const Context& context, VkDeviceSize size, VkBufferUsageFlags usage) : size_(size) {
  VkBufferCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = size;
  info.usage = usage;
  info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
  VkBuffer buffer = VK_NULL_HANDLE;
  check(vkCreateBuffer(context.device(), &info, nullptr, &buffer), "vkCreateBuffer");
  buffer_ = RawBuffer(context.device(), buffer);

  VkMemoryRequirements needs = {};
  vkGetBufferMemoryRequirements(context.device(), buffer, &needs);
  memory_ = allocate(context, needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  check(vkBindBufferMemory(context.device(), buffer, memory_.get(), 0), "vkBindBufferMemory");
  check(vkMapMemory(context.device(), memory_.get(), 0, VK_WHOLE_SIZE, 0, &data_), "vkMapMemory");
}

void Buffer::write(std::span<const std::byte> bytes) {
  if (bytes.size() > size_) throw std::runtime_error("a buffer is smaller than what is written to it");
  std::memcpy(data_, bytes.data(), bytes.size());
}

VkImageAspectFlags aspect_of(VkFormat format) {
  return format == VK_FORMAT_D32_SFLOAT ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

Image::Image(const Context& context, VkExtent2D extent, VkFormat format, VkImageUsageFlags usage,
             const ImageShape& shape)
    : extent_(extent) {
  VkImageCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = format;
  info.extent = {extent.width, extent.height, 1};
  info.mipLevels = shape.mip_levels;
  info.arrayLayers = 1;
  info.samples = shape.samples;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = usage;
  info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
  info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  VkImage image = VK_NULL_HANDLE;
  check(vkCreateImage(context.device(), &info, nullptr, &image), "vkCreateImage");
  image_ = RawImage(context.device(), image);

  VkMemoryRequirements needs = {};
  vkGetImageMemoryRequirements(context.device(), image, &needs);
  memory_ = allocate(context, needs, 0);
  check(vkBindImageMemory(context.device(), image, memory_.get(), 0), "vkBindImageMemory");

  VkImageViewCreateInfo view = {};
  view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
  view.image = image;
  view.viewType = VK_IMAGE_VIEW_TYPE_2D;
  view.format = format;
  view.subresourceRange = {aspect_of(format), 0, shape.mip_levels, 0, 1};
  VkImageView raw_view = VK_NULL_HANDLE;
  check(vkCreateImageView(context.device(), &view, nullptr, &raw_view), "vkCreateImageView");
  view_ = ImageView(context.device(), raw_view);
}

Image upload_texture(const Context& context, VkExtent2D extent, std::span<const std::byte> texels) {
  const Buffer staging(context, texels, VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
  Image image(context, extent, VK_FORMAT_R8G8B8A8_UNORM, VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT);

  VkCommandBuffer commands = context.begin_commands();
  change_layout(commands, image.get(), VK_IMAGE_ASPECT_COLOR_BIT,
                {VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, 0},
                {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT});
  VkBufferImageCopy region = {};
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.imageExtent = {extent.width, extent.height, 1};
  vkCmdCopyBufferToImage(commands, staging.get(), image.get(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
  change_layout(
      commands, image.get(), VK_IMAGE_ASPECT_COLOR_BIT,
      {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT},
      {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT});
  context.submit_and_wait(commands);
  return image;
}

Sampler create_sampler(const Context& context, VkFilter filter, VkSamplerAddressMode address_mode) {
  VkSamplerCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
  info.magFilter = filter;
  info.minFilter = filter;
  info.mipmapMode = VK_SAMPLER_MIPMAP_MODE_NEAREST;
  info.addressModeU = address_mode;
  info.addressModeV = address_mode;
  info.addressModeW = address_mode;
  VkSampler sampler = VK_NULL_HANDLE;
  check(vkCreateSampler(context.device(), &info, nullptr, &sampler), "vkCreateSampler");
  return {context.device(), sampler};
}

DescriptorSet::DescriptorSet(const Context& context, std::span<const Binding> bindings) {
  std::vector<VkDescriptorSetLayoutBinding> slots;
  std::vector<VkDescriptorPoolSize> sizes;
  for (const Binding& binding : bindings) {
    VkDescriptorSetLayoutBinding slot = {};
    slot.binding = static_cast<uint32_t>(slots.size());
    slot.descriptorType = type_of(binding);
    slot.descriptorCount = 1;
    slot.stageFlags = stages_of(binding);
    slots.push_back(slot);
    sizes.push_back({type_of(binding), 1});
  }

  VkDescriptorSetLayoutCreateInfo layout = {};
  layout.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  layout.bindingCount = static_cast<uint32_t>(slots.size());
  layout.pBindings = slots.data();
  VkDescriptorSetLayout raw_layout = VK_NULL_HANDLE;
  check(vkCreateDescriptorSetLayout(context.device(), &layout, nullptr, &raw_layout), "vkCreateDescriptorSetLayout");
  layout_ = DescriptorSetLayout(context.device(), raw_layout);

  VkDescriptorPoolCreateInfo pool = {};
  pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  pool.maxSets = 1;
  pool.poolSizeCount = static_cast<uint32_t>(sizes.size());
  pool.pPoolSizes = sizes.data();
  VkDescriptorPool raw_pool = VK_NULL_HANDLE;
  check(vkCreateDescriptorPool(context.device(), &pool, nullptr, &raw_pool), "vkCreateDescriptorPool");
  pool_ = DescriptorPool(context.device(), raw_pool);

  VkDescriptorSetAllocateInfo allocate = {};
  allocate.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  allocate.descriptorPool = raw_pool;
  allocate.descriptorSetCount = 1;
  allocate.pSetLayouts = &raw_layout;
  check(vkAllocateDescriptorSets(context.device(), &allocate, &set_), "vkAllocateDescriptorSets");

  for (uint32_t slot = 0; slot < bindings.size(); ++slot) {
    VkDescriptorBufferInfo buffer_info = {};
    VkDescriptorImageInfo image_info = {};
    if (const auto* buffer = std::get_if<BufferBinding>(&bindings[slot])) {
      buffer_info = {buffer->buffer->get(), 0, VK_WHOLE_SIZE};
    } else {
      const auto& image = std::get<ImageBinding>(bindings[slot]);
      image_info = {image.sampler->get(), image.image->view(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    }
    VkWriteDescriptorSet write = {};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set_;
    write.dstBinding = slot;
    write.descriptorCount = 1;
    write.descriptorType = type_of(bindings[slot]);
    write.pBufferInfo = &buffer_info;
    write.pImageInfo = &image_info;
    vkUpdateDescriptorSets(context.device(), 1, &write, 0, nullptr);
  }
}

}  // namespace lapilli::samples
