// Descriptor sets of any shape: layouts, a pool and writes in one place.
#pragma once

#include <span>
#include <vector>

#include "common/resources.h"

namespace lapilli::conformance {

struct DescriptorSlot {
  uint32_t binding;  // the same several times: an array
  VkDescriptorType type;
  VkDescriptorBufferInfo buffer = {};
  VkDescriptorImageInfo image = {};
  VkBufferView view = VK_NULL_HANDLE;
  uint32_t element = 0;  // of the array; in order
  bool written = true;
};

// One set; all stages see it.
class Descriptors {
 public:
  Descriptors(const samples::Context& context, std::span<const DescriptorSlot> slots);
  VkDescriptorSet get() const { return set_; }
  VkDescriptorSetLayout layout() const { return layout_.get(); }
  void write(const DescriptorSlot& slot) const;

 private:
  const samples::Context& context_;
  samples::DescriptorSetLayout layout_;
  samples::DescriptorPool pool_;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
};

}  // namespace lapilli::conformance
