// The table of goals on figures made up for it, the page, and the limits of the machine that runs this.
#include "report.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace lapilli::bench {
namespace {

Result result_of(const char* driver, double frame) {
  Result result;
  result.driver = driver;
  result.device = driver;
  result.frame = frame;
  result.cpu = 2 * frame;
  result.turns = {frame};
  result.cpu_turns = {2 * frame};
  result.pipelines = frame;
  result.first_frame = frame / 2;
  return result;
}

Series series_of(const char* scene, double ours, double lavapipe, double swiftshader, double limit) {
  Series series;
  series.scene = scene;
  series.limit = {limit, "memory"};
  series.results = {result_of("Lapilli", ours), result_of("lavapipe", lavapipe), result_of("SwiftShader", swiftshader)};
  return series;
}

Findings findings_of(std::vector<Series> series) {
  Findings found;
  found.drivers = {{"", "Lapilli"}, {"", "lavapipe"}, {"", "SwiftShader"}};
  found.series = std::move(series);
  return found;
}

const Goal& find(const std::vector<Goal>& goals, std::string_view part) {
  for (const Goal& goal : goals) {
    if (goal.what.find(part) != std::string::npos) return goal;
  }
  ADD_FAILURE() << "no goal about " << part;
  return goals.front();
}

TEST(Series, ComparesWithTheFasterPeer) {
  Series series = series_of("blend", 2, 9, 8, 1);
  EXPECT_EQ(series.ratio(), 4);
  series.results[2].absent = "gone";
  EXPECT_EQ(series.ratio(), 4.5);
  series.results[0].absent = "gone";
  EXPECT_EQ(series.ratio(), 0);
}

// The machine runs at half its speed in the second round: medians of the turns would compare one speed with the other.
TEST(Series, ComparesTurnsOfTheSameRound) {
  Series series = series_of("blend", 0, 0, 0, 1);
  series.results[0].turns = {1, 2, 1, 2, 2};
  series.results[1].turns = {4, 8, 4, 8, 8};
  series.results[2].turns = {5, 10, 5, 5, 5};
  EXPECT_EQ(series.ratio(), 4);
}

TEST(Goals, AreUnknownWithoutFigures) {
  for (const Goal& goal : goals_of(findings_of({}))) EXPECT_EQ(goal.verdict, Verdict::unknown) << goal.what;
}

TEST(Goals, HoldOrNot) {
  Findings found = findings_of({series_of("blend", 1, 4, 5, 0.3), series_of("bilinear", 1, 2.9, 9, 0.2),
                                series_of("grid", 1, 4, 9, 1), series_of("tiny", 1, 5, 4.5, 1),
                                series_of("layers_btf", 1, 16, 99, 1)});
  found.two_threads = {{"blend", 1.9, 1}, {"clear", 0.2, 0.2}};
  found.starts = {{"Lapilli", "", 2.5, 9000, 0}, {"nothing", "", 1.0, 6000, 0}};
  const std::vector<Goal> goals = goals_of(found);
  EXPECT_EQ(find(goals, "every scene, frame").verdict, Verdict::holds);
  EXPECT_EQ(find(goals, "blending").verdict, Verdict::holds);
  EXPECT_EQ(find(goals, "bilinear").verdict, Verdict::fails);
  EXPECT_EQ(find(goals, "million-triangle").verdict, Verdict::holds);
  EXPECT_EQ(find(goals, "64 opaque layers").verdict, Verdict::unknown) << "front to back is missing";
  // The two best, 16 and 4.5, are left out: the cube root of 2.9 * 4 * 4.
  EXPECT_EQ(find(goals, "geometric mean").measured, "3.59×");
  EXPECT_EQ(find(goals, "geometric mean").verdict, Verdict::fails);
  EXPECT_EQ(find(goals, "two threads").verdict, Verdict::holds) << "the short frame does not count";
  EXPECT_EQ(find(goals, "instance + device").verdict, Verdict::fails) << "1.5 ms more";
  EXPECT_EQ(find(goals, "limit").verdict, Verdict::holds) << "bilinear is at five times its limit, with a reason";
  EXPECT_NE(find(goals, "limit").detail.find("bilinear 5.00× (reason given)"), std::string::npos);
}

TEST(Goals, EveryScenesDistanceHasAReason) {
  for (const SceneEntry& entry : scenes()) EXPECT_NE(reason_for_distance(entry.name), "") << entry.name;
  EXPECT_EQ(find(goals_of(findings_of({series_of("new", 5, 9, 9, 1)})), "limit").verdict, Verdict::fails);
}

TEST(Goals, CountPipelinesWithTheFirstFrame) {
  const Findings found = findings_of({series_of("pipelines", 2, 400, 90, 1), series_of("triangle", 0.6, 9, 9, 0.5)});
  EXPECT_EQ(find(goals_of(found), "200 pipelines").verdict, Verdict::fails) << "45 times SwiftShader";
  EXPECT_EQ(find(goals_of(found), "200 pipelines").measured, "45.0×; 200.0× (3.00 ms)");
  EXPECT_EQ(find(goals_of(found), "first frame of one").verdict, Verdict::holds) << "0.9 ms";
}

TEST(Page, HoldsEverythingItself) {
  Findings found = findings_of({series_of("blend", 1, 4, 5, 0.3), series_of("bilinear", 1, 2.9, 9, 0.2)});
  found.series[1].results[2].absent = "needs patience";
  found.two_threads = {{"blend", 1.9, 1}};
  found.growth = {{"layers", "layers", {{"Lapilli", 1, 1}, {"Lapilli", 4, 2}}}};
  found.starts = {{"Lapilli", "", 2.5, 9000, 0}, {"nothing", "", 1.0, 6000, 0}};
  const std::filesystem::path directory = testing::TempDir();
  std::ofstream(directory / "bench.json") << page(found).dump();
  ASSERT_TRUE(run::write_page(directory / "bench.json", directory / "bench.html"));
  std::stringstream html;
  html << std::ifstream(directory / "bench.html").rdbuf();
  for (const char* part : {"blend", "needs patience", "<svg", "What must be true", "nothing"}) {
    EXPECT_NE(html.str().find(part), std::string::npos) << part;
  }
  EXPECT_EQ(html.str().find("src=\"http"), std::string::npos);
}

TEST(Line, ShowsFramesRatiosAndAbsences) {
  Series series = series_of("blend", 2, 8, 9, 1);
  EXPECT_NE(line(series).find("4.00"), std::string::npos);
  series.results[0].absent = "needs 4 samples a pixel";
  EXPECT_NE(line(series).find("Lapilli: needs 4 samples a pixel"), std::string::npos);
}

TEST(Machine, LimitIsTheLongestOfItsParts) {
  const Machine machine;
  EXPECT_GT(machine.rates().operations, 0);
  EXPECT_GT(machine.rates().loads, 0);
  EXPECT_GT(machine.rates().cached, 0);
  if (machine.threads() > 1) {
    EXPECT_GT(machine.scaling().operations, 0.5);
  }
  EXPECT_STREQ(machine.limit_of({.operations = 1e12}).resource, "arithmetic");
  EXPECT_STREQ(machine.limit_of({.loads = 1e12}).resource, "loads");
  EXPECT_STREQ(machine.limit_of({.cached_bytes = 1e13}).resource, "cache");
  EXPECT_STREQ(machine.limit_of({.written_bytes = 1e6, .operations = 1}).resource, "memory");
}

}  // namespace
}  // namespace lapilli::bench
