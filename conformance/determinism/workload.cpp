// See workload.h.
#include "determinism/workload.h"

#include <random>

#include "shader/numbers.h"
#include "shaders/control_flow.comp.h"
#include "shaders/float_basic.comp.h"
#include "shaders/float_functions.comp.h"

namespace lapilli::conformance {
namespace {

constexpr uint32_t kSide = 200;

std::vector<TriangleDraw> random_triangles(uint32_t seed, int count, bool blend) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> xy(-1.3f, 1.3f), z(-0.2f, 1.2f), w(0.3f, 3), color(0, 1);
  TriangleDraw d;
  d.raster = full_state(kSide, kSide);
  d.count = blend;
  for (int i = 0; i < count * 3; ++i) {
    const float weight = w(random);
    d.vertices.push_back({xy(random) * weight, xy(random) * weight, z(random) * weight, weight});
    d.colors.push_back({color(random), color(random), color(random), color(random)});
  }
  return {d};
}

}  // namespace

Workload::Workload() : triangles_(random_triangles(1, 400, false)), blended_(random_triangles(2, 60, true)) {
  const FloatOperands operands = float_operands(3);
  floats_a_ = operands.a;
  floats_b_ = operands.b;
  ints_ = int_operands(4).a;
  prepare_scenes();
}

void Workload::prepare_scenes() {
  scenes_.clear();
  for (const samples::SceneEntry& entry : samples::scenes()) {
    scenes_.emplace_back(std::string(entry.name), entry.create({kSide, 150, 0.7f}));
  }
}

std::vector<Result> Workload::run(const samples::Context& context, const std::function<void()>& after_part) const {
  std::vector<Result> out;
  const auto add = [&](std::string name, Bytes bytes) {
    if (after_part) after_part();
    out.push_back({std::move(name), std::move(bytes)});
  };
  for (auto& [name, scene] : scenes_) {
    if (!scene) continue;
    samples::SceneRenderer renderer(context, std::move(scene));
    renderer.draw_frame();
    const samples::Frame frame = renderer.read_back();
    add(name + " colour", to_bytes(frame.color));
    add(name + " depth", to_bytes(frame.depth));
  }
  add("triangles", to_bytes(draw_triangles(context, kSide, kSide, triangles_)));
  add("blended triangles", to_bytes(draw_triangles(context, kSide, kSide, blended_)));
  for (const int op : {0, 2, 3, 4, 17, 19, 20, 21, 22}) {
    add("float operation " + std::to_string(op),
        to_bytes(run_op(context, shaders::kFloatBasicComp, op, floats_a_, floats_b_, floats_a_)));
  }
  for (int op = 0; op < 18; ++op) {
    add("float function " + std::to_string(op),
        to_bytes(run_op(context, shaders::kFloatFunctionsComp, op, floats_a_, floats_b_, floats_a_)));
  }
  ComputeRun flow;
  flow.shader = shaders::kControlFlowComp;
  flow.buffers = {to_bytes(ints_), Bytes(ints_.size() * 4)};
  flow.groups[0] = uint32_t((ints_.size() + 63) / 64);
  flow.push_constants = to_bytes(std::vector<uint32_t>{99});
  add("control flow", run_compute(context, flow)[1]);
  return out;
}

std::string first_difference(const std::vector<Result>& a, const std::vector<Result>& b) {
  if (a.size() != b.size()) return "another number of results";
  for (size_t i = 0; i < a.size(); ++i) {
    if (a[i].bytes.size() != b[i].bytes.size()) return a[i].name + ": another size";
    size_t count = 0, first = 0;
    for (size_t k = 0; k < a[i].bytes.size(); ++k) {
      if (a[i].bytes[k] == b[i].bytes[k]) continue;
      if (count++ == 0) first = k;
    }
    if (count != 0) {
      return a[i].name + ": " + std::to_string(count) + " bytes differ, the first at " + std::to_string(first);
    }
  }
  return {};
}

}  // namespace lapilli::conformance
