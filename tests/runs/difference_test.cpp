#include "runs/difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/article_equations.h"
#include "support/exact_runs.h"

namespace careen {
namespace {

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
  b[0].pose.worldFromBody = a[0].pose.worldFromBody * axisAngle(Vec3(0.6, 0, 0.8), 0.3);
  EXPECT_NEAR(differenceOf(world, a, b).relative, 0.3, 1e-15);
}

}  // namespace
}  // namespace careen
