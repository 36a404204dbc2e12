// Two passes: depth as the light sees it, then the picture, which reads that depth.
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "common/pipeline.h"
#include "scenes/kinds.h"
#include "scenes/target.h"
#include "shaders/shadow_caster.vert.h"
#include "shaders/shadowed.frag.h"
#include "shaders/shadowed.vert.h"

namespace lapilli::bench {
namespace {

using glm::mat4;
using glm::vec3;
using glm::vec4;

constexpr VkExtent2D kMapExtent = {1024, 1024};

struct Vertex {
  vec3 position;
  vec3 normal;
};

struct Uniforms {
  mat4 view_projection;
  mat4 light_projection;
  vec4 light;
};

// Round columns of eight by eight on a floor.
struct Hall {
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;
};

Hall hall(uint32_t triangles) {
  constexpr uint32_t kColumns = 64;
  constexpr uint32_t kRings = 8;
  const uint32_t sides = std::max(3u, triangles / (kColumns * kRings * 2));
  Hall hall;
  for (const auto& corner : {vec3(-1, -1, 0), vec3(1, -1, 0), vec3(1, 1, 0), vec3(-1, 1, 0)}) {
    hall.vertices.push_back({corner * 4.0f, {0, 0, 1}});
  }
  hall.indices = {0, 1, 2, 0, 2, 3};
  for (uint32_t column = 0; column < kColumns; ++column) {
    const vec3 foot = {static_cast<float>(column % 8) - 3.5f, static_cast<float>(column / 8) - 3.5f, 0};
    const auto first = static_cast<uint32_t>(hall.vertices.size());
    for (uint32_t ring = 0; ring <= kRings; ++ring) {
      const float height = 1.2f * static_cast<float>(ring) / kRings;
      const float radius = 0.2f + 0.06f * std::cos(9 * height);
      for (uint32_t side = 0; side < sides; ++side) {
        const float turn = 6.2831853f * static_cast<float>(side) / static_cast<float>(sides);
        const vec3 normal = {std::cos(turn), std::sin(turn), 0};
        hall.vertices.push_back({foot + radius * normal + vec3(0, 0, height), normal});
      }
    }
    for (uint32_t ring = 0; ring < kRings; ++ring) {
      for (uint32_t side = 0; side < sides; ++side) {
        const uint32_t next = (side + 1) % sides;
        const uint32_t a = first + ring * sides + side, b = first + ring * sides + next;
        const uint32_t c = b + sides, d = a + sides;
        hall.indices.insert(hall.indices.end(), {a, b, c, a, c, d});
      }
    }
  }
  return hall;
}

class ShadowMap : public Scene {
 public:
  explicit ShadowMap(const SceneOptions& options) : extent_(options.extent), hall_(hall(options.count)) {}

  std::string missing(const samples::Context& context) const override {
    constexpr VkFormatFeatureFlags kNeeds =
        VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT | VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT;
    return offers_format(context, Target::kDepthFormat, kNeeds) ? "" : "sampling of D32_SFLOAT images";
  }
  void create_resources(const samples::Context& context) override {
    target_ = Target(context, extent_, {.depth = true});
    map_ = samples::Image(context, kMapExtent, Target::kDepthFormat,
                          VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT);
    create_map_pass(context);
    vertices_ = samples::Buffer(context, std::span<const Vertex>(hall_.vertices), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    indices_ = samples::Buffer(context, std::span<const uint32_t>(hall_.indices), VK_BUFFER_USAGE_INDEX_BUFFER_BIT);

    const vec3 light = glm::normalize(vec3(0.6f, -0.5f, 0.9f));
    const float aspect = static_cast<float>(extent_.width) / static_cast<float>(extent_.height);
    mat4 projection = glm::perspective(0.8f, aspect, 0.5f, 20.0f);
    projection[1][1] = -projection[1][1];
    const Uniforms uniforms = {
        projection * glm::lookAt(vec3(-1, -6.0f, 4.5f), vec3(0, -0.4f, 0), vec3(0, 0, 1)),
        glm::ortho(-6.0f, 6.0f, -6.0f, 6.0f, 1.0f, 20.0f) * glm::lookAt(10.0f * light, vec3(0), vec3(0, 1, 0)),
        vec4(light, 0)};
    uniforms_ = samples::Buffer(context, std::span<const Uniforms>(&uniforms, 1), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    sampler_ = samples::create_sampler(context, VK_FILTER_NEAREST, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE);
    const std::array<samples::Binding, 2> bindings = {
        samples::BufferBinding{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                               VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, &uniforms_},
        samples::ImageBinding{VK_SHADER_STAGE_FRAGMENT_BIT, &map_, &sampler_}};
    // The depth pass has a set without the map, which it draws.
    caster_set_ = samples::DescriptorSet(context, std::span(bindings).first(1));
    set_ = samples::DescriptorSet(context, bindings);
    const VkDescriptorSetLayout caster_layout = caster_set_.layout();
    const VkDescriptorSetLayout layout = set_.layout();
    caster_layout_ = samples::create_pipeline_layout(context, std::span(&caster_layout, 1));
    layout_ = samples::create_pipeline_layout(context, std::span(&layout, 1));
  }
  void create_pipelines(const samples::Context& context) override {
    const std::array<VkVertexInputAttributeDescription, 2> attributes = {
        {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0}, {1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(Vertex, normal)}}};
    samples::GraphicsPipelineInfo info;
    info.vertex_shader = shaders::kShadowCasterVert;
    info.vertices = {sizeof(Vertex), std::span(attributes).first(1)};
    info.layout = caster_layout_.get();
    info.render_pass = map_pass_.get();
    info.extent = kMapExtent;
    info.depth_test = true;
    caster_ = samples::create_graphics_pipeline(context, info);
    info.vertex_shader = shaders::kShadowedVert;
    info.fragment_shader = shaders::kShadowedFrag;
    info.vertices = {sizeof(Vertex), attributes};
    info.layout = layout_.get();
    info.render_pass = target_.render_pass();
    info.extent = extent_;
    pipeline_ = samples::create_graphics_pipeline(context, info);
  }
  void record(VkCommandBuffer commands) const override {
    VkClearValue clear = {};
    clear.depthStencil = {1.0f, 0};
    VkRenderPassBeginInfo begin = {};
    begin.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
    begin.renderPass = map_pass_.get();
    begin.framebuffer = map_framebuffer_.get();
    begin.renderArea = {{0, 0}, kMapExtent};
    begin.clearValueCount = 1;
    begin.pClearValues = &clear;
    vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    draw(commands, caster_, caster_layout_, caster_set_);
    vkCmdEndRenderPass(commands);
    target_.begin(commands, {0.35f, 0.5f, 0.7f, 1});
    draw(commands, pipeline_, layout_, set_);
    vkCmdEndRenderPass(commands);
  }
  samples::Frame read_back(const samples::Context& context) const override { return target_.read_back(context); }
  // Both passes' vertices and triangles; nine lookups for each pixel and 60 operations; three quarters of it is
  // covered.
  Work work() const override {
    const double pixels = 0.75 * extent_.width * extent_.height;
    const double map_bytes = 4.0 * kMapExtent.width * kMapExtent.height;
    const double vertices = static_cast<double>(hall_.vertices.size());
    const double triangles = static_cast<double>(hall_.indices.size()) / 3;
    return {.written_bytes = 4 * pixels + map_bytes,
            .read_bytes = 2 * vertices * sizeof(Vertex) + 2 * 12 * triangles,
            .operations = 2 * (24 * vertices + 20 * triangles) + 60 * pixels,
            .loads = 9 * pixels};
  }

 private:
  void create_map_pass(const samples::Context& context) {
    VkAttachmentDescription attachment = {};
    attachment.format = Target::kDepthFormat;
    attachment.samples = VK_SAMPLE_COUNT_1_BIT;
    attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachment.finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    const VkAttachmentReference depth = {0, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.pDepthStencilAttachment = &depth;
    constexpr VkPipelineStageFlags kTests =
        VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
    // Before: the last frame's lookups. After: this one's.
    const std::array<VkSubpassDependency, 2> dependencies = {{
        {VK_SUBPASS_EXTERNAL, 0, VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, kTests, VK_ACCESS_SHADER_READ_BIT,
         VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT, 0},
        {0, VK_SUBPASS_EXTERNAL, kTests, VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT,
         VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT, VK_ACCESS_SHADER_READ_BIT, 0},
    }};
    VkRenderPassCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = 1;
    info.pAttachments = &attachment;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = static_cast<uint32_t>(dependencies.size());
    info.pDependencies = dependencies.data();
    VkRenderPass render_pass = VK_NULL_HANDLE;
    samples::check(vkCreateRenderPass(context.device(), &info, nullptr, &render_pass), "vkCreateRenderPass");
    map_pass_ = samples::RenderPass(context.device(), render_pass);

    VkImageView view = map_.view();
    VkFramebufferCreateInfo framebuffer = {};
    framebuffer.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    framebuffer.renderPass = render_pass;
    framebuffer.attachmentCount = 1;
    framebuffer.pAttachments = &view;
    framebuffer.width = kMapExtent.width;
    framebuffer.height = kMapExtent.height;
    framebuffer.layers = 1;
    VkFramebuffer raw = VK_NULL_HANDLE;
    samples::check(vkCreateFramebuffer(context.device(), &framebuffer, nullptr, &raw), "vkCreateFramebuffer");
    map_framebuffer_ = samples::Framebuffer(context.device(), raw);
  }
  void draw(VkCommandBuffer commands, const samples::Pipeline& pipeline, const samples::PipelineLayout& layout,
            const samples::DescriptorSet& descriptors) const {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
    VkDescriptorSet set = descriptors.get();
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout.get(), 0, 1, &set, 0, nullptr);
    const VkDeviceSize offset = 0;
    VkBuffer vertices = vertices_.get();
    vkCmdBindVertexBuffers(commands, 0, 1, &vertices, &offset);
    vkCmdBindIndexBuffer(commands, indices_.get(), 0, VK_INDEX_TYPE_UINT32);
    vkCmdDrawIndexed(commands, static_cast<uint32_t>(hall_.indices.size()), 1, 0, 0, 0);
  }

  VkExtent2D extent_;
  Hall hall_;
  Target target_;
  samples::Image map_;
  samples::RenderPass map_pass_;
  samples::Framebuffer map_framebuffer_;
  samples::Buffer vertices_, indices_, uniforms_;
  samples::Sampler sampler_;
  samples::DescriptorSet caster_set_, set_;
  samples::PipelineLayout caster_layout_, layout_;
  samples::Pipeline caster_, pipeline_;
};

}  // namespace

std::unique_ptr<Scene> shadow_map_scene(const SceneOptions& options) { return std::make_unique<ShadowMap>(options); }

}  // namespace lapilli::bench
