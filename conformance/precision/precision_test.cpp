// A sample of what docs/precision.md lists: every function within the specification's bound, and Lapilli within its
// own.
#include <gtest/gtest.h>

#include "harness/devices.h"
#include "precision/measure.h"

namespace lapilli::precision {
namespace {

using conformance::subject;
using conformance::subject_is_lapilli;

Judge judge() { return subject_is_lapilli() ? Judge::everything : Judge::specified; }

std::string at(const Worst& worst) {
  std::ostringstream text;
  text << std::hexfloat << "at";
  for (const float x : worst.operands) text << ' ' << x;
  return text.str();
}

void expect_within(const Measured& measured) {
  EXPECT_GT(measured.judged, 1000u) << measured.name;
  EXPECT_LE(measured.share.value, 1) << measured.name << ' ' << at(measured.share);
  if (!subject_is_lapilli()) return;
  EXPECT_LE(measured.ulp.value, measured.promised) << measured.name << ' ' << at(measured.ulp);
  EXPECT_EQ(measured.special.value, 0) << measured.name << ' ' << at(measured.special);
}

TEST(Precision, FunctionsOfOneOperand) {
  for (const OneOperand& function : functions_of_one()) expect_within(measure(subject(), judge(), function, 4093));
}

TEST(Precision, FunctionsOfSeveralOperands) {
  for (const SeveralOperands& function : functions_of_several()) {
    expect_within(measure(subject(), judge(), function, 100'000, 1));
  }
}

TEST(Precision, Edges) {
  if (!subject_is_lapilli()) GTEST_SKIP() << "Vulkan leaves most of them open";
  for (const Edge& edge : edges()) {
    const std::vector<float> got = run_edge(subject(), edge);
    EXPECT_TRUE(same(got, edge.result)) << edge.text << " gives " << testing::PrintToString(got);
  }
}

}  // namespace
}  // namespace lapilli::precision
