#include "render/draw/shadow_map.h"

#include <gtest/gtest.h>

namespace careen {
namespace {

Vec3 mapped(const Mat4& shadow, const Vec3& point) {
  const Vec4 result = shadow * Vec4(point.x(), point.y(), point.z(), 1);
  return result.head<3>();
}

TEST(ShadowMap, holdsEverythingThatCastsShadows) {
  const Extent casters{.min = Vec3(-3, -2, 0), .max = Vec3(3, 2, 3)};
  for (const Vec3& towards : {Vec3(1, -1, 2), Vec3(0, 0, 1), Vec3(0, 1, 0), Vec3(-5, 0.1, -1)}) {
    const Mat4 shadow = shadowFromWorld(casters, towards);
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 at = mapped(shadow, casters.corner(corner));
      EXPECT_GT(at.minCoeff(), 0) << towards.transpose();
      EXPECT_LT(at.maxCoeff(), 1) << towards.transpose();
    }
  }
}

TEST(ShadowMap, depthGrowsAwayFromTheLightAndNothingElseChangesAlongIt) {
  const Vec3 towards(1, -1, 2);
  const Mat4 shadow = shadowFromWorld({.min = Vec3(-3, -2, 0), .max = Vec3(3, 2, 3)}, towards);
  const Vec3 near = mapped(shadow, Vec3(0.5, 0.5, 1));
  const Vec3 far = mapped(shadow, Vec3(0.5, 0.5, 1) - 0.3 * towards);
  EXPECT_GT(far.z(), near.z());
  EXPECT_NEAR(far.x(), near.x(), 1e-15);
  EXPECT_NEAR(far.y(), near.y(), 1e-15);
}

}  // namespace
}  // namespace careen
