// Scene oracle: see scene.h.
#include "oracle/scene.h"

#include <algorithm>
#include <cmath>

#include "oracle/interpolate.h"

namespace lapilli::oracle {
namespace {

using samples::Attribute;
using samples::Color;
using samples::DrawGeometry;
using samples::Interpolation;
using samples::SceneGeometry;

RasterState raster_state(const SceneGeometry& scene, const DrawGeometry& draw) {
  RasterState state;
  state.viewport = {0, 0, float(scene.width), float(scene.height), 0, 1};
  state.scissor = {0, 0, int(scene.width), int(scene.height)};
  state.cull = draw.cull_back_faces ? Cull::kBack : Cull::kNone;
  return state;
}

Triangle triangle_of(const DrawGeometry& draw, size_t first_index) {
  Triangle t;
  for (size_t i = 0; i < 3; ++i) {
    const samples::Position& p = draw.positions[draw.indices[first_index + i]];
    t[i] = {p[0], p[1], p[2], p[3]};
  }
  return t;
}

std::vector<double> inputs_at(const DrawGeometry& draw, size_t first_index, const Weights& weights) {
  std::vector<double> inputs;
  for (const Attribute& a : draw.attributes) {
    for (uint32_t c = 0; c < a.components; ++c) {
      double value[3];
      for (size_t i = 0; i < 3; ++i) value[i] = a.values[size_t(draw.indices[first_index + i]) * a.components + c];
      const double* w = a.interpolation == Interpolation::kLinear ? weights.linear : weights.perspective;
      inputs.push_back(a.interpolation == Interpolation::kFlat ? value[0]
                                                               : w[0] * value[0] + w[1] * value[1] + w[2] * value[2]);
    }
  }
  return inputs;
}

bool unclipped(const Triangle& triangle, const RasterState& state) {
  SnappedPoint ignored;
  return std::all_of(triangle.begin(), triangle.end(),
                     [&](const ClipVertex& v) { return snap_vertex(v, state.viewport, &ignored); });
}

constexpr double kDepthTie = 1e-6;  // float32 rounding of the interpolated depths

double unorm8(double v) { return std::nearbyint(std::clamp(v, 0.0, 1.0) * 255.0) / 255.0; }

Color blended(const Color& src, const Color& dst) {
  Color out;
  for (size_t c = 0; c < 3; ++c) out[c] = src[3] * src[c] + (1 - src[3]) * dst[c];
  out[3] = src[3] + (1 - src[3]) * dst[3];
  return out;
}

// Draws triangle after triangle into an Expected.
class Resolver {
 public:
  Resolver(const SceneGeometry& scene, Expected* out) : scene_(scene), out_(out) {}

  void draw(const DrawGeometry& d) {
    const RasterState state = raster_state(scene_, d);
    for (size_t first = 0; first + 2 < d.indices.size(); first += 3, ++owner_) {
      const Triangle triangle = triangle_of(d, first);
      const TriangleCoverage coverage = cover(triangle, state);
      const Rect& b = coverage.bounds;
      for (int y = b.y; y < b.y + b.height; ++y) {
        for (int x = b.x; x < b.x + b.width; ++x) {
          const Coverage c = coverage.at(x, y);
          if (c != Coverage::kOutside) fragment(d, first, triangle, state, x, y, c);
        }
      }
    }
  }

 private:
  void fragment(const DrawGeometry& d, size_t first, const Triangle& triangle, const RasterState& state, int x, int y,
                Coverage coverage) {
    const size_t at = out_->index(x, y);
    const Weights w = interpolate(triangle, state, Positions::kSnapped, x + 0.5, y + 0.5);
    const double z = double(float(w.depth));
    if (d.depth_test) {
      const double stored = out_->depth[at];
      if (std::abs(z - stored) <= kDepthTie + out_->depth_slack[at]) out_->either[at] = 1;
      if (!(z < stored)) return;
    }
    const std::vector<double> inputs = inputs_at(d, first, w);
    const std::optional<Color> color = d.shade(inputs.data());
    if (!color) return;
    Color result = *color;
    if (d.blend) {
      Color dst = out_->color[at];
      for (double& v : dst) v = unorm8(v);
      for (double& v : result) v = std::clamp(v, 0.0, 1.0);
      result = blended(result, dst);
    }
    for (double& v : result) v = std::clamp(v, 0.0, 1.0);

    Slack slack;
    if (!unclipped(triangle, state)) slack = slack_at(d, first, triangle, state, x, y);
    out_->color[at] = result;
    out_->owner[at] = owner_;
    out_->color_slack[at] = d.blend ? slack.color + out_->color_slack[at] : slack.color;
    if (coverage == Coverage::kEither) out_->either[at] = 1;
    if (d.depth_test) {
      out_->depth[at] = z;
      out_->depth_slack[at] = slack.depth;
    }
  }

  struct Slack {
    float color = 0, depth = 0;
  };
  // How colour and depth differ between a pixel's centre and kSubpixelReach beside it.
  static Slack slack_at(const DrawGeometry& d, size_t first, const Triangle& triangle, const RasterState& state, int x,
                        int y) {
    const Weights centre = interpolate(triangle, state, Positions::kExact, x + 0.5, y + 0.5);
    const std::optional<Color> color = d.shade(inputs_at(d, first, centre).data());
    Slack slack;
    for (const double step : {-kSubpixelReach, kSubpixelReach}) {
      for (const bool vertical : {false, true}) {
        const Weights w = interpolate(triangle, state, Positions::kExact, x + 0.5 + (vertical ? 0 : step),
                                      y + 0.5 + (vertical ? step : 0));
        slack.depth = std::max(slack.depth, float(std::abs(w.depth - centre.depth)));
        const std::optional<Color> other = d.shade(inputs_at(d, first, w).data());
        for (size_t c = 0; color && other && c < 4; ++c) {
          slack.color = std::max(slack.color, float(std::abs((*other)[c] - (*color)[c])));
        }
      }
    }
    return slack;
  }

  const SceneGeometry& scene_;
  Expected* out_;
  int32_t owner_ = 0;
};

template <typename Get>
ImageError compare(const Expected& e, int channels, double tolerance, const std::vector<float>& slack, Get difference) {
  ImageError error;
  double sum = 0;
  for (int y = 0; y < e.height; ++y) {
    for (int x = 0; x < e.width; ++x) {
      const size_t at = e.index(x, y);
      if (e.either[at]) continue;
      ++error.compared;
      bool beyond = false;
      for (int c = 0; c < channels; ++c) {
        const double d = difference(at, c);
        sum += d;
        beyond = beyond || !(d <= tolerance + slack[at]);
        if (!(d <= error.max_abs)) {
          error.max_abs = d;
          error.x = x;
          error.y = y;
          error.channel = c;
        }
      }
      error.beyond += beyond;
    }
  }
  error.mean_abs = error.compared > 0 ? sum / double(error.compared * channels) : 0;
  return error;
}

}  // namespace

Expected resolve(const SceneGeometry& scene) {
  Expected out;
  out.width = int(scene.width);
  out.height = int(scene.height);
  const size_t count = size_t(scene.width) * scene.height;
  out.color.assign(count, scene.clear_color);
  out.depth.assign(count, scene.clear_depth);
  out.owner.assign(count, -1);
  out.either.assign(count, 0);
  out.color_slack.assign(count, 0);
  out.depth_slack.assign(count, 0);
  Resolver resolver(scene, &out);
  for (const DrawGeometry& d : scene.draws) resolver.draw(d);
  return out;
}

NamedTriangle find_triangle(const SceneGeometry& scene, int32_t owner) {
  int32_t first = 0;
  for (const DrawGeometry& d : scene.draws) {
    const int32_t count = int32_t(d.indices.size() / 3);
    if (owner >= first && owner < first + count) {
      return {triangle_of(d, size_t(owner - first) * 3), raster_state(scene, d)};
    }
    first += count;
  }
  return {};
}

ImageError compare_color(const Expected& expected, std::span<const uint8_t> rgba8, double tolerance) {
  return compare(expected, 4, tolerance, expected.color_slack, [&](size_t at, int c) {
    return std::abs(expected.color[at][size_t(c)] - double(rgba8[at * 4 + size_t(c)]) / 255.0);
  });
}

ImageError compare_depth(const Expected& expected, std::span<const float> depth, double tolerance) {
  return compare(expected, 1, tolerance, expected.depth_slack,
                 [&](size_t at, int) { return std::abs(expected.depth[at] - double(depth[at])); });
}

}  // namespace lapilli::oracle
