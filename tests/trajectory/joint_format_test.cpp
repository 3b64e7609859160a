#include "trajectory/joint_format.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "support/trajectories.h"
#include "trajectory/trajectory_file.h"

namespace careen {
namespace {

// Every number another, so that none can stand in another's place.
TEST(JointFormat, bringsBackJointsAndTheirImpulses) {
  Trajectory run = driftAndReturn();
  Mat3 turned;
  turned << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  run.world.joints = {{.name = "knee",
                       .kind = Joint::Kind::kHinge,
                       .from = {.body = 1, .point = {1, 2, 3}, .axes = turned},
                       .to = {.body = 0, .point = {4, 5, 6}},
                       .lowest = -0.5,
                       .highest = 0.75,
                       .restitution = 0.25,
                       .stiffness = 12,
                       .rest = 13,
                       .damping = 14,
                       .grip = 16,
                       .keptRate = -17},
                      {.name = "leash",
                       .kind = Joint::Kind::kRope,
                       .from = {.body = 0},
                       .to = {.body = {}, .point = {7, 8, 9}},
                       .length = 10,
                       .until = 11}};
  run.world.apart = {{0, 1}};
  run.jointImpulses = {
      {.time = 0.5, .joint = 1, .point = {1, 2, 3}, .linear = {4, 5, 6}, .angular = {7, 8, 9}}};
  run.jointEfforts = {{.time = 0.25, .joint = 1, .effort = 15}};
  const std::string bytes = encodeTrajectory(run);
  const Trajectory back = decodeTrajectory(bytes, "run.careen");
  EXPECT_EQ(encodeTrajectory(back), bytes);
  ASSERT_EQ(back.world.joints.size(), 2U);
  const Joint& knee = back.world.joints[0];
  EXPECT_EQ(knee.name, "knee");
  EXPECT_EQ(knee.kind, Joint::Kind::kHinge);
  EXPECT_EQ(knee.from.body, 1);
  EXPECT_EQ(knee.from.point, Vec3(1, 2, 3));
  EXPECT_EQ(knee.from.axes, turned);
  EXPECT_EQ(knee.to.point, Vec3(4, 5, 6));
  EXPECT_EQ(knee.lowest, -0.5);
  EXPECT_EQ(knee.highest, 0.75);
  EXPECT_EQ(knee.restitution, 0.25);
  EXPECT_EQ(knee.until, Joint::kFree);
  EXPECT_EQ(knee.stiffness, 12);
  EXPECT_EQ(knee.rest, 13);
  EXPECT_EQ(knee.damping, 14);
  EXPECT_EQ(knee.grip, 16);
  EXPECT_EQ(knee.keptRate, -17);
  const Joint& leash = back.world.joints[1];
  EXPECT_EQ(leash.kind, Joint::Kind::kRope);
  EXPECT_EQ(leash.to.body, std::nullopt);
  EXPECT_EQ(leash.length, 10);
  EXPECT_EQ(leash.lowest, -Joint::kFree);
  EXPECT_EQ(leash.until, 11);
  EXPECT_EQ(back.world.apart, (std::vector<std::pair<int, int>>{{0, 1}}));
  ASSERT_EQ(back.jointImpulses.size(), 1U);
  const JointImpulse& impulse = back.jointImpulses[0];
  EXPECT_EQ(impulse.time, 0.5);
  EXPECT_EQ(impulse.joint, 1);
  EXPECT_EQ(impulse.point, Vec3(1, 2, 3));
  EXPECT_EQ(impulse.linear, Vec3(4, 5, 6));
  EXPECT_EQ(impulse.angular, Vec3(7, 8, 9));
  ASSERT_EQ(back.jointEfforts.size(), 1U);
  EXPECT_EQ(back.jointEfforts[0].time, 0.25);
  EXPECT_EQ(back.jointEfforts[0].joint, 1);
  EXPECT_EQ(back.jointEfforts[0].effort, 15);
}

// Joints are not part of the last state, whose hash compares runs.
TEST(JointFormat, leavesTheHashOfTheLastState) {
  Trajectory run = driftAndReturn();
  const std::string hash = run.stateHash();
  run.world.apart = {{0, 1}};
  EXPECT_EQ(run.stateHash(), hash);
}

}  // namespace
}  // namespace careen
