// The scenes of the benchmark as tests: the same bits whatever the threads and vectors, close to the peer's pictures,
// and nothing for the validation layer to say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "harness/devices.h"
#include "harness/images.h"
#include "scenes/renderer.h"

namespace lapilli::bench {

void PrintTo(const SceneEntry& entry, std::ostream* out) { *out << entry.name; }

}  // namespace lapilli::bench

namespace lapilli::conformance {
namespace {

using bench::SceneEntry;
using samples::Frame;

constexpr VkExtent2D kExtent = {200, 150};  // no multiple of a tile

// How far a picture may be from the peer's.
struct Closeness {
  int steps = 2;      // of 8 bits
  double beyond = 0;  // share of the pixels that may be further apart
};
Closeness closeness(std::string_view scene) {
  if (scene == "blend") return {5, 0};          // it blends in 8 bits, layer after layer
  if (scene == "mandelbrot") return {2, 5e-3};  // the boundary is chaotic
  if (scene == "ray_march") return {2, 1e-3};   // silhouettes
  if (scene == "shadow_map") return {2, 1e-3};  // depths compared at the edges of shadows
  return {};
}

class Environment {
 public:
  Environment(const char* name, const char* value) : name_(name) { setenv(name, value, 1); }
  ~Environment() { unsetenv(name_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
};

class BenchScene : public testing::TestWithParam<SceneEntry> {
 protected:
  void SetUp() override {
    if (!create_scene(GetParam(), {kExtent})->missing(subject()).empty()) GTEST_SKIP() << "the device lacks something";
    ours_ = draw_once(subject(), GetParam(), kExtent);
  }
  void expect_same(const std::string& what) const {
    const auto context = new_subject();
    EXPECT_EQ(draw_once(*context, GetParam(), kExtent).color, ours_.color) << what;
  }
  Frame ours_;
};

TEST_P(BenchScene, ShowsSomething) {
  std::set<uint32_t> colors;
  for (size_t i = 0; i < ours_.color.size(); i += 4) {
    colors.insert(uint32_t{ours_.color[i]} | uint32_t{ours_.color[i + 1]} << 8 | uint32_t{ours_.color[i + 2]} << 16);
  }
  const bool few = GetParam().name == "matmul" || GetParam().name == "histogram";  // results that are much alike
  EXPECT_GE(colors.size(), GetParam().name == "clear" ? 1u : few ? 5u : 20u);
}

TEST_P(BenchScene, HasTheSameBitsWhateverTheThreads) {
  for (const char* threads : {"1", "2", "7"}) {
    const Environment set("LAPILLI_THREADS", threads);
    expect_same(std::string(threads) + " threads");
  }
}

TEST_P(BenchScene, HasTheSameBitsWhateverTheVectors) {
  for (const char* target : {"sse2", "avx2", "avx3"}) {
    const Environment set("LAPILLI_SIMD", target);
    expect_same(target);
  }
}

// What a draw is spared (base/removals.h of the driver) may not be seen.
TEST_P(BenchScene, HasTheSameBitsWhateverIsLeftOut) {
  for (const char* kept : {"all", "hidden", "blocks", "triangles", "vertices", "varyings", "uniforms", "outputs"}) {
    const Environment set("LAPILLI_KEEP", kept);
    expect_same(std::string("kept: ") + kept);
  }
}

TEST_P(BenchScene, IsCloseToThePeers) {
  if (peer() == nullptr) GTEST_SKIP() << "no peer to compare with";
  const Frame theirs = draw_once(*peer(), GetParam(), kExtent);
  ASSERT_EQ(theirs.color.size(), ours_.color.size());
  const Closeness close = closeness(GetParam().name);
  int64_t apart = 0;
  int largest = 0;
  for (size_t i = 0; i < ours_.color.size(); i += 4) {
    int most = 0;
    for (size_t c = 0; c < 4; ++c) most = std::max(most, std::abs(ours_.color[i + c] - theirs.color[i + c]));
    apart += most > close.steps ? 1 : 0;
    largest = std::max(largest, most);
  }
  EXPECT_LE(static_cast<double>(apart), close.beyond * kExtent.width * kExtent.height)
      << "the largest difference is " << largest;
  std::printf("  %s: %lld pixels differ by more than %d, at most by %d\n", std::string(GetParam().name).c_str(),
              static_cast<long long>(apart), close.steps, largest);
  if (HasFailure()) write_comparison("bench_" + std::string(GetParam().name), ours_, theirs);
}

TEST_P(BenchScene, LeavesTheValidationLayerSilent) {
  samples::ContextOptions options;
  options.device_name = subject_name();
  options.validation = true;
  const samples::Context context(options);
  if (!context.validation_active()) GTEST_SKIP() << "VK_LAYER_KHRONOS_validation is not installed";
  {
    bench::SceneRenderer renderer(context, create_scene(GetParam(), {{160, 120}, GetParam().small_count}));
    renderer.draw_frame();
    renderer.draw_frame();
    renderer.read_back();
  }
  for (const std::string& message : context.messages()) ADD_FAILURE() << message;
}

INSTANTIATE_TEST_SUITE_P(All, BenchScene, testing::ValuesIn(bench::scenes().begin(), bench::scenes().end()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace lapilli::conformance
