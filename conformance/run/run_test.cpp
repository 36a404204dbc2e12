// The runner's arithmetic on small pictures, what it does about drivers that fail, and the page it makes.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "run/report.h"

namespace lapilli::run {
namespace {

namespace fs = std::filesystem;
using samples::Frame;

// Two pixels.
Frame two_pixels(std::array<uint8_t, 4> first, std::array<uint8_t, 4> second, float depth0, float depth1) {
  Frame frame = {2, 1, {}, {depth0, depth1}};
  frame.color.insert(frame.color.end(), first.begin(), first.end());
  frame.color.insert(frame.color.end(), second.begin(), second.end());
  return frame;
}

fs::path scratch() {
  const fs::path directory = fs::path(testing::TempDir()) / "lapilli_run_test";
  fs::create_directories(directory);
  return directory;
}

TEST(Difference, CountsPixelsAndFindsTheLargestStep) {
  const Frame a = two_pixels({10, 20, 30, 255}, {1, 2, 3, 255}, 1.0f, 0.5f);
  const Frame b = two_pixels({10, 20, 30, 255}, {1, 9, 0, 255}, 0.25f, 0.5f);
  const Difference d = difference(a, b, 1.0f);
  EXPECT_EQ(d.pixels, 1);
  EXPECT_EQ(d.largest, 7);
  EXPECT_EQ(d.coverage, 1) << "the first pixel's depth is cleared in one and not in the other";
  EXPECT_EQ(d.depth, 0.75);
  EXPECT_EQ(difference(a, a, 1.0f).pixels, 0);
}

TEST(Difference, PictureIsAmplifiedClampedAndOpaque) {
  const Frame a = two_pixels({10, 20, 30, 255}, {1, 2, 3, 0}, 1, 1);
  const Frame b = two_pixels({11, 20, 0, 255}, {1, 0, 3, 255}, 1, 1);
  EXPECT_EQ(difference_picture(a, b, 64), (std::vector<uint8_t>{64, 0, 255, 255, 0, 128, 0, 255}));
}

TEST(IsEmpty, MeansOneColorEverywhere) {
  EXPECT_TRUE(is_empty(two_pixels({1, 2, 3, 4}, {1, 2, 3, 4}, 0, 1)));
  EXPECT_FALSE(is_empty(two_pixels({1, 2, 3, 4}, {1, 2, 3, 5}, 0, 1)));
}

TEST(Median, IsTheMiddleValue) {
  EXPECT_EQ(median({}), 0);
  EXPECT_EQ(median({3}), 3);
  EXPECT_EQ(median({9, 1, 5}), 5);
  EXPECT_EQ(median({4, 1, 3, 2}), 3);
}

TEST(Measure, ReportsADriverThatEndsAtOnce) {
  Plan plan;
  plan.program = "/bin/false";
  plan.scratch = scratch();
  const std::vector<Measurement> results = measure("barycentric", {{"/none.json", "nobody"}}, plan);
  ASSERT_EQ(results.size(), 1u);
  EXPECT_FALSE(results[0].frame.has_value());
  EXPECT_EQ(results[0].failure, "no first frame: exit status 1");
}

// One triangle over the left pixel of two, white; the oracle knows the rest.
samples::SceneGeometry left_pixel() {
  samples::DrawGeometry draw;
  draw.positions = {{-1, -3, 0.5f, 1}, {-1, 3, 0.5f, 1}, {0, 0, 0.5f, 1}};
  draw.indices = {0, 1, 2};
  draw.depth_test = true;
  draw.shade = [](const double*) { return samples::Color{1, 1, 1, 1}; };
  return {2, 1, {0, 0, 0, 1}, 1.0f, {draw}};
}

std::vector<SceneReport> reports_of(const std::string& directory) {
  Measurement ours;
  ours.driver = {"ours.json", "Ours"};
  ours.device = "ours";
  ours.timings = {1, 2, 3, 0.5};
  ours.frame = two_pixels({255, 255, 255, 255}, {0, 0, 0, 255}, 0.5f, 1.0f);
  Measurement theirs = ours;
  theirs.driver = {"theirs.json", "Theirs"};
  theirs.frame = two_pixels({255, 255, 255, 255}, {9, 0, 0, 255}, 0.5f, 0.5f);
  Measurement gone;
  gone.driver = {"gone.json", "Gone"};
  gone.failure = "no first frame: signal 11";
  return {make_report("corner", "one pixel of two", left_pixel(), {ours, theirs, gone}, directory)};
}

TEST(Report, ComparesWithTheOracleAndWithTheFirstDriver) {
  const SceneReport report = reports_of(scratch())[0];
  ASSERT_EQ(report.rows.size(), 3u);
  EXPECT_EQ(report.triangles, 1u);
  EXPECT_EQ(report.rows[0].error.largest, 0);
  EXPECT_EQ(report.rows[0].error.coverage, 0);
  EXPECT_NEAR(report.rows[1].error.largest, 9, 1e-9);
  EXPECT_EQ(report.rows[1].error.coverage, 1);
  EXPECT_EQ(report.rows[1].error.beyond, 1);
  EXPECT_EQ(report.rows[1].from_first.largest, 9);
  EXPECT_TRUE(report.rows[2].picture.empty());
}

TEST(Report, TableNamesEveryDriverAndEveryFailure) {
  const std::string text = table(reports_of(scratch()));
  for (const char* part : {"corner", "Ours", "Theirs", "Gone", "no first frame: signal 11", "median frame [ms]"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
}

TEST(Page, HoldsPicturesAndDiagramsItself) {
  const fs::path directory = scratch();
  const nlohmann::json data = page(reports_of(directory), Plan());
  std::ofstream(directory / "results.json") << data.dump();
  const std::string command = std::string(LAPILLI_PYTHON " '" LAPILLI_PAGE_SCRIPT "' '") +
                              (directory / "results.json").string() + "' '" + (directory / "page.html").string() + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  std::stringstream html;
  html << std::ifstream(directory / "page.html").rdbuf();
  const std::string text = html.str();
  const auto count = [&](const std::string& part) {
    int found = 0;
    for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count("src=\"data:image/png;base64,"), 3) << "two drivers' pictures and one difference";
  EXPECT_EQ(count("src="), 3) << "nothing is loaded from elsewhere";
  EXPECT_EQ(count("<svg"), 2);
  EXPECT_NE(text.find("no first frame: signal 11"), std::string::npos);
}

}  // namespace
}  // namespace lapilli::run
