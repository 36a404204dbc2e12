// What a scene draws, without Vulkan: enough for an oracle to compute coverage, depth and colour by itself.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace lapilli::samples {

enum class Interpolation {
  kPerspective,  // the default of GLSL ("smooth")
  kLinear,       // noperspective: linear in the framebuffer
  kFlat,         // the value of the provoking vertex, which is the first of the triangle
};

// One input of the fragment shader, `components` floats for each vertex of the draw.
struct Attribute {
  Interpolation interpolation = Interpolation::kPerspective;
  uint32_t components = 4;
  std::vector<float> values;
};

using Position = std::array<float, 4>;  // clip space, as gl_Position holds it
using Color = std::array<double, 4>;    // red, green, blue, alpha, nominally [0, 1]

// The fragment shader in double. `inputs` holds the interpolated attributes one after another in the order of
// DrawGeometry::attributes. No value means discard.
using Shade = std::function<std::optional<Color>(const double* inputs)>;

// One indexed triangle list. The viewport covers the framebuffer, depth range [0, 1]; no primitive restart.
struct DrawGeometry {
  // The exact bits of gl_Position. Scenes see to it that the vertex shader's arithmetic is exact in float32
  // (exact_transform.h), so these hold for every conforming driver, whatever it fuses or reorders.
  std::vector<Position> positions;
  std::vector<uint32_t> indices;  // three for each triangle
  std::vector<Attribute> attributes;
  bool cull_back_faces = false;  // VK_FRONT_FACE_COUNTER_CLOCKWISE: front if -sum(x_i*y_j - x_j*y_i)/2 > 0 in pixels
  bool depth_test = false;       // VK_COMPARE_OP_LESS; passing fragments write their depth
  bool blend = false;            // rgb: src.a * src + (1 - src.a) * dst; alpha: src.a + (1 - src.a) * dst.a
  Shade shade;
};

// Draws happen in order into an R8G8B8A8_UNORM and a D32_SFLOAT attachment of this size, cleared first. A colour
// is clamped and rounded to 8 bits after each draw (blending reads the rounded one).
struct SceneGeometry {
  uint32_t width = 0;
  uint32_t height = 0;
  Color clear_color = {0, 0, 0, 1};
  float clear_depth = 1.0f;
  std::vector<DrawGeometry> draws;
};

}  // namespace lapilli::samples
