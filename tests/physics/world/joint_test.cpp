#include "physics/world/joint.h"

#include <gtest/gtest.h>

#include <cmath>

namespace careen {
namespace {

constexpr double kPi = 3.141592653589793;

Pose turnedAboutZ(double angle) {
  Pose pose;
  pose.worldFromBody << std::cos(angle), -std::sin(angle), 0, std::sin(angle), std::cos(angle), 0, 0, 0, 1;
  return pose;
}

Joint hinge(double lowest = -Joint::kFree, double highest = Joint::kFree) {
  Joint joint;
  joint.kind = Joint::Kind::kHinge;
  joint.from.body = 0;
  joint.lowest = lowest;
  joint.highest = highest;
  return joint;
}

// The world's end stays what it is, whatever pose it is given.
TEST(Joint, endsAreInTheFrameOfTheirBody) {
  JointEnd end{.body = 3, .point = {1, 0, 0}, .axes = turnedAboutZ(kPi / 2).worldFromBody};
  Pose pose = turnedAboutZ(kPi / 2);
  pose.position = {0, 0, 2};
  EXPECT_LT((end.pointAt(pose) - Vec3(0, 1, 2)).norm(), 1e-15);
  EXPECT_LT((end.axesAt(pose).col(0) - Vec3(-1, 0, 0)).norm(), 1e-15);
  end.body.reset();
  EXPECT_EQ(end.pointAt(pose), Vec3(1, 0, 0));
  EXPECT_EQ(end.axesAt(pose), end.axes);
}

TEST(JointCoordinate, ofAHingeIsTheAngleOfTheFirstRelativeToTheSecond) {
  for (const double angle : {-3.0, -1.0, 0.0, 0.5, 3.0}) {
    EXPECT_NEAR(jointCoordinate(hinge(), turnedAboutZ(angle), {}), angle, 1e-15);
    EXPECT_EQ(jointCoordinate(hinge(), turnedAboutZ(angle), turnedAboutZ(1)),
              jointCoordinate(hinge(), turnedAboutZ(angle), {}));  // the other end is the world's
  }
  Joint between = hinge();
  between.to.body = 1;
  EXPECT_NEAR(jointCoordinate(between, turnedAboutZ(2), turnedAboutZ(0.5)), 1.5, 1e-15);
}

// Within half a turn from the middle of the limits: of -0.5 to 5, from -0.8916 to 5.3916.
TEST(JointCoordinate, ofALimitedHingeIsNearTheMiddleOfItsLimits) {
  const Joint limited = hinge(-0.5, 5);
  EXPECT_NEAR(jointCoordinate(limited, turnedAboutZ(4.5), {}), 4.5, 1e-15);
  EXPECT_NEAR(jointCoordinate(limited, turnedAboutZ(5.3), {}), 5.3, 1e-15);
  EXPECT_NEAR(jointCoordinate(limited, turnedAboutZ(-0.8), {}), -0.8, 1e-15);
  EXPECT_NEAR(jointCoordinate(hinge(-5, 0.5), turnedAboutZ(2), {}), 2 - 2 * kPi, 1e-15);
}

// Along the second end's axis, here the world's y.
TEST(JointCoordinate, ofASliderIsItsWay) {
  Joint slider;
  slider.kind = Joint::Kind::kSlider;
  slider.from.body = 0;
  slider.to.point = {1, 2, 3};
  slider.to.axes << 1, 0, 0, 0, 0, 1, 0, -1, 0;  // columns x, -z, y
  Pose pose;
  pose.position = {1, 2.75, 3};
  EXPECT_EQ(jointCoordinate(slider, pose, {}), 0.75);
}

TEST(Joint, onlyHingesAndSlidersHaveACoordinate) {
  int have = 0;
  for (std::size_t kind = 0; kind < kJointKindNames.size(); ++kind) {
    Joint joint;
    joint.kind = static_cast<Joint::Kind>(kind);
    have += joint.hasCoordinate() ? 1 : 0;
    EXPECT_EQ(joint.hasCoordinate(), kJointKindNames[kind] == "hinge" || kJointKindNames[kind] == "slider");
  }
  EXPECT_EQ(have, 2);
}

}  // namespace
}  // namespace careen
