#include "audit/joint_gap.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/exact_runs.h"

namespace careen {
namespace {

// Half diagonals 3 and 1.5 m.
World twoBoxes() {
  World world;
  world.bodies = {box("large", Vec3(1, 2, 2), 1, Vec3::Zero()),
                  box("small", Vec3(1, 1, 0.5), 1, Vec3::Zero())};
  return world;
}

// The first's point (1, 0, 0) is the second's (-1, 0, 0) where that is at (2, 0, 0).
Joint joint(Joint::Kind kind) {
  Joint joint{.name = "joint", .kind = kind, .from = {.body = 0}, .to = {.body = 1}};
  joint.from.point = {1, 0, 0};
  joint.to.point = {-1, 0, 0};
  return joint;
}

Pose at(const Vec3& position, const Vec3& axis = Vec3::UnitZ(), double angle = 0) {
  return {.position = position, .worldFromBody = Eigen::AngleAxisd(angle, axis).toRotationMatrix()};
}

// The distance of both points.
TEST(JointGap, ofPointsInCommon) {
  for (const Joint::Kind kind : {Joint::Kind::kBall, Joint::Kind::kHinge, Joint::Kind::kFixed}) {
    EXPECT_EQ(jointGapOf(twoBoxes(), joint(kind), {}, at({2, 0, 0})).open, 0);
    EXPECT_EQ(jointGapOf(twoBoxes(), joint(kind), {}, at({2, 0.75, 1})).open, 1.25);
    EXPECT_EQ(jointGapOf(twoBoxes(), joint(kind), {}, at({2, 0.75, 1})).beyond, 0);
  }
}

// By an angle of which the smaller half diagonal, 1.5 m, takes its corners the chord 2 sin(angle/2).
TEST(JointGap, ofAxesThatAreMisaligned) {
  const auto turned = [](Joint::Kind kind, const Vec3& axis, double angle) {
    Pose pose = at(Vec3::Zero(), axis, angle);
    pose.position = Vec3(1, 0, 0) + pose.worldFromBody.col(0);
    return jointGapOf(twoBoxes(), joint(kind), {}, pose).open;
  };
  constexpr double kAngle = 0.01;
  const double open = 1.5 * 2 * std::sin(kAngle / 2);
  EXPECT_NEAR(turned(Joint::Kind::kBall, Vec3::UnitX(), kAngle), 0, 1e-15);
  EXPECT_NEAR(turned(Joint::Kind::kHinge, Vec3::UnitX(), kAngle), open, 1e-15);
  EXPECT_NEAR(turned(Joint::Kind::kHinge, Vec3::UnitZ(), kAngle), 0, 1e-15);
  EXPECT_NEAR(turned(Joint::Kind::kFixed, Vec3::UnitZ(), kAngle), open, 1e-15);
  EXPECT_NEAR(turned(Joint::Kind::kSlider, Vec3::UnitX(), kAngle), open, 1e-15);
}

// Along its axis, z, a slider is free.
TEST(JointGap, ofASliderIsTheWayOffItsAxis) {
  EXPECT_EQ(jointGapOf(twoBoxes(), joint(Joint::Kind::kSlider), {}, at({2, 0, 7})).open, 0);
  EXPECT_EQ(jointGapOf(twoBoxes(), joint(Joint::Kind::kSlider), {}, at({2.5, 0, 7})).open, 0.5);
}

TEST(JointGap, ofRodsAndRopesIsTheirLength) {
  Joint rod = joint(Joint::Kind::kRod);
  rod.length = 2;
  Joint rope = joint(Joint::Kind::kRope);
  rope.length = 2;
  EXPECT_EQ(jointGapOf(twoBoxes(), rod, {}, at({4.5, 0, 0})).open, 0.5);
  EXPECT_EQ(jointGapOf(twoBoxes(), rod, {}, at({3.5, 0, 0})).open, 0.5);
  EXPECT_EQ(jointGapOf(twoBoxes(), rope, {}, at({4.5, 0, 0})).open, 0.5);
  EXPECT_EQ(jointGapOf(twoBoxes(), rope, {}, at({3.5, 0, 0})).open, 0);
}

// From its lowest -0.5 to its highest 1; the first's coordinate relative to the second's.
TEST(JointGap, beyondLimitsInMetres) {
  Joint slider = joint(Joint::Kind::kSlider);
  slider.lowest = -0.5;
  slider.highest = 1;
  EXPECT_EQ(jointGapOf(twoBoxes(), slider, {}, at({2, 0, -1.25})).beyond, 0.25);
  EXPECT_EQ(jointGapOf(twoBoxes(), slider, {}, at({2, 0, 0.75})).beyond, 0.25);
  EXPECT_EQ(jointGapOf(twoBoxes(), slider, {}, at({2, 0, 0.25})).beyond, 0);
  Joint hinge = joint(Joint::Kind::kHinge);
  hinge.lowest = -0.5;
  hinge.highest = 1;
  EXPECT_NEAR(jointGapOf(twoBoxes(), hinge, {}, at(Vec3::Zero(), Vec3::UnitZ(), 0.75)).beyond, 1.5 * 0.25,
              1e-15);
  EXPECT_NEAR(jointGapOf(twoBoxes(), hinge, {}, at(Vec3::Zero(), Vec3::UnitZ(), -1.25)).beyond, 1.5 * 0.25,
              1e-15);
  EXPECT_EQ(jointGapOf(twoBoxes(), hinge, {}, at(Vec3::Zero(), Vec3::UnitZ(), -0.75)).beyond, 0);
}

// Of a joint to the world, the body is the smaller one.
TEST(JointGap, toTheWorldIsInThatFrame) {
  Joint pin = joint(Joint::Kind::kHinge);
  pin.to = {.body = {}, .point = {1, 0, 0}};
  EXPECT_EQ(jointGapOf(twoBoxes(), pin, {}, at({5, 5, 5}, Vec3::UnitX(), 1)).open, 0);
  EXPECT_NEAR(jointGapOf(twoBoxes(), pin, at(Vec3::Zero(), Vec3::UnitX(), 0.01), {}).open,
              3 * 2 * std::sin(0.005), 1e-15);
}

}  // namespace
}  // namespace careen
