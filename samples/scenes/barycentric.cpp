// Two triangles with depth, given in clip space. The near one is drawn first, so the far one must fail the depth test
// wherever both are.
#include "scenes/barycentric.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "common/pipeline.h"
#include "scenes/draw_buffers.h"
#include "shaders/barycentric.frag.h"
#include "shaders/barycentric.vert.h"

namespace lapilli::samples {
namespace {

struct Vertex {
  std::array<float, 3> position;  // clip space with w = 1
  std::array<float, 3> color;
};

constexpr std::array<VkVertexInputAttributeDescription, 2> kVertexAttributes = {{
    {0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(Vertex, position)},
    {1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(Vertex, color)},
}};

// Corners at angle 0, on a square screen: x to the right, y down, z away.
constexpr std::array<Vertex, 6> kCorners = {{
    {{0.0f, -0.82f, 0.30f}, {1, 0, 0}},
    {{0.78f, 0.58f, 0.45f}, {0, 1, 0}},
    {{-0.78f, 0.58f, 0.20f}, {0, 0, 1}},
    {{0.05f, 0.88f, 0.55f}, {0.95f, 0.85f, 0.55f}},
    {{-0.95f, -0.50f, 0.80f}, {0.20f, 0.22f, 0.30f}},
    {{0.95f, -0.62f, 0.95f}, {0.55f, 0.25f, 0.45f}},
}};
constexpr std::array<uint32_t, 6> kIndices = {0, 1, 2, 3, 4, 5};

class Barycentric final : public Scene {
 public:
  explicit Barycentric(const SceneOptions& options) : options_(options) {
    const float c = std::cos(options.angle);
    const float s = std::sin(options.angle);
    const float squeeze = static_cast<float>(options.height) / static_cast<float>(options.width);
    for (size_t i = 0; i < kCorners.size(); ++i) {
      const auto [x, y, z] = kCorners[i].position;
      vertices_[i] = {{squeeze * (c * x - s * y), s * x + c * y, z}, kCorners[i].color};
    }
  }

  SceneGeometry geometry() const override {
    DrawGeometry draw;
    Attribute color = {Interpolation::kPerspective, 3, {}};
    for (const Vertex& vertex : vertices_) {
      draw.positions.push_back({vertex.position[0], vertex.position[1], vertex.position[2], 1.0f});
      color.values.insert(color.values.end(), vertex.color.begin(), vertex.color.end());
    }
    draw.indices.assign(kIndices.begin(), kIndices.end());
    draw.attributes = {std::move(color)};
    draw.depth_test = true;
    draw.shade = [](const double* in) { return Color{in[0], in[1], in[2], 1.0}; };
    return {options_.width, options_.height, {0.07, 0.08, 0.10, 1.0}, 1.0f, {std::move(draw)}};
  }

  void create_resources(const Context& context) override {
    buffers_ = DrawBuffers(context, std::span<const Vertex>(vertices_), std::span<const uint32_t>(kIndices));
    layout_ = create_pipeline_layout(context, {});
  }

  void create_pipelines(const Context& context, const RenderTarget& target) override {
    GraphicsPipelineInfo info;
    info.vertex_shader = shaders::kBarycentricVert;
    info.fragment_shader = shaders::kBarycentricFrag;
    info.vertices = {sizeof(Vertex), kVertexAttributes};
    info.layout = layout_.get();
    info.render_pass = target.render_pass();
    info.extent = target.extent();
    info.depth_test = true;
    pipeline_ = create_graphics_pipeline(context, info);
  }

  void record(VkCommandBuffer commands) const override {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_.get());
    buffers_.draw(commands);
  }

 private:
  SceneOptions options_;
  std::array<Vertex, 6> vertices_ = {};
  DrawBuffers buffers_;
  PipelineLayout layout_;
  Pipeline pipeline_;
};

}  // namespace

std::unique_ptr<Scene> create_barycentric(const SceneOptions& options) {
  return std::make_unique<Barycentric>(options);
}

}  // namespace lapilli::samples
