#include "physics/attitude/middle_axis_frame.h"

#include <gtest/gtest.h>

#include <cmath>

namespace careen {
namespace {

using Frame = MiddleAxisFrame<double>;

TEST(MiddleAxisFrame, isRightHandedAboutTheMiddleAxisForEveryOrderOfTheMoments) {
  for (const Vec3& moments :
       {Vec3(1, 2, 4), Vec3(1, 4, 2), Vec3(2, 1, 4), Vec3(2, 4, 1), Vec3(4, 1, 2), Vec3(4, 2, 1)}) {
    const Frame frame(moments);
    EXPECT_EQ(moments[frame.z], 2);
    EXPECT_EQ(Vec3::Unit(frame.x).cross(Vec3::Unit(frame.y)), frame.sign * Vec3::Unit(frame.z));
    EXPECT_EQ(moments[frame.x], 1);  // the larger rate: 1/1 − 1/2, not 1/4 − 1/2
    EXPECT_EQ(frame.alphaX, 0.5);
    EXPECT_EQ(frame.alphaY, -0.25);
  }
}

TEST(MiddleAxisFrame, leavesNothingToStepOfASphere) {
  const Frame frame(Vec3(3, 3, 3));
  EXPECT_EQ(frame.alphaX, 0);
  EXPECT_EQ(frame.alphaY, 0);
  const FreeState<double> start{unit(Quat(1, 2, 3, 4)), {3, -1, 2}};
  const FreeState<double> end = MiddleAxisState<double>(frame, start).restored(frame, 0.6);
  const Quat turn(Eigen::AngleAxisd(0.2 * start.bodyMomentum.norm(), start.bodyMomentum.normalized()));
  EXPECT_LT(((start.worldFromBody * turn).coeffs() - end.worldFromBody.coeffs()).norm(), 4e-16);
  EXPECT_EQ(end.bodyMomentum, start.bodyMomentum);
}

}  // namespace
}  // namespace careen
