// Descriptor set layouts, pools, updates and copies.
#include <gtest/gtest.h>

#include <array>

#include "object/buffer.h"
#include "object/descriptor_set.h"
#include "object/test_context.h"

namespace lapilli {
namespace {

class Descriptors : public testing::Test {
 protected:
  TestContext context;
  DeviceContext& device = *context.device;
  std::array<std::byte, 256> bytes{};
  ObjectPtr<Buffer> buffer = make_object<Buffer>(HostMemory(), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  ObjectPtr<Sampler> samplers[2] = {make_object<Sampler>(HostMemory(), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT),
                                    make_object<Sampler>(HostMemory(), VK_SYSTEM_ALLOCATION_SCOPE_OBJECT)};

  void SetUp() override {
    buffer->data = bytes.data();
    buffer->size = bytes.size();
  }
  ObjectPtr<DescriptorSetLayout> layout(std::span<const VkDescriptorSetLayoutBinding> bindings) {
    VkDescriptorSetLayoutCreateInfo info = {};
    info.bindingCount = static_cast<uint32_t>(bindings.size());
    info.pBindings = bindings.data();
    VkDescriptorSetLayout handle = VK_NULL_HANDLE;
    EXPECT_EQ(create_descriptor_set_layout(device, info, nullptr, &handle), VK_SUCCESS);
    return ObjectPtr<DescriptorSetLayout>(DescriptorSetLayout::from(handle));
  }
  ObjectPtr<DescriptorPool> pool(uint32_t sets, uint32_t of_each_type) {
    std::array<VkDescriptorPoolSize, kDescriptorTypes> sizes;
    for (uint32_t i = 0; i < kDescriptorTypes; ++i) sizes[i] = {static_cast<VkDescriptorType>(i), of_each_type};
    VkDescriptorPoolCreateInfo info = {};
    info.maxSets = sets;
    info.poolSizeCount = kDescriptorTypes;
    info.pPoolSizes = sizes.data();
    VkDescriptorPool handle = VK_NULL_HANDLE;
    EXPECT_EQ(create_descriptor_pool(device, info, nullptr, &handle), VK_SUCCESS);
    return ObjectPtr<DescriptorPool>(DescriptorPool::from(handle));
  }
  static VkResult allocate(DescriptorPool& from, DescriptorSetLayout& of, DescriptorSet** set) {
    VkDescriptorSetLayout layout_handle = of.handle();
    VkDescriptorSetAllocateInfo info = {};
    info.descriptorPool = from.handle();
    info.descriptorSetCount = 1;
    info.pSetLayouts = &layout_handle;
    VkDescriptorSet handle = VK_NULL_HANDLE;
    const VkResult result = allocate_descriptor_sets(info, &handle);
    *set = DescriptorSet::from(handle);
    return result;
  }
};

constexpr VkDescriptorType kUniform = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
constexpr VkDescriptorType kDynamic = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC;
constexpr VkDescriptorType kCombined = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;

TEST_F(Descriptors, LieInOrderOfTheirBindingNumbers) {
  const VkDescriptorSetLayoutBinding bindings[] = {
      {7, kDynamic, 2, VK_SHADER_STAGE_ALL, nullptr},
      {0, kUniform, 3, VK_SHADER_STAGE_ALL, nullptr},
      {3, kDynamic, 1, VK_SHADER_STAGE_ALL, nullptr},
  };
  const auto set_layout = layout(bindings);
  EXPECT_EQ(set_layout->descriptor_count, 6u);
  EXPECT_EQ(set_layout->dynamic_count, 3u);
  EXPECT_EQ(set_layout->find(0)->first, 0u);
  EXPECT_EQ(set_layout->find(3)->first, 3u);
  EXPECT_EQ(set_layout->find(7)->first, 4u);
  EXPECT_EQ(set_layout->find(3)->first_dynamic, 0u);
  EXPECT_EQ(set_layout->find(7)->first_dynamic, 1u);
  EXPECT_EQ(set_layout->find(1), nullptr);
}

TEST_F(Descriptors, CountsThatWouldOverflowAreRefused) {
  const VkDescriptorSetLayoutBinding bindings[] = {{0, kUniform, 1u << 31, VK_SHADER_STAGE_ALL, nullptr},
                                                   {1, kUniform, 1u << 31, VK_SHADER_STAGE_ALL, nullptr}};
  VkDescriptorSetLayoutCreateInfo info = {};
  info.bindingCount = 2;
  info.pBindings = bindings;
  VkDescriptorSetLayout handle = VK_NULL_HANDLE;
  EXPECT_EQ(create_descriptor_set_layout(device, info, nullptr, &handle), VK_ERROR_OUT_OF_HOST_MEMORY);
}

TEST_F(Descriptors, DynamicOffsetsAreCountedThroughTheSetsOfAPipelineLayout) {
  const VkDescriptorSetLayoutBinding bindings[] = {{0, kDynamic, 2, VK_SHADER_STAGE_ALL, nullptr},
                                                   {1, kUniform, 1, VK_SHADER_STAGE_ALL, nullptr}};
  const auto set_layout = layout(bindings);
  const VkDescriptorSetLayout sets[] = {set_layout->handle(), set_layout->handle()};
  const VkPushConstantRange range = {VK_SHADER_STAGE_ALL, 16, 32};
  VkPipelineLayoutCreateInfo info = {};
  info.setLayoutCount = 2;
  info.pSetLayouts = sets;
  info.pushConstantRangeCount = 1;
  info.pPushConstantRanges = &range;
  VkPipelineLayout handle = VK_NULL_HANDLE;
  ASSERT_EQ(create_pipeline_layout(device, info, nullptr, &handle), VK_SUCCESS);
  const ObjectPtr<PipelineLayout> made(PipelineLayout::from(handle));
  EXPECT_EQ(made->push_constant_bytes, 48u);
  ASSERT_EQ(made->slots.size(), 4u);
  EXPECT_EQ(made->slots[0].dynamic_offset, 0);
  EXPECT_EQ(made->slots[1].dynamic_offset, -1);
  EXPECT_EQ(made->slots[2].set, 1u);
  EXPECT_EQ(made->slots[2].dynamic_offset, 2);
  EXPECT_EQ(made->dynamic_total, 4u);
}

TEST_F(Descriptors, AnUpdateRunsOnIntoTheNextBinding) {
  const VkDescriptorSetLayoutBinding bindings[] = {{0, kUniform, 2, VK_SHADER_STAGE_ALL, nullptr},
                                                   {4, kUniform, 2, VK_SHADER_STAGE_ALL, nullptr}};
  const auto set_layout = layout(bindings);
  const auto sets = pool(1, 4);
  DescriptorSet* set = nullptr;
  ASSERT_EQ(allocate(*sets, *set_layout, &set), VK_SUCCESS);
  const VkDescriptorBufferInfo buffers[] = {{buffer->handle(), 16, 32}, {buffer->handle(), 64, VK_WHOLE_SIZE}};
  VkWriteDescriptorSet write = {};
  write.dstSet = set->handle();
  write.dstBinding = 0;
  write.dstArrayElement = 1;
  write.descriptorCount = 2;
  write.descriptorType = kUniform;
  write.pBufferInfo = buffers;
  write_descriptors(write);
  EXPECT_EQ(set->descriptors[0].data, nullptr);
  EXPECT_EQ(set->descriptors[1].data, bytes.data() + 16);
  EXPECT_EQ(set->descriptors[1].size, 32u);
  EXPECT_EQ(set->descriptors[1].room, 240u);
  EXPECT_EQ(set->descriptors[2].data, bytes.data() + 64);
  EXPECT_EQ(set->descriptors[2].size, 192u);
  EXPECT_EQ(set->descriptors[3].data, nullptr);
}

TEST_F(Descriptors, UpdatesOutsideOfTheSetWriteNothingThere) {
  const VkDescriptorSetLayoutBinding bindings[] = {{0, kUniform, 1, VK_SHADER_STAGE_ALL, nullptr}};
  const auto set_layout = layout(bindings);
  const auto sets = pool(1, 1);
  DescriptorSet* set = nullptr;
  ASSERT_EQ(allocate(*sets, *set_layout, &set), VK_SUCCESS);
  const VkDescriptorBufferInfo buffers[2] = {{buffer->handle(), 0, 4}, {buffer->handle(), 4, 4}};
  VkWriteDescriptorSet write = {};
  write.dstSet = set->handle();
  write.descriptorCount = 2;
  write.descriptorType = kUniform;
  write.pBufferInfo = buffers;
  write_descriptors(write);  // asan would see a write behind the only descriptor
  EXPECT_EQ(set->descriptors[0].size, 4u);
  write.dstBinding = 9;
  write_descriptors(write);
  EXPECT_EQ(set->descriptors[0].size, 4u);
}

TEST_F(Descriptors, ImmutableSamplersAreThereFromTheStartAndStay) {
  const VkSampler immutable[] = {samplers[0]->handle()};
  const VkDescriptorSetLayoutBinding bindings[] = {{0, kCombined, 1, VK_SHADER_STAGE_ALL, immutable},
                                                   {1, kCombined, 1, VK_SHADER_STAGE_ALL, nullptr}};
  const auto set_layout = layout(bindings);
  const auto sets = pool(1, 2);
  DescriptorSet* set = nullptr;
  ASSERT_EQ(allocate(*sets, *set_layout, &set), VK_SUCCESS);
  EXPECT_EQ(set->descriptors[0].sampler, &samplers[0]->state);
  EXPECT_EQ(set->descriptors[1].sampler, nullptr);
  const VkDescriptorImageInfo images[] = {{samplers[1]->handle(), VK_NULL_HANDLE, VK_IMAGE_LAYOUT_GENERAL},
                                          {samplers[1]->handle(), VK_NULL_HANDLE, VK_IMAGE_LAYOUT_GENERAL}};
  VkWriteDescriptorSet write = {};
  write.dstSet = set->handle();
  write.descriptorCount = 2;
  write.descriptorType = kCombined;
  write.pImageInfo = images;
  write_descriptors(write);
  EXPECT_EQ(set->descriptors[0].sampler, &samplers[0]->state);
  EXPECT_EQ(set->descriptors[1].sampler, &samplers[1]->state);

  VkCopyDescriptorSet copy = {};
  copy.srcSet = set->handle();
  copy.srcBinding = 1;
  copy.dstSet = set->handle();
  copy.dstBinding = 0;
  copy.descriptorCount = 1;
  copy_descriptors(copy);
  EXPECT_EQ(set->descriptors[0].sampler, &samplers[0]->state);
}

TEST_F(Descriptors, APoolGivesWhatItHasAndTakesItBack) {
  const VkDescriptorSetLayoutBinding bindings[] = {{0, kUniform, 2, VK_SHADER_STAGE_ALL, nullptr}};
  const auto set_layout = layout(bindings);
  const auto sets = pool(3, 4);
  DescriptorSet *first = nullptr, *second = nullptr, *third = nullptr;
  EXPECT_EQ(allocate(*sets, *set_layout, &first), VK_SUCCESS);
  EXPECT_EQ(allocate(*sets, *set_layout, &second), VK_SUCCESS);
  EXPECT_EQ(allocate(*sets, *set_layout, &third), VK_ERROR_OUT_OF_POOL_MEMORY);  // descriptors
  EXPECT_EQ(third, nullptr);
  sets->free(*first);
  EXPECT_EQ(allocate(*sets, *set_layout, &third), VK_SUCCESS);
  sets->free_all();
  EXPECT_EQ(sets->first, nullptr);
  EXPECT_EQ(sets->free_sets, 3u);
  EXPECT_EQ(sets->free_descriptors[kUniform], 4u);
}

TEST_F(Descriptors, SetsThatDoNotAllFitAreNoneAtAll) {
  const VkDescriptorSetLayoutBinding bindings[] = {{0, kUniform, 1, VK_SHADER_STAGE_ALL, nullptr}};
  const auto set_layout = layout(bindings);
  const auto sets = pool(2, 8);
  const VkDescriptorSetLayout layouts[] = {set_layout->handle(), set_layout->handle(), set_layout->handle()};
  VkDescriptorSetAllocateInfo info = {};
  info.descriptorPool = sets->handle();
  info.descriptorSetCount = 3;
  info.pSetLayouts = layouts;
  VkDescriptorSet handles[3];
  EXPECT_EQ(allocate_descriptor_sets(info, handles), VK_ERROR_OUT_OF_POOL_MEMORY);
  for (VkDescriptorSet handle : handles) EXPECT_EQ(handle, VkDescriptorSet{VK_NULL_HANDLE});
  EXPECT_EQ(sets->free_sets, 2u);
}

}  // namespace
}  // namespace lapilli
