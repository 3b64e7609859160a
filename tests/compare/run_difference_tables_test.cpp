// Runs that come from tables of poses.
#include <gtest/gtest.h>

#include "compare/run_difference.h"
#include "support/exact_runs.h"
#include "trajectory/export_csv.h"
#include "trajectory/given_run.h"
#include "trajectory/pose_table.h"

namespace careen {
namespace {

Trajectory recordedBouncing(double duration = 2) {
  return record(elasticRoom(), {.duration = duration}, "a scene");
}

PoseTable tableOf(const Trajectory& run, double every) {
  std::string text;
  writePosesCsv(run, every, [&text](std::string_view piece) { text += piece; });
  return readPoseTable(text, "t.csv");
}

Trajectory given(const PoseTable& table) {
  RunSetup setup = recordedBouncing();
  return givenRun(std::move(setup), table);
}

TEST(RunDifferenceOfTables, aTableOfARunIsThatRun) {
  const Trajectory run = recordedBouncing();
  for (const double every : {0.01, 0.0007, 0.3}) {
    const RunDifference found = differenceOf(run, given(tableOf(run, every)));
    EXPECT_FALSE(found.firstTime || found.horizon || found.firstImpact || found.lastImpact);
    EXPECT_LT(found.worst.difference.relative, kTableRounding);
    EXPECT_LE(found.growth.size(), kRunSamples + 2U);
    EXPECT_GE(found.expectedImpacts, 5U);
  }
}

// From 0.9 s on a box is off, at first by little.
TEST(RunDifferenceOfTables, fromWhenByHowMuchAndAfterWhichImpact) {
  const Trajectory run = recordedBouncing();
  PoseTable table = tableOf(run, 0.01);
  for (PoseRow& row : table.rows) {
    row.position.x() += row.time > 0.9 ? 1e-3 * (row.time - 0.9) : 0;
  }
  const RunDifference found = differenceOf(run, given(table));
  ASSERT_TRUE(found.firstTime);
  EXPECT_NEAR(*found.firstTime, 0.91, 1e-12);
  EXPECT_NEAR(found.worst.difference.position, 1.1e-3, 1e-12);
  EXPECT_FALSE(found.horizon);
  ASSERT_TRUE(found.lastImpact);
  const auto before = static_cast<std::size_t>(std::count_if(
      run.impacts.begin(), run.impacts.end(), [](const Impact& impact) { return impact.time <= 0.91; }));
  ASSERT_GT(before, 0U);
  EXPECT_EQ(found.lastImpact->index, before - 1);
  EXPECT_EQ(found.lastImpact->what, describe(run.impacts[before - 1], run));
  // Within a tolerance it is the same, and seen later.
  EXPECT_NEAR(*differenceOf(run, given(table), 9, 1e-4).firstTime, 0.97, 1e-12);
  EXPECT_FALSE(differenceOf(run, given(table), 9, 1e-2).firstTime);
  EXPECT_FALSE(differenceOf(run, given(table), 0.9).firstTime);
  // The other way round.
  EXPECT_EQ(differenceOf(given(table), run).firstTime, found.firstTime);
  EXPECT_EQ(differenceOf(given(table), run).lastImpact->what, found.lastImpact->what);
}

TEST(RunDifferenceOfTables, oneThatLeavesHasAHorizon) {
  const Trajectory run = recordedBouncing();
  PoseTable table = tableOf(run, 0.01);
  for (PoseRow& row : table.rows) {
    row.position.x() += row.time > 0.5 ? row.time - 0.5 : 0;
  }
  const RunDifference found = differenceOf(run, given(table));
  EXPECT_NEAR(found.horizon.value_or(0), 0.5, 1e-12);
  EXPECT_LT(found.worst.difference.relative, kHorizonDifference);
}

}  // namespace
}  // namespace careen
