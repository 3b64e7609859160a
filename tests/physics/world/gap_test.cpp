#include "physics/world/gap.h"

#include <gtest/gtest.h>

namespace careen {
namespace {

// By hand: the plane x + 2y + 2z = 9 is 3 m from the origin.
TEST(Gap, isTheDistanceOnTheFreeSideAndNegativeBehind) {
  const Wall wall{.name = "ramp", .normal = Vec3(1, 2, 2) / 3, .offset = 3, .material = {}};
  EXPECT_NEAR(gap(wall, {3, 3, 3}), 2, 1e-15);
  EXPECT_NEAR(gap(wall, {1, 2, 2}), 0, 1e-15);
  EXPECT_NEAR(gap(wall, Vec3::Zero()), -3, 1e-15);
}

}  // namespace
}  // namespace careen
