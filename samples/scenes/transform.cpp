// A triangle scaled, turned and moved, seen by a camera with a 90 degree perspective. The intensity at its corners is
// interpolated perspective-correctly.
#include "scenes/transform.h"

#include <array>
#include <cstddef>
#include <glm/gtc/matrix_transform.hpp>

#include "common/pipeline.h"
#include "scenes/draw_buffers.h"
#include "scenes/exact_transform.h"
#include "shaders/transform.frag.h"
#include "shaders/transform.vert.h"

namespace lapilli::samples {
namespace {

struct Vertex {
  glm::vec3 position;  // object space
  float intensity;
};

constexpr std::array<VkVertexInputAttributeDescription, 2> kVertexAttributes = {{
    {0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(Vertex, position)},
    {1, 0, VK_FORMAT_R32_SFLOAT, offsetof(Vertex, intensity)},
}};

constexpr std::array<Vertex, 3> kVertices = {{
    {{-0.5f, -0.5f, 0.0f}, 1.0f},
    {{0.5f, -0.5f, 0.0f}, 0.5f},
    {{0.0f, 0.5f, 0.0f}, 0.0f},
}};
constexpr std::array<uint32_t, 3> kIndices = {0, 1, 2};

glm::mat4 model_view_projection(const SceneOptions& options) {
  const glm::mat4 one(1.0f);
  const glm::mat4 scale = glm::scale(one, {2.6f, 2.2f, 1.0f});
  const glm::mat4 rotation = glm::rotate(one, glm::radians(38.0f) + options.angle, {0.0f, 1.0f, 0.0f});
  const glm::mat4 translation = glm::translate(one, {0.25f, 0.05f, -0.1f});
  const glm::mat4 model = translation * rotation * scale;
  const glm::mat4 view = glm::lookAt(glm::vec3(0.3f, 0.5f, 1.6f), glm::vec3(0.0f), glm::vec3(0.0f, 1.0f, 0.0f));
  const float aspect = static_cast<float>(options.width) / static_cast<float>(options.height);
  glm::mat4 projection = glm::perspective(glm::radians(90.0f), aspect, 0.1f, 100.0f);
  projection[1][1] = -projection[1][1];  // GLM looks up along y, Vulkan down
  return snap_matrix(projection * view * model);
}

class Transform final : public Scene {
 public:
  explicit Transform(const SceneOptions& options) : options_(options), matrix_(model_view_projection(options)) {}

  SceneGeometry geometry() const override {
    DrawGeometry draw;
    Attribute intensity = {Interpolation::kPerspective, 1, {}};
    for (const Vertex& vertex : kVertices) {
      draw.positions.push_back(exact_transform(matrix_, vertex.position));
      intensity.values.push_back(vertex.intensity);
    }
    draw.indices.assign(kIndices.begin(), kIndices.end());
    draw.attributes = {std::move(intensity)};
    draw.depth_test = true;
    draw.shade = [](const double* in) { return Color{in[0], 0.55 * in[0], 0.15 * in[0], 1.0}; };
    return {options_.width, options_.height, {0.09, 0.13, 0.20, 1.0}, 1.0f, {std::move(draw)}};
  }

  void create_resources(const Context& context) override {
    buffers_ = DrawBuffers(context, std::span<const Vertex>(kVertices), std::span<const uint32_t>(kIndices));
    const VkPushConstantRange push = {VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(glm::mat4)};
    layout_ = create_pipeline_layout(context, {}, std::span(&push, 1));
  }

  void create_pipelines(const Context& context, const RenderTarget& target) override {
    GraphicsPipelineInfo info;
    info.vertex_shader = shaders::kTransformVert;
    info.fragment_shader = shaders::kTransformFrag;
    info.vertices = {sizeof(Vertex), kVertexAttributes};
    info.layout = layout_.get();
    info.render_pass = target.render_pass();
    info.extent = target.extent();
    info.depth_test = true;
    pipeline_ = create_graphics_pipeline(context, info);
  }

  void record(VkCommandBuffer commands) const override {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_.get());
    vkCmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(matrix_), &matrix_);
    buffers_.draw(commands);
  }

 private:
  SceneOptions options_;
  glm::mat4 matrix_;
  DrawBuffers buffers_;
  PipelineLayout layout_;
  Pipeline pipeline_;
};

}  // namespace

std::unique_ptr<Scene> create_transform(const SceneOptions& options) { return std::make_unique<Transform>(options); }

}  // namespace lapilli::samples
