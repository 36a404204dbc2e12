// Scenes of whole screens: clearing, layers, textures, arithmetic.
#include <cmath>
#include <optional>

#include "common/pipeline.h"
#include "scenes/kinds.h"
#include "scenes/target.h"
#include "scenes/textures.h"
#include "shaders/bilinear.frag.h"
#include "shaders/clouds.frag.h"
#include "shaders/full_screen.vert.h"
#include "shaders/glass.frag.h"
#include "shaders/layer.frag.h"
#include "shaders/layer.vert.h"
#include "shaders/mandelbrot.frag.h"
#include "shaders/ray_march.frag.h"
#include "shaders/trilinear.frag.h"

namespace lapilli::bench {
namespace {

constexpr double kColorBytes = 4;  // R8G8B8A8_UNORM

double pixels_of(VkExtent2D extent) { return double{1} * extent.width * extent.height; }

class Clear : public Scene {
 public:
  explicit Clear(const SceneOptions& options) : extent_(options.extent) {}
  void create_resources(const samples::Context& context) override { target_ = Target(context, extent_, {}); }
  void create_pipelines(const samples::Context&) override {}
  void record(VkCommandBuffer commands) const override {
    target_.begin(commands, {0.2f, 0.4f, 0.6f, 1.0f});
    vkCmdEndRenderPass(commands);
  }
  samples::Frame read_back(const samples::Context& context) const override { return target_.read_back(context); }
  Work work() const override { return {.written_bytes = kColorBytes * pixels_of(extent_)}; }

 private:
  VkExtent2D extent_;
  Target target_;
};

// Layers over each other: opaque with a depth test, or blended without.
enum class Order { back_to_front, front_to_back, blended };

class Layers : public Scene {
 public:
  Layers(const SceneOptions& options, Order order) : extent_(options.extent), count_(options.count), order_(order) {}

  void create_resources(const samples::Context& context) override {
    target_ = Target(context, extent_, {.depth = order_ != Order::blended});
    const VkPushConstantRange push = {VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(Push)};
    layout_ = samples::create_pipeline_layout(context, {}, std::span(&push, 1));
  }
  void create_pipelines(const samples::Context& context) override {
    samples::GraphicsPipelineInfo info;
    info.vertex_shader = shaders::kLayerVert;
    info.fragment_shader = shaders::kLayerFrag;
    if (order_ == Order::blended) info.fragment_shader = shaders::kGlassFrag;
    info.layout = layout_.get();
    info.render_pass = target_.render_pass();
    info.extent = extent_;
    info.depth_test = order_ != Order::blended;
    info.blend = order_ == Order::blended;
    pipeline_ = samples::create_graphics_pipeline(context, info);
  }
  void record(VkCommandBuffer commands) const override {
    target_.begin(commands, {0, 0, 0, 1});
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_.get());
    for (uint32_t i = 0; i < count_; ++i) {
      const float place = (static_cast<float>(i) + 0.5f) / static_cast<float>(count_);
      const float turn = 6.2831853f * place;
      const Push push = {
          {0.5f + 0.4f * std::cos(turn), 0.5f + 0.4f * std::cos(turn + 2), 0.5f + 0.4f * std::sin(turn), 0.3f},
          order_ == Order::back_to_front ? 1 - place : place};
      vkCmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                         sizeof(push), &push);
      vkCmdDraw(commands, 3, 1, 0, 0);
    }
    vkCmdEndRenderPass(commands);
  }
  samples::Frame read_back(const samples::Context& context) const override { return target_.read_back(context); }
  // Opaque: each pixel is shaded once. Blended: each layer reads and writes every pixel of its tile; four fma and six
  // operations for the disc.
  Work work() const override {
    const double pixels = pixels_of(extent_);
    if (order_ != Order::blended) return {.written_bytes = kColorBytes * pixels, .operations = 45 * pixels};
    return {.written_bytes = kColorBytes * pixels,
            .cached_bytes = 2 * kColorBytes * pixels * count_,
            .operations = 10 * pixels * count_};
  }

 private:
  struct Push {
    float tint[4];
    float depth;
  };
  VkExtent2D extent_;
  uint32_t count_;
  Order order_;
  Target target_;
  samples::PipelineLayout layout_;
  samples::Pipeline pipeline_;
};

// A fragment shader for every pixel, with a texture if it has one. `per_pixel` is its least work.
struct Picture {
  std::span<const uint32_t> shader;
  enum class Texture { none, bilinear, trilinear } texture;
  double operations;  // for each pixel
  double loads;
};

class FullScreen : public Scene {
 public:
  FullScreen(const SceneOptions& options, const Picture& picture) : extent_(options.extent), picture_(picture) {}

  void create_resources(const samples::Context& context) override {
    target_ = Target(context, extent_, {});
    const VkPushConstantRange push = {VK_SHADER_STAGE_VERTEX_BIT, 0, 2 * sizeof(float)};
    if (picture_.texture == Picture::Texture::none) {
      layout_ = samples::create_pipeline_layout(context, {}, std::span(&push, 1));
      return;
    }
    const bool trilinear = picture_.texture == Picture::Texture::trilinear;
    texture_ = std::move(upload_patterns(context, 1, 1024, trilinear)[0]);
    sampler_ = trilinear ? create_trilinear_sampler(context)
                         : samples::create_sampler(context, VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_REPEAT);
    const samples::Binding binding = samples::ImageBinding{VK_SHADER_STAGE_FRAGMENT_BIT, &texture_, &sampler_};
    set_ = samples::DescriptorSet(context, std::span(&binding, 1));
    const VkDescriptorSetLayout set_layout = set_.layout();
    layout_ = samples::create_pipeline_layout(context, std::span(&set_layout, 1), std::span(&push, 1));
  }
  void create_pipelines(const samples::Context& context) override {
    samples::GraphicsPipelineInfo info;
    info.vertex_shader = shaders::kFullScreenVert;
    info.fragment_shader = picture_.shader;
    info.layout = layout_.get();
    info.render_pass = target_.render_pass();
    info.extent = extent_;
    pipeline_ = samples::create_graphics_pipeline(context, info);
  }
  void record(VkCommandBuffer commands) const override {
    target_.begin(commands, {0, 0, 0, 1});
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_.get());
    const std::array<float, 2> size = {static_cast<float>(extent_.width), static_cast<float>(extent_.height)};
    vkCmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(size), size.data());
    if (VkDescriptorSet set = set_.get()) {
      vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 0, 1, &set, 0, nullptr);
    }
    vkCmdDraw(commands, 3, 1, 0, 0);
    vkCmdEndRenderPass(commands);
  }
  samples::Frame read_back(const samples::Context& context) const override { return target_.read_back(context); }
  Work work() const override {
    const double pixels = pixels_of(extent_);
    return {.written_bytes = kColorBytes * pixels,
            .operations = picture_.operations * pixels,
            .loads = picture_.loads * pixels};
  }

 private:
  VkExtent2D extent_;
  Picture picture_;
  Target target_;
  samples::Image texture_;
  samples::Sampler sampler_;
  samples::DescriptorSet set_;
  samples::PipelineLayout layout_;
  samples::Pipeline pipeline_;
};

}  // namespace

std::unique_ptr<Scene> clear_scene(const SceneOptions& options) { return std::make_unique<Clear>(options); }
std::unique_ptr<Scene> back_to_front_scene(const SceneOptions& options) {
  return std::make_unique<Layers>(options, Order::back_to_front);
}
std::unique_ptr<Scene> front_to_back_scene(const SceneOptions& options) {
  return std::make_unique<Layers>(options, Order::front_to_back);
}
std::unique_ptr<Scene> blended_scene(const SceneOptions& options) {
  return std::make_unique<Layers>(options, Order::blended);
}

// Two pairs of texels; three linear steps of four components, two operations each, and eight for the weights.
std::unique_ptr<Scene> bilinear_scene(const SceneOptions& options) {
  return std::make_unique<FullScreen>(options, Picture{shaders::kBilinearFrag, Picture::Texture::bilinear, 32, 2});
}
// Twice as much, and the step between the levels.
std::unique_ptr<Scene> trilinear_scene(const SceneOptions& options) {
  return std::make_unique<FullScreen>(options, Picture{shaders::kTrilinearFrag, Picture::Texture::trilinear, 80, 4});
}
// An estimate: the least that three octaves take.
std::unique_ptr<Scene> noise_scene(const SceneOptions& options) {
  return std::make_unique<FullScreen>(options, Picture{shaders::kCloudsFrag, Picture::Texture::none, 200, 0});
}
// 19.7 steps for each pixel at 1280 x 720, counted with the same loop in float32 on the CPU, of 8 operations: six for z
// and its square, two comparisons.
std::unique_ptr<Scene> mandelbrot_scene(const SceneOptions& options) {
  return std::make_unique<FullScreen>(options, Picture{shaders::kMandelbrotFrag, Picture::Texture::none, 158, 0});
}
// Counted in the same way: 27.0 looks at the four stones (9 operations each stone), 19.6 of them with the ground (5
// more) and 7.4 for a shadow (9 more); shading is an estimate of 60 for the 0.56 that hit something.
std::unique_ptr<Scene> ray_march_scene(const SceneOptions& options) {
  return std::make_unique<FullScreen>(options, Picture{shaders::kRayMarchFrag, Picture::Texture::none, 1170, 0});
}

}  // namespace lapilli::bench
