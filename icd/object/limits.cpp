// Limits of the device. Those of features that are not offered are the values that the specification gives for that
// case.
#include "object/limits.h"

#include "image/texture.h"
#include "shader/batch.h"
#include "shader/resources.h"

namespace lapilli {
namespace {

// Descriptors cost only their memory; these counts keep a set below a few megabytes.
constexpr uint32_t kMaxDescriptors = 4096;
constexpr uint32_t kMaxDynamicBuffers = 16;

void set_image_limits(VkPhysicalDeviceLimits& limits) {
  limits.maxImageDimension1D = kMaxImageDimension2D;
  limits.maxImageDimension2D = kMaxImageDimension2D;
  limits.maxImageDimension3D = kMaxImageDimension3D;
  limits.maxImageDimensionCube = kMaxImageDimension2D;
  limits.maxImageArrayLayers = kMaxImageLayers;
  limits.maxTexelBufferElements = kMaxTexelBufferElements;
  limits.bufferImageGranularity = 1;
  limits.sparseAddressSpaceSize = 0;
  limits.maxSamplerAllocationCount = kMaxSamplers;
  limits.maxSamplerLodBias = kMaxSamplerLodBias;
  limits.maxSamplerAnisotropy = 1.0f;
  limits.minTexelOffset = -8;
  limits.maxTexelOffset = 7;
  limits.minTexelGatherOffset = -8;
  limits.maxTexelGatherOffset = 7;
  limits.minInterpolationOffset = -0.5f;
  limits.maxInterpolationOffset = 0.5f;
  limits.subPixelInterpolationOffsetBits = 8;  // offsets are taken as they are
}

void set_descriptor_limits(VkPhysicalDeviceLimits& limits) {
  limits.maxUniformBufferRange = 1u << 30;
  limits.maxStorageBufferRange = 1u << 30;
  limits.maxPushConstantsSize = kMaxPushConstantBytes;
  limits.maxBoundDescriptorSets = kMaxDescriptorSets;
  limits.maxPerStageDescriptorSamplers = kMaxDescriptors;
  limits.maxPerStageDescriptorUniformBuffers = kMaxDescriptors;
  limits.maxPerStageDescriptorStorageBuffers = kMaxDescriptors;
  limits.maxPerStageDescriptorSampledImages = kMaxDescriptors;
  limits.maxPerStageDescriptorStorageImages = kMaxDescriptors;
  limits.maxPerStageDescriptorInputAttachments = kMaxColorAttachments;
  limits.maxPerStageResources = kMaxDescriptors * 4;
  limits.maxDescriptorSetSamplers = kMaxDescriptors;
  limits.maxDescriptorSetUniformBuffers = kMaxDescriptors;
  limits.maxDescriptorSetUniformBuffersDynamic = kMaxDynamicBuffers;
  limits.maxDescriptorSetStorageBuffers = kMaxDescriptors;
  limits.maxDescriptorSetStorageBuffersDynamic = kMaxDynamicBuffers;
  limits.maxDescriptorSetSampledImages = kMaxDescriptors;
  limits.maxDescriptorSetStorageImages = kMaxDescriptors;
  limits.maxDescriptorSetInputAttachments = kMaxColorAttachments;
  limits.minTexelBufferOffsetAlignment = 16;
  limits.minUniformBufferOffsetAlignment = 16;
  limits.minStorageBufferOffsetAlignment = 16;
}

void set_vertex_limits(VkPhysicalDeviceLimits& limits) {
  limits.maxVertexInputAttributes = kMaxVertexAttributes;
  limits.maxVertexInputBindings = kMaxVertexBindings;
  limits.maxVertexInputAttributeOffset = kMaxVertexStride - 1;
  limits.maxVertexInputBindingStride = kMaxVertexStride;
  limits.maxVertexOutputComponents = kMaxVaryingComponents;
  limits.maxDrawIndexedIndexValue = (1u << 24) - 1;  // fullDrawIndexUint32 is not offered
  limits.maxDrawIndirectCount = UINT32_MAX;
  limits.maxClipDistances = kMaxDistances;
  limits.maxCullDistances = kMaxDistances;
  limits.maxCombinedClipAndCullDistances = kMaxDistances;
}

void set_fragment_limits(VkPhysicalDeviceLimits& limits) {
  limits.maxFragmentInputComponents = kMaxVaryingComponents;
  limits.maxFragmentOutputAttachments = kMaxColorAttachments;
  limits.maxFragmentDualSrcAttachments = 0;  // dualSrcBlend is not offered
  limits.maxFragmentCombinedOutputResources = kMaxDescriptors * 2;
}

void set_compute_limits(VkPhysicalDeviceLimits& limits) {
  limits.maxComputeSharedMemorySize = kMaxSharedBytes;
  for (uint32_t& count : limits.maxComputeWorkGroupCount) count = kMaxWorkgroupCount;
  limits.maxComputeWorkGroupInvocations = kMaxWorkgroupInvocations;
  limits.maxComputeWorkGroupSize[0] = kMaxWorkgroupInvocations;
  limits.maxComputeWorkGroupSize[1] = kMaxWorkgroupInvocations;
  limits.maxComputeWorkGroupSize[2] = 64;
}

void set_raster_limits(VkPhysicalDeviceLimits& limits) {
  limits.subPixelPrecisionBits = 8;
  limits.subTexelPrecisionBits = 8;
  limits.mipmapPrecisionBits = 8;
  limits.maxViewports = 1;  // multiViewport is not offered
  limits.maxViewportDimensions[0] = kMaxImageDimension2D;
  limits.maxViewportDimensions[1] = kMaxImageDimension2D;
  limits.viewportBoundsRange[0] = -2.0f * static_cast<float>(kMaxImageDimension2D);
  limits.viewportBoundsRange[1] = 2.0f * static_cast<float>(kMaxImageDimension2D) - 1.0f;
  limits.viewportSubPixelBits = 8;
  limits.pointSizeRange[0] = limits.pointSizeRange[1] = 1.0f;  // largePoints is not offered
  limits.lineWidthRange[0] = limits.lineWidthRange[1] = 1.0f;  // wideLines is not offered
  limits.pointSizeGranularity = 0.0f;
  limits.lineWidthGranularity = 0.0f;
  limits.strictLines = VK_TRUE;
  limits.standardSampleLocations = VK_TRUE;
  limits.discreteQueuePriorities = 2;
}

void set_framebuffer_limits(VkPhysicalDeviceLimits& limits) {
  limits.maxFramebufferWidth = kMaxImageDimension2D;
  limits.maxFramebufferHeight = kMaxImageDimension2D;
  limits.maxFramebufferLayers = kMaxImageLayers;
  limits.maxColorAttachments = kMaxColorAttachments;
  limits.framebufferColorSampleCounts = VK_SAMPLE_COUNT_1_BIT;
  limits.framebufferDepthSampleCounts = VK_SAMPLE_COUNT_1_BIT;
  limits.framebufferStencilSampleCounts = VK_SAMPLE_COUNT_1_BIT;
  limits.framebufferNoAttachmentsSampleCounts = VK_SAMPLE_COUNT_1_BIT;
  limits.sampledImageColorSampleCounts = VK_SAMPLE_COUNT_1_BIT;
  limits.sampledImageIntegerSampleCounts = VK_SAMPLE_COUNT_1_BIT;
  limits.sampledImageDepthSampleCounts = VK_SAMPLE_COUNT_1_BIT;
  limits.sampledImageStencilSampleCounts = VK_SAMPLE_COUNT_1_BIT;
  limits.storageImageSampleCounts = VK_SAMPLE_COUNT_1_BIT;
  limits.maxSampleMaskWords = 1;
}

void set_memory_limits(VkPhysicalDeviceLimits& limits) {
  limits.maxMemoryAllocationCount = kMaxMemoryAllocations;
  limits.minMemoryMapAlignment = 4096;
  limits.optimalBufferCopyOffsetAlignment = 1;
  limits.optimalBufferCopyRowPitchAlignment = 1;
  limits.nonCoherentAtomSize = 64;
}

}  // namespace

VkPhysicalDeviceLimits device_limits() {
  VkPhysicalDeviceLimits limits = {};
  set_image_limits(limits);
  set_descriptor_limits(limits);
  set_vertex_limits(limits);
  set_fragment_limits(limits);
  set_compute_limits(limits);
  set_raster_limits(limits);
  set_framebuffer_limits(limits);
  set_memory_limits(limits);
  limits.timestampComputeAndGraphics = VK_TRUE;
  limits.timestampPeriod = 1.0f;  // nanoseconds a tick
  return limits;
}

}  // namespace lapilli
