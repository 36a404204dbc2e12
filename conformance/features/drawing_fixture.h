// A canvas, the pipeline for flat colours, and rectangles to draw with it.
#pragma once

#include <array>
#include <vector>

#include "harness/canvas.h"
#include "harness/devices.h"
#include "harness/graphics.h"
#include "shaders/flat_color.frag.h"
#include "shaders/position_color.vert.h"

namespace lapilli::conformance {

using ColoredVertex = std::array<float, 8>;  // clip-space position, colour

// Two triangles over the pixels of `area` of a width x height canvas.
inline void add_rectangle(std::vector<ColoredVertex>& vertices, const Canvas& canvas, const VkRect2D& area, float depth,
                          std::array<float, 4> c) {
  const float w = static_cast<float>(canvas.width()), h = static_cast<float>(canvas.height());
  const float x0 = static_cast<float>(area.offset.x) / w * 2 - 1, y0 = static_cast<float>(area.offset.y) / h * 2 - 1;
  const float x1 = x0 + static_cast<float>(area.extent.width) / w * 2;
  const float y1 = y0 + static_cast<float>(area.extent.height) / h * 2;
  const auto vertex = [&](float x, float y) { return ColoredVertex{x, y, depth, 1, c[0], c[1], c[2], c[3]}; };
  const ColoredVertex corners[] = {vertex(x0, y0), vertex(x1, y0), vertex(x0, y1),
                                   vertex(x0, y1), vertex(x1, y0), vertex(x1, y1)};
  vertices.insert(vertices.end(), std::begin(corners), std::end(corners));
}

struct FlatPipeline {
  explicit FlatPipeline(const Canvas& canvas, bool depth = false)
      : layout(create_layout(subject())), pipeline(make(canvas, layout.get(), depth)) {}

  samples::PipelineLayout layout;
  samples::Pipeline pipeline;

  void bind(VkCommandBuffer commands, const samples::Buffer& vertices) const {
    const VkBuffer buffer = vertices.get();
    const VkDeviceSize offset = 0;
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
    vkCmdBindVertexBuffers(commands, 0, 1, &buffer, &offset);
  }

 private:
  static samples::Pipeline make(const Canvas& canvas, VkPipelineLayout layout, bool depth) {
    PipelineState state;
    state.vertex_shader = shaders::kPositionColorVert;
    state.fragment_shader = shaders::kFlatColorFrag;
    state.depth_test = state.depth_write = depth;
    state.layout = layout;
    state.render_pass = canvas.render_pass();
    return create_pipeline(subject(), state);
  }
};

}  // namespace lapilli::conformance
