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

// Spun about its centre of mass, the box's middle circles it: a row has the middle's place and velocity.
TEST(PoseSamples, rowsAreOfTheMiddleOfTheBox) {
  Trajectory run = driftAndReturn();
  run.world.bodies[0].boxCenter = Vec3(0, 0.1, 0);
  run.world.bodies[0].mass = solidBox(run.world.bodies[0].halfExtents, 1);
  Flight flight{.velocity = Vec3(2, 0, 0),
                .angularMomentum = 3 * run.world.bodies[0].mass.inertiaBody.z() * Vec3::UnitZ()};
  run.tracks[0].segments = {{.start = 0, .motion = flight}};
  const PoseRow row = poseRow(run, 0, 0);
  EXPECT_LT((row.position - Vec3(0, 0.1, 0)).norm(), 1e-16);
  EXPECT_LT((row.velocity - Vec3(2 - 0.3, 0, 0)).norm(), 1e-15);
  EXPECT_LT((run.boxPoseAt(0, 0).position - row.position).norm(), 1e-16);
  EXPECT_LT((run.poses(0.2)[0].position - poseRow(run, 0, 0.2).position).norm(), 1e-16);
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
