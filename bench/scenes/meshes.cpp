// Scenes of triangles: one, a million that share vertices, tiny ones, a lit mesh.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "common/pipeline.h"
#include "scenes/kinds.h"
#include "scenes/target.h"
#include "shaders/color.frag.h"
#include "shaders/phong.frag.h"
#include "shaders/phong.vert.h"
#include "shaders/screen_color.vert.h"
#include "shaders/terrain.vert.h"

namespace lapilli::bench {
namespace {

using glm::mat4;
using glm::vec2;
using glm::vec3;
using glm::vec4;

struct ScreenVertex {
  vec2 position;  // NDC
  vec3 color;
};
struct TerrainVertex {
  vec3 position;
  vec3 color;
};
struct SurfaceVertex {
  vec3 position;
  vec3 normal;
};

// One draw, with a uniform buffer if the shaders read one.
struct Mesh {
  std::vector<std::byte> vertices;
  uint32_t vertex_count = 0;
  uint32_t stride = 0;
  std::vector<uint32_t> indices;  // none: every vertex once
  std::vector<VkVertexInputAttributeDescription> attributes;
  std::vector<std::byte> uniforms;
  std::span<const uint32_t> vertex_shader;
  std::span<const uint32_t> fragment_shader;
  bool depth_test = false;
  bool cull_back_faces = false;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  Work work;  // without the attachment's bytes
};

template <typename Vertex>
void set_vertices(Mesh& mesh, std::span<const Vertex> vertices) {
  const auto bytes = std::as_bytes(vertices);
  mesh.vertices.assign(bytes.begin(), bytes.end());
  mesh.vertex_count = static_cast<uint32_t>(vertices.size());
  mesh.stride = sizeof(Vertex);
}
template <typename T>
std::vector<std::byte> bytes_of(const T& value) {
  const auto bytes = std::as_bytes(std::span(&value, 1));
  return {bytes.begin(), bytes.end()};
}
// Bytes that geometry reads at the least, once each.
double input_bytes(const Mesh& mesh) {
  return static_cast<double>(mesh.vertices.size() + mesh.indices.size() * sizeof(uint32_t));
}

class MeshScene : public Scene {
 public:
  MeshScene(VkExtent2D extent, Mesh mesh) : extent_(extent), mesh_(std::move(mesh)) {}

  std::string missing(const samples::Context& context) const override {
    return offers_samples(context, mesh_.samples) ? "" : std::to_string(mesh_.samples) + " samples a pixel";
  }
  void create_resources(const samples::Context& context) override {
    target_ = Target(context, extent_, {mesh_.depth_test, mesh_.samples});
    vertices_ = samples::Buffer(context, std::span<const std::byte>(mesh_.vertices), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    if (!mesh_.indices.empty()) {
      indices_ = samples::Buffer(context, std::span<const uint32_t>(mesh_.indices), VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
    }
    if (mesh_.uniforms.empty()) {
      layout_ = samples::create_pipeline_layout(context, {});
      return;
    }
    uniforms_ =
        samples::Buffer(context, std::span<const std::byte>(mesh_.uniforms), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    const samples::Binding binding = samples::BufferBinding{
        VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, &uniforms_};
    set_ = samples::DescriptorSet(context, std::span(&binding, 1));
    const VkDescriptorSetLayout set_layout = set_.layout();
    layout_ = samples::create_pipeline_layout(context, std::span(&set_layout, 1));
  }
  void create_pipelines(const samples::Context& context) override {
    samples::GraphicsPipelineInfo info;
    info.vertex_shader = mesh_.vertex_shader;
    info.fragment_shader = mesh_.fragment_shader;
    info.vertices = {mesh_.stride, mesh_.attributes};
    info.layout = layout_.get();
    info.render_pass = target_.render_pass();
    info.extent = extent_;
    info.depth_test = mesh_.depth_test;
    info.cull_back_faces = mesh_.cull_back_faces;
    info.samples = mesh_.samples;
    pipeline_ = samples::create_graphics_pipeline(context, info);
  }
  void record(VkCommandBuffer commands) const override {
    target_.begin(commands, {0.05f, 0.07f, 0.12f, 1});
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_.get());
    if (VkDescriptorSet set = set_.get()) {
      vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 0, 1, &set, 0, nullptr);
    }
    const VkDeviceSize offset = 0;
    VkBuffer vertices = vertices_.get();
    vkCmdBindVertexBuffers(commands, 0, 1, &vertices, &offset);
    if (mesh_.indices.empty()) {
      vkCmdDraw(commands, mesh_.vertex_count, 1, 0, 0);
    } else {
      vkCmdBindIndexBuffer(commands, indices_.get(), 0, VK_INDEX_TYPE_UINT32);
      vkCmdDrawIndexed(commands, static_cast<uint32_t>(mesh_.indices.size()), 1, 0, 0, 0);
    }
    vkCmdEndRenderPass(commands);
  }
  samples::Frame read_back(const samples::Context& context) const override { return target_.read_back(context); }
  Work work() const override {
    Work work = mesh_.work;
    work.written_bytes += 4.0 * extent_.width * extent_.height;
    work.read_bytes += input_bytes(mesh_);
    return work;
  }

 private:
  VkExtent2D extent_;
  Mesh mesh_;
  Target target_;
  samples::Buffer vertices_, indices_, uniforms_;
  samples::DescriptorSet set_;
  samples::PipelineLayout layout_;
  samples::Pipeline pipeline_;
};

// Projection as Vulkan wants it: y down, depth 0 to 1.
mat4 projection_of(VkExtent2D extent, float vertical_angle) {
  const float aspect = static_cast<float>(extent.width) / static_cast<float>(extent.height);
  mat4 projection = glm::perspective(vertical_angle, aspect, 0.1f, 50.0f);
  projection[1][1] = -projection[1][1];
  return projection;
}

// A (2, 3) torus knot's centre line.
vec3 knot(float t) {
  const float radius = 1.0f + 0.4f * std::cos(3 * t);
  return {radius * std::cos(2 * t), radius * std::sin(2 * t), 0.55f * std::sin(3 * t)};
}

Mesh knot_mesh(VkExtent2D extent, uint32_t triangles) {
  constexpr float kTurn = 6.2831853f;
  const auto sides = static_cast<uint32_t>(std::max(3.0, std::sqrt(triangles / 2.0 / 8)));
  const uint32_t segments = triangles / 2 / sides;
  std::vector<SurfaceVertex> vertices;
  Mesh mesh;
  for (uint32_t s = 0; s < segments; ++s) {
    const float t = kTurn * static_cast<float>(s) / static_cast<float>(segments);
    const vec3 center = knot(t);
    const vec3 forward = glm::normalize(knot(t + 1e-3f) - knot(t - 1e-3f));
    const vec3 right = glm::normalize(glm::cross(forward, center));
    const vec3 up = glm::cross(right, forward);
    for (uint32_t k = 0; k < sides; ++k) {
      const float around = kTurn * static_cast<float>(k) / static_cast<float>(sides);
      const vec3 normal = std::cos(around) * right + std::sin(around) * up;
      vertices.push_back({center + 0.28f * normal, normal});
      const uint32_t next_s = (s + 1) % segments * sides;
      const uint32_t next_k = (k + 1) % sides;
      const uint32_t a = s * sides + k, b = next_s + k, c = next_s + next_k, d = s * sides + next_k;
      mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
    }
  }
  set_vertices(mesh, std::span<const SurfaceVertex>(vertices));
  mesh.attributes = {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0},
                     {1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(SurfaceVertex, normal)}};
  struct Camera {
    mat4 projection, view, model;
    vec4 light, eye;
  };
  const vec3 eye = {0.6f, -2.2f, 2.6f};
  const Camera camera = {projection_of(extent, 0.75f), glm::lookAt(eye, vec3(0), vec3(0, 0, 1)),
                         glm::rotate(mat4(1), 0.4f, vec3(0, 0, 1)), vec4(2, -3, 4, 1), vec4(eye, 1)};
  mesh.uniforms = bytes_of(camera);
  mesh.vertex_shader = shaders::kPhongVert;
  mesh.fragment_shader = shaders::kPhongFrag;
  mesh.depth_test = true;
  mesh.cull_back_faces = true;
  // 46 operations a vertex (three matrices, two of them at best once for all), 40 a triangle that faces us, 55 a pixel
  // of the third of the screen that it covers.
  mesh.work.operations = 46.0 * mesh.vertex_count + 40.0 * triangles / 2 + 55.0 / 3 * extent.width * extent.height;
  return mesh;
}

}  // namespace

std::unique_ptr<Scene> triangle_scene(const SceneOptions& options) {
  const std::array<ScreenVertex, 3> corners = {
      {{{-0.95f, 0.95f}, {1, 0.2f, 0.1f}}, {{0.95f, 0.9f}, {0.1f, 0.9f, 0.3f}}, {{0.05f, -0.95f}, {0.2f, 0.3f, 1}}}};
  Mesh mesh;
  set_vertices(mesh, std::span<const ScreenVertex>(corners));
  mesh.attributes = {{0, 0, VK_FORMAT_R32G32_SFLOAT, 0},
                     {1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(ScreenVertex, color)}};
  mesh.vertex_shader = shaders::kScreenColorVert;
  mesh.fragment_shader = shaders::kColorFrag;
  mesh.work.operations = 10.0 / 2 * options.extent.width * options.extent.height;
  return std::make_unique<MeshScene>(options.extent, std::move(mesh));
}

// Hills under a camera that sees most of them.
std::unique_ptr<Scene> grid_scene(const SceneOptions& options) {
  const auto n = static_cast<uint32_t>(std::ceil(std::sqrt(options.count / 2.0)));  // squares along a side
  std::vector<TerrainVertex> vertices;
  Mesh mesh;
  for (uint32_t j = 0; j <= n; ++j) {
    for (uint32_t i = 0; i <= n; ++i) {
      const float x = static_cast<float>(i) / static_cast<float>(n) * 2 - 1;
      const float y = static_cast<float>(j) / static_cast<float>(n) * 2 - 1;
      const float height =
          0.12f * std::sin(5 * x + 1) * std::cos(4 * y) + 0.05f * std::sin(17 * x) * std::sin(13 * y + 2);
      const float shade = 0.5f + 3 * height;
      vertices.push_back({{x, y, height}, {0.25f + 0.6f * shade, 0.45f + 0.2f * shade * x, 0.3f + 0.3f * y * shade}});
    }
  }
  for (uint32_t j = 0; j < n; ++j) {
    for (uint32_t i = 0; i < n; ++i) {
      const uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
    }
  }
  set_vertices(mesh, std::span<const TerrainVertex>(vertices));
  mesh.attributes = {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0},
                     {1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(TerrainVertex, color)}};
  const mat4 camera =
      projection_of(options.extent, 0.9f) * glm::lookAt(vec3(0.2f, -1.25f, 1.25f), vec3(0, -0.1f, 0), vec3(0, 0, 1));
  mesh.uniforms = bytes_of(camera);
  mesh.vertex_shader = shaders::kTerrainVert;
  mesh.fragment_shader = shaders::kColorFrag;
  mesh.depth_test = true;
  // A matrix, a division and a snap for each vertex; three edges and an area for each triangle; interpolation.
  mesh.work.operations =
      24.0 * mesh.vertex_count + 20.0 * 2 * n * n + 10.0 * 0.7 * options.extent.width * options.extent.height;
  return std::make_unique<MeshScene>(options.extent, std::move(mesh));
}

// Right-angled triangles with legs of 1.4 pixels, scattered; each covers a pixel on average, at every size.
std::unique_ptr<Scene> tiny_scene(const SceneOptions& options) {
  std::vector<ScreenVertex> vertices;
  uint32_t state = 12345;
  const auto random = [&] {
    state = state * 1664525u + 1013904223u;
    return static_cast<float>(state >> 8) / 16777216.0f;
  };
  const vec2 pixel = {2.0f / static_cast<float>(options.extent.width),
                      2.0f / static_cast<float>(options.extent.height)};
  for (uint32_t i = 0; i < options.count; ++i) {
    const vec2 at = {random() * 2 - 1, random() * 2 - 1};
    const vec3 color = {random(), 0.5f + 0.5f * at.x, 0.5f + 0.5f * at.y};
    vertices.push_back({at, color});
    vertices.push_back({at + vec2(1.4f, 0) * pixel, color});
    vertices.push_back({at + vec2(0, 1.4f) * pixel, color});
  }
  Mesh mesh;
  set_vertices(mesh, std::span<const ScreenVertex>(vertices));
  mesh.attributes = {{0, 0, VK_FORMAT_R32G32_SFLOAT, 0},
                     {1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(ScreenVertex, color)}};
  mesh.vertex_shader = shaders::kScreenColorVert;
  mesh.fragment_shader = shaders::kColorFrag;
  // A snap of each vertex, three edges and an area for each triangle, a pixel each.
  mesh.work.operations = (3.0 * 6 + 20 + 10) * options.count;
  return std::make_unique<MeshScene>(options.extent, std::move(mesh));
}

std::unique_ptr<Scene> phong_scene(const SceneOptions& options) {
  return std::make_unique<MeshScene>(options.extent, knot_mesh(options.extent, options.count));
}

std::unique_ptr<Scene> phong_msaa_scene(const SceneOptions& options) {
  Mesh mesh = knot_mesh(options.extent, options.count);
  mesh.samples = VK_SAMPLE_COUNT_4_BIT;
  mesh.work.cached_bytes +=
      4.0 * 8 * options.extent.width * options.extent.height / 3;  // colour and depth of 4 samples
  return std::make_unique<MeshScene>(options.extent, std::move(mesh));
}

}  // namespace lapilli::bench
