#include "core/math/pose_difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/without_traps.h"

namespace careen {
namespace {

Mat3 turn(double angle) {
  return Quat(std::cos(angle / 2), 0.6 * std::sin(angle / 2), 0, 0.8 * std::sin(angle / 2))
      .toRotationMatrix();
}

TEST(PoseDifference, isTheAngleWhateverItsSize) {
  const Mat3 from = turn(1);
  for (const double angle : {0.0, 1e-15, 1e-9, 1e-3, 0.7, 1.5, 3.0, 3.14159}) {
    // measured 2e-16 below 1, 1.3e-15 at 3; the trace hardly changes near π
    EXPECT_NEAR(angleBetween(from, from * turn(angle)), angle, angle > 3 ? 1e-9 : 3e-15) << angle;
  }
}

TEST(PoseDifference, isRelativeToTheBodyOrAnAngle) {
  const Pose here{.position = Vec3(1, 2, 3), .worldFromBody = turn(1)};
  Pose there = here;
  there.position += Vec3(0.03, 0, 0.04);
  PoseDifference difference = differenceOf(here, there, 0.5);
  EXPECT_NEAR(difference.position, 0.05, 1e-15);
  EXPECT_EQ(difference.angle, 0);
  EXPECT_NEAR(difference.relative, 0.1, 1e-15);
  there.worldFromBody = here.worldFromBody * turn(0.2);
  EXPECT_NEAR(differenceOf(here, there, 0.5).relative, 0.2, 1e-15);
  difference.include(PoseDifference{.position = 0.01, .angle = 0.3, .relative = 0.3});
  EXPECT_NEAR(difference.position, 0.05, 1e-15);
  EXPECT_EQ(difference.angle, 0.3);
  EXPECT_EQ(difference.relative, 0.3);
}

TEST(PoseDifference, isInfiniteWhereANumberIsNone) {
  const WithoutTraps free;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Pose none;
  none.position.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(differenceOf(Pose(), none, 1).relative, kInfinity);
  none = Pose();
  none.worldFromBody(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(differenceOf(none, Pose(), 1).relative, kInfinity);
}

}  // namespace
}  // namespace careen
