// vkCmdBlitImage: the source is sampled 64 texels at a time, and packed into the target's format.
// Specification: chapter "Copy Commands", section "Image Copies With Scaling".
#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/log.h"
#include "image/sampling.h"
#include "image/texel.h"
#include "queue/command_executor.h"

namespace lapilli {
namespace {

constexpr uint32_t kLanes = 64;

// One direction of a region: the source coordinate of target texel t is (t + 0.5 - target_begin) * scale +
// source_begin.
struct Axis {
  double source_begin = 0, scale = 0;
  int32_t target_begin = 0;
  int32_t first = 0, end = 0;  // target texels

  Axis(int32_t source0, int32_t source1, int32_t target0, int32_t target1)
      : source_begin(source0),
        scale(static_cast<double>(int64_t{source1} - source0) / static_cast<double>(int64_t{target1} - target0)),
        target_begin(target0),
        first(std::min(target0, target1)),
        end(std::max(target0, target1)) {}
  float source(int32_t target) const {
    return static_cast<float>((target + 0.5 - target_begin) * scale + source_begin);
  }
};

// One layer of one region.
struct Blit {
  TextureView source;
  SamplerState sampler;
  const FormatInfo* format;  // of the target
  std::byte* target;         // texel (0, 0)
  uint64_t row_pitch;        // bytes
  Axis x, y;

  void row(int32_t line) const;
};

void Blit::row(int32_t line) const {
  static constexpr uint16_t kQuads[kLanes / 4] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  alignas(64) float u[kLanes], v[kLanes], rgba[4][kLanes];
  alignas(64) std::byte packed[kLanes * 16];
  const SamplingFunctions& sampling = sampling_functions();
  const TexelFunctions& texels = texel_functions(*format);
  std::fill_n(v, kLanes, y.source(line));
  for (int32_t first = x.first; first < x.end; first += int32_t{kLanes}) {
    const auto count = std::min<uint32_t>(static_cast<uint32_t>(x.end - first), kLanes);
    for (uint32_t i = 0; i < kLanes; ++i) u[i] = x.source(first + static_cast<int32_t>(i));
    const uint64_t lanes = count == kLanes ? ~uint64_t{0} : (uint64_t{1} << count) - 1;
    float* const registers[4] = {rgba[0], rgba[1], rgba[2], rgba[3]};
    SampleOperands operands;
    operands.u = u;
    operands.v = v;
    operands.lanes = lanes;
    sampling.sample_2d(&source, &sampler, operands, registers);
    const float* const values[4] = {rgba[0], rgba[1], rgba[2], rgba[3]};
    texels.store_quads(packed, {kQuads, true}, lanes, values, 0xF);
    std::byte* out =
        target + static_cast<uint64_t>(line) * row_pitch + static_cast<uint64_t>(first) * format->texel_size;
    std::memcpy(out, packed, size_t{count} * format->texel_size);
  }
}

SamplerState sampler_of(VkFilter filter) {
  SamplerState sampler;
  sampler.mag_filter = filter;
  sampler.min_filter = filter;
  sampler.address_u = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  sampler.address_v = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  sampler.address_w = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  sampler.unnormalized = true;
  return sampler;
}

bool inside(const ImageLayout& layout, const VkImageSubresourceLayers& layers, const VkOffset3D (&offsets)[2]) {
  const ImageExtent& extent = layout.extent;
  if (layers.mipLevel >= extent.mip_levels || layers.baseArrayLayer >= extent.layers ||
      layers.layerCount > extent.layers - layers.baseArrayLayer) {
    return false;
  }
  const auto width = static_cast<int32_t>(layout.levels[layers.mipLevel].width);
  const auto height = static_cast<int32_t>(layout.levels[layers.mipLevel].height);
  return std::ranges::all_of(offsets, [&](const VkOffset3D& offset) {
    return offset.x >= 0 && offset.x <= width && offset.y >= 0 && offset.y <= height;
  });
}

// False if the region does not lie in the images.
bool blit_region(CommandExecutor& executor, const cmd::BlitImage& command, const VkImageBlit& region) {
  const ImageLayout& source = command.source->layout;
  const ImageLayout& target = command.target->layout;
  if (!inside(source, region.srcSubresource, region.srcOffsets)) return false;
  if (!inside(target, region.dstSubresource, region.dstOffsets)) return false;
  const VkOffset3D(&to)[2] = region.dstOffsets;
  const VkOffset3D(&from)[2] = region.srcOffsets;
  if (to[0].x == to[1].x || to[0].y == to[1].y) return true;
  const uint32_t layers = std::min(region.srcSubresource.layerCount, region.dstSubresource.layerCount);
  for (uint32_t layer = 0; layer < layers; ++layer) {
    const VkImageSubresourceRange range = {region.srcSubresource.aspectMask, region.srcSubresource.mipLevel, 1,
                                           region.srcSubresource.baseArrayLayer + layer, 1};
    const Result<TextureView> view = make_view(source, command.source->data, source.format->format, {}, range);
    if (!view) return false;
    const VkImageSubresourceLayers& at = region.dstSubresource;
    const Blit blit = {*view,
                       sampler_of(command.filter),
                       target.format,
                       command.target->data + texel_offset(target, at.mipLevel, at.baseArrayLayer + layer),
                       target.levels[at.mipLevel].row_pitch,
                       Axis(from[0].x, from[1].x, to[0].x, to[1].x),
                       Axis(from[0].y, from[1].y, to[0].y, to[1].y)};
    executor.pool.parallel_for(static_cast<size_t>(blit.y.end - blit.y.first),
                               [&blit](size_t row, unsigned) { blit.row(blit.y.first + static_cast<int32_t>(row)); });
  }
  return true;
}

}  // namespace

void execute(CommandExecutor& executor, const cmd::BlitImage& command) {
  for (const VkImageBlit& region : command.regions) {
    const bool bound = command.source->data != nullptr && command.target->data != nullptr;
    if (!bound || !blit_region(executor, command, region)) {
      log_error("vkCmdBlitImage: a region does not lie in its images");
    }
  }
}

}  // namespace lapilli
