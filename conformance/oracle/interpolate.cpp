// Interpolation oracle: see interpolate.h.
#include "oracle/interpolate.h"

#include <algorithm>

#include "oracle/homogeneous.h"

namespace lapilli::oracle {

Weights interpolate(const Triangle& triangle, const RasterState& state, Positions positions, double x, double y) {
  std::array<SnappedPoint, 3> points;
  bool unclipped = true;
  for (size_t i = 0; i < 3; ++i) unclipped = snap_vertex(triangle[i], state.viewport, &points[i]) && unclipped;
  const Homogeneous h = unclipped && positions == Positions::kSnapped ? homogeneous_snapped(triangle, points)
                                                                      : homogeneous_exact(triangle, state.viewport);

  // (x, y, 1) = sum(lambda * vertex): the clip-space point with w = 1, so sum(lambda) is 1/w of the fragment,
  // sum(lambda * z) its z/w, and lambda * w are the weights that are linear on the screen.
  const std::array<Wide, 3> lambda = homogeneous_weights(h, x, y);
  const Wide inverse_w = lambda[0] + lambda[1] + lambda[2];
  Wide z = 0;
  Weights out{};
  for (size_t i = 0; i < 3; ++i) {
    out.perspective[i] = double(lambda[i] / inverse_w);
    out.linear[i] = double(lambda[i] * triangle[i].w);
    z += lambda[i] * triangle[i].z;
  }
  const Viewport& v = state.viewport;
  const Wide depth = z * (Wide(v.max_depth) - v.min_depth) + v.min_depth;
  out.depth =
      std::clamp(double(depth), double(std::min(v.min_depth, v.max_depth)), double(std::max(v.min_depth, v.max_depth)));
  out.inverse_w = double(inverse_w);
  return out;
}

}  // namespace lapilli::oracle
