#include "view/scene_extent.h"

#include <gtest/gtest.h>

#include "support/stages.h"

namespace careen {
namespace {

TEST(SceneExtent, isTheRoomWhereThereIsOne) {
  const Extent extent = extentOf(setupOf(crateInRoom()));
  EXPECT_EQ(extent.min, Vec3(-3, -2, 0));
  EXPECT_EQ(extent.max, Vec3(3, 2, 3));
  EXPECT_EQ(extent.centre(), Vec3(0, 0, 1.5));
}

// Up at 10 m/s under 10 m/s²: the top is 5 m above the start after 1 s, and after 2 s it is back.
TEST(SceneExtent, followsAThrowToItsTop) {
  Scene scene;
  scene.settings.duration = 2;
  scene.gravity = Vec3(0, 0, -10);
  scene.boxes.push_back(boxAt(Vec3(1, 1, 1), Vec3(0.3, 0.4, 1.2)));  // corners 1.3 m from the middle
  scene.boxes[0].velocity = Vec3(0, 0, 10);
  const Extent extent = extentOf(setupOf(scene));
  EXPECT_NEAR(extent.max.z(), 1 + 5 + 1.3, 1e-12);
  EXPECT_NEAR(extent.min.z(), 1 - 1.3, 1e-12);
  EXPECT_NEAR(extent.max.x(), 1 + 1.3, 1e-12);
}

// 1 s down at 1 m/s², then 2 s sideways at that: down .5 + 2 m, sideways 2 m. Fifty samples of 60 ms: the
// first second ends within one, whose mean bends the way by less than 1e-3 m.
TEST(SceneExtent, followsGravityThatChanges) {
  Scene scene;
  scene.settings.duration = 3;
  scene.gravity = Vec3(0, 0, -1);
  scene.gravityChanges = {{.time = 1, .gravity = Vec3(1, 0, 0)}};
  scene.boxes.push_back(boxAt(Vec3::Zero(), Vec3(0.3, 0.4, 1.2)));
  const Extent extent = extentOf(setupOf(scene));
  EXPECT_NEAR(extent.min.z(), -2.5 - 1.3, 1e-3);
  EXPECT_NEAR(extent.max.x(), 2 + 1.3, 1e-3);
}

TEST(SceneExtent, endsBehindAWall) {
  Scene scene;
  scene.settings.duration = 10;
  scene.gravity = Vec3(0, 0, -10);
  scene.boxes.push_back(boxAt(Vec3(0, 0, 5), Vec3(0.1, 0.1, 0.1)));
  scene.walls.push_back(wallAt(Vec3::UnitZ(), 0));
  const Extent extent = extentOf(setupOf(scene));
  EXPECT_GT(extent.min.z(), -0.2);  // without the wall: −495
  EXPECT_LT(extent.min.z(), 1.5);
}

TEST(SceneExtent, holdsWhereSpringsAreFixed) {
  Scene scene;
  scene.boxes.push_back(boxAt(Vec3::Zero(), Vec3(0.1, 0.1, 0.1)));
  Spring spring;
  spring.from.body = 0;
  spring.to.point = Vec3(0, 0, 7);
  scene.springs.push_back(spring);
  EXPECT_EQ(extentOf(setupOf(scene)).max.z(), 7);
}

TEST(SceneExtent, isSomethingEvenOfNothing) { EXPECT_GT(extentOf(RunSetup{}).radius(), 0); }

}  // namespace
}  // namespace careen
