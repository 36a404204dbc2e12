// Every scene on the driver under test: against the float64 oracle, and against lavapipe (in sanitizer builds: against
// the images that lavapipe drew, in references/). Where lavapipe differs, the oracle must explain it.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "harness/devices.h"
#include "harness/images.h"
#include "oracle/scene.h"
#include "scenes/renderer.h"

namespace lapilli::conformance {
namespace {

using samples::Frame;
using samples::SceneGeometry;

struct View {
  std::string scene;
  uint32_t width, height;
  float angle;  // radians
};

void PrintTo(const View& v, std::ostream* out) { *out << v.scene << " " << v.width << "x" << v.height; }

constexpr int kColorBar = 1;           // largest difference of an 8-bit component from lavapipe
constexpr double kPeerDepth = 2e-4;    // lavapipe's planes go through unsnapped vertices and are anchored at (0, 0)
constexpr double kOracleDepth = 1e-6;  // float32 rounding
constexpr double kOracleColor = 0.51 / 255.0;  // rounding to 8 bits, and a little for float32
constexpr double kCloseToEdge = 1.0 / 64.0;    // pixels; as far as lavapipe's coverage may differ

Frame render(const samples::Context& context, const View& view) {
  const samples::SceneOptions options = {view.width, view.height, view.angle};
  samples::SceneRenderer renderer(context, samples::create_scene(view.scene, options));
  renderer.draw_frame();
  return renderer.read_back();
}

bool covered(const Frame& f, const SceneGeometry& g, size_t at) {
  if (f.depth[at] != g.clear_depth) return true;
  for (size_t c = 0; c < 4; ++c) {
    if (std::abs(double(f.color[at * 4 + c]) - g.clear_color[c] * 255) > 1) return true;
  }
  return false;
}

int color_difference(const Frame& a, const Frame& b, size_t at) {
  int most = 0;
  for (size_t c = 0; c < 4; ++c) most = std::max(most, std::abs(int(a.color[at * 4 + c]) - int(b.color[at * 4 + c])));
  return most;
}

// Distance from the pixel's centre to the nearest edge of any triangle: only asked for the few pixels that differ.
double nearest_edge(const SceneGeometry& g, int x, int y) {
  double nearest = 1e9;
  for (const samples::DrawGeometry& d : g.draws) {
    for (size_t i = 0; i + 2 < d.indices.size(); i += 3) {
      oracle::Triangle t;
      for (size_t k = 0; k < 3; ++k) {
        const samples::Position& p = d.positions[d.indices[i + k]];
        t[k] = {p[0], p[1], p[2], p[3]};
      }
      oracle::RasterState state;
      state.viewport = {0, 0, float(g.width), float(g.height), 0, 1};
      nearest = std::min(nearest, std::abs(oracle::edge_distance(t, state, x, y)));
    }
  }
  return nearest;
}

void check_against_oracle(const SceneGeometry& g, const oracle::Expected& e, const Frame& ours) {
  int64_t wrong = 0, undecided = 0;
  for (int y = 0; y < e.height; ++y) {
    for (int x = 0; x < e.width; ++x) {
      const size_t at = e.index(x, y);
      undecided += e.either[at];
      if (e.either[at] || covered(ours, g, at) == e.covered(x, y)) continue;
      // A covered pixel may look like the clear colour.
      bool looks_clear = e.depth[at] == double(g.clear_depth);
      for (size_t c = 0; c < 4; ++c) looks_clear &= std::abs(e.color[at][c] - g.clear_color[c]) * 255 <= 2;
      if (e.covered(x, y) && looks_clear) continue;
      if (++wrong <= 5) {
        ADD_FAILURE() << "coverage of (" << x << ", " << y << ") differs from the oracle, " << nearest_edge(g, x, y)
                      << " pixels from an edge";
      }
    }
  }
  EXPECT_EQ(wrong, 0) << "pixels of coverage";
  const oracle::ImageError color = oracle::compare_color(e, ours.color, kOracleColor);
  EXPECT_EQ(color.beyond, 0) << "colours; the worst is " << color.max_abs << " at (" << color.x << ", " << color.y
                             << "), channel " << color.channel;
  const oracle::ImageError depth = oracle::compare_depth(e, ours.depth, kOracleDepth);
  EXPECT_EQ(depth.beyond, 0) << "depths; the worst is " << depth.max_abs << " at (" << depth.x << ", " << depth.y
                             << ")";
  EXPECT_LE(undecided, e.width * e.height / 100) << "the oracle leaves too much open";
  testing::Test::RecordProperty("oracle_color_error", std::to_string(color.max_abs));
  testing::Test::RecordProperty("oracle_depth_error", std::to_string(depth.max_abs));
}

// Differences that the oracle does not explain in our favour are failures.
void check_against_peer(const View& view, const SceneGeometry& g, const oracle::Expected& e, const Frame& ours,
                        const Frame& theirs) {
  ASSERT_EQ(ours.color.size(), theirs.color.size());
  int64_t ours_seen = 0, theirs_seen = 0, explained = 0, unexplained = 0;
  for (int y = 0; y < e.height; ++y) {
    for (int x = 0; x < e.width; ++x) {
      const size_t at = e.index(x, y);
      const bool we_cover = covered(ours, g, at), they_cover = covered(theirs, g, at);
      ours_seen += we_cover;
      theirs_seen += they_cover;
      const int color = color_difference(ours, theirs, at);
      const double depth = std::abs(double(ours.depth[at]) - double(theirs.depth[at]));
      if (we_cover == they_cover && color <= kColorBar && depth <= kPeerDepth) continue;
      // Explained: so close to an edge that the peer's rounding may decide otherwise, and the oracle agrees with us.
      double worst = 0;
      for (size_t c = 0; c < 4; ++c) {
        worst = std::max(worst, std::abs(e.color[at][c] - double(ours.color[at * 4 + c]) / 255));
      }
      const bool oracle_agrees =
          e.either[at] || (worst <= kOracleColor + double(e.color_slack[at]) &&
                           std::abs(e.depth[at] - double(ours.depth[at])) <= kOracleDepth + double(e.depth_slack[at]));
      const double distance = nearest_edge(g, x, y);
      double peer_error = 0;
      for (size_t c = 0; c < 4; ++c) {
        peer_error = std::max(peer_error, std::abs(e.color[at][c] - double(theirs.color[at * 4 + c]) / 255));
      }
      // Or the peer's own colour is more than a step from the truth (its texture filter), by which we differ by two.
      const bool peer_imprecise = we_cover == they_cover && color == kColorBar + 1 && peer_error > 1.0 / 255;
      if (oracle_agrees && (distance <= kCloseToEdge || peer_imprecise)) {
        ++explained;
        std::printf(
            "  explained: (%d, %d) of %s, %.2g pixels from an edge: the oracle has our value, the peer is off by "
            "%.2f steps\n",
            x, y, view.scene.c_str(), distance, peer_error * 255);
        continue;
      }
      if (++unexplained <= 5) {
        ADD_FAILURE() << "(" << x << ", " << y << ") differs from the peer: colour by " << color << ", depth by "
                      << depth << ", coverage " << we_cover << " / " << they_cover << ", " << distance
                      << " pixels from an edge, oracle " << (oracle_agrees ? "agrees" : "disagrees") << " with us";
      }
    }
  }
  EXPECT_EQ(unexplained, 0);
  EXPECT_LE(explained, e.width * e.height / 1000) << "too many to be rounding";
  EXPECT_GT(ours_seen, 0) << "our image is empty";
  EXPECT_GT(theirs_seen, 0) << "the peer's image is empty";
  testing::Test::RecordProperty("explained_pixels", std::to_string(explained));
  if (testing::Test::HasFailure()) {
    write_comparison(view.scene + "_" + std::to_string(view.width), ours, theirs);
    std::printf("images: %s/%s_%u_*.png\n", output_directory().c_str(), view.scene.c_str(), view.width);
  }
}

// lavapipe's bits depend on the host (whether it fuses multiply-add, its estimates of reciprocals): say which it was.
void write_host(const std::string& path) {
  std::ofstream out(path);
  out << "Drawn by: " << peer()->properties().deviceName << ", driver version " << std::hex
      << peer()->properties().driverVersion << "\n";
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line) && !line.empty();) {
    const bool wanted = line.starts_with("vendor_id") || line.starts_with("model") || line.starts_with("cpu family") ||
                        line.starts_with("stepping") || line.starts_with("flags");
    if (wanted) out << line << "\n";
  }
}

class Scenes : public testing::TestWithParam<View> {};

TEST_P(Scenes, MatchOracleAndPeer) {
  const View view = GetParam();
  const SceneGeometry geometry = samples::create_scene(view.scene, {view.width, view.height, view.angle})->geometry();
  const oracle::Expected expected = oracle::resolve(geometry);
  const Frame ours = render(subject(), view);
  check_against_oracle(geometry, expected, ours);
  if (peer() != nullptr) check_against_peer(view, geometry, expected, ours, render(*peer(), view));
}

// The stored images of lavapipe: small, so that sanitizer builds have something to compare with.
TEST_P(Scenes, MatchStoredImageOfThePeer) {
  const View view = {GetParam().scene, 128, 96, GetParam().angle};
  if (GetParam().width != 640 || view.angle != 0) GTEST_SKIP() << "one stored image for each scene";
  const SceneGeometry geometry = samples::create_scene(view.scene, {view.width, view.height, view.angle})->geometry();
  const std::string path = std::string(LAPILLI_REFERENCES) + "/" + view.scene;
  if (std::getenv("LAPILLI_WRITE_REFERENCES") != nullptr && peer() != nullptr) {
    write_frame(path, render(*peer(), view));
    write_host(std::string(LAPILLI_REFERENCES) + "/HOST.txt");
  }
  const std::optional<Frame> theirs = read_frame(path);
  ASSERT_TRUE(theirs) << path << " cannot be read";
  const oracle::Expected expected = oracle::resolve(geometry);
  const Frame ours = render(subject(), view);
  check_against_oracle(geometry, expected, ours);
  check_against_peer(view, geometry, expected, ours, *theirs);
}

std::vector<View> views() {
  std::vector<View> out;
  for (const samples::SceneEntry& scene : samples::scenes()) {
    out.push_back({std::string(scene.name), 640, 480, 0});
    out.push_back({std::string(scene.name), 333, 257, 1.3f});  // no multiple of a tile
  }
  return out;
}

INSTANTIATE_TEST_SUITE_P(All, Scenes, testing::ValuesIn(views()),
                         [](const auto& kind) { return kind.param.scene + "_" + std::to_string(kind.param.width); });

}  // namespace
}  // namespace lapilli::conformance
