// A torus knot that turns. The vertex shader lights a face at its provoking vertex; back faces are dropped, the depth
// test hides what is behind.
#include "scenes/solid_object.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <glm/gtc/matrix_transform.hpp>

#include "common/pipeline.h"
#include "scenes/draw_buffers.h"
#include "scenes/exact_transform.h"
#include "scenes/mesh.h"
#include "shaders/solid_object.frag.h"
#include "shaders/solid_object.vert.h"

namespace lapilli::samples {
namespace {

constexpr uint32_t kSegments = 180;
constexpr uint32_t kSides = 12;

constexpr std::array<VkVertexInputAttributeDescription, 3> kVertexAttributes = {{
    {0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(FaceVertex, position)},
    {1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(FaceVertex, normal)},
    {2, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(FaceVertex, albedo)},
}};

// The uniform buffer, as the vertex shader declares it (std140).
struct ObjectUniforms {
  glm::mat4 model_view_projection;
  glm::vec4 light;  // unit vectors in object space
  glm::vec4 half_way;
};

ObjectUniforms uniforms(const SceneOptions& options) {
  const glm::mat4 one(1.0f);
  const glm::mat4 model = glm::rotate(one, glm::radians(25.0f) + options.angle, {0.0f, 1.0f, 0.0f}) *
                          glm::rotate(one, glm::radians(-20.0f) + 0.5f * options.angle, {1.0f, 0.0f, 0.0f});
  const glm::mat4 view = glm::lookAt(glm::vec3(0.0f, 0.35f, 3.1f), glm::vec3(0.0f), glm::vec3(0.0f, 1.0f, 0.0f));
  const float aspect = static_cast<float>(options.width) / static_cast<float>(options.height);
  glm::mat4 projection = glm::perspective(glm::radians(45.0f), aspect, 0.5f, 8.0f);
  projection[1][1] = -projection[1][1];  // GLM looks up along y, Vulkan down

  const glm::vec3 light = glm::normalize(glm::vec3(0.5f, 0.8f, 0.6f));
  const glm::vec3 eye = glm::vec3(0.0f, 0.0f, 1.0f);
  const glm::mat3 to_object = glm::transpose(glm::mat3(model));
  return {snap_matrix(projection * view * model), glm::vec4(to_object * light, 0.0f),
          glm::vec4(to_object * glm::normalize(light + eye), 0.0f)};
}

// What the vertex shader computes, in double.
glm::dvec3 lit(const FaceVertex& vertex, const ObjectUniforms& object) {
  const glm::dvec3 normal(vertex.normal);
  const double diffuse = std::max(glm::dot(normal, glm::dvec3(object.light)), 0.0);
  const double highlight = std::pow(std::max(glm::dot(normal, glm::dvec3(object.half_way)), 0.0), 32.0);
  return glm::dvec3(vertex.albedo) * (0.18 + 0.82 * diffuse) + glm::dvec3(0.35 * highlight);
}

class SolidObject final : public Scene {
 public:
  explicit SolidObject(const SceneOptions& options)
      : options_(options), object_(uniforms(options)), mesh_(torus_knot(kSegments, kSides)) {}

  SceneGeometry geometry() const override {
    DrawGeometry draw;
    Attribute color = {Interpolation::kFlat, 3, {}};
    for (const FaceVertex& vertex : mesh_.vertices) {
      draw.positions.push_back(exact_transform(object_.model_view_projection, vertex.position));
      const glm::vec3 rgb(lit(vertex, object_));
      color.values.insert(color.values.end(), {rgb.x, rgb.y, rgb.z});
    }
    draw.indices = mesh_.indices;
    draw.attributes = {std::move(color)};
    draw.cull_back_faces = true;
    draw.depth_test = true;
    draw.shade = [](const double* in) { return Color{in[0], in[1], in[2], 1.0}; };
    return {options_.width, options_.height, {0.06, 0.07, 0.09, 1.0}, 1.0f, {std::move(draw)}};
  }

  void create_resources(const Context& context) override {
    buffers_ =
        DrawBuffers(context, std::span<const FaceVertex>(mesh_.vertices), std::span<const uint32_t>(mesh_.indices));
    uniform_buffer_ = Buffer(context, std::span<const ObjectUniforms>(&object_, 1), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    const std::array<Binding, 1> bindings = {
        BufferBinding{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_SHADER_STAGE_VERTEX_BIT, &uniform_buffer_}};
    descriptors_ = DescriptorSet(context, bindings);
    const VkDescriptorSetLayout set_layout = descriptors_.layout();
    layout_ = create_pipeline_layout(context, std::span(&set_layout, 1));
  }

  void create_pipelines(const Context& context, const RenderTarget& target) override {
    GraphicsPipelineInfo info;
    info.vertex_shader = shaders::kSolidObjectVert;
    info.fragment_shader = shaders::kSolidObjectFrag;
    info.vertices = {sizeof(FaceVertex), kVertexAttributes};
    info.layout = layout_.get();
    info.render_pass = target.render_pass();
    info.extent = target.extent();
    info.cull_back_faces = true;
    info.depth_test = true;
    pipeline_ = create_graphics_pipeline(context, info);
  }

  void record(VkCommandBuffer commands) const override {
    const VkDescriptorSet set = descriptors_.get();
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_.get());
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 0, 1, &set, 0, nullptr);
    buffers_.draw(commands);
  }

 private:
  SceneOptions options_;
  ObjectUniforms object_;
  Mesh mesh_;
  DrawBuffers buffers_;
  Buffer uniform_buffer_;
  DescriptorSet descriptors_;
  PipelineLayout layout_;
  Pipeline pipeline_;
};

}  // namespace

std::unique_ptr<Scene> create_solid_object(const SceneOptions& options) {
  return std::make_unique<SolidObject>(options);
}

}  // namespace lapilli::samples
