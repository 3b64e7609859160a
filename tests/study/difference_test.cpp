#include "study/difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/rotation.h"
#include "support/exact_runs.h"

namespace careen {
namespace {

Mat3 turn(double angle) {
  return Quat(std::cos(angle / 2), 0.6 * std::sin(angle / 2), 0, 0.8 * std::sin(angle / 2))
      .toRotationMatrix();
}

TEST(Difference, isTheAngleWhateverItsSize) {
  const Mat3 from = turn(1);
  for (const double angle : {0.0, 1e-15, 1e-9, 1e-3, 0.7, 1.5, 3.0, 3.14159}) {
    // measured 2e-16 below 1, 1.3e-15 at 3; near π the trace hardly changes
    EXPECT_NEAR(angleBetween(from, from * turn(angle)), angle, angle > 3 ? 1e-9 : 3e-15) << angle;
  }
}

TEST(Difference, isTheWorstOfTheBoxesThatMoveInTheirOwnSizes) {
  World world = elasticRoom();
  world.bodies.push_back(box("held", Vec3(1, 1, 1), 1, Vec3::Zero()));
  world.bodies[1].mass = immovable();
  std::vector<BodyState> a = {world.bodies[0].initial, world.bodies[1].initial};
  std::vector<BodyState> b = a;
  b[0].pose.position += Vec3(0.03, 0, 0.04);
  b[1].pose.position += Vec3(1, 0, 0);
  const PoseDifference moved = differenceOf(world, a, b);
  EXPECT_DOUBLE_EQ(moved.position, 0.05);
  EXPECT_EQ(moved.angle, 0);
  EXPECT_DOUBLE_EQ(moved.relative, 0.05 / std::sqrt(0.38));
  b[0].pose.worldFromBody = a[0].pose.worldFromBody * turn(0.3);
  EXPECT_NEAR(differenceOf(world, a, b).relative, 0.3, 1e-15);
}

TEST(Difference, isInfiniteWhereANumberIsNone) {
  const World world = elasticRoom();
  const std::vector<BodyState> a = {world.bodies[0].initial};
  std::vector<BodyState> b = a;
  b[0].pose.position.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(differenceOf(world, a, b).relative, std::numeric_limits<double>::infinity());
  b = a;
  b[0].pose.worldFromBody(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(differenceOf(world, b, a).relative, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace careen
