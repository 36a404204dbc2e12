// Scenes that compute: a vector operation at the speed of memory, gravity between all pairs, and the kernels of every
// library: matrix product, Fourier transform, sorting, histogram.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "common/pipeline.h"
#include "scenes/kinds.h"
#include "shaders/fft.comp.h"
#include "shaders/histogram.comp.h"
#include "shaders/matmul.comp.h"
#include "shaders/nbody.comp.h"
#include "shaders/nbody_shared.comp.h"
#include "shaders/saxpy.comp.h"
#include "shaders/shared_probe.comp.h"
#include "shaders/sort.comp.h"

namespace lapilli::bench {
namespace {

// Two storage buffers and push constants of a float and a count.
struct Kernel {
  std::span<const uint32_t> shader;
  std::vector<float> input;
  std::vector<float> output;  // as it is before the first frame
  float parameter;
  Work work;
  uint32_t elements_per_group = 64;
  bool counts = false;  // the output is counts, cleared before each frame
};

class Compute : public Scene {
 public:
  Compute(const SceneOptions& options, Kernel kernel)
      : extent_(options.extent), count_(options.count), kernel_(std::move(kernel)) {}

  void create_resources(const samples::Context& context) override {
    input_ = samples::Buffer(context, std::span<const float>(kernel_.input), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    output_ = samples::Buffer(context, std::span<const float>(kernel_.output),
                              VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    const std::array<samples::Binding, 2> bindings = {
        samples::BufferBinding{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_COMPUTE_BIT, &input_},
        samples::BufferBinding{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_SHADER_STAGE_COMPUTE_BIT, &output_}};
    set_ = samples::DescriptorSet(context, bindings);
    const VkDescriptorSetLayout set_layout = set_.layout();
    const VkPushConstantRange push = {VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(Push)};
    layout_ = samples::create_pipeline_layout(context, std::span(&set_layout, 1), std::span(&push, 1));
  }
  void create_pipelines(const samples::Context& context) override {
    pipeline_ = samples::create_compute_pipeline(context, kernel_.shader, layout_.get());
  }
  void record(VkCommandBuffer commands) const override {
    constexpr VkPipelineStageFlags kStages = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
    VkMemoryBarrier barrier = {};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
    const auto wait = [&] { vkCmdPipelineBarrier(commands, kStages, kStages, 0, 1, &barrier, 0, nullptr, 0, nullptr); };
    wait();
    if (kernel_.counts) {
      vkCmdFillBuffer(commands, output_.get(), 0, VK_WHOLE_SIZE, 0);
      wait();
    }
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
    VkDescriptorSet set = set_.get();
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_.get(), 0, 1, &set, 0, nullptr);
    const Push push = {kernel_.parameter, count_};
    vkCmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(push), &push);
    vkCmdDispatch(commands, (count_ + kernel_.elements_per_group - 1) / kernel_.elements_per_group, 1, 1);
    barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    vkCmdPipelineBarrier(commands, kStages, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, nullptr, 0, nullptr);
  }
  // The first results as grey values, 0.5 for 0 (counts: 0.5 for 0, 1 for a tenth of all); black behind the last.
  samples::Frame read_back(const samples::Context&) const override {
    const size_t pixels = size_t{extent_.width} * extent_.height;
    samples::Frame frame = {extent_.width, extent_.height, std::vector<uint8_t>(pixels * 4, 0), {}};
    const auto* values = static_cast<const float*>(output_.data());
    for (size_t i = 0; i < std::min(pixels, kernel_.output.size()); ++i) {
      const float value =
          kernel_.counts ? 10.0f * static_cast<float>(std::bit_cast<uint32_t>(values[i])) / static_cast<float>(count_)
                         : values[i];
      const float level = std::clamp(0.5f + 0.5f * value, 0.0f, 1.0f);
      std::memset(&frame.color[i * 4], static_cast<int>(std::lround(level * 255)), 3);
      frame.color[i * 4 + 3] = 255;
    }
    return frame;
  }
  Work work() const override { return kernel_.work; }

 private:
  struct Push {
    float parameter;
    uint32_t count;
  };
  VkExtent2D extent_;
  uint32_t count_;
  Kernel kernel_;
  samples::Buffer input_, output_;
  samples::DescriptorSet set_;
  samples::PipelineLayout layout_;
  samples::Pipeline pipeline_;
};

// Vulkan 1.0 has no way to ask for shared memory, which every driver has to have; one that lacks it refuses the
// pipeline.
class ComputeWithSharedMemory : public Compute {
 public:
  using Compute::Compute;
  std::string missing(const samples::Context& context) const override try {
    Compute probe({.count = 2}, Kernel{shaders::kSharedProbeComp, {1, 2}, {0, 0}, 0, {}});
    probe.create_resources(context);
    probe.create_pipelines(context);
    return {};
  } catch (const std::runtime_error&) {
    return "shared memory and barriers";
  }
};

std::vector<float> waves(size_t count, float step) {
  std::vector<float> values(count);
  for (size_t i = 0; i < count; ++i) values[i] = std::sin(step * static_cast<float>(i % 65536));
  return values;
}

Kernel gravity(const SceneOptions& options, std::span<const uint32_t> shader) {
  Kernel kernel = {
      shader, waves(size_t{options.count} * 4, 0.37f), std::vector<float>(size_t{options.count} * 4), 1e-4f, {}};
  for (size_t i = 3; i < kernel.input.size(); i += 4) kernel.input[i] = 1.0f;  // masses
  // Three differences, three for the square, a root and a division as one each, three products, three fma.
  kernel.work.operations = 14.0 * options.count * options.count;
  return kernel;
}

}  // namespace

// Two numbers read and one written. The factor is small, so that thousands of frames stay in range.
std::unique_ptr<Scene> saxpy_scene(const SceneOptions& options) {
  return std::make_unique<Compute>(options, Kernel{shaders::kSaxpyComp,
                                                   waves(options.count, 0.01f),
                                                   waves(options.count, 0.0007f),
                                                   1e-6f,
                                                   {.written_bytes = 4.0 * options.count,
                                                    .read_bytes = 8.0 * options.count,
                                                    .operations = 1.0 * options.count}});
}
std::unique_ptr<Scene> nbody_scene(const SceneOptions& options) {
  return std::make_unique<Compute>(options, gravity(options, shaders::kNbodyComp));
}
// count: elements of a matrix, a square of a multiple of 16.
std::unique_ptr<Scene> matmul_scene(const SceneOptions& options) {
  const double side = std::sqrt(double{1} * options.count);
  return std::make_unique<ComputeWithSharedMemory>(options, Kernel{shaders::kMatmulComp,
                                                                   waves(size_t{2} * options.count, 0.37f),
                                                                   std::vector<float>(options.count),
                                                                   static_cast<float>(1 / side),
                                                                   {.operations = side * side * side},
                                                                   256});
}
// count: complex numbers, a multiple of 1,024. A butterfly is ten operations.
std::unique_ptr<Scene> fft_scene(const SceneOptions& options) {
  return std::make_unique<ComputeWithSharedMemory>(options, Kernel{shaders::kFftComp,
                                                                   waves(size_t{2} * options.count, 0.37f),
                                                                   std::vector<float>(size_t{2} * options.count),
                                                                   1 / 32.0f,
                                                                   {.operations = 10.0 * 10 / 2 * options.count},
                                                                   1024});
}
// count: numbers, a multiple of 1,024. 55 steps of a comparison for each two.
std::unique_ptr<Scene> sort_scene(const SceneOptions& options) {
  return std::make_unique<ComputeWithSharedMemory>(options, Kernel{shaders::kSortComp,
                                                                   waves(options.count, 0.37f),
                                                                   std::vector<float>(options.count),
                                                                   1,
                                                                   {.operations = 55.0 / 2 * options.count},
                                                                   1024});
}
std::unique_ptr<Scene> histogram_scene(const SceneOptions& options) {
  return std::make_unique<ComputeWithSharedMemory>(
      options, Kernel{shaders::kHistogramComp,
                      waves(options.count, 0.37f),
                      std::vector<float>(256),
                      1,
                      {.read_bytes = 4.0 * options.count, .loads = 1.0 * options.count},
                      4096,
                      true});
}
std::unique_ptr<Scene> nbody_shared_scene(const SceneOptions& options) {
  return std::make_unique<ComputeWithSharedMemory>(options, gravity(options, shaders::kNbodySharedComp));
}

}  // namespace lapilli::bench
