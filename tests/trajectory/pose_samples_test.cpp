#include "trajectory/pose_samples.h"

#include <gtest/gtest.h>

#include "support/trajectories.h"

namespace careen {
namespace {

TEST(PoseSamples, rowsAreTheStatesOfTheRun) {
  const Trajectory run = driftAndReturn();
  const PoseRow row = poseRow(run, 0, 0.25);
  EXPECT_EQ(row.time, 0.25);
  EXPECT_EQ(row.box, 0U);
  EXPECT_EQ(row.position, Vec3(1.5, 0, 0));
  EXPECT_EQ(row.velocity, Vec3(2, 0, 0));
  EXPECT_EQ(row.worldFromBody.coeffs(), Quat::Identity().coeffs());
}

TEST(PoseSamples, timesAreMultiplesThatEndWithTheRun) {
  Trajectory run = driftAndReturn();
  EXPECT_EQ(sampleTimes(run, 0.4), (std::vector<double>{0, 0.4, 0.8}));
  run.settings.duration = 1.2;
  EXPECT_EQ(sampleTimes(run, 0.05).size(), 25U);  // 24 · 0.05 is 1.2000000000000002
  EXPECT_EQ(sampleTimes(run, 0.05).back(), 1.2);
}

}  // namespace
}  // namespace careen
