// Scenes of many small draws: only push constants change, or descriptors, or the pipeline.
#include <cmath>
#include <cstring>
#include <glm/glm.hpp>

#include "common/pipeline.h"
#include "scenes/kinds.h"
#include "scenes/target.h"
#include "scenes/textures.h"
#include "shaders/color.frag.h"
#include "shaders/material.frag.h"
#include "shaders/material.vert.h"
#include "shaders/sprite.vert.h"
#include "shaders/variants.frag.h"

namespace lapilli::bench {
namespace {

using glm::mat4;
using glm::vec2;
using glm::vec4;

constexpr VkVertexInputAttributeDescription kPosition = {0, 0, VK_FORMAT_R32G32_SFLOAT, 0};

// Cell `i` of a grid of at least `count` cells over the screen: its centre and half its size, NDC.
struct Cell {
  vec2 center, half;
};
Cell cell_of(uint32_t i, uint32_t count) {
  const auto columns = static_cast<uint32_t>(std::ceil(std::sqrt(count * 16.0 / 9)));
  const uint32_t rows = (count + columns - 1) / columns;
  const vec2 half = {1.0f / static_cast<float>(columns), 1.0f / static_cast<float>(rows)};
  return {vec2(-1) + half * vec2(2 * (i % columns) + 1, 2 * (i / columns) + 1), half};
}

struct SpritePush {
  vec4 tint;
  vec2 center;
  vec2 size;
};

SpritePush sprite(uint32_t i, uint32_t count) {
  const Cell cell = cell_of(i, count);
  const float turn = 0.61803f * static_cast<float>(i);
  return {vec4(0.55f + 0.4f * std::sin(6.28f * turn), 0.5f + 0.5f * cell.center.x, 0.5f - 0.5f * cell.center.y, 1),
          cell.center, 0.9f * cell.half};
}

// Draws of one small triangle each; with one pipeline, or with as many as there are draws.
class Sprites : public Scene {
 public:
  Sprites(const SceneOptions& options, bool own_pipelines)
      : extent_(options.extent), count_(options.count), own_pipelines_(own_pipelines) {}

  void create_resources(const samples::Context& context) override {
    target_ = Target(context, extent_, {});
    const std::array<vec2, 3> corners = {{{-1, 1}, {1, 1}, {0, -1}}};
    vertices_ = samples::Buffer(context, std::span<const vec2>(corners), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    const VkPushConstantRange push = {VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(SpritePush)};
    layout_ = samples::create_pipeline_layout(context, {}, std::span(&push, 1));
  }
  void create_pipelines(const samples::Context& context) override {
    samples::GraphicsPipelineInfo info;
    info.vertex_shader = shaders::kSpriteVert;
    info.fragment_shader = shaders::kColorFrag;
    info.vertices = {sizeof(vec2), std::span(&kPosition, 1)};
    info.layout = layout_.get();
    info.render_pass = target_.render_pass();
    info.extent = extent_;
    if (!own_pipelines_) {
      pipelines_.push_back(samples::create_graphics_pipeline(context, info));
      return;
    }
    info.fragment_shader = shaders::kVariantsFrag;
    for (uint32_t i = 0; i < count_; ++i) {
      // Both constants reach the arithmetic, so that no two programs are alike.
      const struct {
        int32_t variant;
        float roughness;
      } constants = {static_cast<int32_t>(i % 64), 0.2f + 0.003f * static_cast<float>(i)};
      const std::array<VkSpecializationMapEntry, 2> entries = {{{0, 0, 4}, {1, 4, 4}}};
      const VkSpecializationInfo specialization = {2, entries.data(), sizeof(constants), &constants};
      info.fragment_constants = &specialization;
      info.blend = i % 5 == 0;
      pipelines_.push_back(samples::create_graphics_pipeline(context, info));
    }
  }
  void record(VkCommandBuffer commands) const override {
    target_.begin(commands, {0.1f, 0.1f, 0.1f, 1});
    const VkDeviceSize offset = 0;
    VkBuffer vertices = vertices_.get();
    vkCmdBindVertexBuffers(commands, 0, 1, &vertices, &offset);
    if (!own_pipelines_) vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_[0].get());
    for (uint32_t i = 0; i < count_; ++i) {
      if (own_pipelines_) vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_[i].get());
      const SpritePush push = sprite(i, count_);
      vkCmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(push), &push);
      vkCmdDraw(commands, 3, 1, 0, 0);
    }
    vkCmdEndRenderPass(commands);
  }
  samples::Frame read_back(const samples::Context& context) const override { return target_.read_back(context); }
  // The triangles cover 0.4 of the screen.
  Work work() const override {
    const double pixels = 1.0 * extent_.width * extent_.height;
    return {.written_bytes = 4 * pixels, .operations = (own_pipelines_ ? 60 : 6) * 0.4 * pixels, .draws = 1.0 * count_};
  }

 private:
  VkExtent2D extent_;
  uint32_t count_;
  bool own_pipelines_;
  Target target_;
  samples::Buffer vertices_;
  samples::PipelineLayout layout_;
  std::vector<samples::Pipeline> pipelines_;
};

// Quads, each with its part of a uniform buffer and a small texture that is its own.
class Descriptors : public Scene {
 public:
  explicit Descriptors(const SceneOptions& options) : extent_(options.extent), count_(options.count) {}

  void create_resources(const samples::Context& context) override {
    target_ = Target(context, extent_, {});
    const std::array<vec2, 6> corners = {{{-1, -1}, {-1, 1}, {1, 1}, {-1, -1}, {1, 1}, {1, -1}}};
    vertices_ = samples::Buffer(context, std::span<const vec2>(corners), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    textures_ = upload_patterns(context, count_, 32, false);
    sampler_ = samples::create_sampler(context, VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_REPEAT);

    const auto alignment = static_cast<uint32_t>(context.properties().limits.minUniformBufferOffsetAlignment);
    stride_ = (static_cast<uint32_t>(sizeof(Object)) + alignment - 1) / alignment * alignment;
    uniforms_ = samples::Buffer(context, VkDeviceSize{stride_} * count_, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    for (uint32_t i = 0; i < count_; ++i) {
      const SpritePush place = sprite(i, count_);
      mat4 transform(1);
      transform[0][0] = place.size.x;
      transform[1][1] = place.size.y;
      transform[3] = vec4(place.center, 0.5f, 1);
      const Object object = {transform, place.tint};
      std::memcpy(static_cast<std::byte*>(uniforms_.data()) + size_t{stride_} * i, &object, sizeof(object));
    }
    create_sets(context);
    const VkDescriptorSetLayout set_layout = set_layout_.get();
    layout_ = samples::create_pipeline_layout(context, std::span(&set_layout, 1));
  }
  void create_pipelines(const samples::Context& context) override {
    samples::GraphicsPipelineInfo info;
    info.vertex_shader = shaders::kMaterialVert;
    info.fragment_shader = shaders::kMaterialFrag;
    info.vertices = {sizeof(vec2), std::span(&kPosition, 1)};
    info.layout = layout_.get();
    info.render_pass = target_.render_pass();
    info.extent = extent_;
    pipeline_ = samples::create_graphics_pipeline(context, info);
  }
  void record(VkCommandBuffer commands) const override {
    target_.begin(commands, {0.1f, 0.1f, 0.1f, 1});
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_.get());
    const VkDeviceSize offset = 0;
    VkBuffer vertices = vertices_.get();
    vkCmdBindVertexBuffers(commands, 0, 1, &vertices, &offset);
    for (uint32_t i = 0; i < count_; ++i) {
      const uint32_t place = stride_ * i;
      vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 0, 1, &sets_[i], 1, &place);
      vkCmdDraw(commands, 6, 1, 0, 0);
    }
    vkCmdEndRenderPass(commands);
  }
  samples::Frame read_back(const samples::Context& context) const override { return target_.read_back(context); }
  // The quads cover 0.81 of the screen, bilinear.
  Work work() const override {
    const double pixels = 1.0 * extent_.width * extent_.height;
    return {.written_bytes = 4 * pixels,
            .operations = 36 * 0.81 * pixels,
            .draws = 1.0 * count_,
            .loads = 2 * 0.81 * pixels};
  }

 private:
  struct Object {
    mat4 transform;
    vec4 tint;
  };

  void create_sets(const samples::Context& context) {
    const std::array<VkDescriptorSetLayoutBinding, 2> slots = {
        {{0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, 1, VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT,
          nullptr},
         {1, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr}}};
    VkDescriptorSetLayoutCreateInfo layout = {};
    layout.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    layout.bindingCount = 2;
    layout.pBindings = slots.data();
    VkDescriptorSetLayout raw_layout = VK_NULL_HANDLE;
    samples::check(vkCreateDescriptorSetLayout(context.device(), &layout, nullptr, &raw_layout),
                   "vkCreateDescriptorSetLayout");
    set_layout_ = samples::DescriptorSetLayout(context.device(), raw_layout);

    const std::array<VkDescriptorPoolSize, 2> sizes = {
        {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, count_}, {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, count_}}};
    VkDescriptorPoolCreateInfo pool = {};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = count_;
    pool.poolSizeCount = 2;
    pool.pPoolSizes = sizes.data();
    VkDescriptorPool raw_pool = VK_NULL_HANDLE;
    samples::check(vkCreateDescriptorPool(context.device(), &pool, nullptr, &raw_pool), "vkCreateDescriptorPool");
    pool_ = samples::DescriptorPool(context.device(), raw_pool);

    const std::vector<VkDescriptorSetLayout> layouts(count_, raw_layout);
    sets_.resize(count_);
    VkDescriptorSetAllocateInfo allocate = {};
    allocate.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    allocate.descriptorPool = raw_pool;
    allocate.descriptorSetCount = count_;
    allocate.pSetLayouts = layouts.data();
    samples::check(vkAllocateDescriptorSets(context.device(), &allocate, sets_.data()), "vkAllocateDescriptorSets");
    const VkDescriptorBufferInfo buffer = {uniforms_.get(), 0, sizeof(Object)};
    for (uint32_t i = 0; i < count_; ++i) {
      const VkDescriptorImageInfo image = {sampler_.get(), textures_[i].view(),
                                           VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
      std::array<VkWriteDescriptorSet, 2> writes = {};
      for (uint32_t slot = 0; slot < 2; ++slot) {
        writes[slot].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        writes[slot].dstSet = sets_[i];
        writes[slot].dstBinding = slot;
        writes[slot].descriptorCount = 1;
        writes[slot].descriptorType = slots[slot].descriptorType;
      }
      writes[0].pBufferInfo = &buffer;
      writes[1].pImageInfo = &image;
      vkUpdateDescriptorSets(context.device(), 2, writes.data(), 0, nullptr);
    }
  }

  VkExtent2D extent_;
  uint32_t count_;
  uint32_t stride_ = 0;  // bytes between objects
  Target target_;
  samples::Buffer vertices_, uniforms_;
  std::vector<samples::Image> textures_;
  samples::Sampler sampler_;
  samples::DescriptorSetLayout set_layout_;
  samples::DescriptorPool pool_;
  std::vector<VkDescriptorSet> sets_;
  samples::PipelineLayout layout_;
  samples::Pipeline pipeline_;
};

}  // namespace

std::unique_ptr<Scene> draws_scene(const SceneOptions& options) { return std::make_unique<Sprites>(options, false); }
std::unique_ptr<Scene> pipelines_scene(const SceneOptions& options) { return std::make_unique<Sprites>(options, true); }
std::unique_ptr<Scene> descriptors_scene(const SceneOptions& options) { return std::make_unique<Descriptors>(options); }

}  // namespace lapilli::bench
