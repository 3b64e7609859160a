#include "physics/world/control.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace careen {
namespace {

constexpr double kHalfTurn = 3.141592653589793;

TEST(MotorTarget, isASine) {
  const MotorTarget target{.offset = 1, .amplitude = 2, .frequency = 0.5, .phase = kHalfTurn / 2};
  EXPECT_NEAR(target.at(0).coordinate, 3, 1e-15);
  EXPECT_NEAR(target.at(0).rate, 0, 1e-15);
  EXPECT_NEAR(target.at(0.5).coordinate, 1, 1e-15);
  EXPECT_NEAR(target.at(0.5).rate, -2 * kHalfTurn, 1e-14);
}

// amplitude · t/2 · sin: its rate is that of the product.
TEST(MotorTarget, growsWithinItsRamp) {
  const MotorTarget target{.amplitude = 2, .frequency = 0.25, .ramp = 2};
  EXPECT_NEAR(target.at(1).coordinate, 1, 1e-15);
  EXPECT_NEAR(target.at(1).rate, 1, 1e-15);
  EXPECT_NEAR(target.at(2).coordinate, 0, 1e-15);
  EXPECT_NEAR(target.at(2).rate, -kHalfTurn, 1e-14);
}

TEST(MotorTarget, followsItsPath) {
  const MotorTarget target{.path = {{1, 2}, {3, 6}}};
  EXPECT_EQ(target.at(0.5).coordinate, 2);
  EXPECT_EQ(target.at(0.5).rate, 0);
  EXPECT_EQ(target.at(2).coordinate, 4);
  EXPECT_EQ(target.at(2).rate, 2);
  EXPECT_EQ(target.at(3).coordinate, 6);
  EXPECT_EQ(target.at(9).rate, 0);
}

TEST(MotorEfforts, areThoseOfTheirLaw) {
  Control control;
  control.motors = {{.joint = 1, .target = {.offset = 2}, .stiffness = 10, .damping = 3},
                    {.joint = 0, .gains = {{.joint = 0, .k = 1, .d = 2}, {.joint = 1, .k = -4, .d = 0}}}};
  const std::vector<JointSample> joints{{.coordinate = 0.5, .rate = 1}, {.coordinate = 1, .rate = -2}};
  const std::vector<double> efforts = motorEfforts(control, 0, joints);
  EXPECT_EQ(efforts[1], 10 * 1 + 3 * 2);
  EXPECT_EQ(efforts[0], -(0.5 + 2) + 4);
}

TEST(MotorEfforts, areNoLargerThanTheyMayBe) {
  Control control;
  control.motors = {{.joint = 0, .largest = 5, .target = {.offset = 2}, .stiffness = 10}};
  EXPECT_EQ(motorEfforts(control, 0, std::vector<JointSample>{{.coordinate = 0}})[0], 5);
  EXPECT_EQ(motorEfforts(control, 0, std::vector<JointSample>{{.coordinate = 9}})[0], -5);
}

}  // namespace
}  // namespace careen
