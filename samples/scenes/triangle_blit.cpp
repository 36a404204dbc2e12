// Draws the picture over the whole screen, then the rectangle around the source triangle as a parallelogram, placed so
// that the triangle in it falls on the target. The mask makes the rest of the parallelogram transparent.
#include "scenes/triangle_blit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "common/pipeline.h"
#include "scenes/draw_buffers.h"
#include "scenes/picture.h"
#include "shaders/triangle_blit.frag.h"
#include "shaders/triangle_blit.vert.h"
#include "shaders/triangle_blit_backdrop.frag.h"

namespace lapilli::samples {
namespace {

constexpr uint32_t kPictureWidth = 640;
constexpr uint32_t kPictureHeight = 480;
constexpr double kMaskSoftness = 3.0;  // texels
constexpr Point kScreen = {640, 480};  // the units of TriangleBlitOptions::target

struct Vertex {
  std::array<float, 2> position;  // clip space with z = 0 and w = 1
  std::array<float, 2> uv;
};
using Quad = std::array<Vertex, 4>;

constexpr std::array<VkVertexInputAttributeDescription, 2> kVertexAttributes = {{
    {0, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(Vertex, position)},
    {1, 0, VK_FORMAT_R32G32_SFLOAT, offsetof(Vertex, uv)},
}};
constexpr std::array<uint32_t, 6> kQuadIndices = {0, 1, 2, 2, 1, 3};

// Painting takes a second, and tests make the scene many times.
const Texture& painted_once() {
  static const Texture picture = volcano_picture(kPictureWidth, kPictureHeight);
  return picture;
}

Triangle turned(const Triangle& triangle, double angle) {
  const Point center = {(triangle[0].x + triangle[1].x + triangle[2].x) / 3,
                        (triangle[0].y + triangle[1].y + triangle[2].y) / 3};
  Triangle result;
  for (size_t i = 0; i < 3; ++i) {
    const double dx = triangle[i].x - center.x;
    const double dy = triangle[i].y - center.y;
    result[i] = {center.x + std::cos(angle) * dx - std::sin(angle) * dy,
                 center.y + std::sin(angle) * dx + std::cos(angle) * dy};
  }
  return result;
}

// The rectangle [low, high] of the picture (texels), each corner where `to_screen` takes it.
Quad mapped_rectangle(Point low, Point high, const AffineMap& to_screen) {
  Quad quad;
  for (size_t i = 0; i < 4; ++i) {
    const Point texel = {(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y};
    const Point screen = to_screen.apply(texel);
    quad[i] = {{static_cast<float>(screen.x / kScreen.x * 2 - 1), static_cast<float>(screen.y / kScreen.y * 2 - 1)},
               {static_cast<float>(texel.x / kPictureWidth), static_cast<float>(texel.y / kPictureHeight)}};
  }
  return quad;
}

Quad backdrop_quad() {
  const AffineMap fill = {kScreen.x / kPictureWidth, 0, 0, 0, kScreen.y / kPictureHeight, 0};
  return mapped_rectangle({0, 0}, {kPictureWidth, kPictureHeight}, fill);
}

Quad cut_out_quad(const TriangleBlitOptions& blit, double angle) {
  const Triangle& source = blit.source;
  const std::optional<AffineMap> map = solve_affine(source, turned(blit.target, angle));
  if (!map) throw std::invalid_argument("triangle_blit: the corners of the source triangle lie on one line");
  // Room for the soft edge of the mask, and for its filter.
  constexpr double kMargin = kMaskSoftness / 2 + 1;
  const auto [left, right] = std::minmax({source[0].x, source[1].x, source[2].x});
  const auto [top, bottom] = std::minmax({source[0].y, source[1].y, source[2].y});
  return mapped_rectangle({left - kMargin, top - kMargin}, {right + kMargin, bottom + kMargin}, *map);
}

DrawGeometry describe(const Quad& quad, bool blend, Shade shade) {
  DrawGeometry draw;
  Attribute uv = {Interpolation::kLinear, 2, {}};
  for (const Vertex& vertex : quad) {
    draw.positions.push_back({vertex.position[0], vertex.position[1], 0.0f, 1.0f});
    uv.values.insert(uv.values.end(), vertex.uv.begin(), vertex.uv.end());
  }
  draw.indices.assign(kQuadIndices.begin(), kQuadIndices.end());
  draw.attributes = {std::move(uv)};
  draw.blend = blend;
  draw.shade = std::move(shade);
  return draw;
}

class TriangleBlit final : public Scene {
 public:
  TriangleBlit(const SceneOptions& options, const TriangleBlitOptions& blit)
      : options_(options),
        backdrop_(backdrop_quad()),
        cut_out_(cut_out_quad(blit, static_cast<double>(options.angle))),
        picture_(painted_once()),
        mask_(triangle_mask(kPictureWidth, kPictureHeight, blit.source, kMaskSoftness)) {}

  SceneGeometry geometry() const override {
    // The functions own what they sample, so that the description may outlive the scene.
    const auto textures = std::make_shared<const std::pair<Texture, Texture>>(picture_, mask_);
    Shade backdrop = [textures](const double* in) {
      const Color texel = sample_bilinear(textures->first, Wrap::kRepeat, in[0], in[1]);
      const double in_color = sample_bilinear(textures->second, Wrap::kClampToEdge, in[0], in[1])[0];
      const double grey = 0.6 * (0.2126 * texel[0] + 0.7152 * texel[1] + 0.0722 * texel[2]);
      Color color = {0, 0, 0, 1};
      for (size_t c = 0; c < 3; ++c) color[c] = grey * (1 - in_color) + texel[c] * in_color;
      return color;
    };
    Shade cut_out = [textures](const double* in) -> std::optional<Color> {
      const double opacity = sample_bilinear(textures->second, Wrap::kClampToEdge, in[0], in[1])[0];
      if (opacity == 0.0) return std::nullopt;
      const Color texel = sample_bilinear(textures->first, Wrap::kRepeat, in[0], in[1]);
      return Color{texel[0], texel[1], texel[2], opacity};
    };
    return {options_.width,
            options_.height,
            {0, 0, 0, 1},
            1.0f,
            {describe(backdrop_, false, std::move(backdrop)), describe(cut_out_, true, std::move(cut_out))}};
  }

  void create_resources(const Context& context) override {
    backdrop_buffers_ =
        DrawBuffers(context, std::span<const Vertex>(backdrop_), std::span<const uint32_t>(kQuadIndices));
    cut_out_buffers_ = DrawBuffers(context, std::span<const Vertex>(cut_out_), std::span<const uint32_t>(kQuadIndices));
    const VkExtent2D extent = {kPictureWidth, kPictureHeight};
    picture_image_ = upload_texture(context, extent, std::as_bytes(std::span(picture_.rgba)));
    mask_image_ = upload_texture(context, extent, std::as_bytes(std::span(mask_.rgba)));
    picture_sampler_ = create_sampler(context, VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_REPEAT);
    mask_sampler_ = create_sampler(context, VK_FILTER_LINEAR, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE);
    const std::array<Binding, 2> bindings = {
        ImageBinding{VK_SHADER_STAGE_FRAGMENT_BIT, &picture_image_, &picture_sampler_},
        ImageBinding{VK_SHADER_STAGE_FRAGMENT_BIT, &mask_image_, &mask_sampler_}};
    descriptors_ = DescriptorSet(context, bindings);
    const VkDescriptorSetLayout set_layout = descriptors_.layout();
    layout_ = create_pipeline_layout(context, std::span(&set_layout, 1));
  }

  void create_pipelines(const Context& context, const RenderTarget& target) override {
    GraphicsPipelineInfo info;
    info.vertex_shader = shaders::kTriangleBlitVert;
    info.fragment_shader = shaders::kTriangleBlitBackdropFrag;
    info.vertices = {sizeof(Vertex), kVertexAttributes};
    info.layout = layout_.get();
    info.render_pass = target.render_pass();
    info.extent = target.extent();
    backdrop_pipeline_ = create_graphics_pipeline(context, info);
    info.fragment_shader = shaders::kTriangleBlitFrag;
    info.blend = true;
    cut_out_pipeline_ = create_graphics_pipeline(context, info);
  }

  void record(VkCommandBuffer commands) const override {
    const VkDescriptorSet set = descriptors_.get();
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 0, 1, &set, 0, nullptr);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, backdrop_pipeline_.get());
    backdrop_buffers_.draw(commands);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, cut_out_pipeline_.get());
    cut_out_buffers_.draw(commands);
  }

 private:
  SceneOptions options_;
  Quad backdrop_;
  Quad cut_out_;
  Texture picture_;
  Texture mask_;
  DrawBuffers backdrop_buffers_;
  DrawBuffers cut_out_buffers_;
  Image picture_image_;
  Image mask_image_;
  Sampler picture_sampler_;
  Sampler mask_sampler_;
  DescriptorSet descriptors_;
  PipelineLayout layout_;
  Pipeline backdrop_pipeline_;
  Pipeline cut_out_pipeline_;
};

}  // namespace

std::unique_ptr<Scene> create_triangle_blit(const SceneOptions& options) { return create_triangle_blit(options, {}); }

std::unique_ptr<Scene> create_triangle_blit(const SceneOptions& options, const TriangleBlitOptions& blit) {
  return std::make_unique<TriangleBlit>(options, blit);
}

}  // namespace lapilli::samples
