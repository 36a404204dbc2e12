// See draw_triangles.h.
#include "coverage/draw_triangles.h"

#include <map>
#include <tuple>

#include "harness/graphics.h"
#include "shaders/flat_color.frag.h"
#include "shaders/position_color.vert.h"

namespace lapilli::conformance {
namespace {

struct Vertex {
  oracle::ClipVertex position;
  std::array<float, 4> color;
};
static_assert(sizeof(Vertex) == 32);

VkPrimitiveTopology vk_topology(Topology topology) {
  switch (topology) {
    case Topology::kStrip:
      return VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP;
    case Topology::kFan:
      return VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN;
    default:
      return VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  }
}

VkCullModeFlags vk_cull(oracle::Cull cull) {
  switch (cull) {
    case oracle::Cull::kFront:
      return VK_CULL_MODE_FRONT_BIT;
    case oracle::Cull::kBack:
      return VK_CULL_MODE_BACK_BIT;
    case oracle::Cull::kBoth:
      return VK_CULL_MODE_FRONT_AND_BACK;
    default:
      return VK_CULL_MODE_NONE;
  }
}

samples::Pipeline pipeline_for(const samples::Context& context, const TriangleDraw& draw, VkPipelineLayout layout,
                               VkRenderPass render_pass) {
  PipelineState state;
  state.vertex_shader = shaders::kPositionColorVert;
  state.fragment_shader = shaders::kFlatColorFrag;
  state.topology = vk_topology(draw.topology);
  state.primitive_restart = draw.primitive_restart;
  state.cull = vk_cull(draw.raster.cull);
  state.front_face = draw.raster.front_is_clockwise ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE;
  if (draw.count) {
    state.blend = {VK_TRUE,
                   VK_BLEND_FACTOR_ONE,
                   VK_BLEND_FACTOR_ONE,
                   VK_BLEND_OP_ADD,
                   VK_BLEND_FACTOR_ONE,
                   VK_BLEND_FACTOR_ONE,
                   VK_BLEND_OP_ADD,
                   0xF};
  }
  state.layout = layout;
  state.render_pass = render_pass;
  return create_pipeline(context, state);
}

}  // namespace

oracle::RasterState full_state(uint32_t width, uint32_t height) {
  oracle::RasterState state;
  state.viewport = {0, 0, float(width), float(height), 0, 1};
  state.scissor = {0, 0, int(width), int(height)};
  return state;
}

std::vector<std::array<uint32_t, 3>> assemble(const TriangleDraw& draw) {
  std::vector<std::vector<uint32_t>> runs(1);
  if (draw.index_type == Indices::kNone) {
    for (uint32_t i = 0; i < draw.vertices.size(); ++i) runs[0].push_back(i);
  }
  for (const uint32_t index : draw.indices) {
    const bool restart = draw.primitive_restart && index == (draw.index_type == Indices::k16 ? 0xFFFFu : 0xFFFFFFFFu);
    if (restart) {
      runs.emplace_back();
    } else {
      runs.back().push_back(uint32_t(int32_t(index) + draw.vertex_offset));
    }
  }
  std::vector<std::array<uint32_t, 3>> out;
  for (const std::vector<uint32_t>& r : runs) {
    if (draw.topology == Topology::kList) {
      for (size_t i = 0; i + 2 < r.size(); i += 3) out.push_back({r[i], r[i + 1], r[i + 2]});
    } else {
      for (size_t i = 0; i + 2 < r.size(); ++i) {
        if (draw.topology == Topology::kFan) {
          out.push_back({r[i + 1], r[i + 2], r[0]});
        } else {
          out.push_back({r[i], r[i + 1 + i % 2], r[i + 2 - i % 2]});
        }
      }
    }
  }
  return out;
}

std::vector<uint32_t> draw_triangles(const samples::Context& context, uint32_t width, uint32_t height,
                                     std::span<const TriangleDraw> draws) {
  const Canvas canvas(context, {.width = width, .height = height});
  const samples::PipelineLayout layout = create_layout(context);
  using Key = std::tuple<Topology, bool, oracle::Cull, bool, bool>;
  std::map<Key, samples::Pipeline> pipelines;
  std::vector<Vertex> vertices;
  std::vector<std::byte> indices;
  for (const TriangleDraw& draw : draws) {
    const float unit = draw.count ? 1.0f / 255.0f : 1.0f;
    for (size_t i = 0; i < draw.vertices.size(); ++i) {
      const bool colored = !draw.colors.empty() && !draw.count;
      vertices.push_back({draw.vertices[i], colored ? draw.colors[i] : std::array{unit, unit, unit, unit}});
    }
    for (const uint32_t index : draw.indices) {
      const size_t bytes = draw.index_type == Indices::k16 ? 2 : 4;  // little endian
      const size_t at = indices.size();
      indices.resize(at + bytes);
      std::memcpy(&indices[at], &index, bytes);
    }
    while (indices.size() % 4 != 0) indices.push_back(std::byte{0});
  }
  if (indices.empty()) indices.resize(4);
  const samples::Buffer vertex_buffer(context, std::span<const Vertex>(vertices), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
  const samples::Buffer index_buffer(context, std::span<const std::byte>(indices), VK_BUFFER_USAGE_INDEX_BUFFER_BIT);

  VkCommandBuffer commands = context.begin_commands();
  canvas.begin(commands, {});
  VkDeviceSize vertex_at = 0, index_at = 0;
  for (const TriangleDraw& draw : draws) {
    const Key key = {draw.topology, draw.primitive_restart, draw.raster.cull, draw.raster.front_is_clockwise,
                     draw.count};
    if (!pipelines.contains(key)) {
      pipelines[key] = pipeline_for(context, draw, layout.get(), canvas.render_pass());
    }
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines[key].get());
    const oracle::Viewport& v = draw.raster.viewport;
    const VkViewport viewport = {v.x, v.y, v.width, v.height, v.min_depth, v.max_depth};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    const oracle::Rect& s = draw.raster.scissor;
    const VkRect2D scissor = {{s.x, s.y}, {uint32_t(s.width), uint32_t(s.height)}};
    vkCmdSetScissor(commands, 0, 1, &scissor);
    const VkBuffer buffer = vertex_buffer.get();
    vkCmdBindVertexBuffers(commands, 0, 1, &buffer, &vertex_at);
    if (draw.index_type == Indices::kNone) {
      vkCmdDraw(commands, uint32_t(draw.vertices.size()), 1, 0, 0);
    } else {
      const bool narrow = draw.index_type == Indices::k16;
      vkCmdBindIndexBuffer(commands, index_buffer.get(), index_at,
                           narrow ? VK_INDEX_TYPE_UINT16 : VK_INDEX_TYPE_UINT32);
      vkCmdDrawIndexed(commands, uint32_t(draw.indices.size()), 1, 0, draw.vertex_offset, 0);
      index_at += (draw.indices.size() * (narrow ? 2 : 4) + 3) / 4 * 4;
    }
    vertex_at += draw.vertices.size() * sizeof(Vertex);
  }
  Canvas::end(commands);
  context.submit_and_wait(commands);
  return canvas.read_color<uint32_t>();
}

}  // namespace lapilli::conformance
