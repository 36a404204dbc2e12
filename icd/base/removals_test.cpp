// LAPILLI_KEEP, and the ledger's sums.
#include "base/removals.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace lapilli {
namespace {

class RemovalsTest : public testing::Test {
 protected:
  void TearDown() override {
    unsetenv("LAPILLI_KEEP");
    set_kept_removals(0);
  }
};

TEST_F(RemovalsTest, AreKeptByName) {
  setenv("LAPILLI_KEEP", "varyings,hidden", 1);
  set_kept_removals_from_environment();
  EXPECT_TRUE(keeps(Removal::varyings));
  EXPECT_TRUE(keeps(Removal::hidden));
  EXPECT_FALSE(keeps(Removal::uniforms));
}

TEST_F(RemovalsTest, NoneIsKeptWithoutTheVariable) {
  set_kept_removals(~0u);
  set_kept_removals_from_environment();
  EXPECT_EQ(kept_removals(), 0u);
}

TEST_F(RemovalsTest, UnknownNamesChangeNothing) {
  setenv("LAPILLI_KEEP", "nonsense,,blocks", 1);
  set_kept_removals_from_environment();
  EXPECT_EQ(kept_removals(), 1u << static_cast<uint32_t>(Removal::blocks));
}

TEST_F(RemovalsTest, AllNamesAreKnown) {
  setenv("LAPILLI_KEEP", "all", 1);
  set_kept_removals_from_environment();
  for (size_t i = 0; i < kRemovalCount; ++i) {
    EXPECT_TRUE(keeps(static_cast<Removal>(i))) << removal_info(static_cast<Removal>(i)).name;
  }
}

TEST(Ledger, AddsUp) {
  DrawLedger ledger;
  add_to_ledger(&ledger, Removal::hidden, 3, 30);
  add_to_ledger(&ledger, Removal::hidden, 4, 40);
  add_vertices_to_ledger(&ledger, 3, 30);
  add_fragments_to_ledger(&ledger, 64, 640);
  add_fragments_to_ledger(nullptr, 64, 640);
  const DrawLedger::Line& line = ledger.lines[static_cast<size_t>(Removal::hidden)];
  EXPECT_EQ(line.count, 7u);
  EXPECT_EQ(line.lane_ops, 70u);
  EXPECT_EQ(ledger.vertices, 3u);
  EXPECT_EQ(ledger.fragments, 64u);
  EXPECT_EQ(ledger.lane_ops_run, 670u);
}

}  // namespace
}  // namespace lapilli
