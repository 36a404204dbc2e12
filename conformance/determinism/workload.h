// One picture of what the driver computes: pixels of scenes, triangles and blending, results of compute shaders. Its
// inputs are made once, so that runs under another floating-point mode start from the same bits.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "coverage/draw_triangles.h"
#include "harness/compute.h"
#include "scenes/renderer.h"

namespace lapilli::conformance {

struct Result {
  std::string name;
  Bytes bytes;
};

class Workload {
 public:
  Workload();
  // Everything on one device; scenes only if they have been prepared. `after_part` is called after each part, e.g. to
  // look at the control register.
  std::vector<Result> run(const samples::Context& context, const std::function<void()>& after_part = {}) const;
  // Scenes hold Vulkan objects once they have been drawn: new ones for every run, made before the mode is changed.
  void prepare_scenes();
  void forget_scenes() { scenes_.clear(); }

 private:
  std::vector<TriangleDraw> triangles_, blended_;
  std::vector<float> floats_a_, floats_b_;
  std::vector<uint32_t> ints_;
  mutable std::vector<std::pair<std::string, std::unique_ptr<samples::Scene>>> scenes_;
};

// The first difference, or an empty string.
std::string first_difference(const std::vector<Result>& a, const std::vector<Result>& b);

}  // namespace lapilli::conformance
