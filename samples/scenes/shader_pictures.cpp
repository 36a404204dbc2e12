// A triangle without vertex buffers and a fragment shader that does the rest.
#include "scenes/shader_pictures.h"

#include <array>

#include "common/pipeline.h"
#include "shaders/bits.frag.h"
#include "shaders/full_screen.vert.h"
#include "shaders/functions.frag.h"
#include "shaders/holes.frag.h"
#include "shaders/mandelbrot.frag.h"
#include "shaders/noise.frag.h"
#include "shaders/ray_march.frag.h"

namespace lapilli::samples {

std::span<const ShaderPicture> shader_pictures() {
  static constexpr std::array<ShaderPicture, 6> kPictures = {{
      {"bits", "integer arithmetic: every driver gives the same bits", shaders::kBitsFrag},
      {"functions", "a chart of GLSL.std.450 and its neighbours", shaders::kFunctionsFrag},
      {"holes", "discard in a function in a loop, and derivatives", shaders::kHolesFrag},
      {"mandelbrot", "a loop of a different length in every lane", shaders::kMandelbrotFrag},
      {"noise", "hashes, nested loops and a switch that lanes take differently", shaders::kNoiseFrag},
      {"ray_march", "nested calls, early returns, loops within loops", shaders::kRayMarchFrag},
  }};
  return kPictures;
}

Frame draw_shader_picture(const Context& context, const ShaderPicture& picture, VkExtent2D extent) {
  const std::array<float, 2> size = {static_cast<float>(extent.width), static_cast<float>(extent.height)};
  const VkPushConstantRange push = {VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(size)};
  const PipelineLayout layout = create_pipeline_layout(context, {}, std::span(&push, 1));
  const RenderTarget target(context, extent);
  GraphicsPipelineInfo info;
  info.vertex_shader = shaders::kFullScreenVert;
  info.fragment_shader = picture.fragment_shader;
  info.layout = layout.get();
  info.render_pass = target.render_pass();
  info.extent = extent;
  info.depth_test = true;
  const Pipeline pipeline = create_graphics_pipeline(context, info);

  VkCommandBuffer commands = context.begin_commands();
  target.begin(commands, {0.09f, 0.10f, 0.12f, 1.0f}, 1.0f);
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
  vkCmdPushConstants(commands, layout.get(), VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(size), size.data());
  vkCmdDraw(commands, 3, 1, 0, 0);
  target.end(commands);
  context.submit_and_wait(commands);
  return target.read_back(context);
}

}  // namespace lapilli::samples
