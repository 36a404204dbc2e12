// vkUpdateDescriptorSets: from the application's structures to descriptors.
#include <algorithm>

#include "object/buffer.h"
#include "object/descriptor_set.h"
#include "object/image.h"

namespace lapilli {
namespace {

void write_buffer(Descriptor& descriptor, const VkDescriptorBufferInfo& info) {
  descriptor = {};
  Buffer* buffer = Buffer::from(info.buffer);
  if (buffer == nullptr) return;
  const BufferMemory all = buffer->bytes(info.offset);
  descriptor.data = all.data;
  descriptor.size = std::min(info.range, all.size);
  descriptor.room = all.size;
}

const TextureView* texture_of(VkImageView view) {
  const ImageView* object = ImageView::from(view);
  return object != nullptr ? &object->texture : nullptr;
}

// The handle is ignored, and may be garbage, where the sampler is immutable.
void write_sampler(Descriptor& descriptor, VkSampler sampler, bool immutable) {
  if (immutable) return;
  const Sampler* object = Sampler::from(sampler);
  descriptor.sampler = object != nullptr ? &object->state : nullptr;
}

void write_one(Descriptor& descriptor, const VkWriteDescriptorSet& write, uint32_t i, bool immutable) {
  switch (write.descriptorType) {
    case VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER:
    case VK_DESCRIPTOR_TYPE_STORAGE_BUFFER:
    case VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC:
    case VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC:
      write_buffer(descriptor, write.pBufferInfo[i]);
      break;
    case VK_DESCRIPTOR_TYPE_SAMPLER:
      write_sampler(descriptor, write.pImageInfo[i].sampler, immutable);
      break;
    case VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER:
      descriptor.texture = texture_of(write.pImageInfo[i].imageView);
      write_sampler(descriptor, write.pImageInfo[i].sampler, immutable);
      break;
    case VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE:
    case VK_DESCRIPTOR_TYPE_STORAGE_IMAGE:
    case VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT:
      descriptor.texture = texture_of(write.pImageInfo[i].imageView);
      break;
    case VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER:
    case VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER: {
      const BufferView* view = BufferView::from(write.pTexelBufferView[i]);
      descriptor.texture = view != nullptr ? &view->texture : nullptr;
      break;
    }
    default:
      break;
  }
}

}  // namespace

const LayoutBinding* DescriptorSet::find(uint32_t binding) const {
  const auto at = std::lower_bound(bindings.begin(), bindings.end(), binding,
                                   [](const LayoutBinding& a, uint32_t number) { return a.binding < number; });
  return at != bindings.end() && at->binding == binding ? &*at : nullptr;
}

// An update runs on into the following bindings: in a set they follow each other without a gap.
void write_descriptors(const VkWriteDescriptorSet& write) {
  DescriptorSet& set = *DescriptorSet::from(write.dstSet);
  const LayoutBinding* binding = set.find(write.dstBinding);
  if (binding == nullptr) return;
  const size_t first = size_t{binding->first} + write.dstArrayElement;
  for (uint32_t i = 0; i < write.descriptorCount && first + i < set.descriptors.size(); ++i) {
    const bool immutable = !set.immutable_samplers.empty() && set.immutable_samplers[first + i] != nullptr;
    write_one(set.descriptors[first + i], write, i, immutable);
  }
}

void copy_descriptors(const VkCopyDescriptorSet& copy) {
  const DescriptorSet& source = *DescriptorSet::from(copy.srcSet);
  DescriptorSet& target = *DescriptorSet::from(copy.dstSet);
  const LayoutBinding* from = source.find(copy.srcBinding);
  const LayoutBinding* to = target.find(copy.dstBinding);
  if (from == nullptr || to == nullptr) return;
  const size_t first_source = size_t{from->first} + copy.srcArrayElement;
  const size_t first_target = size_t{to->first} + copy.dstArrayElement;
  for (uint32_t i = 0; i < copy.descriptorCount; ++i) {
    if (first_source + i >= source.descriptors.size() || first_target + i >= target.descriptors.size()) return;
    Descriptor& descriptor = target.descriptors[first_target + i];
    descriptor = source.descriptors[first_source + i];
    if (!target.immutable_samplers.empty() && target.immutable_samplers[first_target + i] != nullptr) {
      descriptor.sampler = target.immutable_samplers[first_target + i];
    }
  }
}

}  // namespace lapilli
