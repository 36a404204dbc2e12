// Scene oracle: resolves draws with depth test and blending to the colour, depth and coverage that an image must have,
// in float64. Takes the geometry description of samples/scenes, so that any scene can be checked:
//   const oracle::Expected expected = oracle::resolve(scene.geometry());
//   const oracle::ColorError error = oracle::compare_color(expected, rgba8_pixels);
#pragma once

#include <span>
#include <string>

#include "oracle/coverage.h"
#include "scenes/geometry.h"

namespace lapilli::oracle {

struct Expected {
  int width = 0, height = 0;
  std::vector<std::array<double, 4>> color;  // not quantized after the last draw that wrote it; [0, 1]
  std::vector<double> depth;
  // Index of the triangle (counted over all draws) that is seen at the pixel; -1: the clear colour.
  std::vector<int32_t> owner;
  // 1: coverage (clipping, coverage.h) or the depth test is decided by less than rounding: either result is right.
  std::vector<uint8_t> either;
  // Of clipped triangles: how much the colour (depth) changes within kSubpixelReach of the pixel's centre, which is
  // what snapping the points that clipping made may do to it. 0 for all others.
  std::vector<float> color_slack;
  std::vector<float> depth_slack;

  bool covered(int x, int y) const { return owner[index(x, y)] >= 0; }
  size_t index(int x, int y) const { return size_t(y) * size_t(width) + size_t(x); }
};

inline constexpr double kSubpixelReach = 1.0 / 256.0;  // pixels

Expected resolve(const samples::SceneGeometry& scene);

// The triangle that Expected::owner names, and the raster state it was drawn with: for explanations.
struct NamedTriangle {
  Triangle triangle;
  RasterState state;
};
NamedTriangle find_triangle(const samples::SceneGeometry& scene, int32_t owner);

// Error of an image against the oracle over the pixels that are not `either`.
struct ImageError {
  double max_abs = 0;   // largest difference of one component, 1.0 = full scale
  double mean_abs = 0;  // over the components compared
  int x = -1, y = -1;   // where max_abs is
  int channel = 0;
  int64_t compared = 0;  // pixels
  int64_t beyond = 0;    // pixels that differ by more than the tolerance (plus the pixel's slack)
};
// `rgba8`: width * height * 4 bytes, R8G8B8A8_UNORM.
ImageError compare_color(const Expected& expected, std::span<const uint8_t> rgba8, double tolerance = 1.0 / 255.0);
ImageError compare_depth(const Expected& expected, std::span<const float> depth, double tolerance = 1e-6);

}  // namespace lapilli::oracle
