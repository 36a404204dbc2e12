// The limits against the table "Required Limits" of the specification, transcribed for a device with the features that
// are offered.
#include "object/limits.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lapilli {
namespace {

const VkPhysicalDeviceLimits kLimits = device_limits();

struct AtLeast {
  const char* name;
  uint64_t value, minimum;
};
#define LIMIT(name, minimum) \
  AtLeast { #name, kLimits.name, minimum }

TEST(Limits, AreAtLeastWhatIsRequired) {
  const AtLeast table[] = {
      LIMIT(maxImageDimension1D, 4096),
      LIMIT(maxImageDimension2D, 4096),
      LIMIT(maxImageDimension3D, 256),
      LIMIT(maxImageDimensionCube, 4096),
      LIMIT(maxImageArrayLayers, 256),
      LIMIT(maxTexelBufferElements, 65536),
      LIMIT(maxUniformBufferRange, 16384),
      LIMIT(maxStorageBufferRange, 1u << 27),
      LIMIT(maxPushConstantsSize, 128),
      LIMIT(maxMemoryAllocationCount, 4096),
      LIMIT(maxSamplerAllocationCount, 4000),
      LIMIT(maxBoundDescriptorSets, 4),
      LIMIT(maxPerStageDescriptorSamplers, 16),
      LIMIT(maxPerStageDescriptorUniformBuffers, 12),
      LIMIT(maxPerStageDescriptorStorageBuffers, 4),
      LIMIT(maxPerStageDescriptorSampledImages, 16),
      LIMIT(maxPerStageDescriptorStorageImages, 4),
      LIMIT(maxPerStageDescriptorInputAttachments, 4),
      LIMIT(maxPerStageResources, 128),
      LIMIT(maxDescriptorSetSamplers, 96),
      LIMIT(maxDescriptorSetUniformBuffers, 72),
      LIMIT(maxDescriptorSetUniformBuffersDynamic, 8),
      LIMIT(maxDescriptorSetStorageBuffers, 24),
      LIMIT(maxDescriptorSetStorageBuffersDynamic, 4),
      LIMIT(maxDescriptorSetSampledImages, 96),
      LIMIT(maxDescriptorSetStorageImages, 24),
      LIMIT(maxDescriptorSetInputAttachments, 4),
      LIMIT(maxVertexInputAttributes, 16),
      LIMIT(maxVertexInputBindings, 16),
      LIMIT(maxVertexInputAttributeOffset, 2047),
      LIMIT(maxVertexInputBindingStride, 2048),
      LIMIT(maxVertexOutputComponents, 64),
      LIMIT(maxFragmentInputComponents, 64),
      LIMIT(maxFragmentOutputAttachments, 4),
      LIMIT(maxFragmentCombinedOutputResources, 4),
      LIMIT(maxComputeSharedMemorySize, 16384),
      LIMIT(maxComputeWorkGroupCount[0], 65535),
      LIMIT(maxComputeWorkGroupCount[1], 65535),
      LIMIT(maxComputeWorkGroupCount[2], 65535),
      LIMIT(maxComputeWorkGroupInvocations, 128),
      LIMIT(maxComputeWorkGroupSize[0], 128),
      LIMIT(maxComputeWorkGroupSize[1], 128),
      LIMIT(maxComputeWorkGroupSize[2], 64),
      LIMIT(subPixelPrecisionBits, 4),
      LIMIT(subTexelPrecisionBits, 4),
      LIMIT(mipmapPrecisionBits, 4),
      LIMIT(maxDrawIndexedIndexValue, (1u << 24) - 1),
      LIMIT(maxDrawIndirectCount, (1u << 16) - 1),  // with multiDrawIndirect
      LIMIT(maxClipDistances, 8),
      LIMIT(maxCullDistances, 8),
      LIMIT(maxCombinedClipAndCullDistances, 8),
      LIMIT(maxViewports, 1),
      LIMIT(maxViewportDimensions[0], 4096),
      LIMIT(maxViewportDimensions[1], 4096),
      LIMIT(minMemoryMapAlignment, 64),
      LIMIT(maxFramebufferWidth, 4096),
      LIMIT(maxFramebufferHeight, 4096),
      LIMIT(maxFramebufferLayers, 256),
      LIMIT(maxColorAttachments, 4),
      LIMIT(maxSampleMaskWords, 1),
      LIMIT(discreteQueuePriorities, 2),
  };
  for (const AtLeast& limit : table) EXPECT_GE(limit.value, limit.minimum) << limit.name;
}
#undef LIMIT

TEST(Limits, AlignmentsAreAtMostWhatIsAllowed) {
  EXPECT_LE(kLimits.minTexelBufferOffsetAlignment, 256u);
  EXPECT_LE(kLimits.minUniformBufferOffsetAlignment, 256u);
  EXPECT_LE(kLimits.minStorageBufferOffsetAlignment, 256u);
  EXPECT_LE(kLimits.bufferImageGranularity, 131072u);
  EXPECT_LE(kLimits.nonCoherentAtomSize, 256u);
}

TEST(Limits, RangesContainWhatIsRequired) {
  EXPECT_GE(kLimits.maxSamplerLodBias, 2.0f);
  EXPECT_GE(kLimits.maxSamplerAnisotropy, 1.0f);
  EXPECT_LE(kLimits.minTexelOffset, -8);
  EXPECT_GE(kLimits.maxTexelOffset, 7u);
  EXPECT_LE(kLimits.minTexelGatherOffset, -8);
  EXPECT_GE(kLimits.maxTexelGatherOffset, 7u);
  EXPECT_LE(kLimits.minInterpolationOffset, -0.5f);
  EXPECT_GE(kLimits.maxInterpolationOffset, 0.5f - std::ldexp(1.0f, -int(kLimits.subPixelInterpolationOffsetBits)));
  EXPECT_GE(kLimits.subPixelInterpolationOffsetBits, 4u);
  const float largest = static_cast<float>(kLimits.maxViewportDimensions[0]);
  EXPECT_LE(kLimits.viewportBoundsRange[0], -2 * largest);
  EXPECT_GE(kLimits.viewportBoundsRange[1], 2 * largest - 1);
  EXPECT_LE(kLimits.pointSizeRange[0], 1.0f);
  EXPECT_GE(kLimits.pointSizeRange[1], 1.0f);
  EXPECT_LE(kLimits.lineWidthRange[0], 1.0f);
  EXPECT_GE(kLimits.lineWidthRange[1], 1.0f);
}

// Departs from the table, which asks for 1 and 4: multisampling is not there yet, so that it is not offered either.
TEST(Limits, OfferOneSampleOnly) {
  EXPECT_EQ(kLimits.framebufferColorSampleCounts, VkSampleCountFlags{VK_SAMPLE_COUNT_1_BIT});
  EXPECT_EQ(kLimits.framebufferDepthSampleCounts, VkSampleCountFlags{VK_SAMPLE_COUNT_1_BIT});
}

}  // namespace
}  // namespace lapilli
