// Interpolation oracle: weights, depth and 1/w of a triangle at a pixel's centre, without rounding to float32. Vulkan
// chapter "Rasterization", "Basic Polygon Rasterization".
#pragma once

#include "oracle/coverage.h"

namespace lapilli::oracle {

enum class Positions : uint8_t {
  kSnapped,  // vertices where 8 subpixel bits put them (what the driver's planes go through); exact if clipped
  kExact,    // vertices where the float32 clip coordinates are: what is lost by snapping is seen too
};

struct Weights {
  double perspective[3];  // sum 1: multiply with the vertices' values for a "smooth" input
  double linear[3];       // sum 1: noperspective
  double depth;           // z_f, in the viewport's depth range
  double inverse_w;       // gl_FragCoord.w
};

// Weights at (x, y) in pixels, e.g. (px + 0.5, py + 0.5). The triangle must have an area.
Weights interpolate(const Triangle& triangle, const RasterState& state, Positions positions, double x, double y);

}  // namespace lapilli::oracle
